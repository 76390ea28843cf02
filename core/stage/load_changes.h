#pragma once
/// When loads and sides change in the running stage. While they do, the rock is not at rest, and each block takes part in each cycle with the same step.

#include "core/model/model.h"
#include "core/state/state.h"

#include <string>
#include <vector>

namespace hdem
{
/// Cycle at which a stage ends that began at `begin`, if it does not come to rest earlier.
[[nodiscard]] std::int64_t last_cycle(const StageDef& stage, std::int64_t begin, double time_step);

/// First cycle from which nothing changes in the running stage any more: no load or side begins, ends, grows or falls, no joint
/// changes, no lining's weight or pressure grows and its strength does not fall.
[[nodiscard]] std::int64_t steady_from(const Model& model, const State& state);

/// Does something change at a time that the case gives in seconds, now or later? Until then all steps must be the same: cycles stand for times.
[[nodiscard]] bool are_times_to_come(const Model& model, const State& state);

/// What still changes when a stage ends, each as text: loads and sides on their way to their last value, joints on their way to what the stage sets, forces within
/// relax_cycles, linings. At the end of the last stage also loads that have not begun,
/// and, if that stage is not one by time, loads that end later.
/// @param state  of the stage's last cycle; only its cycles and stages are read
[[nodiscard]] std::vector<std::string> changes_to_come(const Model& model, const State& state);

/// Prescribed motions that go on when a stage has come to rest, each as text: forces may still grow by them.
/// @param state  as for changes_to_come
[[nodiscard]] std::vector<std::string> motions_that_go_on(const Model& model, const State& state);

/// Do tractions on sides change in the running stage from now on?
[[nodiscard]] bool do_tractions_change(const Model& model, const State& state);

/// Does a load prescribe a motion, now or later?
[[nodiscard]] bool do_loads_drive(const Model& model, const State& state);

/// Do walls move in the running stage, now or later?
[[nodiscard]] bool do_walls_move(const Model& model, const State& state);
}  // namespace hdem
