#pragma once
/// Rock that tractions press from all sides: two translations and a rotation of the whole are free, and are held here.

#include "core/check.h"
#include "core/model/case_def.h"
#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <vector>

namespace hdem
{
/// The free blocks at sides on which tractions act in the state's stage, in the user's order; empty where the model does not hold them (domain.hold).
///
/// Blocks at the sides and not all free ones: a block that falls into an opening would push all the others up.
[[nodiscard]] std::vector<Index> blocks_held_on_average(const Model& model, const State& state);

/// Take out of the net forces on these blocks what would accelerate them as one rigid body, with the mass M and the inertia J about their centre:
///
///   F_i -= m_i (A + alpha x r_i),  M_i -= I_i alpha,    A = sum F / M,  alpha = sum (r x F + M_i) / J,  J = sum (m r^2 + I)
///
/// What is left sums to no force and no moment: contacts between them and with others are as they were.
void hold_forces(const std::vector<Index>& held, const Model& model, Blocks& blocks);

/// The same for their velocities, where damping and impulses have left some: with v for F / m and w for M / I. Their mean way and mean turn of the coming step are then 0.
///
/// @param pseudo  velocities of the position correction, which move the blocks too, one entry a block; or none
void hold_velocities(const std::vector<Index>& held, const Model& model, const std::vector<Triple>* pseudo, Blocks& blocks,
                     EnergyLedger& ledger);

/// Where holding makes no sense: something is fixed, nothing presses, or what presses is not in equilibrium.
/// @pre the model has its boundaries; `blocks` what the case fixes
[[nodiscard]] std::vector<Problem> find_hold_problems(const CaseDef& def, const Model& model, const Blocks& blocks);
}  // namespace hdem
