/// What a simulation finds in its state: the largest step, problems, and whether it rests.

#include "core/boundary/servo.h"
#include "core/contact/point_counts.h"
#include "core/detection/contact_tracking.h"
#include "core/motion/loads.h"
#include "core/motion/rest.h"
#include "core/motion/time_step.h"
#include "core/observer.h"
#include "core/stage/properties.h"
#include "core/stress/drawn_joints.h"
#include "core/support/bolt_springs.h"
#include "core/support/installed_support.h"
#include "core/support/liner_rest.h"
#include "parallel/simulation.h"
#include "parallel/state_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
constexpr double stirs = 10.0;  ///< mean speeds of the criterion: calm rock in which a block is faster is calm no more
}  // namespace

void Simulation::find_default_step()
{
    constexpr double share = 0.5;  // of the limit of the present contacts: others will come
    const double limit = step_limit();
    if (model_.default_time_step <= limit)
        return;
    model_.default_time_step = share * limit;
    if (model_.has_step)
        return;
    state_.default_step = model_.time_step = model_.default_time_step;
    time_loads(model_);
    state_.blocks.step = {model_.time_step, model_.time_step};
}

std::vector<Problem> Simulation::find_problems()
{
    std::vector<Problem> problems;
    if (!std::isnormal(model_.time_step))
    {
        const auto lightest = std::ranges::min_element(model_.mass) - model_.mass.begin();
        return {{.key = "time.step",
                 .text = "time: step (none follows from Eq. (32): the lightest block, " + model_.name[lightest] +
                         ", has a mass of " + with_digits("%.4g", model_.mass[lightest]) +
                         " kg/m). Give a greater material.*.density or softer joints, or a step."}};
    }
    if (const double preload = greatest_preload(state_); preload > 0.5 * skin_width(model_))
        problems.push_back({.key = "contact.skin",
                            .text = "contact: skin = " + with_digits("%.4g", model_.contact.skin) +
                                    " (in-situ stress presses a joint by " + with_digits("%.4g", preload) +
                                    " m: it would be lost while it still bears). Give a greater skin, or stiffer joints."});
    const double limit = step_limit();
    if (model_.time_step > limit)
        problems.push_back({.key = "time.step",
                            .text = "time: step = " + with_digits("%.4g", model_.time_step) +
                                    " s (above the stable limit 2/omega_max = " + with_digits("%.4g", limit) +
                                    (model_.support.empty() ? " s of the contacts)." : " s of the contacts, bolts and liners).") +
                                    " Give a smaller step, or none to use " + with_digits("%.4g", model_.default_time_step) +
                                    " s."});
    return problems;
}

double Simulation::step_limit()
{
    const StageRules rules = resolve_rules(model_, state_);
    if (!rules.step.needs_stable_step())
        return std::numeric_limits<double>::infinity();
    return rules.contact.law == ContactLaw::impulses ? stable_step_of_bolts(model_, state_.blocks) : critical_step();
}

double Simulation::critical_step()
{
    double step = critical_time_step(model_, state_.blocks, state_.contacts);
    for (Index stage = state_.stage_begun ? state_.stage + 1 : 0; stage < static_cast<Index>(model_.stages.size()); ++stage)
        if (changes_properties(model_, stage))
        {
            const Model changed = model_in_stage(model_, stage);
            Blocks blocks = state_.blocks;
            renew_inertia(changed, blocks);
            step = std::min(step, critical_time_step(changed, blocks, state_.contacts));
        }
    return step;
}

void Simulation::check_state()
{
    check_finite(model_, state_);
    watch_ledger(model_, state_);
    check_step(model_, state_);
}

Equilibrium Simulation::equilibrium() const
{
    Equilibrium sums;
    add_equilibrium({0, state_.blocks.size()}, model_, state_, model_.convergence.blocks, sums);
    if (sums.free_mass == 0.0)  // nothing stands
        add_equilibrium({0, state_.blocks.size()}, model_, state_, ConvergenceBlocks::all, sums);
    return sums;
}

void Simulation::find_calm(const Equilibrium& now)
{
    const RestRule rest = resolve_rules(model_, state_).rest;
    if (!rest.leaves_out)
        return;
    const ConvergenceDef& convergence = model_.convergence;
    const bool was_calm = state_.is_calm;
    // Each block by itself may have what all together may not.
    const bool blocks_hold = now.fastest.value < convergence.mean_speed &&
                             now.unbalanced.value < convergence.block_unbalanced_ratio;
    const auto all_stopped = [&] { return all_rest(model_, rest, bolted_blocks(model_, state_), state_.blocks); };
    state_.is_calm = was_calm ? now.fastest.value <= stirs * convergence.mean_speed : blocks_hold || all_stopped();
    // Later, too, if all have stopped: where loads are far below weights, what wakes no block is more than the criterion allows.
    if (state_.is_calm && (!was_calm || all_stopped()) && wake_unbalanced(model_, rest.quiet_at_end, state_.blocks))
        state_.rest_changed = true;
}

bool Simulation::check_rest()
{
    return holds_rest() && !has_other_water();
}

/// Forces of water hold for some cycles. Those of the poses at rest may be others, and the blocks move on: the span of rest begins anew.
bool Simulation::has_other_water()
{
    if (!model_.water.given)
        return false;
    const std::vector<Triple> before = state_.water;
    renew_water();
    runner_.take_contacts();
    for (Index b = 0; b < model_.blocks(); ++b)
    {
        const Triple &now = state_.water[b], &last = before[b];
        const double change = Vec2(now.x - last.x, now.y - last.y).norm() + std::abs(now.w - last.w) / model_.radius[b];
        const double acts = model_.mass[b] * model_.gravity.norm() + Vec2(last.x, last.y).norm();
        if (change > model_.convergence.block_unbalanced_ratio * acts)
        {
            state_.quiet_since = -1.0;
            return true;
        }
    }
    return false;
}

bool Simulation::holds_rest()
{
    const ConvergenceDef& convergence = model_.convergence;
    const Equilibrium now = equilibrium();
    if (!holds(convergence, now))
    {
        state_.quiet_since = -1.0;
        find_calm(now);
        return false;
    }
    if (!moving_liners(model_, state_).empty())
    {
        state_.quiet_since = -1.0;
        return false;
    }
    if (state_.quiet_since < 0.0)
        state_.quiet_since = state_.time;
    if (resolve_rules(model_, state_).moves_walls && !servos_press(model_, state_))
        return false;
    // A lining that swings is in balance now and then.
    const bool must_last = std::ranges::find(convergence.criteria, "every_block") != convergence.criteria.end() ||
                           std::ranges::any_of(state_.support.liners, [](const LinerRecord& r) { return r.installed != 0; });
    if (!must_last)
        return true;
    if (!state_.is_calm)  // blocks that had stopped before the first look
        find_calm(now);
    // Where no block takes part any more nothing can show itself; steps of small blocks are so short that the span would take a million cycles.
    constexpr double cycles_without_motion = 10'000.0;
    const RestRule rest = resolve_rules(model_, state_).rest;
    const bool is_still = rest.leaves_out && state_.is_calm && all_rest(model_, rest, bolted_blocks(model_, state_), state_.blocks);
    const double span = is_still ? std::min(convergence.hold_time, cycles_without_motion * state_.blocks.step.last)
                                 : convergence.hold_time;
    return state_.time - state_.quiet_since >= span;
}

ContactCounts Simulation::count_contacts() const
{
    return {count_points(state_.contacts)};
}
}  // namespace hdem
