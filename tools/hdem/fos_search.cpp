#include "tools/hdem/fos_search.h"

#include "core/boundary/resolve_boundaries.h"
#include "core/motion/equilibrium.h"
#include "io/printable.h"
#include "tools/hdem/fos_report.h"
#include "tools/hdem/fos_warnings.h"

#include <fmt/format.h>

#include <algorithm>

namespace hdem
{
namespace
{
/// What no strength holds has no factor: all trials would begin from where it has fallen to. Its fall under great strength counts as the trial with
/// the least factor.
SafetyFactor fails_at_any_strength(const Moment& fallen, const std::vector<Index>& falling)
{
    Trial trial{.factor = least_factor, .end = TrialEnd::failed, .reason = {}, .failing = falling, .let_fall = {}};
    for (const Index user : falling)
        trial.displacement = std::max(trial.displacement,
                                      rim_displacement(fallen.model.slot_of_user[user], fallen.model, fallen.state.blocks));
    trial.reason = fmt::format("block {} fell even with {:g} times its strength",
                               printable(fallen.model.name[fallen.model.slot_of_user[falling.front()]]), great_strength);
    SafetyFactor found;
    found.as_given.fails = least_factor;
    found.trials.push_back({FactorSearch::as_given, std::move(trial)});
    found.failure = fallen;
    return found;
}

/// Before the last stage, far enough to count as detached. The user's numbers.
std::vector<Index> blocks_that_had_moved(const Moment& last, double least_area)
{
    std::vector<Index> found;
    for (const Index block : report_displacements(last.model, last.state).before)
        if (last.model.area[block] >= least_area)
            found.push_back(last.model.user_number[block]);
    return found;
}

/// Without them nothing can fail.
void expect_free_blocks(const Moment& start)
{
    const Model& model = start.model;
    const Blocks& blocks = start.state.blocks;
    if (std::ranges::any_of(model.slot_of_user, [&](Index block) { return blocks.is_free(block); }))
        return;
    const auto lost = std::ranges::find_if(model.slot_of_user, [&](Index block) { return has_left(block, model, blocks); });
    if (lost != model.slot_of_user.end())
        throw RunError(fmt::format("factor of safety: all free blocks, as {}, have fallen out of the model before the last stage "
                                   "began, so that nothing is left "
                                   "to fail. Give strengths that hold them until then.",
                                   printable(model.name[*lost])));
    throw RunError("factor of safety: no block is free in the last stage, so that nothing can fail. Free blocks in it.");
}
}  // namespace

FosAnswer find_factor(const Moment& last, const FosQuestion& question)
{
    FosOutcome outcome{.def = question.def};
    LastStage stage{.found_rest = question.found_rest, .least_area = outcome.def.least_size};
    if (outcome.def.begin == FactorStart::last_stage)
        stage.before = question.before;
    Reference reference = find_reference(last, stage, question.threads);
    outcome.gave_way = names_of_blocks(last.model, reference.gave_way);
    outcome.gave_way_before = names_of_blocks(last.model, blocks_that_had_moved(last, outcome.def.least_size));
    const Model& model = reference.moment.model;
    if (const std::vector<Index> falling = blocks_that_gave_way(reference.moment, true, outcome.def.least_size); !falling.empty())
    {
        outcome.falls_anyway = names_of_blocks(model, falling);
        outcome.bound.why = "blocks fall at any strength";
        if (question.begin)
            question.begin(outcome);
        outcome.factor = fails_at_any_strength(reference.moment, falling);
        if (question.show)
            question.show(outcome.factor.trials.front());
        outcome.warnings = fos_warnings(outcome, reference.moment, last.state);
        return {std::move(outcome), std::move(reference.moment)};
    }
    expect_free_blocks(reference.moment);
    outcome.bound = strength_bound(model, reference.moment.state, weakened_joints(model.joints, outcome.def), least_factor,
                                   greatest_factor, weakens_bolts(outcome.def));
    if (question.begin)
        question.begin(outcome);
    FactorSetting setting{.def = outcome.def, .bound = {}, .threads = question.threads, .store = question.store};
    const bool is_found = outcome.bound.end == StrengthBound::End::found;
    if (is_found)
        setting.bound = outcome.bound.factor;
    if (is_found || outcome.bound.end == StrengthBound::End::none)
    {
        const StrengthBound lower = strength_bound_without_corners(model, reference.moment.state,
                                                                   weakened_joints(model.joints, outcome.def), least_factor,
                                                                   outcome.bound, weakens_bolts(outcome.def));
        if (lower.end == StrengthBound::End::found && lower.factor < outcome.bound.factor)
            outcome.without_corners = lower.factor;
    }
    setting.show = question.show;
    setting.stop = question.stop;
    outcome.factor = find_safety_factor(reference.moment, setting);
    outcome.warnings = fos_warnings(outcome, reference.moment, last.state);
    return {std::move(outcome), std::move(reference.moment)};
}

void refuse_driven(const CaseDef& def)
{
    const auto refuse = [](const std::string& what)
    {
        throw InputError(
            Problem{.key = {},
                    .text = fmt::format("hdem fos: {} (a motion is prescribed: the rock is never at rest). End it before the "
                                        "last stage.",
                                        what)});
    };
    for (const BoundaryDef& side : def.boundaries)
        if (side.kind == BoundaryKind::velocity && !side.velocity.isZero() && acts_in(side, def.stages.back().name))
            refuse(fmt::format("boundary \"{}\": velocity", printable(side.name)));
    for (const LoadDef& load : def.loads)
        if ((load.velocity_x || load.velocity_y || load.angular_velocity) && !load.interval.until_cycle &&
            !load.interval.until_time)
            refuse("load: velocity");
}
}  // namespace hdem
