#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace hdem
{
namespace
{
/// Where segment p0 p1 meets q0 q1, ends included; nothing when they stay apart. Collinear segments meet in the end of one.
std::optional<Vec2> meeting_point(const Vec2& p0, const Vec2& p1, const Vec2& q0, const Vec2& q1)
{
    const Vec2 d = p1 - p0;
    const Vec2 e = q1 - q0;
    // Lengths below this are round-off of the coordinates: such segments touch.
    const double slack = 1e-13 * (d.norm() + e.norm());
    const double q0_off = cross(d, q0 - p0) / d.norm();
    const double q1_off = cross(d, q1 - p0) / d.norm();
    const double p0_off = cross(e, p0 - q0) / e.norm();
    const double p1_off = cross(e, p1 - q0) / e.norm();
    const auto apart = [slack](double a, double b) { return (a > slack && b > slack) || (a < -slack && b < -slack); };
    if (apart(q0_off, q1_off) || apart(p0_off, p1_off))
    {
        return std::nullopt;
    }
    if (std::abs(q0_off) <= slack && std::abs(q1_off) <= slack)
    {
        const double length = d.norm();
        const double t0 = d.dot(q0 - p0) / length;
        const double t1 = d.dot(q1 - p0) / length;
        if (std::max(t0, t1) < -slack || std::min(t0, t1) > length + slack)
        {
            return std::nullopt;
        }
        return p0 + d * (std::clamp(std::min(t0, t1), 0.0, length) / length);
    }
    return q0 + e * std::clamp(q0_off / (q0_off - q1_off), 0.0, 1.0);
}

/// What two edges of a polygon do to each other; neighbours may share their common vertex, nothing else.
std::optional<Vec2> crossing_of(const Polygon& polygon, std::size_t i, std::size_t j)
{
    const std::size_t n = polygon.size();
    const Vec2& p0 = polygon[i];
    const Vec2& p1 = polygon[next(i, n)];
    const Vec2& q0 = polygon[j];
    const Vec2& q1 = polygon[next(j, n)];
    if (next(i, n) == j || next(j, n) == i)
    {
        const Vec2& shared = next(i, n) == j ? p1 : p0;
        const Vec2 back = (next(i, n) == j ? p0 : p1) - shared;
        const Vec2 forth = (next(i, n) == j ? q1 : q0) - shared;
        const bool folds = back.dot(forth) > 0.0 && std::abs(cross(back, forth)) <= 1e-13 * back.norm() * forth.norm();
        return folds ? std::optional<Vec2>(shared) : std::nullopt;
    }
    return meeting_point(p0, p1, q0, q1);
}

double segment_distance(const Vec2& a, const Vec2& b, const Vec2& point)
{
    const Vec2 d = b - a;
    const double length2 = d.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp(d.dot(point - a) / length2, 0.0, 1.0) : 0.0;
    return (a + t * d - point).norm();
}
}  // namespace

double signed_area(const Polygon& polygon)
{
    double twice = 0.0;
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    {
        twice += cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]);
    }
    return 0.5 * twice;
}

AreaMoments area_moments(const Polygon& polygon)
{
    if (polygon.size() < 3)
    {
        return {};
    }
    double twice = 0.0;
    Vec2 first = Vec2::Zero();
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
    {
        const Vec2 a = polygon[i] - polygon[0];
        const Vec2 b = polygon[i + 1] - polygon[0];
        twice += cross(a, b);
        first += cross(a, b) * (a + b);
    }
    AreaMoments out;
    out.area = 0.5 * std::abs(twice);
    out.centroid = polygon[0] + first / (3.0 * twice);
    // A second round about the centroid: the theorem of parallel axes would subtract two large numbers.
    double polar = 0.0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const Vec2 a = polygon[i] - out.centroid;
        const Vec2 b = polygon[next(i, polygon.size())] - out.centroid;
        polar += cross(a, b) * (a.squaredNorm() + a.dot(b) + b.squaredNorm());
    }
    out.polar = std::abs(polar) / 12.0;
    return out;
}

