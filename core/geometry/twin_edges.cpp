#include "core/geometry/twin_edges.h"

#include "core/geometry/polygon.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace hdem
{
namespace
{
/// Both ends, the lesser one first.
using Ends = std::array<double, 4>;

Ends ends_of(const Vec2& a, const Vec2& b)
{
    const Ends forth{a.x(), a.y(), b.x(), b.y()}, back{b.x(), b.y(), a.x(), a.y()};
    return std::min(forth, back);
}
}  // namespace

std::vector<Index> twin_edges(const std::vector<ConvexPart>& parts)
{
    struct Edge
    {
        Ends ends;
        Index at;
    };
    std::vector<Edge> internal;
    Index edges = 0;
    for (const ConvexPart& part : parts)
        for (std::size_t i = 0, n = part.vertices.size(); i < n; ++i, ++edges)
            if (part.source[i] == edge_internal)
                internal.push_back({ends_of(part.vertices[i], part.vertices[next(i, n)]), edges});
    std::ranges::sort(internal, {}, [](const Edge& e) { return std::pair(e.ends, e.at); });
    std::vector<Index> steps(static_cast<std::size_t>(edges), 0);
    for (std::size_t k = 1; k < internal.size(); ++k)
    {
        const Edge &a = internal[k - 1], &b = internal[k];
        if (a.ends != b.ends)
            continue;
        steps[static_cast<std::size_t>(a.at)] = b.at - a.at;
        steps[static_cast<std::size_t>(b.at)] = a.at - b.at;
    }
    return steps;
}
}  // namespace hdem
