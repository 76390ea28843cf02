#include "core/rock/trace_cells.h"

#include <boost/geometry/algorithms/disjoint.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <array>
#include <cmath>
#include <set>

namespace hdem
{
namespace
{
namespace bg = boost::geometry;
using Place = bg::model::d2::point_xy<double>;
using Around = bg::model::box<Place>;

/// Straight stretches that edges of cells may lie on, found by place.
class Stretches
{
  public:
    explicit Stretches(double tolerance) : tolerance_(tolerance) {}

    void add(const Vec2& from, const Vec2& to, const EdgeTag& tag)
    {
        const Vec2 low = from.cwiseMin(to).array() - tolerance_;
        const Vec2 high = from.cwiseMax(to).array() + tolerance_;
        tree_.insert({{{low.x(), low.y()}, {high.x(), high.y()}}, stretches_.size()});
        stretches_.push_back({from, (to - from).normalized(), (to - from).norm(), tag});
    }

    /// The first stretch added that both ends lie on; without one a tag without chord.
    [[nodiscard]] EdgeTag find(const Vec2& a, const Vec2& b, std::int32_t source) const
    {
        const Vec2 middle = 0.5 * (a + b);
        std::size_t best = stretches_.size();
        const Place place(middle.x(), middle.y());
        for (auto it = tree_.qbegin(bg::index::intersects(place)); it != tree_.qend(); ++it)
            if (it->second < best && stretches_[it->second].holds(a, tolerance_) && stretches_[it->second].holds(b, tolerance_))
                best = it->second;
        return best < stretches_.size() ? stretches_[best].tag : EdgeTag{source, no_index};
    }

  private:
    struct Stretch
    {
        Vec2 from;
        Vec2 along;
        double length;
        EdgeTag tag;

        [[nodiscard]] bool holds(const Vec2& p, double tolerance) const
        {
            const double t = along.dot(p - from);
            return std::abs(cross(along, p - from)) <= tolerance && t >= -tolerance && t <= length + tolerance;
        }
    };
    double tolerance_;
    std::vector<Stretch> stretches_;
    bg::index::rtree<std::pair<Around, std::size_t>, bg::index::quadratic<16>> tree_;
};

using Edge = std::array<double, 4>;

Edge edge_of(const Vec2& from, const Vec2& to)
{
    return {from.x(), from.y(), to.x(), to.y()};
}

/// A piece's edges with their tags, without the vertices at which it goes straight on along one chord. Where lines meet within round-off of
/// one point they leave a piece whose edges all lie on one chord: nothing is left of it.
/// @param edges of all pieces of the cell: one that is there the other way round too lies inside the cell
CutPolygon tagged(const Polygon& piece, const std::set<Edge>& edges, const Stretches& stretches, std::int32_t source,
                  Chords& chords)
{
    const std::size_t n = piece.size();
    std::vector<EdgeTag> tags;
    for (std::size_t i = 0; i < n; ++i)
    {
        const Vec2& to = piece[next(i, n)];
        tags.push_back(edges.contains(edge_of(to, piece[i])) ? EdgeTag{edge_internal, no_index}
                                                             : stretches.find(piece[i], to, source));
    }
    CutPolygon out;
    for (std::size_t i = 0; i < n; ++i)
    {
        const EdgeTag& before = tags[previous(i, n)];
        for (const EdgeTag& tag : {before, tags[i]})
            if (tag.chord != no_index)
                chords.record(tag.chord, piece[i]);
        if (tags[i].chord == no_index || !(before == tags[i]))
            out.add(piece[i], tags[i]);
    }
    return out;
}

std::vector<CutPolygon> parts_of(const std::vector<Polygon>& pieces, const Stretches& stretches, std::int32_t source,
                                 Chords& chords)
{
    std::set<Edge> edges;
    for (const Polygon& piece : pieces)
        for (std::size_t i = 0; i < piece.size(); ++i)
            edges.insert(edge_of(piece[i], piece[next(i, piece.size())]));
    std::vector<CutPolygon> parts;
    for (const Polygon& piece : pieces)
    {
        const CutPolygon outline = tagged(piece, edges, stretches, source, chords);
        if (outline.vertices.size() < 3)
            continue;
        for (CutPolygon& part : convex_parts(outline))
            parts.push_back(std::move(part));
    }
    give_chords(parts, chords);
    return parts;
}
}  // namespace

CutMass traced_mass(const Polygon& domain, const TraceCells& traces, std::int32_t source, double tolerance)
{
    CutMass mass = uncut_mass(domain, tolerance);
    mass.blocks.clear();
    Stretches stretches(tolerance);
    for (std::size_t i = 0; i < domain.size(); ++i)
        stretches.add(domain[i], domain[next(i, domain.size())], {edge_plain, static_cast<Index>(i)});
    for (const TraceSegment& segment : traces.segments)
    {
        const std::int32_t own = segment.source == no_index ? source : segment.source;
        stretches.add(segment.from, segment.to, {own, mass.chords.add(segment.from, segment.to)});
    }
    for (const std::vector<Polygon>& pieces : traces.cells)
        if (std::vector<CutPolygon> parts = parts_of(pieces, stretches, source, mass.chords); !parts.empty())
            mass.blocks.push_back({std::move(parts), no_index, no_index});
    return mass;
}
}  // namespace hdem
