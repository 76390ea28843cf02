#include "core/rock/build_model.h"

#include "core/boundary/resolve_boundaries.h"
#include "core/geometry/polygon.h"
#include "core/geometry/smallest_rectangle.h"
#include "core/geometry/space_curve.h"
#include "core/geometry/unit_direction.h"
#include "core/motion/time_step.h"
#include "core/rock/joint_laws.h"
#include "core/rock/resolve_names.h"
#include "core/stage/rules.h"
#include "core/stress/insitu_stress.h"
#include "core/support/resolve_support.h"
#include "core/water/resolve_water.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

namespace hdem
{
namespace
{
struct BlockMoments
{
    AreaMoments of;
    double radius;
};

BlockMoments block_moments(const RockBlock& block)
{
    std::vector<AreaMoments> parts;
    for (const ConvexPart& part : block.parts)
        parts.push_back(area_moments(part.vertices));
    BlockMoments moments{combined(parts), 0.0};
    for (const ConvexPart& part : block.parts)
        for (const Vec2& v : part.vertices)
            moments.radius = std::max(moments.radius, (v - moments.of.centroid).norm());
    return moments;
}

/// Of the rock, without walls of sides.
std::span<const RockBlock> rock_of(const RockMass& rock)
{
    return {rock.blocks.data(), rock.blocks.size() - rock.walls.size()};
}

Box bounding_box_of(std::span<const RockBlock> blocks)
{
    Box box = bounding_box(blocks.front().parts.front().vertices);
    for (const RockBlock& block : blocks)
        for (const ConvexPart& part : block.parts)
        {
            const Box b = bounding_box(part.vertices);
            box = {box.low.cwiseMin(b.low), box.high.cwiseMax(b.high)};
        }
    return box;
}

/// A model far from the user's origin would lose digits of every centroid.
void move_blocks(RockMass& rock, const Vec2& way)
{
    const auto move = [&](SideEdge& edge)
    {
        edge.from += way;
        edge.to += way;
    };
    for (RockBlock& block : rock.blocks)
    {
        for (ConvexPart& part : block.parts)
            for (Vec2& vertex : part.vertices)
                vertex += way;
        std::ranges::for_each(block.sides, move);
    }
    for (RockWall& wall : rock.walls)
        move(wall.edge);
}

/// Eq. (28): model area over the area of a block, here the mean one. The model's width and height are those of the smallest
/// rectangle around it: along the axes of x and y a turned model would have another threshold.
/// @param origin  of the model in the blocks' coordinates
double size_ratio(std::span<const RockBlock> blocks, const Vec2& origin, double mean_size)
{
    SmallestRectangle around;
    for (const RockBlock& block : blocks)
        for (const ConvexPart& part : block.parts)
        {
            std::vector<Vec2> points = part.vertices;
            for (Vec2& point : points)
                point -= origin;
            around.add(points);
        }
    return around.area() / (mean_size * mean_size);
}

void add_part(Shapes& shapes, const ConvexPart& part, const Vec2& centroid, Index block)
{
    const std::size_t n = part.vertices.size();
    Vec2 low = part.vertices[0] - centroid, high = low;
    for (std::size_t i = 0; i < n; ++i)
    {
        const Vec2 v = part.vertices[i] - centroid;
        const Vec2 edge = part.vertices[next(i, n)] - part.vertices[i];
        shapes.vertex.push_back(v);
        shapes.edge_length.push_back(edge.norm());
        shapes.edge_tangent.push_back(edge / edge.norm());
        shapes.edge_source.push_back(part.source[i]);
        low = low.cwiseMin(v);
        high = high.cwiseMax(v);
    }
    shapes.part_block.push_back(block);
    shapes.vertex_begin.push_back(static_cast<Index>(shapes.vertex.size()));
    shapes.part_centre.push_back(0.5 * (low + high));
    shapes.part_radius.push_back(0.5 * (high - low).norm());
}

/// @param density  0 of a wall, which nothing but its side moves
void add_block(Model& model, const RockBlock& block, const BlockMoments& moments, double density, Index material)
{
    const Index number = model.blocks();
    model.name.push_back(block.name);
    model.material.push_back(material);
    model.excavation.push_back(block.excavation);
    model.area.push_back(moments.of.area);
    model.mass.push_back(density * moments.of.area);
    model.inertia.push_back(density * moments.of.polar);
    model.full_inertia.push_back(
        density > 0.0 ? BlockInertia{1.0 / model.mass.back(), 1.0 / model.mass.back(), 1.0 / model.inertia.back(), 0.0}
                      : BlockInertia{});
    model.radius.push_back(moments.radius);
    for (const ConvexPart& part : block.parts)
        add_part(model.shapes, part, moments.of.centroid, number);
    model.shapes.part_begin.push_back(model.shapes.parts());
}

void add_law_of_walls(Index standard, JointTable& table)
{
    table.of_walls = static_cast<Index>(table.laws.size());
    table.laws.push_back(law_of_walls(table.laws[standard]));
    table.unbonded.push_back(table.of_walls);
    if (table.has_memory())
        table.rows.emplace_back();
}

void add_joints(const CaseDef& def, Model& model)
{
    JointTable& table = model.joints;
    const auto n = static_cast<Index>(def.materials.size());
    table.materials = n;
    Index fallback = 0;
    for (std::size_t j = 0; j < def.joints.size(); ++j)
        if (def.joints[j].name == "default")
            fallback = static_cast<Index>(j);
    if (!def.boundaries.empty())
        add_law_of_walls(fallback, table);
    table.of_materials.assign(static_cast<std::size_t>(n * n), fallback);
    const auto joint_named = [&](const std::string& name)
    {
        const auto at = std::find(table.names.begin(), table.names.end(), name);
        return at == table.names.end() ? no_index : static_cast<Index>(at - table.names.begin());
    };
    for (std::size_t j = 0; j < def.joints.size(); ++j)
    {
        if (def.joints[j].materials.size() != 2)
            continue;
        const Index a = material_number(def, def.joints[j].materials[0]);
        const Index b = material_number(def, def.joints[j].materials[1]);
        table.of_materials[a * n + b] = table.of_materials[b * n + a] = static_cast<Index>(j);
    }
    for (const FaultDef& fault : def.faults)  // in the order of EdgeSources
        table.of_joint_set.push_back(fault.joint.empty() ? no_index : joint_named(fault.joint));
    for (const RegionDef& region : def.regions)
        table.of_joint_set.push_back(region.joint.empty() ? no_index : joint_named(region.joint));
    for (const JointSetDef& set : def.joint_sets)
        table.of_joint_set.push_back(set.joint.empty() ? no_index : joint_named(set.joint));
    table.of_joint_set.push_back(def.domain.traces_joint.empty() ? no_index
                                                                 : joint_named(def.domain.traces_joint));  // of all traces
    if (def.voronoi.given)
        table.of_joint_set.push_back(def.voronoi.joint.empty() ? no_index : joint_named(def.voronoi.joint));
}

double smallest_free_mass(const Model& model, const Blocks& blocks)
{
    double mass = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < model.blocks(); ++i)
        if (blocks.is_free(i))
            mass = std::min(mass, model.mass[i]);
    return mass;
}

/// The blocks with those free that a stage frees: a time step must be good for them too.
Blocks with_freed_names(const Model& model, Blocks blocks)
{
    for (const StageDef& stage : model.stages)
        for (const std::string& name : stage.free)
            if (const Index block = model.find_block(name); block != no_index)
                blocks.inertia[block] = model.full_inertia[block];
    return blocks;
}

double greatest_stiffness(const JointTable& joints)
{
    double stiffness = 0.0;
    for (const CoulombSlip& joint : joints.laws)
        stiffness = std::max({stiffness, joint.normal_stiffness, joint.shear_stiffness});
    return stiffness;
}

/// Of all stages.
double greatest_stiffness(const Model& model)
{
    double stiffness = greatest_stiffness(model.joints);
    for (const StageLaws& stage : model.stage_laws)
        for (const CoulombSlip& joint : stage.laws)
            stiffness = std::max({stiffness, joint.normal_stiffness, joint.shear_stiffness});
    return stiffness;
}

/// The least mass that each block has in a stage [kg].
std::vector<double> least_masses(const Model& model)
{
    std::vector<double> least = model.density;
    for (const std::vector<double>& stage : model.stage_densities)
        for (std::size_t m = 0; m < stage.size(); ++m)
            least[m] = std::min(least[m], stage[m]);
    std::vector<double> masses = model.mass;
    for (std::size_t b = 0; b < masses.size(); ++b)
        masses[b] *= least[static_cast<std::size_t>(model.material[b])] /
                     model.density[static_cast<std::size_t>(model.material[b])];
    return masses;
}

/// By a stage.
bool is_stiffness_changed(const Model& model)
{
    const auto is_changed = [&](const StageLaws& stage)
    {
        for (std::size_t i = 0; i < stage.laws.size(); ++i)
            if (stage.laws[i].normal_stiffness != model.joints.laws[i].normal_stiffness)
                return true;
        return false;
    };
    return std::ranges::any_of(model.stage_laws, is_changed);
}

/// @param origin  of the model in the blocks' coordinates
void add_initial_state(const RockMass& rock, const std::vector<Index>& order, const std::vector<BlockMoments>& moments,
                       const Vec2& origin, const Model& model, State& state)
{
    Blocks& blocks = state.blocks;
    const auto n = static_cast<std::size_t>(model.blocks());
    blocks.motion.resize(n);
    blocks.force.resize(n);
    blocks.inertia.resize(n);
    blocks.stable_step.assign(n, 0.0);
    blocks.rest.assign(n, 0);
    blocks.margin.assign(n, model.contact.skin * model.mean_size);
    blocks.present.assign(n, 1);
    for (Index i = 0; i < model.blocks(); ++i)
    {
        const RockBlock& from = rock.blocks[order[i]];
        const Vec2 at = moments[order[i]].of.centroid - origin;
        blocks.motion[i] = {.x = at.x(), .y = at.y(), .vx = from.velocity.x(), .vy = from.velocity.y(), .w = from.angular_velocity};
        blocks.inertia[i] = model.full_inertia[i];
        if (from.fix_x)
            blocks.inertia[i].inverse_mass_x = 0.0;
        if (from.fix_y)
            blocks.inertia[i].inverse_mass_y = 0.0;
        if (from.fix_rotation)
            blocks.inertia[i].inverse_inertia = 0.0;
        blocks.reference_position.push_back(at);
        blocks.reference_angle.push_back(0.0);
    }
}

}  // namespace

