#include "parallel/factorisation.h"
#include "verification/unit/core/statics/contact_graphs.h"

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace hdem
{
namespace
{
using test::ContactGraph;

Eigen::SparseMatrix<double> sparse(const BlockMatrix& matrix)
{
    std::vector<Eigen::Triplet<double>> entries;
    const auto put = [&](Index row, Index column, const Matrix3& values)
    {
        for (Index r = 0; r < 3; ++r)
            for (Index c = 0; c < 3; ++c)
                entries.emplace_back(3 * row + r, 3 * column + c, values(r, c));
    };
    for (Index row = 0; row < matrix.blocks(); ++row)
    {
        put(row, row, matrix.diagonal(row));
        for (Index entry = matrix.graph().begin[row]; entry < matrix.graph().begin[row + 1]; ++entry)
            put(row, matrix.graph().neighbour[entry], matrix.coupling(entry));
    }
    Eigen::SparseMatrix<double> all(3 * matrix.blocks(), 3 * matrix.blocks());
    all.setFromTriplets(entries.begin(), entries.end());
    return all;
}

void analyse(Factorisation& factorisation, const ContactGraph& graph, const BlockMatrix& matrix, int threads)
{
    with_team(threads, [&](const Team& team) { factorisation.analyse(team, matrix.graph(), graph.places); });
}

/// Factorise and solve on so many threads; what failed, and x.
struct Outcome
{
    Index failed = no_index;
    Eigen::VectorXd x;
};

Outcome run(Factorisation& factorisation, const BlockMatrix& matrix, const Eigen::VectorXd& b, int threads)
{
    Outcome outcome{no_index, Eigen::VectorXd::Zero(b.size())};
    with_team(threads,
              [&](const Team& team)
              {
                  const Index failed = factorisation.factorise(team, matrix);
                  if (failed == no_index)
                      factorisation.solve(team, b.data(), outcome.x.data());
                  if (team.is_first())
                      outcome.failed = failed;
              });
    return outcome;
}

Outcome run(const ContactGraph& graph, const BlockMatrix& matrix, const Eigen::VectorXd& b, int threads = 1)
{
    Factorisation factorisation;
    analyse(factorisation, graph, matrix, threads);
    return run(factorisation, matrix, b, threads);
}

Eigen::VectorXd product(const BlockMatrix& matrix, const Eigen::VectorXd& x)
{
    Eigen::VectorXd y(x.size());
    matrix.multiply({0, matrix.blocks()}, x.data(), y.data());
    return y;
}

TEST(Factorisation, SolvesWhatEigenSolves)
{
    for (const ContactGraph& graph : test::awkward_graphs())
    {
        SCOPED_TRACE(graph.name);
        const BlockMatrix matrix = test::contact_matrix(graph);
        const Eigen::VectorXd expected = test::random_vector(3 * graph.blocks()), b = product(matrix, expected);
        const Outcome outcome = run(graph, matrix, b);
        ASSERT_EQ(outcome.failed, no_index);
        EXPECT_LE((product(matrix, outcome.x) - b).norm(), 1e-13 * b.norm());
        const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> eigen(sparse(matrix));
        if (graph.blocks() > 0)
        {
            const Eigen::VectorXd theirs = eigen.solve(b);
            // Both are as far from the truth as the condition of the matrix allows.
            EXPECT_LE((outcome.x - expected).norm(), 1e-9 * expected.norm());
            EXPECT_LE((outcome.x - theirs).norm(), 1e-9 * expected.norm());
        }
    }
}

TEST(Factorisation, TakesTheSymmetricPartOfAMatrixWithFriction)
{
    const ContactGraph graph = test::rock_graph(20, 12);
    BlockMatrix matrix = test::contact_matrix(graph, 1, 0.1);
    for (Index block = 0; block < graph.blocks(); ++block)
        matrix.diagonal(block) += 3e9 * Matrix3::Identity();  // the symmetric part of slip is not definite
    const Eigen::MatrixXd full = test::dense(matrix);
    ASSERT_GT((full - full.transpose()).norm(), 1e-2 * full.norm());
    const Eigen::VectorXd b = test::random_vector(3 * graph.blocks());
    const Outcome outcome = run(graph, matrix, b);
    ASSERT_EQ(outcome.failed, no_index);
    EXPECT_LE((0.5 * (full + full.transpose()) * outcome.x - b).norm(), 1e-12 * b.norm());
}

class FactorisationThreads : public testing::TestWithParam<int>
{
};

TEST_P(FactorisationThreads, GiveTheSameBits)
{
    std::vector<ContactGraph> graphs = test::awkward_graphs();
    graphs.push_back(test::rock_graph(130, 120));  // fronts of several strips, shared by all
    for (const ContactGraph& graph : graphs)
    {
        SCOPED_TRACE(graph.name);
        const BlockMatrix matrix = test::contact_matrix(graph);
        const Eigen::VectorXd b = test::random_vector(3 * graph.blocks());
        const Outcome one = run(graph, matrix, b), many = run(graph, matrix, b, GetParam());
        ASSERT_EQ(one.failed, no_index);
        ASSERT_EQ(many.failed, no_index);
        EXPECT_TRUE(one.x == many.x);
    }
}

TEST_P(FactorisationThreads, NameTheSameBlockWhenTheMatrixIsNotDefinite)
{
    const ContactGraph graph = test::rock_graph(90, 80);
    const Eigen::VectorXd b = test::random_vector(3 * graph.blocks());
    test::Random random(11);
    for (int trial = 0; trial < 6; ++trial)
    {
        BlockMatrix matrix = test::contact_matrix(graph);
        const std::array<Index, 2> bad{random.below(graph.blocks()), random.below(graph.blocks())};
        for (const Index block : bad)
            matrix.diagonal(block)(1, 1) = -1.0;
        const Index one = run(graph, matrix, b).failed, many = run(graph, matrix, b, GetParam()).failed;
        EXPECT_EQ(one, many);
        EXPECT_TRUE(one == bad[0] || one == bad[1]) << one;
    }
}

/// What divides the rock in the middle is factored last, by all threads together.
TEST_P(FactorisationThreads, NameABlockOfWhatDividesTheRock)
{
    const ContactGraph graph = test::rock_graph(90, 80);
    const Eigen::VectorXd b = test::random_vector(3 * graph.blocks());
    Vec2 middle = Vec2::Zero();
    for (const Vec2& place : graph.places)
        middle += place / static_cast<double>(graph.blocks());
    std::vector<Index> blocks(static_cast<std::size_t>(graph.blocks()));
    std::iota(blocks.begin(), blocks.end(), Index{0});
    std::ranges::sort(blocks, {}, [&](Index block) { return (graph.places[block] - middle).cwiseAbs().minCoeff(); });
    BlockMatrix matrix = test::contact_matrix(graph);
    for (int i = 0; i < 24; ++i)
    {
        const Matrix3 good = matrix.diagonal(blocks[i]);
        matrix.diagonal(blocks[i])(2, 2) = -1.0;
        EXPECT_EQ(run(graph, matrix, b, GetParam()).failed, blocks[i]);
        matrix.diagonal(blocks[i]) = good;
    }
    EXPECT_EQ(run(graph, matrix, b, GetParam()).failed, no_index);
}

INSTANTIATE_TEST_SUITE_P(Counts, FactorisationThreads, testing::Values(2, 3, 8));

/// A piece of rock that nothing holds moves freely: its last block has no pivot left, but for round-off.
TEST(Factorisation, NamesABlockOfThePieceThatNothingHolds)
{
    ContactGraph graph = test::rock_graph(13, 11);
    const Index held = graph.blocks();
    const ContactGraph piece = test::rock_graph(25, 20);
    for (const Vec2& place : piece.places)
        graph.places.emplace_back(place + Vec2(20.0, 0.0));
    for (const CoupledPair& pair : piece.pairs)
        if (pair.b != no_index)
            graph.pairs.push_back({pair.a + held, pair.b + held});
    const Eigen::VectorXd b = test::random_vector(3 * graph.blocks());
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
    {
        const auto matrix_with = [&](double share)
        {
            BlockMatrix matrix;
            matrix.set_pattern(graph.blocks(), graph.pairs);
            test::Random random(seed);
            for (Index i = 0; i < static_cast<Index>(graph.pairs.size()); ++i)
                matrix.add(i, test::contact_stiffness(random));
            for (Index block = 0; block < graph.blocks(); ++block)
                matrix.diagonal(block).diagonal() *= 1.0 + share;
            return matrix;
        };
        EXPECT_GE(run(graph, matrix_with(0.0), b).failed, held) << "seed " << seed;
        EXPECT_EQ(run(graph, matrix_with(1e-8), b).failed, no_index) << "a little of its own stiffness holds it";
    }
}

TEST(Factorisation, MayBeUsedAgain)
{
    const ContactGraph large = test::rock_graph(40, 30), small = test::rock_graph(9, 5);
    Factorisation factorisation;
    for (const ContactGraph* graph : {&large, &small, &large})
    {
        analyse(factorisation, *graph, test::contact_matrix(*graph), 2);
        for (const std::uint64_t seed : {1, 2, 1})
        {
            const BlockMatrix matrix = test::contact_matrix(*graph, seed);
            const Eigen::VectorXd b = test::random_vector(3 * graph->blocks());
            const Outcome again = run(factorisation, matrix, b, 2), fresh = run(*graph, matrix, b, 1);
            ASSERT_EQ(again.failed, no_index);
            EXPECT_TRUE(again.x == fresh.x);
        }
    }
    // After a failure too.
    BlockMatrix bad = test::contact_matrix(large);
    bad.diagonal(700) *= -1.0;
    const Eigen::VectorXd b = test::random_vector(3 * large.blocks());
    EXPECT_NE(run(factorisation, bad, b, 2).failed, no_index);
    const BlockMatrix good = test::contact_matrix(large);
    EXPECT_TRUE(run(factorisation, good, b, 2).x == run(large, good, b).x);
}

TEST(Factorisation, SolvesInPlace)
{
    const ContactGraph graph = test::rock_graph(15, 15);
    const BlockMatrix matrix = test::contact_matrix(graph);
    Eigen::VectorXd x = test::random_vector(3 * graph.blocks());
    const Outcome outcome = run(graph, matrix, x);
    Factorisation factorisation;
    analyse(factorisation, graph, matrix, 1);
    ASSERT_EQ(factorisation.factorise(Team(0, 1), matrix), no_index);
    factorisation.solve(Team(0, 1), x.data(), x.data());
    EXPECT_TRUE(x == outcome.x);
}

/// [Lipton1979] and the bars of the solver: a rock mass of n blocks needs a few kB of factor a block.
TEST(Factorisation, TakesLittleMemory)
{
    const ContactGraph graph = test::rock_graph(150, 150);
    Factorisation factorisation;
    analyse(factorisation, graph, test::contact_matrix(graph), 1);
    EXPECT_LT(static_cast<double>(factorisation.factor_bytes()) / graph.blocks(), 2300.0);
}
}  // namespace
}  // namespace hdem
