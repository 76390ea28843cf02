#include "verification/rest/touching.h"

#include "core/geometry/convex_decomposition.h"
#include "core/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem::verification::rest
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double antiparallel = 1e-2;  // |sum| of the outward normals of two faces that touch as faces [-]

struct Edge
{
    Vec2 start, along, outward;
    double length;

    Edge(const Polygon& polygon, std::size_t i)
        : start(polygon[i]),
          along((polygon[next(i, polygon.size())] - polygon[i]).normalized()),
          outward(-turned_left(along)),
          length((polygon[next(i, polygon.size())] - polygon[i]).norm())
    {
    }
    [[nodiscard]] double before(const Vec2& point) const { return outward.dot(point - start); }
    [[nodiscard]] double beside(const Vec2& point) const { return along.dot(point - start); }
};

/// Distance of all of `other` in front of the edge; negative when some of it lies behind.
double separation(const Edge& edge, const Polygon& other)
{
    double least = infinity;
    for (const Vec2& v : other)
        least = std::min(least, edge.before(v));
    return least;
}

double greatest_separation(const Polygon& a, const Polygon& b)
{
    double greatest = -infinity;
    for (std::size_t i = 0; i < a.size(); ++i)
        greatest = std::max(greatest, separation(Edge(a, i), b));
    return greatest;
}

/// Stretch of an edge, along it, over which `other` is at most `gap` away from its line.
struct Stretch
{
    double from = infinity;
    double to = -infinity;
    void add(double at)
    {
        from = std::min(from, at);
        to = std::max(to, at);
    }
};

Stretch near_stretch(const Edge& edge, const Polygon& other, double gap)
{
    Stretch near;
    for (std::size_t i = 0; i < other.size(); ++i)
    {
        const Vec2& p = other[i];
        const Vec2& q = other[next(i, other.size())];
        const double at_p = edge.before(p);
        const double at_q = edge.before(q);
        if (at_p <= gap)
            near.add(edge.beside(p));
        if ((at_p <= gap) != (at_q <= gap))
            near.add(edge.beside(p + (gap - at_p) / (at_q - at_p) * (q - p)));
    }
    near.from = std::max(near.from, 0.0);
    near.to = std::min(near.to, edge.length);
    return near;
}

class PairSearch
{
  public:
    PairSearch(double gap, double depth) : gap_(gap), depth_(depth) {}

    void search(const ConvexPart& a, std::size_t first, const ConvexPart& b, std::size_t second, std::vector<TouchingPoint>& points)
    {
        std::vector<Vec2> faces;  // outward from a
        for (std::size_t i = 0; i < a.vertices.size(); ++i)
            if (const Edge edge(a.vertices, i); a.source[i] != edge_internal && add(edge, b.vertices, first, second, points))
                faces.push_back(edge.outward);
        for (std::size_t i = 0; i < b.vertices.size(); ++i)
        {
            if (b.source[i] == edge_internal)
                continue;
            const Edge edge(b.vertices, i);
            // The same two faces, seen from the other side, would carry twice their cohesion.
            const bool seen = std::ranges::any_of(faces, [&](const Vec2& f) { return (f + edge.outward).norm() < antiparallel; });
            if (!seen)
                add(edge, a.vertices, second, first, points);
        }
    }

  private:
    bool add(const Edge& edge, const Polygon& other, std::size_t first, std::size_t second,
             std::vector<TouchingPoint>& points) const
    {
        const double apart = separation(edge, other);
        if (apart > gap_ || apart < -depth_)
            return false;
        const double corner = std::min(gap_, 1e-6 * edge.length);
        const Stretch near = near_stretch(edge, other, std::max(apart, 0.0) + gap_);
        if (near.to < near.from - gap_ || near.to < corner || near.from > edge.length - corner)
            return false;  // or only at the end of the edge: a corner on a corner bears nothing
        const double length = std::max(near.to - near.from, 0.0);
        for (const double at : {near.from, near.to})
            points.push_back({first, second, edge.start + at * edge.along, edge.outward, 0.5 * length});
        return true;
    }
    double gap_;
    double depth_;
};
}  // namespace

Body body_of(const Polygon& polygon, double density, bool fixed)
{
    Body body{.fixed = fixed};
    Polygon outline = polygon;
    make_anticlockwise(outline);
    CutPolygon whole;
    for (const Vec2& v : outline)
        whole.add(v, {.source = edge_plain});
    for (const CutPolygon& part : convex_parts(whole))
    {
        ConvexPart& added = body.parts.emplace_back();
        added.vertices = part.vertices;
        for (const EdgeTag& edge : part.edges)
            added.source.push_back(edge.source);
    }
    const AreaMoments moments = area_moments(polygon);
    body.centroid = moments.centroid;
    body.mass = density * moments.area;
    body.inertia = density * moments.polar;
    for (const Vec2& v : polygon)
        body.radius = std::max(body.radius, (v - body.centroid).norm());
    return body;
}

std::vector<TouchingPoint> find_touching(const std::vector<Body>& bodies, double gap, double depth)
{
    std::vector<TouchingPoint> points;
    PairSearch pair(gap, depth);
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (std::size_t j = i + 1; j < bodies.size(); ++j)
        {
            if ((bodies[i].fixed && bodies[j].fixed) ||
                (bodies[i].centroid - bodies[j].centroid).norm() > bodies[i].radius + bodies[j].radius + gap)
                continue;
            for (const ConvexPart& a : bodies[i].parts)
                for (const ConvexPart& b : bodies[j].parts)
                    pair.search(a, i, b, j, points);
        }
    return points;
}

double overlap_depth(const Body& a, const Body& b)
{
    double depth = 0.0;
    if ((a.centroid - b.centroid).norm() > a.radius + b.radius)
        return depth;
    for (const ConvexPart& p : a.parts)
        for (const ConvexPart& q : b.parts)
            depth = std::max(depth,
                             -std::max(greatest_separation(p.vertices, q.vertices), greatest_separation(q.vertices, p.vertices)));
    return depth;
}
}  // namespace hdem::verification::rest
