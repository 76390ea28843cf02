#pragma once
/// Interior-point method for the impulses of an island.

#include "core/contact/island_problem.h"

#include <Eigen/SparseLU>

#include <array>

namespace hdem
{
/// Solves an IslandProblem by a primal-dual interior-point method (S. J. Wright, Primal-Dual Interior-Point Methods, SIAM 1997) for its
/// complementarity conditions (D. E. Stewart, J. C. Trinkle, Int. J. Numer. Meth. Eng. 39, 1996, with the two directions that a plane has):
///
///   M dv + n^T dJ - t^T dJ_S = 0
///   0 <= J   ⟂  s = target - n v >= 0
///   0 <= p = B - J_S  ⟂  a >= 0,   0 <= r = B + J_S  ⟂  b >= 0,   t v = b - a,   B = J tan(phi) + c
///
///   v    velocities of the blocks, dv their change by dJ, dJ_S [m/s]    M   masses [kg]
///   n, t rows that make a point's approach and sliding velocity of v
///   s, a, b   velocities: of parting, and of sliding against and along t [m/s]
///
/// Each product on a line is not 0 but epsilon, which falls towards 0 from step to step; a step is one of Newton's, as far as all stay positive. As
/// all points are seen at once, neither ratios of mass nor the length of a chain matters: 5 to 20 steps. Where points carry more than equilibrium asks
/// for, the load ends up between the possible ones.
/// The matrix has a row a component of a block, scaled by the root of its mass, and one for each J and J_S. (Without rows for J and J_S, the matrix would
/// hold numbers J / s, which grow without bound: at mass ratios of 1e6 light blocks would lose all digits.)
/// @see verification/unit/core/contact/interior_point_test.cpp
class InteriorPoint
{
  public:
    explicit InteriorPoint(const IslandProblem& problem);

    /// The problem with impulses that bring its error() to `goal` [m/s] or below; if that fails, with the best that were met. Impulses stay
    /// below IslandProblem::impulse_bound().
    [[nodiscard]] IslandProblem solve(double goal);

  private:
    using Row = std::array<double, 6>;
    using Vector = Eigen::VectorXd;
    using Matrix = Eigen::SparseMatrix<double>;

    /// Impulses and velocities of a point, or their changes in a step.
    struct Pairs
    {
        double normal = 0.0, parting = 0.0;              ///< J [N s], s [m/s]
        double shear = 0.0, against = 0.0, along = 0.0;  ///< J_S [N s], a, b [m/s]
    };
    friend Pairs operator*(double factor, const Pairs& x)
    {
        return {factor * x.normal, factor * x.parting, factor * x.shear, factor * x.against, factor * x.along};
    }
    friend Pairs operator+(const Pairs& x, const Pairs& y)
    {
        return {x.normal + y.normal, x.parting + y.parting, x.shear + y.shear, x.against + y.against, x.along + y.along};
    }
    /// Products of the pairs: J s, p a, r b [J].
    struct Products
    {
        double normal = 0.0, against = 0.0, along = 0.0;
    };
    struct Point
    {
        Pairs now;
        PointVelocity velocity;                           ///< before any step [m/s]
        std::array<Row, 2> row;                           ///< n and t, scaled
        std::array<Index, 6> at;                          ///< unknowns that they multiply, or no_index
        Index normal_at = no_index, shear_at = no_index;  ///< unknowns J and J_S, or no_index where there is none
    };

    void start();
    /// After a step of that length.
    [[nodiscard]] double mean_product(const std::vector<Pairs>& change, double length) const;
    [[nodiscard]] PointVelocity velocity_now(const Point& point) const;
    void factorize();
    [[nodiscard]] Vector right_side(const std::vector<Products>& aim) const;
    [[nodiscard]] std::vector<Pairs> changes(const Vector& step, const std::vector<Products>& aim) const;
    [[nodiscard]] double length_inside(std::size_t i, const Pairs& change) const;
    [[nodiscard]] double length_inside(const std::vector<Pairs>& change) const;
    /// @return share of Newton's step that was gone; 0: none can be made
    [[nodiscard]] double take_step();
    [[nodiscard]] IslandProblem present() const;

    const IslandProblem& problem_;
    std::vector<Point> points_;
    std::vector<Eigen::Triplet<double>> entries_;
    Vector change_;  ///< of the velocities, scaled
    Matrix matrix_;
    Eigen::SparseLU<Matrix> factor_;
    double greatest_ = 0.0;  ///< impulse that a solution may have [N s]
    Index components_ = 0;   ///< of the blocks' velocities
    Index unknowns_ = 0;
    bool is_analysed_ = false;
};
}  // namespace hdem
