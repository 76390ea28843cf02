#pragma once
/// How near blocks are to rest: kinetic energy and unbalanced forces of a range of blocks, and the scales of both.

#include "core/model/model.h"
#include "core/state/state.h"

namespace hdem
{
inline constexpr double earth_gravity = 9.81;  ///< scale of forces where there is no gravity [m/s2]

/// Net force and moment on a block as an acceleration of its rim, by the components that can move [m/s2]. Impulses count as J / dt.
[[nodiscard]] double unbalance(Index block, const Model& model, const Blocks& blocks);

/// The same without the part that comes from rounding of positions, through stiff springs. As an acceleration, this part is
///
///   16 eps K_max 2 r (|x| + |y| + r) / m      r   radius of the block
///
/// A light block beneath or between heavy ones, or a sliver, keeps such an unbalance for ever. It is subtracted where it exceeds a hundredth of the
/// unbalance that a block at rest may have, and up to ten times that unbalance.
[[nodiscard]] double clear_unbalance(Index block, const Model& model, const Blocks& blocks);

/// Speed of a block's rim [m/s].
[[nodiscard]] double rim_speed(Index block, const Model& model, const Blocks& blocks);

/// A block and a value of it.
struct Worst
{
    double value = 0.0;
    Index block = no_index;

    void add(double other, Index of)
    {
        if (other > value || (block == no_index && other >= value))
            *this = {other, of};
    }
};

/// Sums over free blocks, and the worst of them; ranges add up.
struct Equilibrium
{
    double kinetic_energy = 0.0;    ///< [J]
    double unbalanced_force = 0.0;  ///< sum of the absolute net forces, impulses as J / dt included [N]
    double applied_force = 0.0;     ///< sum over blocks of the absolute sum of weight and loads of the last cycle [N]
    double free_mass = 0.0;         ///< [kg]
    double greatest_speed = 0.0;    ///< of a centroid [m/s]
    /// `clear_unbalance` over the greater of gravity and the block's loads over its mass; over the earth's gravity if both are 0 [-].
    Worst unbalanced;
    Worst fastest;  ///< rim_speed [m/s]

    /// Mean unbalanced force over mean applied force; without any applied force over the weight that the free blocks would have on earth.
    [[nodiscard]] double unbalanced_force_ratio() const
    {
        const double scale = applied_force > 0.0 ? applied_force : earth_gravity * free_mass;
        return scale > 0.0 ? unbalanced_force / scale : 0.0;
    }
    /// Kinetic energy of the free blocks when all move at `speed` [J]; the paper's criterion (sect. 4.4).
    [[nodiscard]] double kinetic_energy_at(double speed) const { return 0.5 * free_mass * speed * speed; }
};

/// Reads motion and the cycle's forces of all free blocks, or of those that stand; adds in block order.
void add_equilibrium(IndexRange range, const Model& model, const State& state, ConvergenceBlocks which, Equilibrium& sums);

/// Do all listed criteria hold?
///
///   kinetic_energy           of all blocks, below that at mean_speed                      [Lee2025] sect. 4.4
///   unbalanced_force_ratio   mean over all blocks, below unbalanced_force_ratio
///   every_block              each block by itself: its rim slower than mean_speed, and net force and moment below block_unbalanced_ratio of its weight and loads
///
/// A block that flies or slides fails the last one, however many others are at rest.
[[nodiscard]] bool holds(const ConvergenceDef& criteria, const Equilibrium& now);

/// Does this free block by itself meet the criterion every_block?
[[nodiscard]] bool is_supported(Index block, const Model& model, const State& state);

[[nodiscard]] double kinetic_energy(const Model& model, const Blocks& blocks, Index block);

/// Displacements since the reference poses, of present free blocks.
struct DisplacementReport
{
    Index counted = 0;            ///< blocks next to the excavation that did not detach (without an excavation: all free blocks)
    double mean = 0.0;            ///< of those [m]
    double greatest = 0.0;        ///< of those [m]
    double mean_all = 0.0;        ///< of all free blocks, detached ones too [m]
    double greatest_all = 0.0;    ///< [m]
    std::vector<Index> detached;  ///< blocks that moved farther than the set distance, in the user's order
    std::vector<Index>
        before;  ///< other blocks that lie farther than that from where the run began and have not settled with the rock around them: detached in an earlier stage
};
[[nodiscard]] DisplacementReport report_displacements(const Model& model, const State& state);

/// Is the block's centroid farther outside the model than convergence.lost_distance?
[[nodiscard]] bool has_left(Index block, const Model& model, const Blocks& blocks);
}  // namespace hdem
