/// hdem check: read and generate only.

#include "core/detection/edge_touch.h"
#include "core/stress/insitu_stress.h"
#include "io/atomic_file.h"
#include "io/block_shapes.h"
#include "io/load_case.h"
#include "io/polygons.h"
#include "parallel/simulation.h"
#include "tools/hdem/console.h"
#include "tools/hdem/options.h"
#include "tools/hdem/patience.h"
#include "tools/hdem/run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>

namespace hdem
{
namespace
{
void list_blocks(const Model& model, const State& state)
{
    say("{:<12} {:<12} {:>12} {:>12} {:>12} {:>12}  mobility\n", "name", "material", "area [m2]", "mass [kg]", "x [m]", "y [m]");
    for (const Index i : model.slot_of_user)
    {
        const BlockMotion& at = state.blocks.motion[i];
        say("{:<12} {:<12} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.5g}  {}{}\n", model.name[i], model.material_names[model.material[i]],
            model.area[i], model.mass[i], at.x + model.origin.x(), at.y + model.origin.y(),
            state.blocks.is_free(i) ? "free" : "fixed",
            model.excavation[i] == no_index ? "" : ", in " + model.excavation_names[model.excavation[i]]);
    }
}

/// Of all blocks, in the axes of the case: so that millimetres are seen that were meant as metres.
void describe_extent(const Model& model, const State& state)
{
    Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
    for (Index part = 0; part < model.shapes.parts(); ++part)
    {
        const BlockMotion& at = state.blocks.motion[model.shapes.part_block[part]];
        for (Index v = model.shapes.vertex_begin[part]; v < model.shapes.vertex_begin[part + 1]; ++v)
        {
            const Vec2 point = Vec2(at.x, at.y) + model.shapes.vertex[v];  // nothing has turned yet
            low = low.cwiseMin(point);
            high = high.cwiseMax(point);
        }
    }
    say("extent            x {:.6g} to {:.6g} m, y {:.6g} to {:.6g} m; a block has {:.3g} m2 on average\n",
        low.x() + model.origin.x(), high.x() + model.origin.x(), low.y() + model.origin.y(), high.y() + model.origin.y(),
        model.mean_size * model.mean_size);
}

/// Blocks that touch in a corner alone, with an edge that leaves it over the other's at an angle.
Index count_steep_corners(const Model& model, const State& state)
{
    constexpr double near = 1e-9;
    Index count = 0;
    for (Index i = 0; i < state.contacts.size(); ++i)
    {
        const Index ref = state.contacts.ref[i], inc = state.contacts.inc[i];
        const EdgeTouch touch = touch_edges(state.contacts.edges(i), state.blocks.motion[ref], state.blocks.motion[inc]);
        const double size = std::min(model.size(ref), model.size(inc));
        if (touch.length < 1e-3 * size || !is_corner_on_side(touch))
            continue;
        for (const TouchPoint& point : touch.point)
            count += std::abs(point.overlap) < near * size && std::abs(point.inside) < near * size ? 1 : 0;
    }
    return count;
}

void write_blocks(const std::string& file, const CaseDef& def)
{
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    if (!folder.empty() && !std::filesystem::exists(folder))
        throw InputError(Problem{.key = {},
                                 .text = fmt::format("--write-blocks {}: (there is no folder {}). Make it, or give another name.",
                                                     printable(file, 200), printable(folder.string(), 200))});
    const std::vector<BlockShape> shapes = block_shapes(def, generate_rock_mass(def));
    write_atomically(file, file.ends_with(".wkt") ? to_wkt(shapes) : to_geojson(shapes));
    const auto hollow = std::ranges::count_if(shapes, [](const BlockShape& shape) { return !shape.holes.empty(); });
    say("wrote             {} blocks to {}{}\n", shapes.size(), printable(file, 200),
        hollow == 0 ? "" : fmt::format("; {} of them with holes, which blocks_file does not read", hollow));
}

void describe_insitu(const Model& model, const InsituSummary& insitu)
{
    say("in-situ stress    field out of equilibrium with gravity by {:.3g} of its weight\n", insitu.field);
    if (insitu.worst != no_index)
        say("worst unbalanced  {:.3g} of the forces on block {}\n", insitu.unbalance, printable(model.name[insitu.worst]));
    for (const std::string& warning : insitu_warnings(model, insitu))
        say("warning: {}\n", warning);
    for (const StressedSet& set : insitu.sets)
        say("joints            {}: {} contacts, {:.6g} m; shear strength in use at most {:.4f}; above it or in tension {} "
            "contacts, {:.6g} m "
            "({:.4g} % "
            "of their length)\n",
            printable(set.name), set.joints, set.length, set.most_used, set.above, set.length_above,
            set.length > 0.0 ? 100.0 * set.length_above / set.length : 0.0);
}
}  // namespace

int check_command(const CheckOptions& options)
{
    std::vector<Override> overrides;
    for (const std::string& text : options.overrides)
        overrides.push_back(parse_override(text));
    std::optional<Patience> patience(
        std::in_place,
        Patience::Settings{.work = "the case is read and its model built", .begin = Patience::Clock::now(), .max_wall = {}});
    const LoadedCase loaded = load_case(options.case_file, overrides);
    Simulation simulation(loaded.setup.model, loaded.setup.state);
    const std::vector<Problem> problems = simulation.find_problems();
    patience.reset();
    const Model& model = simulation.model();
    const State& state = simulation.state();

    if (options.list_blocks)
        list_blocks(model, state);
    Index free = 0;
    double smallest = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < model.blocks(); ++i)
        if (state.blocks.is_free(i))
        {
            ++free;
            smallest = std::min(smallest, model.mass[i]);
        }
    const RockMass& rock = loaded.setup.rock;
    say("blocks            {} ({} free)\n", model.blocks(), free);
    say("smallest free     {:.6g} kg\n", smallest);
    describe_extent(model, state);
    if (rock.joints > 0)
        say("joints            {}\n", describe_cuts(rock));
    for (const std::string& line : describe_sets(rock))
        say("                  {}\n", line);
    if (const Index corners = count_steep_corners(model, state); corners > 0)
        say("corners           {} pairs of blocks touch in a corner alone, where three joints cross in a point. The rock is "
            "stiffer "
            "there than its joints say: give joint sets different origins\n",
            corners);
    if (!options.blocks_file.empty())
        write_blocks(options.blocks_file, loaded.file.def);
    say("time step         {:.6g} s\n", model.time_step);
    say("step of Eq. (32)  {:.6g} s\n", model.paper_time_step);
    say("stable limit      {:.6g} s (2/omega_max of the present contacts)\n", simulation.critical_step());
    if (model.insitu.given)
        describe_insitu(model, summarise_insitu(model, state));
    say("threshold scale   {:.6g}\n", model.threshold_scale);
    for (const Problem& warning : loaded.warnings)
        say("{}\n", warning.text);
    if (!problems.empty())
        throw InputError(loaded.file.source.located(problems));
    return exit_done;
}
}  // namespace hdem
