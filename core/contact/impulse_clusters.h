#pragma once
/// Clusters: light blocks of a large island that carry heavy ones.

#include "core/contact/island_finder.h"

#include <vector>

namespace hdem
{
/// Parts of a large island that are solved all at once. Each begins with a heavy block, and holds all connected blocks that are lighter than it by the ratio
/// that sweeps cannot deal with:
///
///   flood of block h: all blocks that can be reached from h through blocks of mass < m_h / ratio
///
/// Floods that overlap are one cluster, whose points are all those of its light blocks. The other blocks at these points take part, but their other
/// points keep their impulses: sweeps go on with them in the next cycle. So the cost of a rock mass grows with
/// the number of its clusters, not with that of its blocks to the power 1.5. Light blocks that carry nothing are left out: blocks with one neighbour that
/// is no lighter, and blocks that carry only such blocks. Sweeps solve them well.
/// @return cluster of each point, numbered in the order of their first points, or no_index; empty: there is none
[[nodiscard]] std::vector<Index> clusters_of(const Island& island, const Blocks& blocks, double ratio);
}  // namespace hdem
