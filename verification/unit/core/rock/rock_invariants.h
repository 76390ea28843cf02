#pragma once
/// What holds for every generated rock mass, whatever its joints and outlines.

#include "core/geometry/convex_decomposition.h"
#include "core/rock/block_overlap.h"
#include "core/rock/rock_mass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hdem
{
/// Rectangle with joint sets {dip, spacing} of ± 2°.
inline CaseDef jointed_case(double width, double height, const std::vector<Vec2>& sets, std::uint64_t seed = 1)
{
    CaseDef def;
    def.domain.given = true;
    def.domain.width = width;
    def.domain.height = height;
    def.generator.seed = seed;
    for (const Vec2& set : sets)
    {
        JointSetDef joints;
        joints.name = "set" + std::to_string(def.joint_sets.size() + 1);
        joints.dip_deg = set.x();
        joints.spacing = set.y();
        joints.deviation_deg = 2.0;
        def.joint_sets.push_back(joints);
    }
    return def;
}

/// 35 m x 33 m with three joint sets and a horseshoe tunnel of 9 m x 8 m.
inline CaseDef tunnel_case(std::uint64_t seed, InsideOutline inside)
{
    CaseDef def = jointed_case(35.0, 33.0, {{-10.0, 1.7}, {70.0, 1.7}, {-75.0, 3.5}}, seed);
    def.domain.fixed = {"left", "right", "bottom"};
    def.generator.smallest_block_area = 0.363;
    ExcavationDef tunnel;
    tunnel.name = "tunnel";
    tunnel.shape = OutlineShape::horseshoe;
    tunnel.width = 9.0;
    tunnel.height = 8.0;
    tunnel.position = {17.5, 12.5};
    tunnel.inside = inside;
    def.excavations.push_back(tunnel);
    return def;
}

inline double summed_area(const RockMass& rock)
{
    double sum = 0.0;
    for (const RockBlock& block : rock.blocks)
    {
        sum += area(block);
    }
    return sum;
}

struct DirectedEdge
{
    Vec2 from;
    Vec2 to;
    std::size_t block;
    std::int32_t source;
};

inline std::vector<DirectedEdge> all_edges(const RockMass& rock)
{
    std::vector<DirectedEdge> edges;
    for (std::size_t b = 0; b < rock.blocks.size(); ++b)
    {
        for (const ConvexPart& part : rock.blocks[b].parts)
        {
            for (std::size_t i = 0; i < part.vertices.size(); ++i)
            {
                edges.push_back({part.vertices[i], part.vertices[next(i, part.vertices.size())], b, part.source[i]});
            }
        }
    }
    return edges;
}

/// Length along which two edges face each other [m].
inline double facing_length(const DirectedEdge& a, const DirectedEdge& b)
{
    const double length = (a.to - a.from).norm();
    const Vec2 d = (a.to - a.from) / length;
    const double near = 1e-7;
    if (d.dot(b.to - b.from) >= 0.0 || std::abs(cross(d, b.from - a.from)) > near || std::abs(cross(d, b.to - a.from)) > near)
    {
        return 0.0;
    }
    return std::min(length, d.dot(b.from - a.from)) - std::max(0.0, d.dot(b.to - a.from));
}

/// Every edge is wholly internal (faces parts of its own block along its whole length) or wholly external (nowhere).
inline void expect_edges_wholly_internal_or_external(const RockMass& rock)
{
    const std::vector<DirectedEdge> edges = all_edges(rock);
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
        const double length = (edges[i].to - edges[i].from).norm();
        double own = 0.0;
        // Edges of a block lie together.
        for (std::size_t j = i; j-- > 0 && edges[j].block == edges[i].block;)
        {
            own += std::max(0.0, facing_length(edges[i], edges[j]));
        }
        for (std::size_t j = i + 1; j < edges.size() && edges[j].block == edges[i].block; ++j)
        {
            own += std::max(0.0, facing_length(edges[i], edges[j]));
        }
        EXPECT_NEAR(own, edges[i].source == edge_internal ? length : 0.0, 1e-6)
            << "an edge of " << rock.blocks[edges[i].block].name;
    }
}

/// Vertices of different parts are the same point to the last bit, or clearly apart.
inline void expect_shared_points_bitwise_equal(const RockMass& rock)
{
    std::vector<Vec2> points;
    for (const DirectedEdge& edge : all_edges(rock))
    {
        points.push_back(edge.from);
    }
    std::sort(points.begin(), points.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
    std::size_t shared = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        for (std::size_t j = i + 1; j < points.size() && points[j].x() - points[i].x() < 1e-9; ++j)
        {
            if (std::abs(points[j].y() - points[i].y()) < 1e-9)
            {
                ++shared;
                EXPECT_EQ(points[i], points[j]);
            }
        }
    }
    EXPECT_GT(shared, rock.blocks.size() / 2) << "the test must have seen shared points";
}

/// @param lost  share of the area that lines may have moved by
inline void expect_sound(const RockMass& rock, double lost = 1e-12)
{
    EXPECT_NEAR(summed_area(rock), rock.domain_area, lost * rock.domain_area);
    for (const RockBlock& block : rock.blocks)
    {
        for (const ConvexPart& part : block.parts)
        {
            EXPECT_EQ(part.vertices.size(), part.source.size());
            EXPECT_TRUE(is_convex(part.vertices, 1e-9)) << block.name;
        }
    }
    double common = 0.0;
    for (const BlockOverlap& overlap : find_overlaps(rock.blocks, 0, 0.0))
    {
        common += overlap.area;
    }
    EXPECT_LE(common, lost * rock.domain_area);
    expect_edges_wholly_internal_or_external(rock);
    expect_shared_points_bitwise_equal(rock);
}

inline bool identical(const RockBlock& a, const RockBlock& b)
{
    bool same = a.name == b.name && a.parts.size() == b.parts.size() && a.fix_x == b.fix_x && a.excavation == b.excavation;
    for (std::size_t p = 0; same && p < a.parts.size(); ++p)
    {
        same = a.parts[p].vertices == b.parts[p].vertices && a.parts[p].source == b.parts[p].source;
    }
    return same;
}

inline bool identical(const RockMass& a, const RockMass& b)
{
    return std::equal(a.blocks.begin(), a.blocks.end(), b.blocks.begin(), b.blocks.end(),
                      [](const RockBlock& x, const RockBlock& y) { return identical(x, y); });
}
}  // namespace hdem
