#pragma once
/// How large a step may be.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <limits>

namespace hdem
{
/// The paper's step [s]:
///
///   dt = FRAC 2 sqrt(m_min / (2 K_max))                              [Lee2025] Eq. (32)
///
///   m_min smallest mass of a free block [kg]   K_max greatest normal or shear joint stiffness, times 1 m [N/m]
[[nodiscard]] double paper_time_step(double smallest_mass, double greatest_stiffness, double fraction);

/// hdem's own step where a case gives none [s]: the same with the least over all free blocks of
///
///   m / max(1, L / 4)      L longest side of the block [m]
///
/// for m_min. Eq. (32) takes K_max for the stiffness of a contact, which is K_max L. Up to 4 m that is kept: at FRAC = 0.1 springs still take ten steps or more
/// to turn a block round. For longer blocks the equation's own step is too long: slabs of 100 m x 1 m are unstable with it. Not under the preset `paper`.
[[nodiscard]] double default_time_step(const Model& model, const Blocks& blocks, double greatest_stiffness, double fraction);

/// Lower bound on the stable step of a range of blocks, 2 / omega with omega >= omega_max [s]; the least over all blocks is stable for all of them.
/// For springs s of stiffness k_s that join blocks a and b, with rows r_a, r_b of their stretch and q = r M^-1 r^T, the inequality of Cauchy and Schwarz
///
///   (r_a u_a + r_b u_b)^2 <= (q_a + q_b) ((r_a u_a)^2 / q_a + (r_b u_b)^2 / q_b)
///
/// takes the assembled springs apart block by block:
///
///   omega_max^2 <= max over blocks of lambda_max( M^-1 sum_s k_s (q_a + q_b) / q_a r_a^T r_a )
///
/// exact for a single spring, below the limit by some per cent in a packing (unlike critical_time_step, which comes near it from above). Tracked contacts
/// whose edges face each other count as closed and sticking.
[[nodiscard]] double stable_step(IndexRange range, const Model& model, const BlockContacts& list, const Contacts& contacts,
                                 const Blocks& blocks);

/// Which springs count.
enum class Springs
{
    closed,  ///< of closed points, as if they stuck and whatever their regime
    acting   ///< that gave forces in the last cycle; of a point that slips the normal one
};

struct StableLimit
{
    double step = std::numeric_limits<double>::infinity();  ///< 2 / omega_max [s]
    Index block = no_index;                                 ///< with the greatest share in the mode of omega_max
};

/// Stable limit of the assembled contacts by power iteration on M^-1 K. Infinite without springs. `iterations` bounds the work; the estimate of omega_max
/// comes from below, so the limit from above, by a few per cent.
[[nodiscard]] StableLimit stable_limit(const Model& model, const Blocks& blocks, const Contacts& contacts, Springs which,
                                       int iterations = 60);

/// Stable limit of the closed points [s].
[[nodiscard]] double critical_time_step(const Model& model, const Blocks& blocks, const Contacts& contacts, int iterations = 60);
}  // namespace hdem
