#pragma once
/// Outlines of blocks that are unions of convex parts.

#include "core/rock/block_cutter.h"

#include <vector>

namespace hdem
{
struct OutlineEdge
{
    Vec2 from = {0.0, 0.0};  ///< [m]
    Vec2 to = {0.0, 0.0};    ///< [m]
    EdgeTag tag;

    [[nodiscard]] double length() const { return (to - from).norm(); }
};

/// Outer edges one after another, ring by ring; edges that go straight on along one chord are one.
[[nodiscard]] std::vector<std::vector<OutlineEdge>> outline_of(const std::vector<CutPolygon>& parts, double tolerance);

/// Convex parts of a block, at whose outer sides no vertex stands where the side goes straight on. Its outline is decomposed anew: cuts that
/// crossed the block, and slivers that it was joined to, leave internal edges that end on straight sides, and which ones depends on the order
/// of the cuts. Holes are joined to the outside by internal edges. Where round-off leaves no sound parts, those that are there are merged only.
void make_sides_whole(std::vector<CutPolygon>& parts, double tolerance);
}  // namespace hdem
