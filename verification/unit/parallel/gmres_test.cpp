#include "parallel/factorisation.h"
#include "parallel/gmres.h"
#include "verification/unit/core/statics/contact_graphs.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <limits>

namespace hdem
{
namespace
{
using test::ContactGraph;

struct Solution
{
    GmresResult result;
    Eigen::VectorXd x;
};

Gmres::Map map_of(const Eigen::MatrixXd& matrix)
{
    return [&matrix](const Team& team, const double* x, double* y)
    { team.alone([&] { Eigen::VectorXd::Map(y, matrix.rows()) = matrix * Eigen::VectorXd::Map(x, matrix.cols()); }); };
}

void copy(const Team& team, Index size, const double* x, double* y)
{
    team.alone([&] { std::copy_n(x, size, y); });
}

Solution solve(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& b, const GmresSettings& settings, int threads = 1)
{
    Solution solution{{}, Eigen::VectorXd::Constant(b.size(), 1e300)};
    const auto size = static_cast<Index>(b.size());
    Gmres gmres;
    with_team(threads,
              [&](const Team& team)
              {
                  const GmresResult result = gmres.solve(
                      team, size, map_of(matrix), [&](const Team& t, const double* x, double* y) { copy(t, size, x, y); }, b.data(),
                      solution.x.data(), settings);
                  if (team.is_first())
                      solution.result = result;
              });
    return solution;
}

/// Well away from singular, and far from symmetric.
Eigen::MatrixXd unsymmetric(Index size, std::uint64_t seed)
{
    test::Random random(seed);
    return Eigen::MatrixXd::NullaryExpr(size, size, [&] { return random.uniform(-1.0, 1.0); }) +
           2.0 * std::sqrt(static_cast<double>(size)) * Eigen::MatrixXd::Identity(size, size);
}

TEST(Gmres, SolvesWhatALuFactorisationSolves)
{
    for (const Index size : {1, 2, 3, 10, 100, 300})
        for (const int restart : {5, 400})
        {
            const Eigen::MatrixXd matrix = unsymmetric(size, static_cast<std::uint64_t>(size));
            const Eigen::VectorXd b = test::random_vector(size), expected = matrix.lu().solve(b);
            const Solution found = solve(matrix, b, {.tolerance = 1e-12, .most_iterations = 500, .restart = restart});
            EXPECT_TRUE(found.result.converged) << size << ", restart " << restart;
            EXPECT_LE((matrix * found.x - b).norm(), 1e-12 * b.norm());
            EXPECT_NEAR(found.result.residual, (matrix * found.x - b).norm() / b.norm(), 1e-15);
            EXPECT_LE((found.x - expected).norm(), 1e-11 * expected.norm());
        }
}

/// Without restarts the residual is the least that any polynomial of the matrix leaves: after as many iterations as it has different eigenvalues, none.
TEST(Gmres, NeedsAnIterationForEachEigenvalue)
{
    Eigen::VectorXd values(60);
    for (Index i = 0; i < 60; ++i)
        values[i] = 1.0 + i % 4;
    const Eigen::MatrixXd basis = unsymmetric(60, 3), matrix = basis * values.asDiagonal() * basis.inverse();
    const Solution found = solve(matrix, test::random_vector(60), {.tolerance = 1e-11});
    EXPECT_TRUE(found.result.converged);
    EXPECT_EQ(found.result.iterations, 4);
    EXPECT_FALSE(solve(matrix, test::random_vector(60), {.tolerance = 1e-11, .most_iterations = 3}).result.converged);
}

/// What Newton's method asks for: the tangent of points that slip is unsymmetric, +- tan(phi) K_N couples shear to normal; the factor of its symmetric part preconditions it.
class GmresOnSlip : public testing::TestWithParam<int>
{
  protected:
    /// A rock mass in which every third contact slips.
    GmresOnSlip() : graph(test::rock_graph(60, 45))
    {
        tangent.set_pattern(graph.blocks(), graph.pairs);
        test::Random random(4);
        for (Index i = 0; i < static_cast<Index>(graph.pairs.size()); ++i)
            tangent.add(i, test::contact_stiffness(random, i % 3 == 0 ? 0.05 : 0.0));
        for (Index block = 0; block < graph.blocks(); ++block)
            tangent.diagonal(block) += 3e8 * Matrix3::Identity();
        b = test::random_vector(3 * graph.blocks());
    }

    Solution run(int threads, double tolerance)
    {
        Solution solution{{}, Eigen::VectorXd::Zero(b.size())};
        Factorisation factorisation;
        Gmres gmres;
        const auto multiply = [&](const Team& team, const double* x, double* y)
        {
            tangent.multiply(team.share(tangent.blocks()), x, y);
            team.barrier();
        };
        with_team(threads,
                  [&](const Team& team)
                  {
                      factorisation.analyse(team, tangent.graph(), graph.places);
                      ASSERT_EQ(factorisation.factorise(team, tangent), no_index);
                      const GmresResult result = gmres.solve(team, static_cast<Index>(b.size()), multiply,
                                                             [&](const Team& t, const double* x, double* y)
                                                             { factorisation.solve(t, x, y); },
                                                             b.data(), solution.x.data(), {.tolerance = tolerance});
                      if (team.is_first())
                          solution.result = result;
                  });
        return solution;
    }