AreaMoments combined(const std::vector<AreaMoments>& parts)
{
    if (parts.size() == 1)
    {
        return parts.front();
    }
    AreaMoments out;
    Vec2 first = Vec2::Zero();
    for (const AreaMoments& part : parts)
    {
        out.area += part.area;
        first += part.area * (part.centroid - parts.front().centroid);
    }
    if (out.area > 0.0)
    {
        out.centroid = parts.front().centroid + first / out.area;
    }
    for (const AreaMoments& part : parts)
    {
        out.polar += part.polar + part.area * (part.centroid - out.centroid).squaredNorm();
    }
    return out;
}

Box bounding_box(const Polygon& polygon)
{
    Box box{polygon.front(), polygon.front()};
    for (const Vec2& p : polygon)
    {
        box.low = box.low.cwiseMin(p);
        box.high = box.high.cwiseMax(p);
    }
    return box;
}

bool make_anticlockwise(Polygon& polygon)
{
    if (signed_area(polygon) >= 0.0)
    {
        return false;
    }
    std::reverse(polygon.begin(), polygon.end());
    return true;
}

double turn(const Polygon& polygon, std::size_t i)
{
    const std::size_t n = polygon.size();
    const Vec2 in = polygon[i] - polygon[previous(i, n)];
    const Vec2 out = polygon[next(i, n)] - polygon[i];
    const double lengths = in.norm() * out.norm();
    return lengths > 0.0 ? cross(in, out) / lengths : 0.0;
}

bool is_convex(const Polygon& polygon, double slack)
{
    if (polygon.size() < 3 || signed_area(polygon) <= 0.0)
    {
        return false;
    }
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        if (turn(polygon, i) < -slack)
        {
            return false;
        }
    }
    return true;
}

std::optional<SelfCrossing> find_self_crossing(const Polygon& polygon)
{
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i)
    {
        if (polygon[i] == polygon[next(i, n)])
        {
            return SelfCrossing{i, next(i, n), polygon[i]};
        }
    }
    const auto low = [&](std::size_t i) { return std::min(polygon[i].x(), polygon[next(i, n)].x()); };
    const auto high = [&](std::size_t i) { return std::max(polygon[i].x(), polygon[next(i, n)].x()); };
    // Edges in order of x: each is compared only with those that begin before it ends.
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return low(i) < low(j); });
    for (std::size_t a = 0; a < n; ++a)
    {
        for (std::size_t b = a + 1; b < n && low(order[b]) <= high(order[a]); ++b)
        {
            if (const auto point = crossing_of(polygon, order[a], order[b]))
            {
                return SelfCrossing{std::min(order[a], order[b]), std::max(order[a], order[b]), *point};
            }
        }
    }
    return std::nullopt;
}

bool contains(const Polygon& polygon, const Vec2& point)
{
    bool inside = false;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const Vec2 a = polygon[i] - point;
        const Vec2 b = polygon[next(i, polygon.size())] - point;
        if ((a.y() > 0.0) != (b.y() > 0.0) && (cross(a, b) > 0.0) == (b.y() > a.y()))
        {
            inside = !inside;
        }
    }
    return inside;
}

double distance_to_boundary(const Polygon& polygon, const Vec2& point)
{
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        least = std::min(least, segment_distance(polygon[i], polygon[next(i, polygon.size())], point));
    }
    return least;
}

double convex_overlap_area(const Polygon& a, const Polygon& b)
{
    Polygon left = a;
    Polygon clipped;
    for (std::size_t i = 0; i < b.size() && !left.empty(); ++i)
    {
        const Vec2 along = b[next(i, b.size())] - b[i];
        clipped.clear();
        for (std::size_t k = 0; k < left.size(); ++k)
        {
            const Vec2& p = left[k];
            const Vec2& q = left[next(k, left.size())];
            const double side_p = cross(along, p - b[i]);
            const double side_q = cross(along, q - b[i]);
            if (side_p >= 0.0)
            {
                clipped.push_back(p);
            }
            if ((side_p > 0.0 && side_q < 0.0) || (side_p < 0.0 && side_q > 0.0))
            {
                clipped.push_back(p + (q - p) * (side_p / (side_p - side_q)));
            }
        }
        left.swap(clipped);
    }
    return std::max(0.0, signed_area(left));
}
}  // namespace hdem
