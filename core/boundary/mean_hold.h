#pragma once
/// Holds a model that only tractions press, from all sides. Nothing else stops it from moving or turning as a whole.

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
/// The remaining forces sum to no force and no moment. Contacts of these blocks are not changed.
void hold_forces(const std::vector<Index>& held, const Model& model, Blocks& blocks);

/// The same for the velocities that damping and impulses have left, with v for F / m and w for M / I.
/// The mean displacement and the mean rotation of these blocks over the coming step are then 0.
///
/// @param pseudo  velocities of the position correction, which move the blocks too, one entry a block; or none
void hold_velocities(const std::vector<Index>& held, const Model& model, const std::vector<Triple>* pseudo, Blocks& blocks,
                     EnergyLedger& ledger);

/// Problems of holding: something is fixed, no traction acts, or the tractions are not in equilibrium.
/// @pre the model has its boundaries; `blocks` what the case fixes
[[nodiscard]] std::vector<Problem> find_hold_problems(const CaseDef& def, const Model& model, const Blocks& blocks);
}  // namespace hdem
