#pragma once
/// A bar that is bonded to the rock along its length.
///
/// Node k of the bar has moved by u_k along it; the part of the rock in which a segment lies has moved by D, the sum of the openings of all joints before it. Nodes have no
/// mass, so that they do not bound the time step: in each cycle they are where all forces on each are in balance,
///
///   N = E A / dx (u_k+1 - u_k - e_p),  |N| <= yield                  of a segment of length dx [N]
///   q = k_b dx / 2 (D - u_k - slip),   |q| <= s_b dx / 2              of the bond at each of its two ends [N]
///   0 = N_k+1 - N_k + sum of q
///
/// with slip and e_p of the last cycle. These are the conditions of the least of a convex function, found by Newton's method, each step with one tridiagonal system.
/// What the rock feels at a joint is the tension of the bar there, of a short piece without bond: all other forces of the bar act within one block.
///
/// Closed forms of the pull-out test, lambda = (k_b / E A)^1/2, bond length L, l of it slipped:
///
///   K = E A lambda tanh(lambda L),   P = s_b (l + tanh(lambda (L - l)) / lambda)
///
/// @see verification/checks/support.cpp, support.B1 to B3

#include "core/model/support.h"
#include "core/state/support_state.h"

#include <cstdint>
#include <span>
#include <vector>

namespace hdem
{
/// What a segment remembers.
struct SegmentMemory
{
    double slip[2] = {0.0, 0.0};  ///< of the bond at its two ends [m]
    double plastic = 0.0;         ///< elongation [m]
    double cut = 0.0;             ///< 1: it has ruptured
};

/// Numbers of a grouted bolt in SupportState::history: openings of its links when it was installed, displacements of its nodes, then its segments.
struct GroutedMemory
{
    std::span<double> opening;
    std::span<double> node;
    SegmentMemory* segment;
};
[[nodiscard]] Index grouted_history_size(const Bolt& bolt);
[[nodiscard]] GroutedMemory grouted_memory(const Bolt& bolt, std::vector<double>& history);

/// Find the nodes for given places of the rock, and what slips, yields and ruptures.
/// @param moved    D of each part [m]
/// @param gone     per part: is the block gone? Then the bar is gone there, too.
/// @param tension  of each link, out [N]
/// @param reserve  of each link, out: how much more tension the bar, and the bond on both sides of it, could bear [N]
void pull_grouted(const Bolt& bolt, std::span<const double> moved, std::span<const std::uint8_t> gone, const GroutedMemory& memory,
                  std::span<double> tension, std::span<double> reserve, BoltRecord& record);

/// Upper bound on how much more force a link takes when the joints open by 1 m: sum of the sizes of its row of the elastic stiffness [N/m].
[[nodiscard]] std::vector<double> link_stiffness(const Bolt& bolt);
}  // namespace hdem
