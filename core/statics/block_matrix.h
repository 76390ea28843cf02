#pragma once
/// Sparse matrix of 3 x 3 blocks: three unknowns a block of rock (x, y, rotation), coupled where two blocks touch.

#include "core/types.h"

#include <array>
#include <span>

namespace hdem
{
using Matrix3 = Eigen::Matrix3d;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix36 = Eigen::Matrix<double, 3, 6>;  ///< the rows of one of two blocks

/// The same rows with the friction that makes a tangent unsymmetric, and without.
struct RowPair
{
    Matrix36 coupled, symmetric;
};

/// Two blocks that touch, by their numbers among the unknowns; no_index: a block that cannot move.
struct CoupledPair
{
    Index a = no_index;
    Index b = no_index;
};

/// Who touches whom: each pair twice, each row ascending, no block itself.
struct BlockGraph
{
    std::vector<Index> begin = {0};  ///< per block + 1
    std::vector<Index> neighbour;

    [[nodiscard]] Index blocks() const { return static_cast<Index>(begin.size()) - 1; }
    [[nodiscard]] std::span<const Index> of(Index block) const
    {
        return {neighbour.data() + begin[block], neighbour.data() + begin[block + 1]};
    }
};

/// The pattern follows from a list of pairs and stays until another list is given. Pairs may occur several times: theirs add up, in the order of the
/// list. Values need not be symmetric: a tangent with friction is not.
/// @see  verification/unit/core/statics/block_matrix_test.cpp
class BlockMatrix
{
  public:
    /// Set the pattern; all values are zero then. Throws std::invalid_argument, naming the pair, when a number is outside of [0, blocks) and not no_index, or when
    /// a block is paired with itself.
    void set_pattern(Index blocks, std::span<const CoupledPair> pairs);

    [[nodiscard]] Index blocks() const { return graph_.blocks(); }
    [[nodiscard]] const BlockGraph& graph() const { return graph_; }

    void set_zero();
    /// Add the stiffness of pair i of the list; its unknowns are those of a, then those of b. What belongs to a block that cannot move is left out.
    void add(Index pair, const Matrix6& stiffness);

    /// The same for all pairs of two matrices of one pattern, row by row, so that threads may share the rows: their values of `rows` become the sums of
    /// stiffness(i, side), bit by bit those of add().
    /// @param stiffness  rows of a (side 0) or of b (1) of pair i
    template <typename Stiffness>
    static void assemble(IndexRange rows, const Stiffness& stiffness, BlockMatrix& coupled, BlockMatrix& symmetric);

    [[nodiscard]] Matrix3& diagonal(Index block) { return diagonal_[block]; }
    [[nodiscard]] const Matrix3& diagonal(Index block) const { return diagonal_[block]; }
    /// Row block and column block of an entry of graph().neighbour.
    [[nodiscard]] const Matrix3& coupling(Index entry) const { return coupling_[half_[entry]]; }
    /// Symmetric part of the coupling: (K_ab + K_ba^T) / 2.
    [[nodiscard]] Matrix3 symmetric_coupling(Index entry) const
    {
        return 0.5 * (coupling_[half_[entry]] + coupling_[half_[entry] ^ 1].transpose());
    }

    /// y = A x in these rows. x, y: three per block.
    void multiply(IndexRange rows, const double* x, double* y) const;

  private:
    void set_row_zero(Index row);
    void add_row(Index pair, int side, const Matrix36& rows);

    BlockGraph graph_;
    std::vector<CoupledPair> pairs_;
    std::vector<Index> half_of_;     ///< per pair: of the coupling (a, b), or no_index; (b, a) is the other half, half ^ 1
    std::vector<Index> half_;        ///< per entry of the graph: position in coupling_
    std::vector<Index> list_begin_;  ///< per block + 1: its pairs,
    std::vector<Index> list_;        ///< 2 pair + (block is b)
    std::vector<Matrix3> diagonal_;
    std::vector<Matrix3> coupling_;  ///< both halves of a pair beside each other
};

template <typename Stiffness>
void BlockMatrix::assemble(IndexRange rows, const Stiffness& stiffness, BlockMatrix& coupled, BlockMatrix& symmetric)
{
    for (Index row = rows.begin; row < rows.end; ++row)
    {
        coupled.set_row_zero(row);
        symmetric.set_row_zero(row);
        for (Index k = coupled.list_begin_[row]; k < coupled.list_begin_[row + 1]; ++k)
        {
            const Index pair = coupled.list_[k] / 2;
            const int side = coupled.list_[k] % 2;
            const RowPair both = stiffness(pair, side);
            coupled.add_row(pair, side, both.coupled);
            symmetric.add_row(pair, side, both.symmetric);
        }
    }
}
}  // namespace hdem
