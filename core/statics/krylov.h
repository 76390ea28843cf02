#pragma once
/// Parts of GMRES that know no threads: sums over stretches of vectors, and the small problem of least squares.

#include "core/types.h"

#include <span>

namespace hdem
{
/// a . b over a range. Sums over a vector are formed of those over its pieces of this size, in their order: the same bits on any number of threads.
inline constexpr Index sum_piece = 4096;
[[nodiscard]] double dot(IndexRange range, const double* a, const double* b);
/// y <- y + factor x over a range.
void add_scaled(IndexRange range, double factor, const double* x, double* y);

/// min |beta e1 - H y|, H upper Hessenberg, (j + 1) x j, given column by column and turned into a triangle by Givens rotations.
///
/// [Saad1986] Y. Saad, M. H. Schultz, GMRES: a generalized minimal residual algorithm for solving nonsymmetric linear systems, SIAM J. Sci. Stat. Comput. 7
/// (1986) 856-869, section 3.2.
class HessenbergProblem
{
  public:
    void begin(double beta);
    /// Column j of H: j + 2 numbers, the last of them not negative. Returns |beta e1 - H y| of the best y.
    double add_column(std::span<const double> column);
    [[nodiscard]] Index columns() const { return static_cast<Index>(triangle_.size()); }
    /// The best y, one per column. A column that depends on those before it gets 0.
    [[nodiscard]] std::vector<double> solve() const;

  private:
    struct Rotation
    {
        double c = 1.0;
        double s = 0.0;
    };
    std::vector<std::vector<double>> triangle_;  ///< columns
    std::vector<Rotation> rotation_;             ///< one per column
    std::vector<double> right_;                  ///< rotated right side, columns + 1
};
}  // namespace hdem