Vec2 tilted_gravity(const CaseDef& def)
{
    if (def.gravity_tilt_deg == 0.0)
        return def.gravity;
    const Vec2 d = unit_direction(def.gravity_tilt_deg);
    return {d.x() * def.gravity.x() + d.y() * def.gravity.y(), d.x() * def.gravity.y() - d.y() * def.gravity.x()};
}

void set_mobility(const Model& model, Index block, bool is_free, Blocks& blocks)
{
    blocks.inertia[block] = is_free ? model.full_inertia[block] : BlockInertia{};
    if (!is_free)
    {
        BlockMotion& motion = blocks.motion[block];
        motion.vx = motion.vy = motion.w = 0.0;
    }
}

Setup build_model(const CaseDef& def)
{
    Setup setup;
    RockMass rock = generate_rock_mass(def);
    if (rock.blocks.empty())
        throw InputError(Problem{.key = "domain",
                                 .text = "rock mass: blocks = 0 (nothing to compute). Give a [domain] or at least one [[block]]."});
    Model& model = setup.model;
    Box box = bounding_box_of(rock_of(rock));
    model.title = def.title;
    // A whole number of metres, so that subtracting it is exact for coordinates of up to 1e9 m given to a micrometre.
    model.origin = (0.5 * (box.low + box.high)).array().round();
    model.centre = 0.5 * (box.low + box.high) - model.origin;
    const Vec2 extent = box.high - box.low;
    model.lost_beyond = 0.5 * extent.norm() + def.convergence.lost_distance.value_or(10.0 * extent.maxCoeff());

    Vec2 origin = model.origin;
    if (origin.norm() > extent.norm())
    {
        move_blocks(rock, -origin);
        box = {box.low - origin, box.high - origin};
        origin = {0.0, 0.0};
    }
    std::vector<BlockMoments> moments;
    moments.reserve(rock.blocks.size());
    for (const RockBlock& block : rock.blocks)
        moments.push_back(block_moments(block));
    std::vector<Vec2> centroids;
    for (const BlockMoments& block : moments)
        centroids.push_back(block.of.centroid);
    const std::vector<Index> order = curve_order(centroids, box);
    model.shapes.part_begin.push_back(0);
    model.shapes.vertex_begin.push_back(0);
    double total_area = 0.0;
    for (const Index user : order)
    {
        const Index material = material_number(def, rock.blocks[user].material);
        const bool is_rock = static_cast<std::size_t>(user) < rock_of(rock).size();
        add_block(model, rock.blocks[user], moments[user], is_rock ? def.materials[material].density : 0.0, material);
        total_area += is_rock ? moments[user].of.area : 0.0;
    }
    model.user_number = order;
    model.slot_of_user.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i)
        model.slot_of_user[order[i]] = static_cast<Index>(i);
    for (const MaterialDef& material : def.materials)
        model.material_names.push_back(material.name);
    for (const ExcavationDef& excavation : def.excavations)
        model.excavation_names.push_back(excavation.name);
    for (const FaultDef& fault : def.faults)
        model.joint_set_names.push_back("fault " + fault.name);
    for (const RegionDef& region : def.regions)
        model.joint_set_names.push_back("outline of " + region.name);
    for (const JointSetDef& set : def.joint_sets)
        model.joint_set_names.push_back(set.name);
    if (def.insitu.given)
    {
        const std::string& material = def.domain.given ? def.domain.material : rock.blocks.front().material;
        model.insitu = make_field(def.insitu, def.materials[material_number(def, material)].density, tilted_gravity(def),
                                  model.origin);
    }
    model.mean_size = std::sqrt(total_area / static_cast<double>(rock_of(rock).size()));
    const JointSurroundings around{
        .normal_stress = expected_stress(def, model.insitu, box.low.y() - origin.y(), box.high.y() - origin.y(), model.mean_size),
        .block_size = model.mean_size,
        .restitution = def.contact.restitution,
        .reach = 0.5 * def.contact.skin * model.mean_size};
    add_laws(def, around, model.joints);
    model.stage_laws = laws_of_stages(def, around);
    for (const MaterialDef& material : def.materials)
        model.density.push_back(material.density);
    for (const StageDef& stage : def.stages)
    {
        model.stage_densities.emplace_back();
        for (const MaterialDef& material : stage.materials)
            model.stage_densities.back().push_back(material.density);
    }
    add_joints(def, model);
    setup.state.contacts.has_memory = model.joints.has_memory();
    setup.state.contacts.has_preload = def.insitu.given || model.joints.has_memory() || is_stiffness_changed(model);

    model.gravity = tilted_gravity(def);
    model.contact = def.contact;
    model.damping = def.damping;
    model.convergence = def.convergence;
    model.output = def.output;
    model.stages = def.stages;
    model.histories = def.histories;

    model.holds_mean = def.domain.hold == DomainHold::mean;
    add_initial_state(rock, order, moments, origin, model, setup.state);
    std::vector<Problem> problems = resolve_boundaries(def, rock, origin, model, setup.state.blocks);
    std::ranges::move(resolve_water(def, model.origin, setup.state.blocks, model), std::back_inserter(problems));
    std::ranges::move(resolve_support(def, setup.state.blocks, model, setup.state.support), std::back_inserter(problems));
    setup.state.method = def.contact.method;
    setup.state.damping = def.damping.preset;
    const Blocks free_at_times = with_freed_names(model, with_freed_sides(model, setup.state.blocks));
    std::vector<double> masses = least_masses(model);
    std::swap(masses, model.mass);  // the step must be good in all stages
    const double smallest = smallest_free_mass(model, free_at_times);
    const double stiffest = greatest_stiffness(model);
    model.paper_time_step = paper_time_step(smallest, stiffest, def.time.fraction);
    model.default_time_step = takes_paper_step(def) ? model.paper_time_step
                                                    : default_time_step(model, free_at_times, stiffest, def.time.fraction);
    std::swap(masses, model.mass);
    model.time_step = def.time.step.value_or(model.default_time_step);
    setup.state.blocks.step = {model.time_step, model.time_step};
    model.is_driven = have_driven_blocks(def);
    model.has_step = def.time.step.has_value();
    model.stable_fraction = def.time.stable_fraction;
    model.threshold_scale = def.contact.threshold_scale ? *def.contact.threshold_scale
                                                        : size_ratio(rock_of(rock), origin, model.mean_size);

    std::ranges::move(resolve_names(def, model, setup.state.blocks), std::back_inserter(problems));
    if (!std::isfinite(smallest))
        problems.push_back({.key = "domain.fixed",
                            .text = "rock mass: free blocks = 0 (every block is fixed, and no stage frees one: nothing can move). "
                                    "Free at least one block."});
    for (Problem& problem : rock.warnings)
        problems.push_back(std::move(problem));
    std::erase_if(problems,
                  [&](const Problem& problem)
                  {
                      if (problem.severity == Problem::Severity::warning)
                          setup.warnings.push_back(problem);
                      return problem.severity == Problem::Severity::warning;
                  });
    if (!problems.empty())
        throw InputError(std::move(problems));
    rock.blocks.clear();
    setup.rock = std::move(rock);
    return setup;
}
}  // namespace hdem
