#pragma once
/// Straight lines that cut a set of blocks in two near its middle, across as few contacts as possible.

#include "core/statics/block_matrix.h"
#include "core/statics/vertex_cut.h"

namespace hdem
{
/// Blocks whose place p has direction . p < offset lie on its left.
struct StraightCut
{
    Vec2 direction = {1.0, 0.0};
    double offset = 0.0;  ///< [m]
    double cost = 0.0;    ///< see cost_of()
};

/// What a separator costs: its blocks, and up to half as many again where the sides differ.
[[nodiscard]] inline double cost_of(Index separator, Index left, Index right)
{
    const double difference = left > right ? left - right : right - left;
    return separator * (1.0 + 0.5 * difference / (static_cast<double>(left) + right));
}

/// Lines in eight directions, the cheapest of each, the cheapest direction first; none that has fewer than 0.4 of the blocks on a side. Rock is cut by joints that go through:
/// a line along one of them meets far fewer contacts than another.
/// @param blocks  the set; side[block] is not `outside` for these alone
class StraightCutSearch
{
  public:
    StraightCutSearch(const BlockGraph& graph, const std::vector<Vec2>& places);

    [[nodiscard]] std::vector<StraightCut> find(std::span<const Index> blocks, const std::vector<CutSide>& side);

  private:
    [[nodiscard]] bool find_in_direction(std::span<const Index> blocks, const std::vector<CutSide>& side, StraightCut& line);
    void count_borders(std::span<const Index> blocks, const std::vector<CutSide>& side, Index first, Index last);

    const BlockGraph* graph_;
    const std::vector<Vec2>* places_;
    std::vector<Index> slice_;  ///< per block, of equal width along the direction
    std::vector<Index> count_;  ///< per slice: its blocks
    std::array<std::vector<Index>, 2>
        border_;  ///< per slice: change, from the line before it to the one behind it, in the blocks left and right that touch across it
};
}  // namespace hdem
