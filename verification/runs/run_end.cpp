#include "verification/runs/run_end.h"

#include "core/energy_ledger.h"
#include "core/state/state_hash.h"
#include "io/checkpoint.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>

namespace hdem::runs
{
namespace
{
void tell(const StageResult& stage, RunEnd& end)
{
    end.stage_cycles.insert(end.stage_cycles.end(), {stage.first_cycle, stage.cycles, stage.at_rest});
    end.told.push_back(fmt::format("not at rest: {}", fmt::join(stage.not_at_rest, " ")));
    end.told.push_back(
        fmt::format("ended by {}, {:a}, at {:a}; then {}", stage.ended_by, stage.value, stage.time, fmt::join(stage.to_come, " ")));
    if (stage.statics)
        end.told.push_back(fmt::format("{} after {}, {:a}; loose: {}", stage.statics->outcome, stage.statics->iterations,
                                       stage.statics->residual, fmt::join(stage.statics->loose, " ")));
}

Simulation begun(const Build& build, const ThreadRule& threads)
{
    Setup setup = build();
    return {std::move(setup.model), std::move(setup.state), threads};
}
}  // namespace

bool BreakOff::keep(const Simulation& simulation)
{
    if (simulation.state().cycle < cycle_)
        return true;
    RunRecord record;
    record.history_axes.resize(simulation.model().histories.size(), Vec2(0.0, 0.0));
    write_checkpoint(folder_, record, simulation.model(), simulation.state());
    return false;
}

RunEnd run_to_end(Simulation& simulation, Keeper* keeper)
{
    RunEnd end;
    for (const StageResult& stage : run_stages(simulation, {}, keeper))
        tell(stage, end);
    const State& state = simulation.state();
    end.hash = state_hash(simulation.model(), state);
    end.cycle = state.cycle;
    for (const LedgerTerm& term : ledger_terms)
        end.ledger.push_back(std::bit_cast<std::uint64_t>(state.ledger.*term.value));
    end.counters = state.broad_phase_runs + state.feature_searches + state.excavation_cycle;
    end.contacts = state.contacts.size();
    return end;
}

RunEnd run_unbroken(const Build& build, const ThreadRule& threads)
{
    Simulation simulation = begun(build, threads);
    return run_to_end(simulation);
}

void run_until(const Build& build, std::int64_t cycle, const std::filesystem::path& folder, const ThreadRule& threads)
{
    Simulation simulation = begun(build, threads);
    BreakOff keeper(folder, cycle);
    run_stages(simulation, {}, &keeper);
}

RunEnd restart(const Build& build, const std::filesystem::path& folder, const ThreadRule& threads)
{
    Setup setup = build();
    State state = CheckpointReader(checkpoint_file(folder)).state(setup.model);
    Simulation simulation(std::move(setup.model), std::move(state), threads);
    return run_to_end(simulation);
}
}  // namespace hdem::runs
