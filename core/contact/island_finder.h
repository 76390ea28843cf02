#pragma once
/// Islands: impulse points that share movable blocks.

#include "core/state/blocks.h"
#include "core/state/workspace.h"
#include "core/types.h"

#include <array>
#include <vector>

namespace hdem
{
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
}  // namespace hdem
