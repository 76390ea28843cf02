#pragma once
/// Broad phase: boxes to pairs of boxes that overlap.

#include "core/geometry/polygon.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// A box that takes part in no pair.
inline const Box empty_box{{1.0, 1.0}, {-1.0, -1.0}};
[[nodiscard]] inline bool is_empty(const Box& box)
{
    return !(box.low.x() <= box.high.x() && box.low.y() <= box.high.y());
}

/// Pair of boxes i < j as one sortable number.
[[nodiscard]] inline std::uint64_t pair_key(Index i, Index j)
{
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)) << 32 | static_cast<std::uint32_t>(j);
}
[[nodiscard]] inline Index first_of(std::uint64_t key)
{
    return static_cast<Index>(key >> 32);
}
[[nodiscard]] inline Index second_of(std::uint64_t key)
{
    return static_cast<Index>(key & 0xffffffffu);
}

/// Hashed cells on several levels: a box lies in the cell of its centre on the level whose cells are just large enough for
/// it, so a tunnel-sized block beside decimetre ones costs one entry, and an open domain costs nothing. A box meets the
/// nine cells around it on its own and on every coarser level.
class CellList
{
  public:
    /// `boxes` is kept by reference until the next build.
    void build(const std::vector<Box>& boxes);

    /// Append the keys of all overlapping pairs whose first member's turn is in `range`: those found from a box of the range
    /// on its own level with a later box, or on a coarser level with any. Every overlapping pair is found exactly once over
    /// all boxes, in an order that depends on the boxes alone.
    void find_pairs(IndexRange range, std::vector<std::uint64_t>& pairs) const;

  private:
    struct Cell
    {
        std::int64_t x, y;
        int level;
    };
    [[nodiscard]] Cell cell_of(const Box& box) const;
    [[nodiscard]] std::size_t slot(std::int64_t x, std::uint64_t row) const;
    void visit(std::size_t slot, const Cell& cell, Index box, std::vector<std::uint64_t>& pairs) const;

    const std::vector<Box>* boxes_ = nullptr;
    double smallest_cell_ = 1.0;    ///< side of a cell on level 0 [m]
    std::vector<Cell> home_;        ///< per box; level -1: empty
    std::vector<int> used_levels_;  ///< ascending
    std::vector<Index> head_;       ///< per hash slot: first box, the rest by next_
    std::vector<Index> next_;
};
}  // namespace hdem
