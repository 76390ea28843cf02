#include "core/geometry/convex_union.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace hdem
{
namespace
{
/// An edge as an interval of its chord.
struct Interval
{
    Index chord;
    double low;
    double high;
    std::size_t part;
};

Interval interval_of(const CutPolygon& polygon, std::size_t edge, const Chords& chords)
{
    const Index chord = polygon.edges[edge].chord;
    const double a = chords.position(chord, polygon.vertices[edge]);
    const double b = chords.position(chord, polygon.vertices[next(edge, polygon.vertices.size())]);
    return {chord, std::min(a, b), std::max(a, b), 0};
}

struct SharedEdge
{
    std::size_t edge_a;
    std::size_t edge_b;
    Interval a;
    Interval b;

    [[nodiscard]] double length() const { return std::min(a.high, b.high) - std::max(a.low, b.low); }
};

template <class Visit>
void for_each_shared(const CutPolygon& a, const CutPolygon& b, const Chords& chords, double tolerance, const Visit& visit)
{
    for (std::size_t i = 0; i < a.edges.size(); ++i)
    {
        for (std::size_t j = 0; j < b.edges.size(); ++j)
        {
            if (a.edges[i].chord == b.edges[j].chord && a.edges[i].chord != no_index)
            {
                const SharedEdge shared = {i, j, interval_of(a, i, chords), interval_of(b, j, chords)};
                if (shared.length() > tolerance && !visit(shared))
                {
                    return;
                }
            }
        }
    }
}

/// Put a vertex on an edge unless it is an end of it.
void split_edge(CutPolygon& polygon, std::size_t edge, const Vec2& at, const Interval& whole, double where, double tolerance)
{
    if (where > whole.low + tolerance && where < whole.high - tolerance)
    {
        const auto after = static_cast<std::ptrdiff_t>(edge + 1);
        const EdgeTag tag = polygon.edges[edge];
        polygon.vertices.insert(polygon.vertices.begin() + after, at);
        polygon.edges.insert(polygon.edges.begin() + after, tag);
    }
}

/// Split `edge` at the ends of `other_edge` that lie within it. True when the edge was split.
bool split_at_ends(CutPolygon& polygon, std::size_t edge, const CutPolygon& other, std::size_t other_edge, const Chords& chords,
                   double tolerance)
{
    const std::size_t before = polygon.vertices.size();
    for (const std::size_t end : {other_edge, next(other_edge, other.vertices.size())})
    {
        const Vec2 at = other.vertices[end];
        const Interval whole = interval_of(polygon, edge, chords);
        split_edge(polygon, edge, at, whole, chords.position(polygon.edges[edge].chord, at), tolerance);
        if (polygon.vertices.size() != before)
        {
            return true;  // positions have changed: the caller looks again
        }
    }
    return false;
}
}  // namespace

double shared_length(const CutPolygon& a, const CutPolygon& b, const Chords& chords, double tolerance)
{
    double sum = 0.0;
    for_each_shared(a, b, chords, tolerance,
                    [&sum](const SharedEdge& shared)
                    {
                        sum += shared.length();
                        return true;
                    });
    return sum;
}

void add_shared_lengths(const CutPolygon& a, const CutPolygon& b, const Chords& chords, double tolerance,
                        std::map<std::int32_t, double>& lengths)
{
    for_each_shared(a, b, chords, tolerance,
                    [&](const SharedEdge& shared)
                    {
                        lengths[a.edges[shared.edge_a].source] += shared.length();
                        return true;
                    });
}

void set_shared_source(CutPolygon& a, CutPolygon& b, std::int32_t source, const Chords& chords, double tolerance)
{
    bool again = true;
    while (again)
    {
        again = false;
        for_each_shared(a, b, chords, tolerance,
                        [&](const SharedEdge& shared)
                        {
                            EdgeTag& edge_a = a.edges[shared.edge_a];
                            EdgeTag& edge_b = b.edges[shared.edge_b];
                            if (edge_a.source == source && edge_b.source == source)
                            {
                                return true;
                            }
                            again = split_at_ends(a, shared.edge_a, b, shared.edge_b, chords, tolerance) ||
                                    split_at_ends(b, shared.edge_b, a, shared.edge_a, chords, tolerance);
                            if (!again)
                            {
                                edge_a.source = source;
                                edge_b.source = source;
                            }
                            return !again;
                        });
    }
}

std::vector<std::size_t> connected_groups(const std::vector<CutPolygon>& parts, const Chords& chords, double tolerance)
{
    std::vector<Interval> edges;
    for (std::size_t p = 0; p < parts.size(); ++p)
    {
        for (std::size_t i = 0; i < parts[p].edges.size(); ++i)
        {
            // An edge of a cut that is only planned has no chord: nothing lies beyond it.
            if (parts[p].edges[i].source == edge_internal && parts[p].edges[i].chord != no_index)
            {
                edges.push_back(interval_of(parts[p], i, chords));
                edges.back().part = p;
            }
        }
    }
    std::sort(edges.begin(), edges.end(),
              [](const Interval& a, const Interval& b)
              { return a.chord != b.chord ? a.chord < b.chord : (a.low != b.low ? a.low < b.low : a.part < b.part); });

    std::vector<std::size_t> root(parts.size());
    std::iota(root.begin(), root.end(), std::size_t{0});
    const auto find = [&root](std::size_t p)
    {
        while (root[p] != p)
        {
            p = root[p] = root[root[p]];
        }
        return p;
    };
    for (std::size_t i = 0; i < edges.size(); ++i)
    {
        for (std::size_t j = i + 1; j < edges.size() && edges[j].chord == edges[i].chord && edges[j].low < edges[i].high; ++j)
        {
            if (std::min(edges[i].high, edges[j].high) - edges[j].low > tolerance)
            {
                const std::size_t a = find(edges[i].part);
                const std::size_t b = find(edges[j].part);
                root[std::max(a, b)] = std::min(a, b);  // the root is the group's first part
            }
        }
    }
    std::vector<std::size_t> group(parts.size());
    std::size_t groups = 0;
    for (std::size_t p = 0; p < parts.size(); ++p)
    {
        group[p] = find(p) == p ? groups++ : group[find(p)];
    }
    return group;
}

double total_area(const std::vector<CutPolygon>& parts)
{
    double sum = 0.0;
    for (const CutPolygon& part : parts)
    {
        sum += signed_area(part.vertices);
    }
    return sum;
}
}  // namespace hdem
