#pragma once
/// Separators of the graph of blocks that touch: a smallest one near a given one.

#include "core/statics/block_matrix.h"

#include <cstdint>

namespace hdem
{
/// Where a block of the set that is cut in two lies. No block on the left touches one on the right.
enum class CutSide : std::uint8_t
{
    left,
    right,
    separator,
    outside  ///< not of this set
};

struct GraphCut
{
    std::vector<Index> separator;
    std::array<Index, 2> size{};  ///< blocks left and right of it

    [[nodiscard]] Index blocks() const { return size[0] + size[1] + static_cast<Index>(separator.size()); }
};

/// Smallest separators by greatest flow: between what lies left and what lies right of a band around the given separator there are as many paths without
/// a common block as the smallest separator within the band has blocks (Menger's theorem). Paths are found layer by layer.
///
/// E. A. Dinic, Algorithm for solution of a problem of maximum flow in networks with power estimation, Soviet Math. Dokl. 11 (1970) 1277-1280.
/// S. Even, R. E. Tarjan, Network flow and testing graph connectivity, SIAM J. Comput. 4 (1975) 507-518: blocks that bear one path each.
///
/// @see  verification/unit/core/statics/vertex_cut_test.cpp
class VertexCut
{
  public:
    explicit VertexCut(const BlockGraph& graph);

    /// Replace the separator by a smallest one among the blocks within `layers` contacts of it. On each side the blocks farthest from it stay where they are,
    /// `kept` of them at least, or all when there are fewer.
    void shrink(int layers, Index kept, std::vector<CutSide>& side, GraphCut& cut);

  private:
    void gather_band(int layers, Index kept, const std::vector<CutSide>& side, const GraphCut& cut);
    void link_band(const std::vector<CutSide>& side, CutSide from);
    bool find_layers();
    bool find_path(Index start);
    [[nodiscard]] Index next_node(Index node, Index arc) const;
    void add_path();

    const BlockGraph* graph_;
    std::vector<Index> local_;  ///< per block: place in the band, or no_index

    // One per block of the band.
    std::vector<Index> band_;
    std::vector<Index> arc_begin_;             ///< and one more
    std::vector<Index> arc_;                   ///< places in the band
    std::vector<std::uint8_t> starts_, ends_;  ///< touches a block of the one side or of the other that is not in the band
    std::vector<Index> before_, after_;        ///< of the path through it

    // A block is two nodes: 2 i, where paths enter, and 2 i + 1, where they leave.
    std::vector<Index> layer_, tried_;
    std::vector<Index> queue_, path_;
};
}  // namespace hdem
