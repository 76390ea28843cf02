#pragma once
/// Order of elimination by nested dissection: the blocks are cut in two by a small separator, which is eliminated last, and so on in each half.
///
/// A. George, Nested dissection of a regular finite element mesh, SIAM J. Numer. Anal. 10 (1973) 345-363: in two dimensions n blocks leave a factor of n log n numbers
/// and n^1.5 operations. Separators are found from the places of the blocks, then made as small as the graph allows near there; sets of a hundred blocks
/// are ordered by minimum degree. It depends on the graph and the places alone.

#include "core/statics/minimum_degree.h"
#include "core/statics/straight_cut.h"
#include "core/statics/vertex_cut.h"

namespace hdem
{
/// Blocks in their order of elimination, and how they group: the blocks of a front are eliminated together.
struct EliminationOrder
{
    std::vector<Index> order;
    std::vector<Index> front_begin = {0};  ///< per front + 1: places in `order`
};

/// @param places  centroids [m], one per block; any will do, good ones give small separators
[[nodiscard]] EliminationOrder dissect(const BlockGraph& graph, const std::vector<Vec2>& places);

/// Cuts one set of blocks. Needs room for all blocks; one for each thread.
class Dissector
{
  public:
    Dissector(const BlockGraph& graph, const std::vector<Vec2>& places);

    /// Sort the blocks: those left of a separator, those right of it, the separator. Returns the size of each; no set is as large as all.
    std::array<Index, 3> cut(std::span<Index> blocks);

    /// Sort a set that is not cut any more; the sizes of its fronts are appended.
    void order_leaf(std::span<Index> blocks, std::vector<Index>& front_size) { minimum_degree_.order(blocks, front_size); }

  private:
    void cut_along(const StraightCut& line, std::span<const Index> blocks, GraphCut& cut);
    void cut_by_steps(std::span<Index> blocks, GraphCut& cut);
    void sort_by_steps(std::span<Index> blocks);
    void separate(std::span<const Index> blocks, GraphCut& cut);

    const BlockGraph* graph_;
    const std::vector<Vec2>* places_;
    StraightCutSearch straight_cut_search_;
    VertexCut vertex_cut_;
    MinimumDegree minimum_degree_;
    std::vector<CutSide> side_;  ///< per block
    std::vector<CutSide> best_side_;
};

/// The way from one set to all fronts, level by level. Sets of a level have nothing to do with each other: threads may share them.
class Dissection
{
  public:
    explicit Dissection(Index blocks);

    /// Sets that are still to be refined.
    [[nodiscard]] Index open() const { return static_cast<Index>(open_.size()); }
    /// Cut set i, or order it if it is small.
    void refine(Index i, Dissector& dissector);
    /// Go on to the next level, after all sets of a level are refined.
    void descend();
    /// The order of elimination, once no set is open.
    [[nodiscard]] EliminationOrder result() &&;

  private:
    struct Set
    {
        IndexRange range;               ///< of order_
        std::array<Index, 3> part{};    ///< sizes, once it is cut
        std::vector<Index> front_size;  ///< once it is ordered
    };

    std::vector<Index> order_;
    std::vector<Set> open_;
    std::vector<Index> front_begin_;  ///< not sorted
};
}  // namespace hdem
