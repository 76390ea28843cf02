#include "parallel/safety_factor.h"

#include <algorithm>
#include <map>
#include <mutex>

namespace hdem
{
namespace
{
/// One search: asks the store, or runs a trial.
class Trials
{
  public:
    Trials(const Moment& reference, const FactorSetting& setting, FactorSearch search)
        : setting_(setting),
          search_(search),
          start_(search == FactorSearch::stiffer ? stiffened_state(reference, setting.def.check_stiffness) : reference)
    {
    }

    Bracket find(BracketRule rule, std::vector<FactorTrial>& all)
    {
        const StandsAt stands = [this](double factor, int threads, const std::stop_token& stop)
        { return trial(factor, threads, stop).end == TrialEnd::stable; };
        const AfterPair after = [&](const Bracket&) { take_counting(all); };
        return search_bracket(rule, setting_.threads.most, stands, after);
    }

    /// Where the trial at this factor has ended, if it was run.
    [[nodiscard]] std::optional<Moment> failure_at(double factor)
    {
        return failed_at_ == factor ? std::move(failure_) : std::nullopt;
    }

  private:
    Trial trial(double factor, int threads, const std::stop_token& stop)
    {
        std::optional<Trial> found = setting_.store != nullptr ? setting_.store->find(search_, factor) : std::nullopt;
        if (!found)
        {
            std::stop_source either;
            const std::stop_callback first(stop, [&] { either.request_stop(); });
            const std::stop_callback second(setting_.stop, [&] { either.request_stop(); });
            std::optional<Moment> end;
            found = run_trial(start_, trial_rule(start_.model, setting_.def, search_, factor), setting_.threads.for_share(threads),
                              either.get_token(), &end);
            if (either.stop_requested())
            {
                if (setting_.stop.stop_requested() && !stop.stop_requested())
                    throw SearchStopped{};
                return *found;
            }
            if (setting_.store != nullptr)
                setting_.store->add(search_, *found);
            keep_failure(*found, end);
        }
        const std::lock_guard lock(mutex_);
        ended_[factor] = *found;
        return *found;
    }

    void keep_failure(const Trial& trial, std::optional<Moment>& end)
    {
        const std::lock_guard lock(mutex_);
        if (trial.end == TrialEnd::stable || (failure_ && failed_at_ <= trial.factor))
            return;
        failure_ = std::move(end);
        failed_at_ = trial.factor;
    }

    /// Of a pair the second counts only where the first stands.
    void take_counting(std::vector<FactorTrial>& all)
    {
        for (const auto& [factor, trial] : ended_)
        {
            all.push_back({search_, trial});
            if (setting_.show)
                setting_.show(all.back());
            if (trial.end != TrialEnd::stable)
                break;
        }
        ended_.clear();
    }

    const FactorSetting& setting_;
    FactorSearch search_;
    Moment start_;
    std::mutex mutex_;
    std::map<double, Trial> ended_;  ///< of the present pair
    std::optional<Moment> failure_;
    double failed_at_ = 0.0;
};

bool is_before(const Trial* a, const Trial& b)
{
    return a == nullptr || b.factor < a->factor;
}
}  // namespace

const char* name_of(FactorSearch search)
{
    return search == FactorSearch::as_given ? "as_given" : (search == FactorSearch::peak ? "peak" : "stiffer");
}

const Trial* SafetyFactor::first_failure() const
{
    const Trial* first = nullptr;
    for (const FactorTrial& t : trials)
        if (t.search == FactorSearch::as_given && t.trial.end != TrialEnd::stable && is_before(first, t.trial))
            first = &t.trial;
    return first;
}

const Trial* SafetyFactor::last_stable() const
{
    const Trial* last = nullptr;
    for (const FactorTrial& t : trials)
        if (t.search == FactorSearch::as_given && t.trial.end == TrialEnd::stable && !is_before(last, t.trial))
            last = &t.trial;
        else if (t.search == FactorSearch::as_given && t.trial.end == TrialEnd::stable && last == nullptr)
            last = &t.trial;
    return last;
}

std::vector<std::uint8_t> weakened_joints(const JointTable& table, const FactorOfSafetyDef& def)
{
    if (std::ranges::find(def.reduce, "joints") != def.reduce.end())
        return {};
    std::vector<std::uint8_t> chosen;
    for (const std::string& name : table.names)
        chosen.push_back(std::ranges::find(def.reduce, name) != def.reduce.end() ? 1 : 0);
    return chosen;
}

bool weakens_bolts(const FactorOfSafetyDef& def)
{
    return std::ranges::find(def.reduce, "bolts") != def.reduce.end();
}

TrialRule trial_rule(const Model& model, const FactorOfSafetyDef& def, FactorSearch search, double factor)
{
    return {.reduction = {.factor = factor,
                          .joints = weakened_joints(model.joints, def),
                          .bolts = weakens_bolts(def),
                          .keeps_peak = search == FactorSearch::peak,
                          .stiffness = search == FactorSearch::stiffer ? def.check_stiffness : 1.0},
            .failure = {.displacement = def.displacement, .least_area = def.least_size},
            .tolerance = def.tolerance};
}

SafetyFactor find_safety_factor(const Moment& reference, const FactorSetting& setting)
{
    const FactorOfSafetyDef& def = setting.def;
    BracketRule rule{.low = def.bracket.x(),
                     .high = def.bracket.y(),
                     .tolerance = def.tolerance,
                     .guess = setting.bound,
                     .least = std::min(least_factor, def.bracket.x()),
                     .most = std::max(greatest_factor, def.bracket.y())};
    SafetyFactor found;
    Trials as_given(reference, setting, FactorSearch::as_given);
    found.as_given = as_given.find(rule, found.trials);
    if (found.as_given.fails)
        found.failure = as_given.failure_at(*found.as_given.fails);
    if (def.peak && loses_strength(reference.model.joints, weakened_joints(reference.model.joints, def)))
        found.peak = Trials(reference, setting, FactorSearch::peak).find(rule, found.trials);
    if (def.check_stiffness > 1.0 && found.as_given.is_closed())
    {
        rule.guess = found.as_given.middle();
        found.stiffer = Trials(reference, setting, FactorSearch::stiffer).find(rule, found.trials);
    }
    return found;
}
}  // namespace hdem
