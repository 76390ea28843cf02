#include "verification/checks/fos_answer.h"

#include "parallel/critical_search.h"
#include "parallel/reference_state.h"
#include "verification/runs/remembered_trials.h"

namespace hdem::verification
{
namespace
{
bool same_trials(const SafetyFactor& a, const SafetyFactor& b)
{
    const auto same = [](const FactorTrial& x, const FactorTrial& y)
    {
        return x.search == y.search && x.trial.factor == y.trial.factor && x.trial.end == y.trial.end &&
               x.trial.displacement == y.trial.displacement && x.trial.cycles == y.trial.cycles &&
               x.trial.failing == y.trial.failing;
    };
    return a.trials.size() == b.trials.size() && std::equal(a.trials.begin(), a.trials.end(), b.trials.begin(), same);
}

/// Nothing where the search came to its end before it was to be broken off.
std::optional<FosAnswer> broken_off_and_gone_on(const std::string& case_file, const Overrides& overrides)
{
    constexpr int trials = 3;
    std::stop_source stop;
    runs::RememberedTrials store(stop, trials);
    try
    {
        static_cast<void>(find_factor(case_file, overrides, {.store = &store, .stop = stop.get_token()}));
        return std::nullopt;
    }
    catch (const SearchStopped&)
    {
        return find_factor(case_file, overrides, {.store = &store});
    }
}
}  // namespace

FosAnswer find_factor(const std::string& case_file, const Overrides& overrides, const FosRun& run)
{
    LoadedCase loaded = load_case(case_folder() / ("fos/" + case_file), overrides);
    const FactorOfSafetyDef def = loaded.file.def.factor_of_safety;
    Simulation simulation(std::move(loaded.setup.model), std::move(loaded.setup.state), run.threads);
    BeforeLastStage before;
    Observer* const observers[] = {&before};
    const std::vector<StageResult> stages = run_stages(simulation, observers);
    const Moment last{simulation.model(), simulation.state()};
    const bool found_rest = !stages.back().sought_rest || stages.back().at_rest;
    const LastStage stage{.found_rest = found_rest, .least_area = def.least_size, .before = [&] { return before.moment(); }};
    const Reference reference = find_reference(last, stage, run.threads);
    const Model& model = reference.moment.model;
    FosAnswer answer;
    answer.bound = strength_bound(model, reference.moment.state, weakened_joints(model.joints, def), least_factor, greatest_factor,
                                  weakens_bolts(def));
    FactorSetting setting{.def = def, .bound = {}, .threads = run.threads, .store = run.store, .stop = run.stop};
    if (answer.bound.end == StrengthBound::End::found)
        setting.bound = answer.bound.factor;
    answer.factor = find_safety_factor(reference.moment, setting);
    return answer;
}

void require_same_trials(Report& report, const std::string& name, const FosAnswer& one, const std::string& case_file,
                         const Overrides& overrides)
{
    double same = 0.0;
    for (const int threads : {2, 3})
        same += same_trials(one.factor, find_factor(case_file, overrides, {.threads = threads}).factor) ? 1.0 : 0.0;
    const std::optional<FosAnswer> broken = broken_off_and_gone_on(case_file, overrides);
    same += broken && same_trials(one.factor, broken->factor) ? 1.0 : 0.0;
    report.require({name + "searches with the same trials", "2, 3 threads, broken off", 3.0, same}, absolute(0.0));
}
}  // namespace hdem::verification
