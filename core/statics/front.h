#pragma once
/// Dense part of the sparse Cholesky factorisation: one front, a symmetric matrix whose first unknowns are eliminated.
///
///   | A11  A21^T |       | L11      |  | L11^T  L21^T |       L11 L11^T = A11    L21 = A21 L11^-T
///   | A21  A22   |   =   | L21   I  |  |        C     |       C = A22 - L21 L21^T
///
///   1: own unknowns, eliminated here      2: border, unknowns of later fronts      C: what this front hands on to its parent
///
/// [Duff1983] I. S. Duff, J. K. Reid, The multifrontal solution of indefinite sparse symmetric linear equations, ACM Trans. Math. Softw. 9 (1983) 302-325.
///
/// Rows are stored in panels of four: the four numbers of a column lie side by side, and one column behind the other. A panel is at once
/// what the left and what the right factor of a product reads from end to end. Own rows and border rows are each filled up to whole panels with zeros.
/// Own columns are cut into strips, one strip behind the other in memory, each from its own rows down. Every number is formed by the same operations
/// in the same order whichever range of panels is asked for, so that several threads may share a front.
///
/// Eigen's kernels are not used: without its packets, which use fused multiply-add (see core/CMakeLists.txt), they reach a fifth of the speed.

#include "core/simd.h"
#include "core/types.h"

#include <cstddef>

namespace hdem
{
inline constexpr Index strip_columns = 96;  ///< a multiple of 12: strips begin at whole blocks and at whole panels

/// Columns [first, first + width) of the own unknowns.
struct Strip
{
    Index first = 0;
    Index width = 0;
    Index first_panel = 0;   ///< of its rows
    std::size_t offset = 0;  ///< of its numbers among those of the front

    /// Panel behind the rows of its diagonal.
    [[nodiscard]] Index end_panel() const { return first_panel + (width + lanes - 1) / lanes; }
    /// Where a panel of it begins.
    [[nodiscard]] std::size_t panel(Index p) const { return offset + static_cast<std::size_t>(p - first_panel) * width * lanes; }
};

/// How many unknowns, and where their numbers lie.
struct FrontShape
{
    Index own = 0;  ///< multiples of 3
    Index border = 0;

    [[nodiscard]] Index own_panels() const { return (own + lanes - 1) / lanes; }
    [[nodiscard]] Index panels() const { return own_panels() + (border + lanes - 1) / lanes; }
    [[nodiscard]] Index strips() const { return (own + strip_columns - 1) / strip_columns; }
    [[nodiscard]] Strip strip(Index s) const;
    /// Doubles of L11 and L21, and of C.
    [[nodiscard]] std::size_t factor_size() const;
    [[nodiscard]] std::size_t contribution_size() const { return contribution_panel(panels()); }
    /// Where the row panel begins in C, of which the lower triangle is stored.
    [[nodiscard]] std::size_t contribution_panel(Index p) const
    {
        const auto before = static_cast<std::size_t>(p - own_panels());
        return before * (before + 1) / 2 * (lanes * lanes);
    }
    /// Row of the front, filled-up rows counted, of border unknown i.
    [[nodiscard]] Index border_row(Index i) const { return own_panels() * lanes + i; }
};

/// Eliminate the columns of a strip in its first rows: L11 of the strip. On its diagonal the reciprocals are stored.
/// @param smallest  one per column of the front: a pivot that is not greater fails
/// @return  the column of the front that failed, or no_index
[[nodiscard]] Index factor_diagonal(const Strip& strip, const double* smallest, double* factor);

/// L21 of the strip in these row panels, which stand below its diagonal.
void solve_panels(const Strip& strip, IndexRange panels, double* factor);

/// Subtract the strip's product from what stands right of it in these row panels: own columns of later strips, and C, which the first strip
/// sets and the others change.
void update_panels(const FrontShape& shape, Index strip, IndexRange panels, double* factor, double* contribution);

/// All of the above, for a front whose own columns hold A11, A21. C is set to -L21 L21^T.
[[nodiscard]] Index factor_front(const FrontShape& shape, const double* smallest, double* factor, double* contribution);

/// x1 <- L11^-1 x1,  x2 <- x2 - L21 x1.  `x`: one per row of the front, rows that fill up a panel counted and zero.
void solve_forward(const FrontShape& shape, const double* factor, double* x);
/// x1 <- L11^-T (x1 - L21^T x2)
void solve_backward(const FrontShape& shape, const double* factor, double* x);
}  // namespace hdem
