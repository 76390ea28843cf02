#pragma once
/// Distances of one part of a block from the lines of another part's edges: the axes of the separating-axis search (manifold.h).

#include "core/geometry/convex_part.h"
#include "core/model/model.h"
#include "core/state/blocks.h"

#include <algorithm>
#include <array>
#include <limits>

namespace hdem
{
/// Pose of block b as seen from block a's frame. Differences of positions come first, so that far from the origin
/// nothing is lost.
struct RelativePose
{
    double c, s, x, y;

    RelativePose(const BlockMotion& a, const BlockMotion& b)
    {
        c = a.c * b.c + a.s * b.s;
        s = a.c * b.s - a.s * b.c;
        const double dx = b.x - a.x;
        const double dy = b.y - a.y;
        x = a.c * dx + a.s * dy;
        y = a.c * dy - a.s * dx;
    }
    [[nodiscard]] Vec2 turned(const Vec2& v) const { return {c * v.x() - s * v.y(), s * v.x() + c * v.y()}; }
    [[nodiscard]] Vec2 moved(const Vec2& v) const { return turned(v) + Vec2(x, y); }
};

[[nodiscard]] inline bool is_external(const Shapes& shapes, Index edge)
{
    return shapes.edge_source[edge] != edge_internal;
}

/// Cosine of the angle between two pieces of one side.
inline constexpr double in_line = 0.999;

/// Cosine of the angle between two edges that lie on each other.
inline constexpr double opposed = -0.98;

/// Distance of a part from the line of an edge.
struct Distance
{
    double least = std::numeric_limits<double>::infinity();  ///< < 0 when it reaches behind it [m]
    double plain = std::numeric_limits<double>::infinity();  ///< of its vertices at which its block does not go on deeper

    /// Do only corners reach behind the line where the block goes on deeper in the next part? Then nothing lies against the line there: such are reflex corners, and corners at which a
    /// seam ends that runs along the line.
    [[nodiscard]] bool is_at_seam(double margin) const { return least < -margin && plain > least + margin; }
};

/// Distance of part `other` from the line of `edge`. `pose` is that of the other block in the frame of the edge's block.
[[nodiscard]] Distance edge_distance(const Shapes& shapes, Index edge, Index other, const RelativePose& pose);

/// Result of scanning one part's edges against the other's vertices.
struct Scan
{
    double distance = -std::numeric_limits<double>::infinity();  ///< greatest over all edges
    double external_distance = -std::numeric_limits<double>::infinity();
    Index edge = no_index;  ///< external edge that reaches it
    double internal_distance = -std::numeric_limits<double>::infinity();
    Index internal_edge = no_index;                                   ///< that reaches it
    double kept_distance = -std::numeric_limits<double>::infinity();  ///< of the edge asked for
    bool has_external = false;
};

/// Two parts of a contact, and each block as seen from the other.
struct PartPair
{
    Index a, b;
    const BlockMotion& motion_a;
    const BlockMotion& motion_b;
    double margin;     ///< distances that differ by less count as equal [m]
    double round_off;  ///< lengths and differences of distances below it count as 0 [m]
    RelativePose b_from_a{motion_a, motion_b};
    RelativePose a_from_b{motion_b, motion_a};
};

/// Each part's edges against the other's vertices.
struct PairScan
{
    std::array<Scan, 2> on;  ///< 0: edges of part a

    [[nodiscard]] bool has_external() const { return on[0].has_external && on[1].has_external; }
    [[nodiscard]] double distance() const { return std::max(on[0].distance, on[1].distance); }
    [[nodiscard]] double external_distance() const { return std::max(on[0].external_distance, on[1].external_distance); }
};

/// External edges that are at a seam do not count, unless there are no others.
/// @param kept    an edge whose distance is asked for
[[nodiscard]] PairScan scan_pair(const Shapes& shapes, const PartPair& pair, Index kept = no_index);
}  // namespace hdem
