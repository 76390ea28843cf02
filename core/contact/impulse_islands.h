#pragma once
/// Islands: impulse points that share movable blocks. Some are solved all at once where sweeps have left too much.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace hdem
{
/// Which islands are solved all at once.
enum class ExactIslands
{
    great_mass_ratios,  ///< those that sweeps would need many cycles for
    hit,                ///< while blocks hit each other these, and small ones that are hit get more sweeps; else as `small`
    small  ///< great mass ratios, and all others of few points: a tall stack sways on what sweeps leave, and never comes to rest
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
    /// Are sweeps all that blocks so different need? A heavy block on a light one takes about as many sweeps as its mass is greater; those of
    /// ten cycles do no harm, as each cycle begins with the impulses of the last.
    [[nodiscard]] bool suits_sweeps(int sweeps) const { return greatest_inverse <= greatest_ratio(sweeps) * least_inverse; }
    [[nodiscard]] static double greatest_ratio(int sweeps) { return 10.0 * sweeps; }
};
[[nodiscard]] MassRange mass_range(const std::vector<ImpulsePoint>& points, const Blocks& blocks);

/// Has one of the points velocities, or pseudo velocities, that another sweep would change noticeably?
[[nodiscard]] bool are_unsolved(const Model& model, ExactIslands which, const MassRange& masses,
                                const std::vector<ImpulsePoint>& points, const Blocks& blocks, const std::vector<Triple>& pseudo);

struct Island
{
    std::vector<ImpulsePoint*> points;
    std::vector<std::array<Index, 2>> ends;  ///< their ref and inc, in `blocks`; no_index: cannot move
    std::vector<Index> blocks;               ///< that can move
    double loss = 0.0;                       ///< as of sweep_impulses [J]
};

/// Finds the islands of lists of points. Blocks that cannot move join nothing.
class IslandFinder
{
  public:
    /// Islands in the order of their first points, points in the order of the lists.
    void find(const std::vector<std::vector<ImpulsePoint>*>& lists, const Blocks& blocks, std::vector<Island>& islands);

  private:
    Index root(Index block);
    std::vector<Index> parent_;     ///< a block; of those in the lists only
    std::vector<Index> island_of_;  ///< of roots
    std::vector<Index> place_;      ///< of blocks in their islands
};

/// Solves velocities and position correction of an island all at once, if it is one of `which` and the sweeps have left too much. Of an island of
/// more than 100 points only the clusters, where the sweeps have left more than around them: there is nothing to be gained where the cluster's
/// neighbours are not known better. Where masses differ much, clusters of more than 200 points get more sweeps instead, ten times those of a cycle at most: there a
/// heavy block may still sink into what it lies on. An island that is hit, of up to 200 points, gets more sweeps in the same way: the sweeps of one cycle are too few for
/// an impact, which has no other cycle to be shared out in.
void solve_island(const Model& model, ExactIslands which, Blocks& blocks, std::vector<Triple>& pseudo, Island& island);
}  // namespace hdem
