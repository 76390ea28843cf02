#pragma once
/// Numbers of joints and materials that stages change.

#include "core/model/model.h"
#include "core/state/state.h"

namespace hdem
{
/// Do contacts keep a preload besides the overlap of their blocks? For stress from the start, for a memory, and where a stage sets another normal
/// stiffness, under which they go on with their forces. @pre no stage has changed numbers yet
[[nodiscard]] bool needs_preload(const Model& model);

/// Does the stage change numbers of joints or materials?
[[nodiscard]] bool changes_properties(const Model& model, Index stage);

/// Give the model the numbers that hold from a stage on. What earlier stages have changed is to be there already.
void set_properties(Model& model, Index stage);

/// Joints between `before` and those of the stage; their stiffness is the same.
/// @param share  of the way: tangents of friction angles, cohesion, tension and what follows from them [-]
void set_joints_between(const StageLaws& before, Index stage, double share, Model& model);

/// Do strengths come to what a stage sets over some cycles, by set_cycles or by a table?
[[nodiscard]] bool sets_over_time(const StageDef& stage);
/// Cycles of the stage after which all of it is set.
/// @param step  [s] a cycle
[[nodiscard]] std::int64_t set_until(const StageDef& stage, double step);

/// Share of the change that the stage of the state has made by now. It is updated every ten cycles [-].
[[nodiscard]] double share_set(const Model& model, const State& state);
/// Cycle of the next update.
[[nodiscard]] std::int64_t next_share(const Model& model, const State& state);

/// Do the strengths of joints still change in the running stage?
[[nodiscard]] bool is_setting_joints(const Model& model, const State& state);

/// Keep the forces of all contacts after the stiffness of joints has changed. Their preload takes up the difference, so that a linear spring goes on with
///
///   F = K l (u + p) = K' l (u + p')          u overlap less rest overlap   p preload   l length of the point
///
/// and a curve with the closure at which it bears the same stress. Shear forces stay as they are, those of laws with a memory too.
/// @return  whether a stiffness has changed
/// @pre contacts have preloads
bool keep_forces(const StageLaws& before, const Model& model, State& state);

/// After densities have changed: what is free to move has its new inertia. Velocities stay.
void renew_inertia(const Model& model, Blocks& blocks);

/// The model with the numbers of all stages up to this one.
[[nodiscard]] Model model_in_stage(Model model, Index stage);
}  // namespace hdem
