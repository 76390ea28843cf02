#include "core/contact/contact_report.h"
#include "core/geometry/convex_part.h"
#include "core/motion/equilibrium.h"
#include "io/frame_writer.h"
#include "io/vtkhdf.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
enum class BlockRegime : std::uint8_t
{
    none = 0,
    force = 1,
    impulse = 2
};

BlockRegime regime_of(const BlockForce& force)
{
    if ((force.contacts & contact_impulse) != 0)
        return BlockRegime::impulse;
    return (force.contacts & contact_force) != 0 ? BlockRegime::force : BlockRegime::none;
}

/// Vertex of a part in the user's coordinates [m].
Vec2 place(const Model& model, const BlockMotion& motion, Index vertex)
{
    const Vec2& v = model.shapes.vertex[vertex];
    return model.origin + Vec2(motion.x + motion.c * v.x() - motion.s * v.y(), motion.y + motion.s * v.x() + motion.c * v.y());
}

/// One cell for each convex part of the blocks that are there, in the user's order.
struct PartCells
{
    VtkCells cells{.type = CellType::polygon, .points = {}};
    std::vector<Index> block;              ///< per cell
    std::vector<std::uint8_t> outer_edge;  ///< per vertex: the edge that begins there is on the block's outline
};

PartCells make_cells(const Model& model, const Blocks& blocks)
{
    const Shapes& shapes = model.shapes;
    PartCells parts;
    parts.cells.points.reserve(3 * shapes.vertex.size());
    parts.outer_edge.reserve(shapes.vertex.size());
    for (const Index block : model.slot_of_user)
    {
        if (blocks.present[block] == 0)
            continue;
        for (Index part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part)
        {
            for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
            {
                parts.cells.add_point(place(model, blocks.motion[block], v));
                parts.outer_edge.push_back(shapes.edge_source[v] == edge_internal ? 0 : 1);
            }
            parts.cells.end_cell();
            parts.block.push_back(block);
        }
    }
    return parts;
}

std::vector<std::uint8_t> flags_at(const std::vector<Index>& blocks, Index n)
{
    std::vector<std::uint8_t> flags(static_cast<std::size_t>(n), 0);
    for (const Index block : blocks)
        flags[block] = 1;
    return flags;
}

void write_block_data(Hdf5Writer& file, const PartCells& parts, const Model& model, const State& state)
{
    const Blocks& blocks = state.blocks;
    const std::size_t n = parts.cells.size();
    const std::vector<std::uint8_t> detached = flags_at(report_displacements(model, state).detached, model.blocks());
    const std::vector<std::uint8_t> near = flags_at(state.next_to_excavation, model.blocks());
    const std::vector<MeanStress> stress = mean_stresses(model, state);
    const auto motion = [&](std::size_t i) -> const BlockMotion& { return blocks.motion[parts.block[i]]; };

    write_cell_data<std::int32_t>(file, "id", n, [&](std::size_t i) { return model.user_number[parts.block[i]]; });
    write_cell_data<std::int32_t>(file, "material", n, [&](std::size_t i) { return model.material[parts.block[i]]; });
    write_cell_vectors(file, "displacement", n, [&](std::size_t i) { return blocks.displacement(parts.block[i]); });
    write_cell_vectors(file, "velocity", n, [&](std::size_t i) { return blocks.velocity(parts.block[i]); });
    write_cell_data<float>(file, "speed", n, [&](std::size_t i) { return blocks.velocity(parts.block[i]).norm(); });
    write_cell_data<float>(file, "rotation", n,
                           [&](std::size_t i) { return motion(i).angle - blocks.reference_angle[parts.block[i]]; });
    write_cell_data<float>(file, "angular_velocity", n, [&](std::size_t i) { return motion(i).w; });
    write_cell_data<float>(file, "kinetic_energy", n, [&](std::size_t i) { return kinetic_energy(model, blocks, parts.block[i]); });
    write_cell_data<std::uint8_t>(file, "regime", n, [&](std::size_t i) { return regime_of(blocks.force[parts.block[i]]); });
    write_cell_data<std::uint8_t>(file, "fixed", n, [&](std::size_t i) { return !blocks.is_free(parts.block[i]); });
    write_cell_data<std::uint8_t>(file, "detached", n, [&](std::size_t i) { return detached[parts.block[i]]; });
    write_cell_data<std::uint8_t>(file, "next_to_excavation", n, [&](std::size_t i) { return near[parts.block[i]]; });
    write_cell_data<float>(file, "stress_xx", n, [&](std::size_t i) { return stress[parts.block[i]].xx; });
    write_cell_data<float>(file, "stress_yy", n, [&](std::size_t i) { return stress[parts.block[i]].yy; });
    write_cell_data<float>(file, "stress_xy", n, [&](std::size_t i) { return stress[parts.block[i]].xy; });
    write_cell_data<float>(file, "stress_magnitude", n, [&](std::size_t i) { return stress[parts.block[i]].magnitude(); });
}

