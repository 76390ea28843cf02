#pragma once
/// How large a step may be.

#include "core/model/model.h"
#include "core/state/state.h"

namespace hdem
{
/// The paper's step [s]:
///
///   dt = FRAC 2 sqrt(m_min / (2 K_max))                              [Lee2025] Eq. (32)
///
///   m_min smallest mass of a free block [kg]   K_max greatest normal or shear joint stiffness, times 1 m [N/m]
[[nodiscard]] double paper_time_step(double smallest_mass, double greatest_stiffness, double fraction);

/// Stable limit of the assembled contacts, 2 / omega_max [s], by power iteration on M^-1 K with the springs of all tracked contacts
/// as if closed and sticking. Infinite without contacts. `iterations` bounds the work; the estimate of omega_max comes from below,
/// so the limit from above, by a few per cent.
[[nodiscard]] double critical_time_step(const Model& model, const Blocks& blocks, const Contacts& contacts, int iterations = 60);
}  // namespace hdem
