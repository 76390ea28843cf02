#include "verification/checks/robust_run.h"

#include "core/check.h"

#include <algorithm>

namespace hdem::verification
{
namespace
{
constexpr std::int64_t watch_every = 4;  ///< cycles: at 50 m/s 1/50 of the smallest block
constexpr double late_share = 0.8;       ///< of the run, after which it is looked at for rest

double duration(const CaseRun& run)
{
    double seconds = 0.0;
    for (const StageDef& stage : run.model().stages)
        seconds += stage.cycles ? static_cast<double>(*stage.cycles) * run.step() : stage.duration.value_or(0.0);
    return seconds;
}
}  // namespace

const std::vector<RobustVariant>& robust_variants()
{
    static const std::vector<RobustVariant> all{{"force", "force", "default", 0.1, true},
                                                {"force, undamped", "force", "dynamic"},
                                                {"impulse", "impulse", "default", 0.1, true},
                                                {"impulse, R = 0.5", "impulse", "default", 0.5},
                                                {"hybrid", "hybrid", "default", 0.1, true},
                                                {"hybrid, undamped, R = 0.5", "hybrid", "dynamic", 0.5},
                                                {"impulse, R = 1", "impulse", "default", 1.0, false, false},
                                                {"hybrid, undamped, R = 1", "hybrid", "dynamic", 1.0, false, false}};
    return all;
}

RobustOutcome run_scene(const Scene& scene, const RobustVariant& variant, Report* report)
{
    CaseRun run(scene.case_file,
                scene.overrides + Overrides{set("contact.method", variant.method), set("damping.preset", variant.damping),
                                            set("contact.restitution", variant.restitution)});
    RobustOutcome outcome{.watch = RobustWatch(late_share * duration(run)), .failure = {}};
    try
    {
        run.run([&](const Model& model, const State& state) { outcome.watch.observe(model, state); }, watch_every);
    }
    catch (const RunError& error)
    {
        outcome.failure = error.what();
        return outcome;
    }
    outcome.residual = run.worst_residual();
    outcome.had_impulses = run.had_impulses();
    if (report != nullptr)
        report->add_run(run);
    return outcome;
}
}  // namespace hdem::verification