/// Edges that enclose what a stage removes or has removed: cut by an excavation outline, or of a block removed by its name.
void write_outlines(Hdf5Writer& file, const Model& model, const Blocks& blocks)
{
    const Shapes& shapes = model.shapes;
    std::vector<double> segments;
    std::vector<std::int32_t> excavation;
    for (Index v = 0, part = 0; v < static_cast<Index>(shapes.vertex.size()); ++v)
    {
        while (v >= shapes.vertex_begin[part + 1])
            ++part;
        const Index block = shapes.part_block[part];
        const bool by_outline = model.excavation[block] != no_index && shapes.edge_source[v] == edge_outline;
        const bool by_name = model.excavation[block] == no_index && blocks.present[block] == 0 && !model.is_wall(block) &&
                             shapes.edge_source[v] != edge_internal;
        if (!by_outline && !by_name)
            continue;
        for (const Index end : {v, shapes.next_vertex(part, v)})
        {
            const Vec2 p = place(model, blocks.motion[block], end);
            segments.insert(segments.end(), {p.x(), p.y()});
        }
        excavation.push_back(model.excavation[block]);
    }
    const std::uint64_t n = excavation.size();
    file.write("/hdem/outline_segments", segments, {n, 2, 2});
    file.write("/hdem/outline_excavation", excavation);
}

/// The water table of the stage, from one end of the model to the other; nothing where pressures do not come from one.
void write_water_table(Hdf5Writer& file, const Model& model, const State& state, const VtkCells& cells)
{
    const Water& water = model.water;
    const Index table = water.given && water.field.triangle.empty() ? water.table_of_stage[state.stage] : no_index;
    if (table == no_index || cells.points.empty())
        return;
    const Vec2 along(water.up.y(), -water.up.x());
    double low = std::numeric_limits<double>::max(), high = -low;
    for (std::size_t i = 0; i + 2 < cells.points.size(); i += 3)
    {
        const double across = (Vec2(cells.points[i], cells.points[i + 1]) - model.origin).dot(along);
        low = std::min(low, across);
        high = std::max(high, across);
    }
    std::vector<double> places{low, high}, line;
    for (const Vec2& p : water.tables[table].points)
        if (p.x() > low && p.x() < high)
            places.push_back(p.x());
    std::ranges::sort(places);
    for (const double across : places)
    {
        const Vec2 p = model.origin + across * along + water.tables[table].height(across) * water.up;
        line.insert(line.end(), {p.x(), p.y()});
    }
    file.write("/hdem/water_table", line, {places.size(), 2});
}

void write_names(Hdf5Writer& file, const Model& model)
{
    std::vector<std::string> names;
    for (const Index block : model.slot_of_user)
        names.push_back(model.name[block]);
    file.write_texts("/hdem/names", names);
    file.write_texts("/hdem/material_names", model.material_names);
    file.write_texts("/hdem/excavation_names", model.excavation_names);
}

/// Of every block that is there, once, in the user's order.
void write_bodies(Hdf5Writer& file, const Model& model, const Blocks& blocks)
{
    std::vector<std::int32_t> id;
    std::vector<double> position, area, mass;
    for (const Index block : model.slot_of_user)
    {
        if (blocks.present[block] == 0)
            continue;
        id.push_back(model.user_number[block]);
        position.insert(position.end(), {model.origin.x() + blocks.motion[block].x, model.origin.y() + blocks.motion[block].y});
        area.push_back(model.area[block]);
        mass.push_back(model.mass[block]);
    }
    file.write("/hdem/block_id", id);
    file.write("/hdem/block_position", position, {id.size(), 2});
    file.write("/hdem/block_area", area);
    file.write("/hdem/block_mass", mass);
}
}  // namespace

void write_block_frame(const std::filesystem::path& name, const Model& model, const State& state)
{
    Hdf5Writer file(name);
    const PartCells parts = make_cells(model, state.blocks);
    write_vtk_grid(file, parts.cells, state);
    write_block_data(file, parts, model, state);
    write_frame_header(file, "hdem-blocks", model, state);
    file.set_attribute("/hdem", "detached_distance", model.convergence.detached_distance);
    file.write("/hdem/outer_edge", parts.outer_edge);
    write_bodies(file, model, state.blocks);
    write_names(file, model);
    write_outlines(file, model, state.blocks);
    write_water_table(file, model, state, parts.cells);
    file.commit({}, Flush::later);
}
}  // namespace hdem
