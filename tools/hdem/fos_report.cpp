#include "tools/hdem/fos_report.h"

#include "core/contact/contact_report.h"
#include "core/limit/force_points.h"
#include "core/stage/rules.h"
#include "core/support/bolt_strength.h"
#include "io/atomic_file.h"
#include "io/printable.h"
#include "io/text_file.h"
#include "tools/hdem/run_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hdem
{
namespace
{
using Json = nlohmann::ordered_json;

const char* title_of(FactorSearch search)
{
    switch (search)
    {
    case FactorSearch::peak:
        return "peak";
    case FactorSearch::stiffer:
        return "stiffer";
    case FactorSearch::as_given:
        break;
    }
    return "strength";
}

/// Blocks that were let fall in trials that count.
std::vector<Index> all_let_fall(const SafetyFactor& factor)
{
    std::set<Index> users;
    for (const FactorTrial& t : factor.trials)
        if (t.search == FactorSearch::as_given && (!factor.as_given.stands || t.trial.factor <= *factor.as_given.stands))
            users.insert(t.trial.let_fall.begin(), t.trial.let_fall.end());
    return {users.begin(), users.end()};
}

Json bracket_json(const std::optional<Bracket>& bracket)
{
    if (!bracket)
        return nullptr;
    const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
    return {{"factor", bracket->is_closed() ? Json(bracket->middle()) : Json(nullptr)},
            {"stable_at", number(bracket->stands)},
            {"failed_at", number(bracket->fails)}};
}

bool differ(const Bracket& a, const Bracket& b)
{
    return a.is_closed() && b.is_closed() && std::abs(a.middle() - b.middle()) > *a.fails - *a.stands + *b.fails - *b.stands;
}

/// Do corners that touch in a point bear a part of it?
bool leans_on_corners(const FosOutcome& outcome)
{
    const std::optional<double>& stands = outcome.factor.as_given.stands;
    return outcome.without_corners && stands && *stands > *outcome.without_corners;
}
}  // namespace

std::vector<std::string> names_of_blocks(const Model& model, const std::vector<Index>& users)
{
    std::vector<std::string> names;
    for (const Index user : users)
        names.push_back(printable(model.name[model.slot_of_user[user]]));
    return names;
}

std::string trial_heading()
{
    return "trial          F  verdict      cycles      time    moved  why";
}

std::string trial_row(const FactorTrial& t)
{
    return fmt::format("{:<9} {:7.4f}  {:<9} {:>9} {:7.3g} s {:7.3g} m  {}", title_of(t.search), t.trial.factor,
                       name_of(t.trial.end), t.trial.cycles, t.trial.time, t.trial.displacement, t.trial.reason);
}

std::string bound_text(const StrengthBound& bound)
{
    switch (bound.end)
    {
    case StrengthBound::End::found:
        return fmt::format("at most {:.4f} by limit analysis (a linear program of {} rows and {} columns, solved {} times)",
                           bound.factor, bound.rows, bound.columns, bound.solutions);
    case StrengthBound::End::none:
        return "none by limit analysis: forces that balance the blocks exist at any factor";
    case StrengthBound::End::no_balance:
        return "limit analysis finds no forces that balance the blocks at any strength";
    case StrengthBound::End::not_found:
        break;
    }
    return "no bound by limit analysis: " + bound.why;
}

std::string factor_text(const Bracket& b)
{
    if (b.is_closed())
        return fmt::format("{:.4f} ({:.4f} stands, {:.4f} fails)", b.middle(), *b.stands, *b.fails);
    return b.stands ? fmt::format("above {:g}: nothing fails", *b.stands)
                    : fmt::format("below {:g}: fails at any strength", *b.fails);
}

std::vector<std::string> closing_lines(const FosOutcome& outcome, const Model& model)
{
    const SafetyFactor& f = outcome.factor;
    const bool leans = leans_on_corners(outcome);
    std::vector<std::string> lines{
        fmt::format("factor of safety  {}{}", factor_text(f.as_given),
                    leans ? fmt::format("; at most {:.4f} where corners bear nothing", *outcome.without_corners) : "")};
    if (f.peak)
        lines.push_back(fmt::format("with peak strength throughout  {}", factor_text(*f.peak)));
    if (f.stiffer)
        lines.push_back(fmt::format("with joints {:g} times as stiff  {}", outcome.def.check_stiffness, factor_text(*f.stiffer)));
    lines.push_back("bound  " + bound_text(outcome.bound));
    if (const Trial* const first = f.first_failure())
    {
        const std::vector<std::string> names = names_of_blocks(model, first->failing);
        lines.push_back(
            fmt::format("at F = {:.4f} {}{}", first->factor, first->reason,
                        names.size() > 1 ? fmt::format("; with it move {}", first_of({names.begin() + 1, names.end()})) : ""));
    }
    if (const std::vector<Index> fell = all_let_fall(f); !fell.empty())
        lines.push_back(fmt::format("smaller than least_size, fell without counting: {}", first_of(names_of_blocks(model, fell))));
    return lines;
}

namespace
{
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
        warnings.push_back(
            "they fell by their own strength, but stand at a factor above 1 where the rock first comes to rest under great "
            "strength: what "
            "holds them depends on how the stress gets there. Count on less than 1, or let the stage relax slowly (relax_cycles).");
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
    if (is_by_impulses(last.method))
        warnings.push_back(
            "the case runs by impulses, which do not determine the stress in the rock. Trials use springs; begin with method = "
            "\"force\" or \"hybrid\" for a stress that means something.");
    return warnings;
}

Json trial_json(const FactorTrial& t, const Model& model)
{
    return {{"search", name_of(t.search)},
            {"factor", t.trial.factor},
            {"verdict", name_of(t.trial.end)},
            {"reason", t.trial.reason},
            {"displacement", t.trial.displacement},
            {"cycles", t.trial.cycles},
            {"time", t.trial.time},
            {"failing_blocks", names_of_blocks(model, t.trial.failing)}};
}

Json fos_json(const FosOutcome& outcome, const Model& model)
{
    const SafetyFactor& f = outcome.factor;
    Json trials = Json::array();
    for (const FactorTrial& t : f.trials)
        trials.push_back(trial_json(t, model));
    const Trial* const first = f.first_failure();
    Json json = bracket_json(f.as_given);
    json["bound"] = outcome.bound.end == StrengthBound::End::found ? Json(outcome.bound.factor) : Json(nullptr);
    json["bound_text"] = bound_text(outcome.bound);
    json["bound_without_corners"] = outcome.without_corners ? Json(*outcome.without_corners) : Json(nullptr);
    json["peak"] = bracket_json(f.peak);
    json["stiffness_ratio"] = outcome.def.check_stiffness;
    json["stiffer"] = bracket_json(f.stiffer);
    json["verdict"] = first == nullptr ? Json(nullptr) : Json(name_of(first->end));
    json["failing_blocks"] = first == nullptr ? Json::array() : Json(names_of_blocks(model, first->failing));
    json["let_fall"] = names_of_blocks(model, all_let_fall(f));
    json["did_not_stand"] = outcome.gave_way;
    json["did_not_stand_before"] = outcome.gave_way_before;
    json["warnings"] = outcome.warnings;
    json["trials"] = std::move(trials);
    return json;
}

void add_to_summary(const std::filesystem::path& file, const Json& factor)
{
    constexpr std::size_t most = 1'000'000'000;
    Json summary = Json::parse(read_text_file(file, most).text);
    summary["factor_of_safety"] = factor;
    write_atomically(file, summary.dump(2) + "\n");
}
}  // namespace hdem
