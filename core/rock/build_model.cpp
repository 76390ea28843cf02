#include "core/rock/build_model.h"

#include "core/boundary/resolve_boundaries.h"
#include "core/geometry/unit_direction.h"
#include "core/motion/time_step.h"
#include "core/rock/joint_laws.h"
#include "core/rock/joint_table.h"
#include "core/rock/model_blocks.h"
#include "core/rock/resolve_names.h"
#include "core/stage/properties.h"
#include "core/stage/rules.h"
#include "core/statics/static_blocks.h"
#include "core/stress/insitu_stress.h"
#include "core/support/resolve_support.h"
#include "core/water/resolve_water.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace hdem
{
namespace
{
double smallest_free_mass(const Model& model, const Blocks& blocks)
{
    double mass = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < model.blocks(); ++i)
        if (blocks.is_free(i))
            mass = std::min(mass, model.mass[i]);
    return mass;
}

/// The blocks with those free that a stage frees: the time step must be stable for these, too.
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

void add_names(const CaseDef& def, Model& model)
{
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
}

/// Laws of the joints, densities of the materials, and what stages make of both.
void add_joints_and_densities(const CaseDef& def, const RockMass& rock, const PlacedRock& placed, Model& model)
{
    RockExtent extent{.low = placed.box.low.y() - placed.origin.y(),
                      .high = placed.box.high.y() - placed.origin.y(),
                      .along_gravity = extent_along(tilted_gravity(def), rock, placed),
                      .along_loads = {},
                      .block_size = model.mean_size};
    for (const LoadDef& load : def.loads)
        extent.along_loads.push_back(extent_along(load.acceleration, rock, placed));
    const JointSurroundings around{.normal_stress = expected_stress(def, model.insitu, extent),
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
    assign_joints(def, model);
}

/// A static solution is asked for, and there will be none.
void warn_of_few_blocks(const CaseDef& def, const Blocks& blocks, std::vector<Problem>& problems)
{
    Index free = 0;
    for (Index b = 0; b < blocks.size(); ++b)
        free += blocks.is_free(b) ? 1 : 0;
    if (free >= least_static_blocks)
        return;
    const std::vector<StageRules> rules = resolve_rules(def);
    for (std::size_t s = 0; s < def.stages.size(); ++s)
        if (rules[s].tries_statics)
            problems.push_back({.severity = Problem::Severity::warning,
                                .key = "stage[" + std::to_string(s) + "].solver",
                                .text = "stage \"" + def.stages[s].name + "\": solver = \"static\" (has no effect: there are " +
                                        std::to_string(free) + " free blocks, and below " + std::to_string(least_static_blocks) +
                                        " cycles are as fast). Remove this key."});
}

/// Nothing bears the weight of any block, in no stage.
bool falls_as_a_whole(const CaseDef& def, const Model& model, const Blocks& blocks)
{
    const auto is_held = [&](Index block) { return !blocks.is_free(block) || model.is_wall(block); };
    return model.gravity.norm() > 0.0 && def.boundaries.empty() && def.loads.empty() && def.bolts.empty() && !def.water.given &&
           std::ranges::none_of(def.stages, [](const StageDef& stage) { return !stage.fix.empty(); }) &&
           std::ranges::none_of(model.slot_of_user, is_held);
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
    model.title = def.title;
    const PlacedRock placed = place_rock(rock, model);
    model.lost_beyond = 0.5 * placed.extent.norm() + def.convergence.lost_distance.value_or(10.0 * placed.extent.maxCoeff());
    add_blocks(def, rock, placed, model);
    add_names(def, model);
    if (def.insitu.given)
    {
        const std::string& material = def.domain.given ? def.domain.material : rock.blocks.front().material;
        model.insitu = make_field(def.insitu, def.materials[material_number(def, material)].density, tilted_gravity(def),
                                  model.origin);
    }
    add_joints_and_densities(def, rock, placed, model);
    setup.state.contacts.has_memory = model.joints.has_memory();
    setup.state.contacts.has_preload = needs_preload(model);

    model.gravity = tilted_gravity(def);
    model.contact = def.contact;
    model.damping = def.damping;
    model.convergence = def.convergence;
    model.output = def.output;
    model.stages = def.stages;
    model.histories = def.histories;

    model.holds_mean = def.domain.hold == DomainHold::mean;
    add_initial_state(rock, placed, model, setup.state);
    model.start = setup.state.blocks.reference_position;
    std::vector<Problem> problems = resolve_boundaries(def, rock, placed.origin, model, setup.state.blocks);
    const Blocks free_at_times = with_freed_names(model, with_freed_sides(model, setup.state.blocks));
    std::ranges::move(resolve_water(def, model.origin, free_at_times, model), std::back_inserter(problems));
    std::ranges::move(resolve_support(def, setup.state.blocks, model, setup.state.support), std::back_inserter(problems));
    setup.state.method = def.contact.method;
    setup.state.damping = def.damping.preset;
    std::vector<double> masses = least_masses(model);
    std::swap(masses, model.mass);  // the step must be good in all stages
    const double smallest = smallest_free_mass(model, free_at_times);
    const double stiffest = model.greatest_stiffness = greatest_stiffness(model);
    model.paper_time_step = paper_time_step(smallest, stiffest, def.time.fraction);
    model.default_time_step = takes_paper_step(def) ? model.paper_time_step
                                                    : default_time_step(model, free_at_times, stiffest, def.time.fraction);
    std::swap(masses, model.mass);
    model.time_step = def.time.step.value_or(model.default_time_step);
    setup.state.blocks.step = {model.time_step, model.time_step};
    model.is_driven = have_driven_blocks(def);
    model.has_step = def.time.step.has_value();
    model.stable_fraction = def.time.stable_fraction;
    model.threshold_scale = def.contact.threshold_scale ? *def.contact.threshold_scale : size_ratio(rock, placed, model.mean_size);

    std::ranges::move(resolve_names(def, model, setup.state.blocks, free_at_times), std::back_inserter(problems));
    if (!std::isfinite(smallest))
        problems.push_back({.key = "domain.fixed",
                            .text = "rock mass: free blocks = 0 (every block is fixed, and no stage frees one: nothing can move). "
                                    "Free at least one block."});
    if (falls_as_a_whole(def, model, free_at_times))
        problems.push_back({.severity = Problem::Severity::warning,
                            .key = {},
                            .text = "rock mass: no block is fixed, and no side or bolt holds one (all of it falls). Set "
                                    "domain.fixed, or fixed = true of a block."});
    warn_of_few_blocks(def, free_at_times, problems);
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
