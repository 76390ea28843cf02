#pragma once
/// Runs that are broken off at a cycle, restarted from their checkpoint, and compared with the unbroken one.

#include "core/rock/build_model.h"
#include "core/state/state_hash.h"
#include "io/checkpoint.h"
#include "parallel/stages.h"
#include "verification/scenes/scenes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace hdem::test
{
/// Saves the run at one cycle, or breaks it off there.
class SaveAt : public Keeper
{
  public:
    SaveAt(std::filesystem::path folder, std::int64_t cycle, bool go_on) : folder_(std::move(folder)), cycle_(cycle), go_on_(go_on)
    {
    }
    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override { return now < cycle_ ? cycle_ : never; }
    [[nodiscard]] bool keep(const Simulation& simulation) override
    {
        if (simulation.state().cycle != cycle_)
            return true;
        RunRecord record;
        record.history_axes.resize(simulation.model().histories.size(), Vec2(0.0, 0.0));
        write_checkpoint(folder_, record, simulation.model(), simulation.state());
        return go_on_;
    }

  private:
    std::filesystem::path folder_;
    std::int64_t cycle_;
    bool go_on_;
};

struct Ended
{
    std::uint64_t hash = 0;
    std::int64_t cycle = 0;
    std::vector<std::int64_t> stage_cycles;
    std::vector<std::string> told;  ///< of the stages, for people
    std::vector<double> ledger;
    std::int64_t counters = 0;

    bool operator==(const Ended&) const = default;
};

inline Ended run(Simulation& simulation, Keeper* keeper)
{
    Ended ended;
    for (const StageResult& stage : run_stages(simulation, {}, keeper))
    {
        ended.stage_cycles.insert(ended.stage_cycles.end(), {stage.first_cycle, stage.cycles, stage.at_rest});
        ended.told.push_back(fmt::format("not at rest: {}", fmt::join(stage.not_at_rest, " ")));
        ended.told.push_back(fmt::format("ended by {}, {:a}, at {:a}; then {}", stage.ended_by, stage.value, stage.time,
                                         fmt::join(stage.to_come, " ")));
        if (stage.statics)
            ended.told.push_back(fmt::format("{} after {}, {:a}; loose: {}", stage.statics->outcome, stage.statics->iterations,
                                             stage.statics->residual, fmt::join(stage.statics->loose, " ")));
    }
    const State& state = simulation.state();
    ended.hash = state_hash(simulation.model(), state);
    ended.cycle = state.cycle;
    for (const LedgerTerm& term : ledger_terms)
        ended.ledger.push_back(state.ledger.*term.value);
    ended.counters = state.broad_phase_runs + state.feature_searches + state.excavation_cycle;
    return ended;
}

inline Ended run_unbroken(const CaseDef& scene)
{
    hdem::Setup setup = build_model(scene);
    Simulation simulation(std::move(setup.model), std::move(setup.state));
    return run(simulation, nullptr);
}

inline void run_until(const CaseDef& scene, std::int64_t cycle, const std::filesystem::path& folder)
{
    hdem::Setup setup = build_model(scene);
    Simulation simulation(std::move(setup.model), std::move(setup.state));
    SaveAt keeper(folder, cycle, false);
    run(simulation, &keeper);
}

inline Ended restart(const CaseDef& scene, const std::filesystem::path& folder, int threads)
{
    hdem::Setup setup = build_model(scene);
    State state = CheckpointReader(checkpoint_file(folder)).state(setup.model);
    Simulation simulation(std::move(setup.model), std::move(state), threads);
    return run(simulation, nullptr);
}

/// Broken off at each of these cycles and restarted on each of these numbers of threads a run ends as the unbroken one did.
inline void expect_to_go_on(const CaseDef& scene, const std::filesystem::path& folder, const Ended& unbroken,
                            const std::vector<std::int64_t>& cycles, const std::vector<int>& thread_numbers)
{
    for (const std::int64_t cycle : cycles)
    {
        run_until(scene, cycle, folder);
        for (const int threads : thread_numbers)
            EXPECT_EQ(restart(scene, folder, threads), unbroken) << "cycle " << cycle << ", threads " << threads;
    }
}

/// A tunnel in rock: blocks fall out after the excavation; the last stage changes method and damping.
inline CaseDef tunnel(Method method)
{
    CaseDef scene = scenes::joints(12.0, 12.0, 1.0, 3.0);
    scene.contact.method = method;
    scene.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {6.0, 6.0}, .diameter = 4.0}};
    scene.stages = {{.name = "gravity", .until_converged = true, .max_cycles = 300},
                    {.name = "dig", .cycles = 900, .excavate = {"tunnel"}},
                    {.name = "other", .cycles = 200, .method = Method::hybrid, .damping = DampingPreset::dynamic}};
    scene.convergence.least_cycles = 100;
    scene.convergence.mean_speed = 1.0;
    return scene;
}
}  // namespace hdem::test