    ContactGraph graph;
    BlockMatrix tangent;
    Eigen::VectorXd b;
};

TEST_F(GmresOnSlip, ConvergesInAFewSolves)
{
    for (const double tolerance : {1e-2, 1e-10})
    {
        const Solution found = run(1, tolerance);
        EXPECT_TRUE(found.result.converged);
        Eigen::VectorXd product(b.size());
        tangent.multiply({0, tangent.blocks()}, found.x.data(), product.data());
        EXPECT_LE((product - b).norm(), tolerance * b.norm());
        EXPECT_LE(found.result.iterations, tolerance > 1e-3 ? 8 : 40);
        EXPECT_GT(found.result.iterations, 1);
    }
}

TEST_P(GmresOnSlip, GivesTheSameBitsOnAnyNumberOfThreads)
{
    const Solution one = run(1, 1e-6), many = run(GetParam(), 1e-6);
    EXPECT_GT(one.x.norm(), 0.0);
    EXPECT_TRUE(one.x == many.x);
    EXPECT_EQ(one.result.iterations, many.result.iterations);
    EXPECT_EQ(one.result.residual, many.result.residual);
}

INSTANTIATE_TEST_SUITE_P(Threads, GmresOnSlip, testing::Values(2, 3, 8));

TEST(Gmres, SaysWhenItDoesNotConverge)
{
    // A turn by 90 degrees in each of many planes: nothing is gained before the last of `size` iterations.
    const Index size = 40;
    Eigen::MatrixXd cycle = Eigen::MatrixXd::Zero(size, size);
    for (Index i = 0; i < size; ++i)
        cycle((i + 1) % size, i) = 1.0;
    const Eigen::VectorXd b = Eigen::VectorXd::Unit(size, 0);
    const Solution stuck = solve(cycle, b, {.tolerance = 1e-6, .restart = 10});
    EXPECT_FALSE(stuck.result.converged);
    EXPECT_EQ(stuck.result.iterations, 10) << "restarted in vain";
    EXPECT_DOUBLE_EQ(stuck.result.residual, 1.0);
    EXPECT_TRUE(solve(cycle, b, {.tolerance = 1e-6, .restart = 40}).result.converged);
    const Solution cut_short = solve(unsymmetric(100, 5), test::random_vector(100), {.tolerance = 1e-12, .most_iterations = 3});
    EXPECT_FALSE(cut_short.result.converged);
    EXPECT_EQ(cut_short.result.iterations, 3);
    EXPECT_LT(cut_short.result.residual, 1.0);
}

TEST(Gmres, LeavesASingularSystemNoWorseThanItBegan)
{
    Eigen::MatrixXd matrix = unsymmetric(30, 9);
    matrix.row(7).setZero();
    Eigen::VectorXd b = matrix * test::random_vector(30);
    EXPECT_TRUE(solve(matrix, b, {.tolerance = 1e-10}).result.converged) << "a solution exists";
    b[7] = 1.0;  // none exists
    const Solution found = solve(matrix, b, {.tolerance = 1e-10});
    EXPECT_FALSE(found.result.converged);
    EXPECT_NEAR(found.result.residual, (matrix * found.x - b).norm() / b.norm(), 1e-9);
    EXPECT_LT(found.result.residual, 1.0);
}

TEST(Gmres, KeepsWhatItHasWhenTheMatrixGivesNoNumbers)
{
    const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(5, 5);
    const Solution found = solve(zero, Eigen::VectorXd::Ones(5), {});
    EXPECT_FALSE(found.result.converged);
    EXPECT_EQ(found.x.norm(), 0.0);
    EXPECT_EQ(found.result.residual, 1.0);
    const Eigen::MatrixXd broken = Eigen::MatrixXd::Constant(5, 5, std::numeric_limits<double>::quiet_NaN());
    EXPECT_FALSE(solve(broken, Eigen::VectorXd::Ones(5), {}).result.converged);
    EXPECT_EQ(solve(broken, Eigen::VectorXd::Ones(5), {}).x.norm(), 0.0);
    const Solution nothing = solve(unsymmetric(5, 1), Eigen::VectorXd::Zero(5), {});
    EXPECT_TRUE(nothing.result.converged);
    EXPECT_EQ(nothing.result.iterations, 0);
    EXPECT_EQ(nothing.x.norm(), 0.0);
}

/// The same object for systems of other sizes: the basis is kept, not its contents.
TEST(Gmres, MayBeUsedAgain)
{
    Gmres gmres;
    for (const Index size : {50, 20, 50, 120})
    {
        const Eigen::MatrixXd matrix = unsymmetric(size, 2);
        const Eigen::VectorXd b = test::random_vector(size);
        Eigen::VectorXd x(size);
        const Team alone(0, 1);
        const GmresResult result = gmres.solve(alone, size, map_of(matrix),
                                               [&](const Team& t, const double* from, double* to) { copy(t, size, from, to); },
                                               b.data(), x.data(), {.tolerance = 1e-10});
        EXPECT_TRUE(result.converged);
        EXPECT_TRUE(x == solve(matrix, b, {.tolerance = 1e-10}).x);
    }
}
}  // namespace
}  // namespace hdem
