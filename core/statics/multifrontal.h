#pragma once
/// Cholesky factorisation of a sparse matrix of 3 x 3 blocks, front by front (see front.h): what happens to one front or to the fronts of a subtree.
///
/// A front gathers its columns of the matrix and what its children hand on, eliminates its own unknowns, and hands the rest on to its parent.
/// The order of all sums is that of the tree. In which order fronts are done, and on which threads, is said in parallel/factorisation.

#include "core/statics/front_tree.h"
#include "core/statics/number_buffer.h"

#include <cstddef>

namespace hdem
{
/// Where the fronts of a subtree keep what they hand on until their parent has taken it.
struct StackPlan
{
    std::vector<std::size_t> begin;  ///< per front [doubles]
    std::size_t size = 0;

    /// Give places to `fronts`, a subtree or several: those of even and of odd depth on a stack each, so that a front's room lies beside that of its children.
    /// @param sizes  per front [doubles]
    void add(const FrontTree& tree, IndexRange fronts, const std::vector<std::size_t>& sizes);
};

class Multifrontal
{
  public:
    /// Prepare for matrices with the pattern of this graph. The factor's memory is kept when the next pattern needs no more.
    void set_pattern(const BlockGraph& graph, FrontTree tree);

    [[nodiscard]] const FrontTree& tree() const { return tree_; }
    /// Doubles that the factor takes, and those of the contributions of each front.
    [[nodiscard]] std::size_t factor_size() const { return factor_begin_.empty() ? 0 : factor_begin_.back(); }
    [[nodiscard]] std::vector<std::size_t> contribution_sizes() const;

    // One front, in this order; each step may be shared among threads where it names a range. Columns of the matrix:
    void clear(Index front, int share, int shares);
    void add_matrix(Index front, IndexRange own_blocks, const BlockMatrix& matrix);
    /// Add what a child hands on for own unknowns; children one after another, `rows` of the child's border blocks.
    void add_to_factor(Index child, IndexRange rows, const double* child_contribution);
    // Elimination by the steps of front.h on factor(front), and at last what children hand on for the border.
    void add_to_contribution(Index child, IndexRange rows, const double* child_contribution, double* contribution) const;

    [[nodiscard]] double* factor(Index front) { return factor_.data() + factor_begin_[front]; }
    [[nodiscard]] const double* factor(Index front) const { return factor_.data() + factor_begin_[front]; }
    /// Least pivots of a front: `share` of what stood on the diagonal of the matrix.
    void find_smallest_pivots(Index front, const BlockMatrix& matrix, double share, std::vector<double>& smallest) const;

    // Solution, with x in the order of elimination and `rows` one per row of the front, those that fill up panels counted.
    /// Own unknowns from x, 0 for the border.
    void begin_forward(Index front, const double* x, std::vector<double>& rows) const;
    /// Add what a child hands on, 3 per border block.
    void add_to_rows(Index child, const double* child_border, std::vector<double>& rows) const;
    /// Own unknowns and border from x.
    void begin_backward(Index front, const double* x, std::vector<double>& rows) const;

  private:
    FrontTree tree_;
    std::vector<Index>
        entry_row_;  ///< per entry of the graph: block row in the front that eliminates the row's block, or no_index if the other goes first
    std::vector<std::size_t> factor_begin_;  ///< per front + 1
    NumberBuffer factor_;
};
}  // namespace hdem
