#include "core/stage/rules.h"

#include "core/boundary/resolve_boundaries.h"
#include "core/motion/released_forces.h"
#include "core/stage/load_changes.h"
#include "core/support/installed_support.h"

#include <algorithm>
#include <utility>

namespace hdem
{
namespace
{
ContactLaw law_of(Method method)
{
    return method == Method::force ? ContactLaw::springs
                                   : (method == Method::impulse ? ContactLaw::impulses : ContactLaw::by_speed);
}

/// Limits of rest. While some blocks still move, a block rests if it is out of balance by less than a thousandth of its weight on average, and by a few
/// thousandths in single cycles, where a corner rattles. A hundredth wakes it, which changes the closure of its joints by less than 1e-7 m. When no
/// block moves any more, all settle together: a block rests at a hundredth of the unbalance with which the stage may end, and a half of that unbalance wakes it.
RestRule rest_of(const StageSetting& s, double g)
{
    const double at_end = std::min(s.convergence.block_unbalanced_ratio, s.convergence.unbalanced_force_ratio) * g;
    const RestRule calm{.leaves_out = true,
                        .quiet_speed = 0.2 * s.convergence.mean_speed,
                        .quiet = 0.01 * at_end,
                        .waking = 0.5 * at_end,
                        .quiet_at_end = 0.01 * at_end};
    if (s.is_calm)
        return calm;
    RestRule moving = calm;
    moving.quiet = std::max(at_end, 5e-3 * g);
    moving.quiet_on_average = std::max(at_end, 8e-4 * g);
    moving.waking = std::max(at_end, 0.01 * g);
    return moving;
}

/// Of the mean speed at which rock counts as at rest: slower blocks are damped as if they did not slide.
constexpr double settling_speeds = 40.0;

/// Of the same: while rock that stands is faster a given step is kept.
constexpr double slow_speeds = 10.0;

/// Rock that vibrates is slower, blocks that hit are faster [m/s] (core/tried.md, "Damping in the cycle in which a motion turns round").
constexpr double impact_speed = 0.04;

/// Blocks that fall or slide together are free of local damping. Where rest is looked for slower ones are damped in any case; elsewhere as soon as they are faster than
/// rock at rest.
GroupRule groups_of(const StageSetting& s, double settling)
{
    if (s.preset != DampingPreset::automatic || s.damping.local == 0.0 || s.method == Method::impulse)
        return {};
    if (settling == 0.0)
        return {.speed = s.convergence.mean_speed};
    GroupRule rule{.speed = 2.0 * settling, .seeks_rest = true};
    if (!s.is_driven && !s.loads_change)  // else blocks may go one way with what moves them
        rule.loose_distance = s.convergence.loose_distance;
    return rule;
}

/// Where forces of excavated blocks are taken off slowly, cycles and a static solution come to the same answer (verification/README.md, statics.slow); where they vanish at once,
/// rock swings and slips farther. Histories are to show what lies between.
bool seeks_statics(const StageSetting& s)
{
    return s.solver == RestSolver::statics || (s.solver == RestSolver::automatic && s.relaxes && s.is_large && !s.has_histories);
}

StageSetting setting_of(const Model& model, const State& state)
{
    constexpr Index least_blocks = 1000;  // perf/README.md, "Static solutions"
    const bool begun = state.stage_begun;
    return {.method = state.method,
            .preset = state.damping,
            .damping = model.damping,
            .stable_fraction = model.stable_fraction,
            .convergence = model.convergence,
            .gravity = model.gravity.norm(),
            .until_converged = begun && model.stages[state.stage].until_converged,
            .has_loads = !model.loads.empty(),
            .has_support = has_support(state.support),
            .has_water = model.water.given,
            .loads_change = state.cycle < steady_from(model, state),
            .tractions_change = do_tractions_change(model, state),
            .times_to_come = are_times_to_come(model, state),
            .releases = are_forces_released(model, state),
            .holds_released = !state.released.empty(),
            .is_calm = state.is_calm,
            .is_driven = is_driven(model, state),
            .moves_walls = do_walls_move(model, state),
            .holds_mean = model.holds_mean,
            .has_step = model.has_step,
            .keeps_released = begun && model.stages[state.stage].relax_to > 0.0,
            .relaxes = begun && model.stages[state.stage].relax_cycles > 0,
            .is_large = model.blocks() >= least_blocks,
            .has_histories = !model.histories.empty(),
            .solver = begun ? model.stages[state.stage].solver : RestSolver::dynamics};
}

/// The published scheme has the sweeps of the cycle only.
ExactIslands islands_of(DampingPreset preset, bool looks_for_rest)
{
    if (looks_for_rest)
        return ExactIslands::small;
    return preset == DampingPreset::paper ? ExactIslands::great_mass_ratios : ExactIslands::hit;
}
}  // namespace

StageRules resolve_rules(const StageSetting& s)
{
    const bool looks_for_rest = s.until_converged && s.preset == DampingPreset::automatic;
    const double g = s.gravity > 0.0 ? s.gravity : 9.81;
    const double settling = looks_for_rest ? settling_speeds * s.convergence.mean_speed : 0.0;
    const bool is_steady = !s.is_driven && !s.loads_change;
    const bool whole_cycles = s.preset == DampingPreset::paper;
    return {.contact = {.law = law_of(s.method),
                        .rock_keeps_springs = looks_for_rest,
                        .corners_keep_springs = s.preset == DampingPreset::automatic,
                        .lifted_stay_closed = looks_for_rest,
                        .closing = whole_cycles ? Closing::whole_cycles : Closing::fast_points,
                        .closing_speed = settling},
            .islands = islands_of(s.preset, looks_for_rest),
            .damping = {.local = s.preset == DampingPreset::dynamic ? 0.0 : s.damping.local,
                        .global = 2.0 * s.damping.global_damping_ratio * s.damping.average_frequency,
                        .form = s.preset == DampingPreset::automatic ? LocalDamping::along_joint : LocalDamping::by_axis,
                        .settling = settling,
                        .turning = impact_speed,
                        .follows_support = s.preset == DampingPreset::automatic && s.is_driven && !s.moves_walls},
            .groups = groups_of(s, settling),
            .step = {.varies = looks_for_rest && is_steady && !s.times_to_come,
                     .keeps_given = s.has_step,
                     .flies_ahead = looks_for_rest && is_steady && !s.times_to_come && !s.releases && !s.has_water,
                     .stable_share = s.stable_fraction,
                     .falls_by = s.method == Method::impulse ? g : 0.0,
                     .slow = slow_speeds * s.convergence.mean_speed,
                     .loose_distance = s.convergence.loose_distance},
            // A block that is left out would not follow those that are held with it.
            .rest = looks_for_rest && is_steady && !s.releases && !s.holds_mean ? rest_of(s, g) : RestRule{},
            .water = looks_for_rest ? WaterRule{.while_floating = 16, .drag = 0.3} : WaterRule{},
            .ends_at_rest = s.until_converged,
            .has_loads = s.has_loads || s.releases || s.holds_released,
            .has_support = s.has_support,
            .tractions_change = s.tractions_change,
            .moves_walls = s.moves_walls,
            .tries_statics = looks_for_rest && is_steady && !s.has_loads && !s.has_support && !s.holds_mean && !s.keeps_released &&
                             s.method != Method::impulse && s.gravity > 0.0 && seeks_statics(s)};
}

StageRules resolve_rules(const Model& model, const State& state)
{
    return resolve_rules(setting_of(model, state));
}

StageRules approach_rules(const Model& model, const State& state)
{
    StageSetting setting = setting_of(model, state);
    setting.method = Method::force;
    StageRules rules = resolve_rules(setting);
    rules.damping.frees_sliding = false;                                    // what slides is not to go far, but to be named
    rules.groups.loose_distance = std::numeric_limits<double>::infinity();  // nor what creeps
    rules.damping.turning = above_all_speeds;                               // what comes away is to be slow
    return rules;
}

std::vector<StageRules> resolve_rules(const CaseDef& def)
{
    std::vector<StageRules> rules;
    rules.reserve(def.stages.size());
    StageSetting setting{.method = def.contact.method,
                         .preset = def.damping.preset,
                         .damping = def.damping,
                         .stable_fraction = def.time.stable_fraction,
                         .convergence = def.convergence,
                         .gravity = def.gravity.norm(),
                         .has_loads = !def.loads.empty(),
                         .has_support = !def.bolts.empty() || !def.liners.empty(),
                         .has_water = def.water.given,
                         .is_driven = is_driven(def),
                         .holds_mean = def.domain.hold == DomainHold::mean,
                         .has_step = def.time.step.has_value()};
    for (const StageDef& stage : def.stages)
    {
        setting.method = stage.method.value_or(setting.method);
        setting.preset = stage.damping.value_or(setting.preset);
        setting.until_converged = stage.until_converged;
        setting.solver = stage.solver;
        setting.keeps_released = stage.relax_to > 0.0;
        setting.relaxes = stage.relax_cycles > 0;
        setting.moves_walls = std::ranges::any_of(def.boundaries, [&](const BoundaryDef& side)
                                                  { return moves_walls(side.kind) && acts_in(side, stage.name); });
        setting.is_driven = is_driven(def) || setting.moves_walls;
        rules.push_back(resolve_rules(setting));
    }
    return rules;
}

bool ends_at_rest(const StageDef& stage)
{
    return stage.until_converged;
}

bool asks_for_statics(const StageDef& stage)
{
    return stage.solver == RestSolver::statics;
}

StageDef stage_until_rest(std::string name)
{
    return {.name = std::move(name),
            .cycles = {},
            .duration = {},
            .until_converged = true,
            .max_cycles = std::numeric_limits<std::int64_t>::max() / 2,
            .method = Method::force,
            .damping = DampingPreset::automatic};
}

bool is_by_impulses(Method method)
{
    return method == Method::impulse;
}

bool has_impulses_alone(const CaseDef& def)
{
    return is_by_impulses(def.contact.method) ||
           std::ranges::any_of(def.stages, [](const StageDef& stage) { return stage.method && is_by_impulses(*stage.method); });
}

bool begins_with_empty_springs(std::size_t stage, Method last, Method now, bool has_stress)
{
    return !has_stress && (stage == 0 || (is_by_impulses(last) && !is_by_impulses(now)));
}

std::vector<const StageDef*> stages_with_empty_springs(const CaseDef& def)
{
    std::vector<const StageDef*> found;
    Method last = def.contact.method;
    for (std::size_t i = 0; i < def.stages.size(); ++i)
    {
        const Method now = def.stages[i].method.value_or(last);
        if (begins_with_empty_springs(i, last, now, def.insitu.given))
            found.push_back(&def.stages[i]);
        last = now;
    }
    return found;
}

bool takes_paper_step(const CaseDef& def)
{
    return def.damping.preset == DampingPreset::paper;
}

bool is_driven(const CaseDef& def)
{
    const auto prescribes = [](const LoadDef& load) { return load.velocity_x || load.velocity_y || load.angular_velocity; };
    return std::ranges::any_of(def.loads, prescribes) || have_driven_blocks(def);
}

bool is_driven(const Model& model, const State& state)
{
    return model.is_driven || do_loads_drive(model, state) || do_walls_move(model, state);
}

bool have_driven_blocks(const CaseDef& def)
{
    const auto moves = [](const BlockDef& block)
    {
        return (block.fix_x && block.velocity.x() != 0.0) || (block.fix_y && block.velocity.y() != 0.0) ||
               (block.fix_rotation && block.angular_velocity != 0.0);
    };
    return std::ranges::any_of(def.blocks, moves);
}

const char* name_of(Method method)
{
    return method == Method::force ? "force" : (method == Method::impulse ? "impulse" : "hybrid");
}
}  // namespace hdem
