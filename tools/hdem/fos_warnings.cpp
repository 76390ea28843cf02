#include "tools/hdem/fos_warnings.h"

#include "core/contact/contact_report.h"
#include "core/limit/force_points.h"
#include "core/stage/failure.h"
#include "core/stage/rules.h"
#include "core/support/bolt_strength.h"
#include "io/printable.h"
#include "tools/hdem/fos_report.h"
#include "tools/hdem/run_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
bool differ(const Bracket& a, const Bracket& b)
{
    return a.is_closed() && b.is_closed() && std::abs(a.middle() - b.middle()) > *a.fails - *a.stands + *b.fails - *b.stands;
}

/// Where blocks gave way.
std::string factor_of_what(const FosOutcome& outcome)
{
    if (outcome.def.begin == FactorStart::last_state)
        return "The factor is that of the rock as it lies now.";
    if (outcome.falls_anyway.empty())
        return "It was run anew with a thousand times the strength; the factor is that of the blocks where they were.";
    return fmt::format(
        "It was run anew with a thousand times the strength, and these fell again: {}. No strength holds them, so that there is no "
        "factor. Support them, let small ones fall (least_size), or take the rock as it lies (begin = \"last_state\").",
        first_of(outcome.falls_anyway));
}

/// Contacts of rock that was whole at first and has broken.
Index count_broken(const Moment& moment)
{
    const auto& [model, state] = moment;
    Index count = 0;
    for (Index i = 0; i < state.contacts.size(); ++i)
    {
        const Contact contact = state.contacts.get(i);
        const JointTable& joints = model.joints;
        if (!is_closed_contact(state, i) || have_met(joints, contact.law) || !joints.has_memory(contact.law) ||
            joints.rows[contact.law].begins_broken)
            continue;
        count += std::ranges::any_of(contact.point, [&](const PointHistory& point)
                                     { return broken_share(joints, contact.law, point.memory) > 0.0; });
    }
    return count;
}

std::string why_above_bound(const SafetyFactor& factor, const Model& model)
{
    if (!all_let_fall(factor).empty())
        return "it counts the blocks, smaller than least_size, that fell";
    return model.support.bolts.empty() ? "blocks have moved to where others hold them"
                                       : "blocks have moved to where others, or bolts that turn where a joint slips, hold them";
}
/// A block whose joints deform by half of the displacement that is given, or more; "" without one.
std::string block_that_only_deforms(const FactorOfSafetyDef& def, const Moment& reference)
{
    if (!def.displacement)
        return "";
    const auto& [model, state] = reference;
    const FailureWatch elastic({.share = 0.0, .strains = 2.0, .stretches = 0.0, .least_area = def.least_size}, model, state);
    for (Index user = 0; user < model.blocks(); ++user)
        if (elastic.counts(user, model) && elastic.limit(user) > *def.displacement &&
            state.blocks.is_free(model.slot_of_user[user]))
            return printable(model.name[model.slot_of_user[user]]);
    return "";
}
}  // namespace

