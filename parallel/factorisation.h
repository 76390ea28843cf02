#pragma once
/// Direct solution of A x = b for the symmetric part of a matrix of 3 x 3 blocks, on a team of threads.

#include "core/statics/multifrontal.h"
#include "parallel/team.h"

#include <optional>

namespace hdem
{
/// Cholesky factor L L^T. Subtrees of fronts are dealt out to the threads; the fronts above them, which hold most of the operations, are done one after another
/// by all threads together. Every sum has the order of the tree: the same bits on any number of threads.
///
/// All of it is called by all members of a team together, always as many.
/// @see  verification/unit/parallel/factorisation_test.cpp
class Factorisation
{
  public:
    /// Order the blocks and plan the memory, for matrices with this graph. To be called again only when the graph changes.
    /// @param places  centroids of the blocks [m], one per block
    void analyse(const Team& team, const BlockGraph& graph, const std::vector<Vec2>& places);

    /// A pivot that is not greater than this share of the matrix' own diagonal fails: it has lost all but a few of its digits.
    static constexpr double smallest_pivot = 1e-13;

    /// Returns no_index, or the block at which the matrix was found not to be positive definite: the first one in the order of elimination. There is no
    /// factor then.
    Index factorise(const Team& team, const BlockMatrix& matrix);

    /// x = (L L^T)^-1 b;  b, x: three per block; they may be the same.
    void solve(const Team& team, const double* b, double* x);

    [[nodiscard]] const FrontTree& tree() const { return fronts_.tree(); }
    /// Memory of the factor, and all that this object holds [bytes].
    [[nodiscard]] std::size_t factor_bytes() const { return fronts_.factor_size() * sizeof(double); }

  private:
    /// What one thread needs.
    struct Scratch
    {
        NumberBuffer contributions;    ///< of the subtree that it is at
        std::vector<double> smallest;  ///< pivots of one front
        std::vector<double> rows;      ///< of one front
    };

    void choose_subtrees(int threads);
    void plan_memory(int threads);
    [[nodiscard]] double* handed_on(const StackPlan& plan, Index front, Scratch& scratch);
    [[nodiscard]] Index factor_alone(Index front, const BlockMatrix& matrix, Scratch& scratch);
    [[nodiscard]] Index factor_subtree(IndexRange fronts, const BlockMatrix& matrix, Scratch& scratch);
    [[nodiscard]] Index factor_together(const Team& team, Index front, const BlockMatrix& matrix);
    void forward(Index front, Scratch& scratch);
    void backward(Index front, Scratch& scratch);

    std::optional<Dissection> dissection_;  ///< while it is going on
    Multifrontal fronts_;
    std::vector<IndexRange> subtree_;      ///< of fronts; the longest first
    std::vector<Index> top_;               ///< fronts above them, ascending
    std::vector<std::uint8_t> is_shared_;  ///< per front: what it hands on lies in contributions_, not in a thread's scratch

    StackPlan contribution_plan_, border_plan_;
    NumberBuffer contributions_;
    std::vector<Scratch> scratch_;  ///< per thread
    std::vector<Index> failed_;     ///< per subtree, and for what is above them: place, or no_index
    std::vector<double> x_;         ///< in the order of elimination
};
}  // namespace hdem
