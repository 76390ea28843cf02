#include "core/statics/front.h"
#include "verification/unit/core/statics/contact_graphs.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
/// A front with random numbers, positive definite, and what elimination by Eigen makes of it.
struct RandomFront
{
    FrontShape shape;
    Eigen::MatrixXd full;
    std::vector<double> factor, contribution, smallest;

    RandomFront(Index own, Index border) : shape{own, border}
    {
        const Index n = own + border;
        test::Random random(static_cast<std::uint64_t>(1000 * own + border));
        const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return random.uniform(-1.0, 1.0); });
        full = root * root.transpose() + Eigen::MatrixXd::Identity(n, n);
        smallest.assign(static_cast<std::size_t>(own), 0.0);
        contribution.assign(shape.contribution_size(), std::numeric_limits<double>::quiet_NaN());
        fill();
    }

    [[nodiscard]] Index row(Index i) const { return i < shape.own ? i : shape.border_row(i - shape.own); }
    double& at(Index i, Index j)
    {
        const Strip strip = shape.strip(j / strip_columns);
        return factor[strip.panel(row(i) / lanes) + static_cast<std::size_t>(j - strip.first) * lanes + row(i) % lanes];
    }
    [[nodiscard]] double handed_on(Index i, Index j) const
    {
        const Index r = shape.border_row(i);
        return contribution[shape.contribution_panel(r / lanes) + static_cast<std::size_t>(j) * lanes + r % lanes];
    }
    void fill()
    {
        factor.assign(shape.factor_size(), 0.0);
        for (Index j = 0; j < shape.own; ++j)
            for (Index i = j; i < shape.own + shape.border; ++i)
                at(i, j) = full(i, j);
    }
    Index eliminate() { return factor_front(shape, smallest.data(), factor.data(), contribution.data()); }
};

/// Own, border: within a panel, a strip, and beyond; with every remainder.
const std::vector<std::array<Index, 2>> sizes{{3, 0},   {3, 3},  {6, 9},    {9, 12},  {12, 6},    {15, 30}, {96, 0},
                                              {96, 33}, {99, 6}, {105, 51}, {192, 3}, {201, 120}, {300, 60}};

TEST(Front, HoldsTheCholeskyFactorAndHandsOnTheRest)
{
    for (const auto& [own, border] : sizes)
    {
        SCOPED_TRACE(testing::Message() << own << " + " << border);
        RandomFront front(own, border);
        ASSERT_EQ(front.eliminate(), no_index);
        const Eigen::MatrixXd lower = Eigen::LLT<Eigen::MatrixXd>(front.full).matrixL();
        const double round_off = 1e-15 * front.full.norm();
        for (Index j = 0; j < own; ++j)
        {
            EXPECT_NEAR(1.0 / front.at(j, j), lower(j, j), round_off);
            for (Index i = j + 1; i < own + border; ++i)
                EXPECT_NEAR(front.at(i, j), lower(i, j), round_off);
        }
        const Eigen::MatrixXd below = lower.bottomLeftCorner(border, own);
        const Eigen::MatrixXd rest = -below * below.transpose();
        for (Index j = 0; j < border; ++j)
            for (Index i = j; i < border; ++i)
                EXPECT_NEAR(front.handed_on(i, j), rest(i, j), 4.0 * round_off);
    }
}

/// Several threads share a front: whatever the pieces, the same bits.
TEST(Front, IsTheSameInPieces)
{
    for (const auto& [own, border] : sizes)
        for (const Index a_piece : {1, 2, 5, 7})
        {
            RandomFront whole(own, border), parts(own, border);
            ASSERT_EQ(whole.eliminate(), no_index);
            for (Index s = 0; s < parts.shape.strips(); ++s)
            {
                const Strip strip = parts.shape.strip(s);
                ASSERT_EQ(factor_diagonal(strip, parts.smallest.data(), parts.factor.data()), no_index);
                const Index below = strip.end_panel(), end = parts.shape.panels();
                for (Index p = below; p < end; p += a_piece)
                    solve_panels(strip, {p, std::min(p + a_piece, end)}, parts.factor.data());
                for (Index p = below; p < end; p += a_piece)
                    update_panels(parts.shape, s, {p, std::min(p + a_piece, end)}, parts.factor.data(), parts.contribution.data());
            }
            EXPECT_EQ(parts.factor, whole.factor) << own << " + " << border << " in pieces of " << a_piece;
            EXPECT_EQ(parts.contribution, whole.contribution) << own << " + " << border << " in pieces of " << a_piece;
        }
}

TEST(Front, SolvesForwardAndBackward)
{
    for (const auto& [own, border] : sizes)
    {
        SCOPED_TRACE(testing::Message() << own << " + " << border);
        RandomFront front(own, border);
        ASSERT_EQ(front.eliminate(), no_index);
        const Eigen::MatrixXd lower = Eigen::LLT<Eigen::MatrixXd>(front.full).matrixL();
        const auto l11 = lower.topLeftCorner(own, own).triangularView<Eigen::Lower>();
        const Eigen::MatrixXd l21 = lower.bottomLeftCorner(border, own);
        const Eigen::VectorXd x = test::random_vector(own + border);
        std::vector<double> rows(static_cast<std::size_t>(front.shape.panels()) * lanes, 0.0);
        for (Index i = 0; i < own + border; ++i)
            rows[front.row(i)] = x[i];

        solve_forward(front.shape, front.factor.data(), rows.data());
        Eigen::VectorXd x1 = l11.solve(x.head(own));
        const Eigen::VectorXd x2 = x.tail(border) - l21 * x1;
        const double round_off = 1e-12 * (x1.norm() + x2.norm());
        for (Index i = 0; i < own + border; ++i)
            EXPECT_NEAR(rows[front.row(i)], i < own ? x1[i] : x2[i - own], round_off);

        solve_backward(front.shape, front.factor.data(), rows.data());
        x1 = l11.transpose().solve(x1 - l21.transpose() * x2);
        for (Index i = 0; i < own + border; ++i)
            EXPECT_NEAR(rows[front.row(i)], i < own ? x1[i] : x2[i - own], 1e-12 * (x1.norm() + x2.norm()));
    }
}

TEST(Front, NamesTheColumnWhosePivotIsTooSmall)
{
    for (const Index column : {0, 2, 3, 17, 95, 96, 104})
    {
        RandomFront front(105, 12);
        const Eigen::MatrixXd lower = Eigen::LLT<Eigen::MatrixXd>(front.full).matrixL();
        front.at(column, column) -= lower(column, column) * lower(column, column) + 1e-6;  // a little more than is left of it
        EXPECT_EQ(front.eliminate(), column);

        RandomFront low(105, 12);
        low.smallest[column] = 1e9;
        EXPECT_EQ(low.eliminate(), column);

        RandomFront broken(105, 12);
        broken.at(column, column) = std::numeric_limits<double>::quiet_NaN();
        EXPECT_EQ(broken.eliminate(), column);
    }
}
}  // namespace
}  // namespace hdem