std::vector<std::string> fos_warnings(const FosOutcome& outcome, const Moment& reference, const State& last)
{
    const SafetyFactor& f = outcome.factor;
    std::vector<std::string> warnings;
    if (!last.released.empty())
        warnings.emplace_back("forces of excavated rock that are left (relax_to, relax_cycles) act until the last stage ends, and "
                              "not in the trials. Take them off in a stage of its own.");
    if (!outcome.gave_way.empty())
        warnings.push_back(fmt::format("these blocks did not stand in the last stage: {}. {}", first_of(outcome.gave_way),
                                       factor_of_what(outcome)));
    if (!outcome.gave_way_before.empty())
        warnings.push_back(fmt::format(
            "these blocks moved far (convergence.detached_distance) in stages before the last one: {}. The factor is that of the "
            "rock as it lies now. For theirs, let the run end with the stage in which they move.",
            first_of(outcome.gave_way_before)));
    if (!outcome.falls_anyway.empty() && outcome.gave_way.empty())
        warnings.push_back(
            fmt::format("these blocks stood in the last stage, and fall by springs even with a thousand times their "
                        "strength: {}. Impulses find a balance that springs do not. Begin with method = \"force\" or "
                        "\"hybrid\".",
                        first_of(outcome.falls_anyway)));
    if (const Index broken = count_broken(reference); broken > 0)
        warnings.push_back(fmt::format("joints had broken at {} contacts before the trials began. The factor is that of the rock "
                                       "with them. A weight that acts at "
                                       "once breaks more than one that grows: give the first stage relax_cycles, or give [insitu].",
                                       broken));
    if (!outcome.gave_way.empty() && outcome.def.begin == FactorStart::last_stage && f.as_given.stands && *f.as_given.stands > 1.0)
        warnings.push_back("they did not come to rest by their own strength, but stand at a factor above 1 where the rock first "
                           "comes to rest under "
                           "great strength: what holds them depends on how the stress gets there, or the stage was too short. "
                           "Count on less than 1, "
                           "or let the stage relax slowly (relax_cycles) and give it more max_cycles.");
    if (const Trial* const first = f.first_failure(); first != nullptr && first->end == TrialEnd::undecided)
        warnings.push_back(
            fmt::format("the trial at F = {:.4f} is undecided and counts as failed ({}).", first->factor, first->reason));
    if (f.stiffer && differ(f.as_given, *f.stiffer))
        warnings.push_back(fmt::format(
            "the factor depends on the stiffness of joints: {} and {}. Look for corners that stand on a side, or for in-situ "
            "stress that strains joints much.",
            factor_text(f.as_given), factor_text(*f.stiffer)));
    if (outcome.bound.end == StrengthBound::End::found && f.as_given.stands &&
        *f.as_given.stands > outcome.bound.factor * 1.001 + outcome.def.tolerance)
        warnings.push_back(fmt::format("rock stands above the bound of limit analysis ({:.4f}): {}.", outcome.bound.factor,
                                       why_above_bound(f, reference.model)));
    if (leans_on_corners(outcome))
        warnings.push_back(fmt::format(
            "corners that touch other blocks in a point bear part of it: without them the factor is at most {:.4f}. They cannot be "
            "crushed here; rock can. Cut a notch where a tip stands on another plane (hdem plot shows it), or count on the lower "
            "number.",
            *outcome.without_corners));
    if (const Trial* const first = f.first_failure();
        first != nullptr && outcome.bound.end == StrengthBound::End::found && first->factor < 0.95 * outcome.bound.factor)
        if (const double open = open_share_of_cohesion(reference.model, reference.state, first->failing); open > 0.01)
            warnings.push_back(fmt::format(
                "{:.0f} % of the cohesion of what fails lies where its joints are open before the trials, as in rock that settled "
                "unevenly. The bound of limit analysis ({:.4f}) counts it, the factor does not.",
                100.0 * open, outcome.bound.factor));
    std::vector<std::string> endless;
    for (const Bolt& bolt : reference.model.support.bolts)
        if (bears_any_force(bolt))
            endless.push_back(printable(bolt.name));
    if (!endless.empty())
        warnings.push_back(fmt::format("no strength is given for these bolts: {}. Trials and bound count on any force of them. "
                                       "Give yield (and shear_strength).",
                                       first_of(endless)));
    const double most = greatest_factor_for_dilation(reference.model.joints, weakened_joints(reference.model.joints, outcome.def));
    if (f.as_given.is_closed() && f.as_given.middle() > most)
        warnings.push_back(fmt::format(
            "above F = {:.4f} a joint dilates by more than its friction pays for, as dilation is not reduced. Give less "
            "dilation_angle_deg.",
            most));
    if (const std::string block = block_that_only_deforms(outcome.def, reference); !block.empty())
        warnings.push_back(fmt::format(
            "factor_of_safety.displacement = {:g} m is less than twice the elastic deformation of the joints of block {}. What "
            "only deforms may count as failed, and the factor is then too small. Give more, or \"auto\".",
            *outcome.def.displacement, block));
    if (is_by_impulses(last.method))
        warnings.push_back(
            "the case runs by impulses, which do not determine the stress in the rock. Trials use springs; begin with method = "
            "\"force\" or \"hybrid\" for a stress that means something.");
    return warnings;
}
}  // namespace hdem
