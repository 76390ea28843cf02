#pragma once
/// Blocks that touch, as the static solver sees them: from jointed rock to what it must not fail on.

#include "core/statics/block_matrix.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <utility>

namespace hdem::test
{
struct ContactGraph
{
    std::string name;
    std::vector<Vec2> places;
    std::vector<CoupledPair> pairs;

    [[nodiscard]] Index blocks() const { return static_cast<Index>(places.size()); }
};

/// The same numbers on every platform.
class Random
{
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double uniform(double low, double high) { return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53; }
    Index below(Index n) { return static_cast<Index>(engine_() % static_cast<std::uint64_t>(n)); }

  private:
    std::mt19937_64 engine_;
};

/// Columns and rows of blocks that touch their neighbours and, at every other corner, the one across it. The lowest row stands on fixed ground.
inline ContactGraph rock_graph(Index columns, Index rows, std::uint64_t seed = 1)
{
    Random random(seed);
    ContactGraph graph{"rock " + std::to_string(columns) + " x " + std::to_string(rows)};
    const auto number = [&](Index c, Index r) { return r * columns + c; };
    for (Index r = 0; r < rows; ++r)
        for (Index c = 0; c < columns; ++c)
        {
            graph.places.emplace_back(c + random.uniform(-0.3, 0.3), r + random.uniform(-0.3, 0.3));
            if (r == 0)
                graph.pairs.push_back({number(c, r), no_index});
            else
                graph.pairs.push_back({number(c, r - 1), number(c, r)});
            if (c > 0)
                graph.pairs.push_back({number(c, r), number(c - 1, r)});
            if (c > 0 && r > 0 && random.below(2) == 0)
                graph.pairs.push_back({number(c, r), number(c - 1, r - 1)});
        }
    return graph;
}

/// Blocks on each other, all above one point.
inline ContactGraph column_graph(Index blocks)
{
    ContactGraph graph = rock_graph(1, blocks);
    graph.name = "column of " + std::to_string(blocks);
    for (Vec2& place : graph.places)
        place.x() = 0.0;
    return graph;
}

/// A slab on a wall: one block touches the whole upper row.
inline ContactGraph slab_graph(Index columns, Index rows)
{
    ContactGraph graph = rock_graph(columns, rows);
    graph.name = "slab on " + std::to_string(columns) + " x " + std::to_string(rows);
    graph.places.emplace_back(0.5 * columns, rows);
    for (Index c = 0; c < columns; ++c)
        graph.pairs.push_back({(rows - 1) * columns + c, columns * rows});
    return graph;
}

/// Several rock masses that do not touch each other, their blocks numbered in turn; some consist of one block.
inline ContactGraph pieces_graph()
{
    ContactGraph graph{"pieces"};
    const std::vector<ContactGraph> piece{rock_graph(13, 11, 2), rock_graph(1, 1), rock_graph(5, 40, 3), rock_graph(1, 1),
                                          rock_graph(20, 20, 4)};
    std::vector<std::vector<Index>> number(piece.size());
    for (Index i = 0; i < 400; ++i)
        for (std::size_t p = 0; p < piece.size(); ++p)
            if (i < piece[p].blocks())
            {
                number[p].push_back(graph.blocks());
                graph.places.emplace_back(piece[p].places[i] + Vec2(7.0 * static_cast<double>(p), 0.0));
            }
    for (std::size_t p = 0; p < piece.size(); ++p)
        for (const CoupledPair& pair : piece[p].pairs)
            graph.pairs.push_back({number[p][pair.a], pair.b == no_index ? no_index : number[p][pair.b]});
    return graph;
}

/// Every block touches every other.
inline ContactGraph crowd_graph(Index blocks)
{
    ContactGraph graph{"crowd of " + std::to_string(blocks)};
    Random random(5);
    for (Index a = 0; a < blocks; ++a)
    {
        graph.places.emplace_back(random.uniform(0.0, 1.0), random.uniform(0.0, 1.0));
        for (Index b = 0; b < a; ++b)
            graph.pairs.push_back({a, b});
    }
    graph.pairs.push_back({0, no_index});
    return graph;
}

/// Blocks that touch nothing but the ground.
inline ContactGraph loose_graph(Index blocks)
{
    ContactGraph graph = rock_graph(blocks, 1);
    graph.name = std::to_string(blocks) + " loose blocks";
    std::erase_if(graph.pairs, [](const CoupledPair& pair) { return pair.b != no_index; });
    return graph;
}

/// The same blocks, their places told wrongly: all at one point, or each at another's.
inline ContactGraph at_one_point(ContactGraph graph)
{
    graph.name += ", at one point";
    std::fill(graph.places.begin(), graph.places.end(), Vec2(3.0, 4.0));
    return graph;
}
inline ContactGraph scattered(ContactGraph graph)
{
    graph.name += ", scattered";
    Random random(6);
    for (Index i = graph.blocks() - 1; i > 0; --i)
        std::swap(graph.places[i], graph.places[random.below(i + 1)]);
    return graph;
}

/// The same blocks under other numbers.
inline ContactGraph renumbered(ContactGraph graph)
{
    graph.name += ", renumbered";
    Random random(8);
    std::vector<Index> number(graph.places.size());
    std::iota(number.begin(), number.end(), 0);
    for (Index i = graph.blocks() - 1; i > 0; --i)
        std::swap(number[i], number[random.below(i + 1)]);
    const std::vector<Vec2> places = graph.places;
    for (Index i = 0; i < graph.blocks(); ++i)
        graph.places[number[i]] = places[i];
    for (CoupledPair& pair : graph.pairs)
        pair = {pair.a == no_index ? no_index : number[pair.a], pair.b == no_index ? no_index : number[pair.b]};
    return graph;
}

inline std::vector<ContactGraph> awkward_graphs()
{
    std::vector<ContactGraph> graphs{{"none"},           rock_graph(1, 1),   rock_graph(2, 1),    rock_graph(40, 35),
                                     rock_graph(400, 3), column_graph(1000), slab_graph(1500, 2), pieces_graph(),
                                     crowd_graph(260),   loose_graph(500)};
    graphs.push_back(at_one_point(renumbered(rock_graph(30, 30))));
    graphs.push_back(scattered(rock_graph(20, 20)));
    graphs.push_back(rock_graph(25, 25));  // each pair twice, as two parts of a block may touch another
    graphs.back().name += ", doubled";
    const std::vector<CoupledPair> once = graphs.back().pairs;
    for (const CoupledPair& pair : once)
        graphs.back().pairs.push_back({pair.b, pair.a});
    return graphs;
}

/// Stiffness of a contact with two points, each with a spring along and across a normal [N/m]: rank four, symmetric; with friction, the shear force of
/// points that slip follows their normal force, and it is not symmetric.
inline Matrix6 contact_stiffness(Random& random, double friction = 0.0)
{
    Matrix6 stiffness = Matrix6::Zero();
    const double angle = random.uniform(0.0, 6.28);
    const Vec2 normal(std::cos(angle), std::sin(angle)), along = turned_left(normal);
    for (int point = 0; point < 2; ++point)
    {
        const Vec2 arm_a(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7)),
            arm_b(random.uniform(-0.7, 0.7), random.uniform(-0.7, 0.7));
        const auto row = [&](const Vec2& d)
        {
            Eigen::Vector<double, 6> relative;
            relative << -d.x(), -d.y(), -cross(arm_a, d), d.x(), d.y(), cross(arm_b, d);
            return relative;
        };
        const double k_n = 7e9 * random.uniform(0.1, 1.0), k_s = 5e8 * random.uniform(0.1, 1.0);
        stiffness += k_n * row(normal) * row(normal).transpose() + k_s * row(along) * row(along).transpose();
        stiffness += friction * (random.below(2) == 0 ? k_n : -k_n) * row(along) * row(normal).transpose();
    }
    return stiffness;
}

