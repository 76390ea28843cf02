#include "core/water/crack_faces.h"

#include "core/geometry/convex_part.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem
{
namespace
{
using Ways = std::array<double, 2>;

/// Where along a straight piece an edge lies on it; empty where the first number is not below the second.
Ways on_piece(const Vec2& from, const Vec2& along, double length, const Vec2& edge_from, const Vec2& edge_to, double tolerance)
{
    const double off_from = cross(along, edge_from - from), off_to = cross(along, edge_to - from);
    double low = 0.0, high = 1.0;  // of the edge, as far as it is within the tolerance
    for (const double side : {1.0, -1.0})
    {
        const double at_from = tolerance - side * off_from, at_to = tolerance - side * off_to;
        if (at_from < 0.0 && at_to < 0.0)
            return {0.0, 0.0};
        if (at_from < 0.0)
            low = std::max(low, at_from / (at_from - at_to));
        else if (at_to < 0.0)
            high = std::min(high, at_from / (at_from - at_to));
    }
    const double begin = (edge_from + low * (edge_to - edge_from) - from).dot(along);
    const double end = (edge_from + high * (edge_to - edge_from) - from).dot(along);
    return {std::clamp(std::min(begin, end), 0.0, length), std::clamp(std::max(begin, end), 0.0, length)};
}

double covered(std::vector<Ways>& intervals)
{
    std::ranges::sort(intervals);
    double sum = 0.0, reached = 0.0;
    for (const auto& [begin, end] : intervals)
        if (end > reached)
        {
            sum += end - std::max(begin, reached);
            reached = end;
        }
    return sum;
}
}  // namespace

std::vector<double> shares_on_faces(const std::vector<Vec2>& line, const Model& model, const Blocks& blocks)
{
    const Shapes& shapes = model.shapes;
    std::vector<double> shares;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
    {
        const double length = (line[i + 1] - line[i]).norm();
        const Vec2 along = (line[i + 1] - line[i]) / length;
        std::vector<Ways> intervals;
        for (Index part = 0; part < shapes.parts(); ++part)
            for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
            {
                const BlockMotion& motion = blocks.motion[shapes.part_block[part]];
                const Vec2 from = Vec2(motion.x, motion.y) + shapes.vertex[v];
                const Vec2 to = from + shapes.edge_length[v] * shapes.edge_tangent[v];
                if (shapes.edge_source[v] != edge_internal && model.mass[shapes.part_block[part]] > 0.0)
                    intervals.push_back(on_piece(line[i], along, length, from, to, model.water.tolerance));
            }
        shares.push_back(covered(intervals) / length);
    }
    return shares;
}

std::vector<Vec2> wet_part(const WaterCrack& crack, const Vec2& up)
{
    std::vector<Vec2> wet;
    for (std::size_t i = crack.crack.size(); i-- > 0;)
    {
        const Vec2& at = crack.crack[i];
        const double depth = crack.level - at.dot(up);
        if (!wet.empty() && depth <= 0.0)
        {
            const double below = crack.level - wet.back().dot(up);
            wet.push_back(wet.back() + below / (below - depth) * (at - wet.back()));
            return wet;
        }
        if (depth <= 0.0)
            return {};
        wet.push_back(at);
    }
    return wet;
}
}  // namespace hdem
