#pragma once
/// How near to rest: kinetic energy and unbalanced forces of a range of blocks, and what they are measured against.

#include "core/model/model.h"
#include "core/state/state.h"

namespace hdem
{
/// Sums over free blocks; ranges add up.
struct Equilibrium
{
    double kinetic_energy = 0.0;    ///< [J]
    double unbalanced_force = 0.0;  ///< sum of the absolute net forces, impulses as J / dt included [N]
    double applied_force = 0.0;     ///< sum over blocks of the absolute sum of weight and loads of the last cycle [N]
    double free_mass = 0.0;         ///< [kg]
    double greatest_speed = 0.0;    ///< [m/s]

    /// Mean unbalanced force over mean applied force; without any applied force the sum itself is judged against 1 N.
    [[nodiscard]] double unbalanced_force_ratio() const { return unbalanced_force / (applied_force > 0.0 ? applied_force : 1.0); }
    /// Kinetic energy of the free blocks when all move at `speed` [J]; the paper's criterion (sect. 4.4).
    [[nodiscard]] double kinetic_energy_at(double speed) const { return 0.5 * free_mass * speed * speed; }
};

/// Reads motion and the cycle's forces of all free blocks, or of those that stand; adds in block order.
void add_equilibrium(IndexRange range, const Model& model, const State& state, ConvergenceBlocks which, Equilibrium& sums);

[[nodiscard]] double kinetic_energy(const Model& model, const Blocks& blocks, Index block);

/// Displacements since the reference poses, of present free blocks.
struct DisplacementReport
{
    Index counted = 0;            ///< blocks next to the excavation that did not detach (all free blocks without an excavation)
    double mean = 0.0;            ///< of those [m]
    double greatest = 0.0;        ///< of those [m]
    double mean_all = 0.0;        ///< of all free blocks that did not detach [m]
    double greatest_all = 0.0;    ///< [m]
    std::vector<Index> detached;  ///< blocks that moved farther than the set distance, in the user's order
};
[[nodiscard]] DisplacementReport report_displacements(const Model& model, const State& state);
}  // namespace hdem
