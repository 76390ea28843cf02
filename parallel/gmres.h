#pragma once
/// Iterative solution of A x = b with an unsymmetric A, on a team of threads.

#include "core/statics/krylov.h"
#include "core/statics/number_buffer.h"
#include "parallel/team.h"

#include <functional>

namespace hdem
{
struct GmresSettings
{
    double tolerance = 1e-2;  ///< of |b - A x| / |b|
    int most_iterations = 100;
    int restart = 30;  ///< iterations until the basis is built anew; two vectors of memory each, as far as they are used
};

struct GmresResult
{
    bool converged = false;
    int iterations = 0;     ///< applications of the preconditioner
    double residual = 0.0;  ///< |b - A x| / |b|, computed from x
};

/// Flexible GMRES with restarts: the preconditioner stands right of A, so that the residual is that of the system itself, and may differ from iteration to
/// iteration. Each new vector is made orthogonal to the basis twice, by classical Gram-Schmidt.
///
/// [Saad1986], see core/statics/krylov.h.
/// [Saad1993] Y. Saad, A flexible inner-outer preconditioned GMRES algorithm, SIAM J. Sci. Comput. 14 (1993) 461-469.
/// [Giraud2005] L. Giraud, J. Langou, M. Rozloznik, The loss of orthogonality in the Gram-Schmidt orthogonalization process, Comput. Math. Appl. 50 (2005) 1069-1075: twice is
/// enough.
///
/// Called by all members of a team; the same bits on any number of threads if A and the preconditioner give the same.
/// @see  verification/unit/parallel/gmres_test.cpp
class Gmres
{
  public:
    /// y = A x, or y = M^-1 x: called by all members; all of x is there, and all of y must be when it returns on any of them.
    using Map = std::function<void(const Team& team, const double* x, double* y)>;

    /// Starts from x = 0. Stops where no further iteration helps; x is then the best that was found.
    GmresResult solve(const Team& team, Index size, const Map& matrix, const Map& preconditioner, const double* b, double* x,
                      const GmresSettings& settings = {});

  private:
    [[nodiscard]] double* basis(Index j) { return vectors_.data() + static_cast<std::size_t>(j) * stride_; }
    [[nodiscard]] double* direction(Index j) { return basis(restart_ + 1 + j); }
    void prepare(Index size, int restart);
    [[nodiscard]] std::vector<double> sums(const Team& team, Index count);
    [[nodiscard]] double norm(const Team& team, const double* x);
    std::vector<double> make_orthogonal(const Team& team, Index columns);
    double take_residual(const Team& team, const Map& matrix, const double* b, const double* x);

    Index size_ = 0;
    Index restart_ = 0;
    std::size_t stride_ = 0;
    NumberBuffer vectors_;      ///< restart + 1 of the basis, then restart of what the preconditioner made of them
    std::vector<double> sums_;  ///< piece by piece
};
}  // namespace hdem
