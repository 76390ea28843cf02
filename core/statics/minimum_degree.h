#pragma once
/// Order of elimination inside a small set of blocks: always one with the fewest neighbours left.

#include "core/statics/block_matrix.h"

#include <cstdint>

namespace hdem
{
/// Minimum degree [Tinney1967], on the graph itself, as rows of bits: a set is small. Blocks around it, which are eliminated later, count as
/// neighbours. A neighbour of the one just eliminated that has no others than it had goes with it, in the same front.
///
/// [Tinney1967] W. F. Tinney, J. W. Walker, Direct solutions of sparse network equations by optimally ordered triangular factorization, Proc. IEEE 55 (1967) 1801-1809.
class MinimumDegree
{
  public:
    explicit MinimumDegree(const BlockGraph& graph);

    /// Sort the blocks in the order of elimination; `front_size` receives how many of them make up each front, in that order.
    void order(std::span<Index> blocks, std::vector<Index>& front_size);

  private:
    void gather(std::span<const Index> blocks);
    void eliminate(Index pivot, std::vector<Index>& front);
    [[nodiscard]] Index count(Index row) const;
    [[nodiscard]] std::uint64_t* row(Index i) { return bits_.data() + static_cast<std::size_t>(i) * words_; }
    [[nodiscard]] const std::uint64_t* row(Index i) const { return bits_.data() + static_cast<std::size_t>(i) * words_; }
    void clear(Index i, Index column) { row(i)[column / 64] &= ~(std::uint64_t{1} << (column % 64)); }

    const BlockGraph* graph_;
    std::vector<Index> local_;         ///< per block: its row, or no_index
    std::vector<Index> block_;         ///< per row; those to be ordered first
    Index inner_ = 0;                  ///< how many these are
    std::size_t words_ = 0;            ///< a row
    std::vector<std::uint64_t> bits_;  ///< who touches whom, once those eliminated have joined their neighbours
    std::vector<Index> degree_;        ///< per block to be ordered; no_index: eliminated
    std::vector<Index> near_;
};
}  // namespace hdem
