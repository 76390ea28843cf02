#include "tools/hdem/fos_report.h"

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

Json bracket_json(const std::optional<Bracket>& bracket)
{
    if (!bracket)
        return nullptr;
    const auto number = [](const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); };
    return {{"factor", bracket->is_closed() ? Json(bracket->middle()) : Json(nullptr)},
            {"stable_at", number(bracket->stands)},
            {"failed_at", number(bracket->fails)}};
}

}  // namespace

std::vector<Index> all_let_fall(const SafetyFactor& factor)
{
    std::set<Index> users;
    for (const FactorTrial& t : factor.trials)
        if (t.search == FactorSearch::as_given && (!factor.as_given.stands || t.trial.factor <= *factor.as_given.stands))
            users.insert(t.trial.let_fall.begin(), t.trial.let_fall.end());
    return {users.begin(), users.end()};
}

bool leans_on_corners(const FosOutcome& outcome)
{
    const std::optional<double>& stands = outcome.factor.as_given.stands;
    return outcome.without_corners && stands && *stands > *outcome.without_corners;
}

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
