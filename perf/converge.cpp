/// The paper's cases until they are at rest: converge/<static|dynamic|tunnel>/<method>/<threads>. Their cycles are exact, whatever the machine.

#include "core/motion/equilibrium.h"
#include "core/observer.h"
#include "core/rock/build_model.h"
#include "core/state/state_hash.h"
#include "io/case_reader.h"
#include "parallel/stages.h"
#include "perf/counters.h"
#include "perf/limits.h"
#include "perf/scene_run.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <limits>
#include <string>

namespace hdem::perf
{
namespace
{
using Clock = std::chrono::steady_clock;

/// When a case counts as at rest: from the cycle on after which these hold to the end of its first stage.
struct Rest
{
    const char* name;
    const char* file;
    double unbalanced_force_ratio = 0.0;  ///< [-]
    double speed = 0.0;                   ///< mean of the free blocks [m/s]
};

const Rest rests[] = {
    // The paper's measure, a normal force within 5e-6 of the weight, is a net force of as much.
    {.name = "static", .file = "paper_static/static.toml", .unbalanced_force_ratio = 5e-6},
    // Ten times what gravity gives in a step, and a thousandth of the first impact's speed.
    {.name = "dynamic", .file = "paper_dynamic/dynamic.toml", .speed = 5e-3},
    // By the file's own criteria.
    {.name = "tunnel", .file = "paper_tunnel/tunnel.toml"},
};

/// The last cycle at which a case was not at rest.
class RestWatch final : public Observer
{
  public:
    explicit RestWatch(const Rest& rest) : rest_(rest) {}
    [[nodiscard]] std::int64_t last_moving() const { return last_moving_; }
    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override { return now + 1; }
    void observe(const Model& model, const State& state) override
    {
        Equilibrium sums;
        add_equilibrium({0, state.blocks.size()}, model, state, ConvergenceBlocks::all, sums);
        if ((rest_.speed > 0.0 && sums.kinetic_energy >= sums.kinetic_energy_at(rest_.speed)) ||
            (rest_.unbalanced_force_ratio > 0.0 && sums.unbalanced_force_ratio() >= rest_.unbalanced_force_ratio))
            last_moving_ = state.cycle;
    }

  private:
    const Rest& rest_;
    std::int64_t last_moving_ = 0;
};

/// Looks at the machine twenty times a second while a case runs, and takes the time of that.
class Watch final : public Keeper
{
  public:
    explicit Watch(Limits& limits) : limits_(limits) { look(); }

    /// Since the time it was made, without the time of looking.
    [[nodiscard]] Elapsed running() const
    {
        const Elapsed all = since_.elapsed();
        return {all.wall - looking_.wall, all.processor - looking_.processor};
    }
    [[nodiscard]] std::int64_t next_cycle(std::int64_t) const override { return std::numeric_limits<std::int64_t>::max(); }
    bool keep(const Simulation&) override
    {
        if (Clock::now() - last_ > std::chrono::milliseconds(50))
            look();
        return true;
    }

  private:
    void look()
    {
        const Stopwatch watch;
        limits_.look();
        looking_ += watch.elapsed();
        last_ = Clock::now();
    }

    Limits& limits_;
    Stopwatch since_;
    Elapsed looking_;
    Clock::time_point last_;
};

void run_to_rest(benchmark::State& bench, const Rest& rest, Method method, const std::string& family, int threads)
{
    CaseDef def = read_case_file(std::string(HDEM_CASE_FOLDER "/") + rest.file).def;
    def.contact.method = method;
    const bool own_criteria = def.stages.back().until_converged;
    if (!own_criteria)
        def.stages.resize(1);
    Setup setup = build_model(def);
    Simulation run(std::move(setup.model), std::move(setup.state), threads);
    RestWatch rest_watch(rest);
    std::vector<Observer*> observers;
    if (!own_criteria)
        observers.push_back(&rest_watch);
    StageResult last;
    Limits limits(threads, false);
    Elapsed time;
    for (auto _ : bench)
    {
        Watch watch(limits);
        last = run_stages(run, observers, &watch).back();
        time = watch.running();
        bench.SetIterationTime(time.wall);
    }
    const std::int64_t cycles = own_criteria ? last.cycles : rest_watch.last_moving() + 1;
    if (own_criteria ? !last.at_rest : cycles >= last.cycles)
        bench.SkipWithError("not at rest within its limit of cycles");
    const auto updates = static_cast<double>(run.contact_point_updates());
    report_points(bench, updates);
    limits.report_operations(bench, updates, time);
    limits.report_roofline(bench, updates, time);
    bench.counters["cycles"] = static_cast<double>(cycles);
    bench.counters["blocks"] = static_cast<double>(run.model().blocks());
    report_hash(bench, family, state_hash(run.model(), run.state()));
}

[[maybe_unused]] const bool registered = []
{
    for (const Rest& rest : rests)
        for (const auto& [name, method] : named_methods)
            for (const int threads : thread_counts())
            {
                if (std::string(rest.name) == "tunnel" && method == Method::impulse)
                    continue;  // does not come to rest
                const std::string family = std::string("converge/") + rest.name + '/' + name;
                benchmark::RegisterBenchmark((family + '/' + std::to_string(threads)).c_str(),
                                             [=, &rest, method = method](benchmark::State& bench)
                                             { run_to_rest(bench, rest, method, family, threads); })
                    ->UseManualTime()
                    ->Iterations(1)
                    ->Unit(benchmark::kMillisecond);
            }
    return true;
}();
}  // namespace
}  // namespace hdem::perf