/// Contacts of random stiffness, and a small stiffness of each block by itself, so that nothing can move freely.
inline BlockMatrix contact_matrix(const ContactGraph& graph, std::uint64_t seed = 1, double friction = 0.0)
{
    BlockMatrix matrix;
    matrix.set_pattern(graph.blocks(), graph.pairs);
    Random random(seed);
    for (Index i = 0; i < static_cast<Index>(graph.pairs.size()); ++i)
        matrix.add(i, contact_stiffness(random, friction));
    for (Index block = 0; block < graph.blocks(); ++block)
        matrix.diagonal(block) += 1e7 * Matrix3::Identity();
    return matrix;
}

inline Eigen::VectorXd random_vector(Index size, std::uint64_t seed = 7)
{
    Random random(seed);
    return Eigen::VectorXd::NullaryExpr(size, [&] { return random.uniform(-1.0, 1.0); });
}

inline Eigen::MatrixXd dense(const BlockMatrix& matrix)
{
    Eigen::MatrixXd full = Eigen::MatrixXd::Zero(3 * matrix.blocks(), 3 * matrix.blocks());
    const BlockGraph& graph = matrix.graph();
    for (Index row = 0; row < matrix.blocks(); ++row)
    {
        full.block<3, 3>(3 * row, 3 * row) = matrix.diagonal(row);
        for (Index entry = graph.begin[row]; entry < graph.begin[row + 1]; ++entry)
            full.block<3, 3>(3 * row, 3 * graph.neighbour[entry]) = matrix.coupling(entry);
    }
    return full;
}
}  // namespace hdem::test
