#include "core/geometry/convex_decomposition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

namespace hdem
{
namespace
{
/// Sine of an angle below which a vertex counts as straight: round-off of a vertex put on an edge.
constexpr double straight = 1e-12;

// ---- ears -----------------------------------------------------------------------------------------------------------

/// What is left of a polygon while its ears are cut off.
struct Remainder
{
    const Polygon& points;
    std::vector<std::size_t> vertex;  // positions in points, in order
    std::vector<EdgeTag> edges;       // edge k runs from vertex[k] to vertex[k+1]

    [[nodiscard]] const Vec2& at(std::size_t k) const { return points[vertex[k]]; }

    [[nodiscard]] double turn_at(std::size_t k) const
    {
        const Vec2 in = at(k) - at(previous(k, vertex.size()));
        const Vec2 out = at(next(k, vertex.size())) - at(k);
        return cross(in, out) / (in.norm() * out.norm());
    }
};

/// No other vertex lies in the closed triangle that cutting off k would take. Only vertices that do not turn left can.
bool is_ear(const Remainder& rest, const std::vector<double>& turns, std::size_t k)
{
    const std::size_t n = rest.vertex.size();
    if (turns[k] <= straight)
    {
        return false;
    }
    const std::array<Vec2, 3> corner = {rest.at(previous(k, n)), rest.at(k), rest.at(next(k, n))};
    for (std::size_t m = 0; m < n; ++m)
    {
        if (m == k || m == previous(k, n) || m == next(k, n) || turns[m] > straight)
        {
            continue;
        }
        bool inside = true;
        for (std::size_t c = 0; c < 3 && inside; ++c)
        {
            const Vec2 edge = corner[(c + 1) % 3] - corner[c];
            inside = cross(edge, rest.at(m) - corner[c]) >= -straight * edge.squaredNorm();
        }
        if (inside)
        {
            return false;
        }
    }
    return true;
}

/// The ear whose new edge is shortest; in a polygon without one (round-off) the sharpest left turn.
std::size_t best_ear(const Remainder& rest)
{
    const std::size_t n = rest.vertex.size();
    std::vector<double> turns(n);
    for (std::size_t k = 0; k < n; ++k)
    {
        turns[k] = rest.turn_at(k);
    }
    std::optional<std::size_t> best;
    double least = 0.0;
    for (std::size_t k = 0; k < n; ++k)
    {
        const double length = (rest.at(next(k, n)) - rest.at(previous(k, n))).squaredNorm();
        if ((!best || length < least) && is_ear(rest, turns, k))
        {
            best = k;
            least = length;
        }
    }
    const auto sharpest = std::max_element(turns.begin(), turns.end());
    return best ? *best : static_cast<std::size_t>(sharpest - turns.begin());
}

std::vector<CutPolygon> triangles(const CutPolygon& polygon)
{
    Remainder rest = {polygon.vertices, std::vector<std::size_t>(polygon.vertices.size()), polygon.edges};
    std::iota(rest.vertex.begin(), rest.vertex.end(), std::size_t{0});
    std::vector<CutPolygon> out;
    while (rest.vertex.size() > 3)
    {
        const std::size_t n = rest.vertex.size();
        const std::size_t k = best_ear(rest);
        CutPolygon ear;
        ear.add(rest.at(previous(k, n)), rest.edges[previous(k, n)]);
        ear.add(rest.at(k), rest.edges[k]);
        ear.add(rest.at(next(k, n)), {edge_internal, no_index});
        out.push_back(std::move(ear));
        rest.edges[previous(k, n)] = {edge_internal, no_index};
        rest.vertex.erase(rest.vertex.begin() + static_cast<std::ptrdiff_t>(k));
        rest.edges.erase(rest.edges.begin() + static_cast<std::ptrdiff_t>(k));
    }
    out.push_back({{rest.at(0), rest.at(1), rest.at(2)}, rest.edges});
    return out;
}

// ---- merging --------------------------------------------------------------------------------------------------------

/// Edge i of part a and edge j of part b have the same two ends.
struct Seam
{
    std::size_t a;
    std::size_t i;
    std::size_t b;
    std::size_t j;
    double length2;
};

std::vector<Seam> find_seams(const std::vector<CutPolygon>& parts)
{
    std::map<std::array<double, 4>, std::array<std::size_t, 2>> seen;
    std::vector<Seam> seams;
    for (std::size_t p = 0; p < parts.size(); ++p)
    {
        for (std::size_t i = 0; i < parts[p].edges.size(); ++i)
        {
            if (parts[p].edges[i].source != edge_internal)
            {
                continue;
            }
            const Vec2& u = parts[p].vertices[i];
            const Vec2& v = parts[p].vertices[next(i, parts[p].vertices.size())];
            const auto opposite = seen.find({v.x(), v.y(), u.x(), u.y()});
            if (opposite != seen.end())
            {
                seams.push_back({opposite->second[0], opposite->second[1], p, i, (v - u).squaredNorm()});
            }
            seen[{u.x(), u.y(), v.x(), v.y()}] = {p, i};
        }
    }
    std::stable_sort(seams.begin(), seams.end(), [](const Seam& s, const Seam& t) { return s.length2 > t.length2; });
    return seams;
}

bool is_seam(const CutPolygon& a, std::size_t i, const CutPolygon& b, std::size_t j)
{
    return a.edges[i].source == edge_internal && b.edges[j].source == edge_internal &&
           a.vertices[i] == b.vertices[next(j, b.vertices.size())] && a.vertices[next(i, a.vertices.size())] == b.vertices[j];
}

/// May the boundary go on from the edge that ends in vertex k of `in` to the edge that begins in vertex m of `out`?
bool turns_left_or_straight(const CutPolygon& in, std::size_t k, const CutPolygon& out, std::size_t m)
{
    const Vec2 before = in.vertices[k] - in.vertices[previous(k, in.vertices.size())];
    const Vec2 after = out.vertices[next(m, out.vertices.size())] - out.vertices[m];
    const double sine = cross(before, after) / (before.norm() * after.norm());
    return sine > straight || (sine >= -straight && before.dot(after) > 0.0);
}

void drop_straight_vertices(CutPolygon& polygon)
{
    for (std::size_t i = polygon.vertices.size(); i-- > 0 && polygon.vertices.size() > 3;)
    {
        const EdgeTag& before = polygon.edges[previous(i, polygon.edges.size())];
        const EdgeTag& after = polygon.edges[i];
        if (before == after && after.chord != no_index && after.source != edge_internal &&
            std::abs(turn(polygon.vertices, i)) <= straight)
        {
            polygon.vertices.erase(polygon.vertices.begin() + static_cast<std::ptrdiff_t>(i));
            polygon.edges.erase(polygon.edges.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
}

/// Union of two parts across a seam, if it is convex.
std::optional<CutPolygon> joined(const CutPolygon& a, std::size_t i, const CutPolygon& b, std::size_t j)
{
    const std::size_t na = a.vertices.size();
    const std::size_t nb = b.vertices.size();
    // The seam may consist of several edges: [first, last] in a, [b_last, b_first] in b.
    std::size_t first = i;
    std::size_t b_first = j;
    std::size_t last = i;
    std::size_t b_last = j;
    std::size_t edges = 1;
    while (edges + 1 < std::min(na, nb) && is_seam(a, previous(first, na), b, next(b_first, nb)))
    {
        first = previous(first, na);
        b_first = next(b_first, nb);
        ++edges;
    }
    while (edges + 1 < std::min(na, nb) && is_seam(a, next(last, na), b, previous(b_last, nb)))
    {
        last = next(last, na);
        b_last = previous(b_last, nb);
        ++edges;
    }
    const std::size_t begin_b = next(b_first, nb);
    const std::size_t begin_a = next(last, na);
    if (!turns_left_or_straight(a, first, b, begin_b) || !turns_left_or_straight(b, b_last, a, begin_a))
    {
        return std::nullopt;
    }
    CutPolygon out;
    for (std::size_t k = begin_a; k != first; k = next(k, na))
    {
        out.add(a.vertices[k], a.edges[k]);
    }
    for (std::size_t k = begin_b; k != b_last; k = next(k, nb))
    {
        out.add(b.vertices[k], b.edges[k]);
    }
    drop_straight_vertices(out);
    return out;
}

bool merge_one(std::vector<CutPolygon>& parts)
{
    for (const Seam& seam : find_seams(parts))
    {
        if (seam.a == seam.b)
        {
            continue;
        }
        if (auto both = joined(parts[seam.a], seam.i, parts[seam.b], seam.j))
        {
            const auto [low, high] = std::minmax(seam.a, seam.b);
            parts[low] = std::move(*both);
            parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(high));
            return true;
        }
    }
    return false;
}
}  // namespace

std::vector<CutPolygon> convex_parts(const CutPolygon& polygon)
{
    if (is_convex(polygon.vertices, straight))
    {
        return {polygon};
    }
    std::vector<CutPolygon> parts = triangles(polygon);
    merge_convex_parts(parts);
    return parts;
}

void merge_convex_parts(std::vector<CutPolygon>& parts)
{
    while (parts.size() > 1 && merge_one(parts))
    {
    }
}

double overlap_area(const Polygon& a, const Polygon& b)
{
    if (a.size() < 3 || b.size() < 3 || !bounding_box(a).meets(bounding_box(b)))
    {
        return 0.0;
    }
    const auto parts_of = [](Polygon polygon)
    {
        make_anticlockwise(polygon);
        const std::size_t n = polygon.size();
        return convex_parts({std::move(polygon), std::vector<EdgeTag>(n)});
    };
    const std::vector<CutPolygon> parts_of_b = parts_of(b);
    double sum = 0.0;
    for (const CutPolygon& of_a : parts_of(a))
    {
        for (const CutPolygon& of_b : parts_of_b)
        {
            sum += convex_overlap_area(of_a.vertices, of_b.vertices);
        }
    }
    return sum;
}
}  // namespace hdem
