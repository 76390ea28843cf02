#pragma once
/// Clusters: light blocks of a large island that carry heavy ones.

#include "core/contact/impulse_islands.h"

#include <vector>

namespace hdem
{
/// What of a large island is solved all at once: each heavy block with what lies next to it and beyond, as far as all of that is lighter by the ratio
/// that sweeps cannot deal with:
///
///   flood of block h: all blocks that can be reached from h through blocks of mass < m_h / ratio
///
/// Floods that overlap are one cluster, whose points are all those of its light blocks. The other blocks at these points take part, but their other
/// points keep their impulses: sweeps go on with them in the next cycle. So the cost of a rock mass grows with
/// the number of its clusters, not with that of its blocks to the power 1.5. Left out are light blocks that carry nothing: with one neighbour that is
/// no lighter, and those that carry only such blocks. Sweeps are good at them.
/// @return cluster of each point, numbered in the order of their first points, or no_index; empty: there is none
[[nodiscard]] std::vector<Index> clusters_of(const Island& island, const Blocks& blocks, double ratio);
}  // namespace hdem
