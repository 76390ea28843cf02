#pragma once
/// Some islands are solved all at once where sweeps have left too much.

#include "core/contact/island_finder.h"
#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace hdem
{
/// Which islands are solved all at once.
enum class ExactIslands
{
    great_mass_ratios,  ///< islands for which sweeps would need many cycles
    hit,  ///< while blocks hit each other: islands of great mass ratios, and more sweeps for small ones that are hit; else as `small`
    small  ///< great mass ratios, and all others of few points: after sweeps alone, a tall stack sways and never comes to rest
};

/// How much the masses of movable blocks differ.
struct MassRange
{
    double least_inverse = std::numeric_limits<double>::max();  ///< of the heaviest [1/kg]
    double greatest_inverse = 0.0;                              ///< of the lightest

    void add(const BlockInertia& inertia)
    {
        const double inverse = std::max(inertia.inverse_mass_x, inertia.inverse_mass_y);
        greatest_inverse = std::max(greatest_inverse, inverse);
        least_inverse = inverse > 0.0 ? std::min(least_inverse, inverse) : least_inverse;
    }
    void add(const MassRange& other)
    {
        greatest_inverse = std::max(greatest_inverse, other.greatest_inverse);
        least_inverse = std::min(least_inverse, other.least_inverse);
    }
    /// Are sweeps enough for such mass ratios? A heavy block on a light one takes about as many sweeps as the ratio of their masses. The sweeps
    /// of ten cycles may be needed, as each cycle begins with the impulses of the last.
    [[nodiscard]] bool suits_sweeps(int sweeps) const { return greatest_inverse <= greatest_ratio(sweeps) * least_inverse; }
    [[nodiscard]] static double greatest_ratio(int sweeps) { return 10.0 * sweeps; }
};
[[nodiscard]] MassRange mass_range(const std::vector<ImpulsePoint>& points, const Blocks& blocks);

/// Has one of the points velocities, or pseudo velocities, that another sweep would change noticeably?
[[nodiscard]] bool are_unsolved(const Model& model, ExactIslands which, const MassRange& masses,
                                const std::vector<ImpulsePoint>& points, const Blocks& blocks, const std::vector<Triple>& pseudo);

/// Solves velocities and position correction of an island all at once, if it is one of `which` and the sweeps have left too much.
/// Of an island of more than 100 points only the clusters are solved, and only where the sweeps have left more in a cluster than around it: its solution
/// is no better than what is known of its neighbours. Where masses differ much, clusters of more than 200 points get more sweeps instead, at most
/// ten times those of a cycle; a heavy block may still sink into its support there. An island of up to 200 points that is hit gets more sweeps in
/// the same way, since an impact must be solved within one cycle.
void solve_island(const Model& model, ExactIslands which, Blocks& blocks, std::vector<Triple>& pseudo, Island& island);
}  // namespace hdem
