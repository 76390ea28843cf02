#include "core/geometry/convex_decomposition.h"

#include "core/geometry/ear_cutting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <unordered_map>
#include <utility>

namespace hdem
{
namespace
{
/// Edge from vertex to vertex, both by their coordinates.
using Ends = std::array<double, 4>;

struct HashOfEnds
{
    std::size_t operator()(const Ends& ends) const
    {
        std::size_t hash = 0;
        for (const double x : ends)
            hash = (hash ^ std::hash<double>()(x)) * 0x9e3779b97f4a7c15ULL;  // +0 and -0 have one hash
        return hash ^ (hash >> 32U);
    }
};

/// Sine of the turn at which a side with a vertex that lies up to `slack` beside it is straight.
double straight_sine_of(const Vec2& before, const Vec2& after, double slack)
{
    return straight_sine + slack * (1.0 / before.norm() + 1.0 / after.norm());
}

bool are_one_side(const EdgeTag& before, const EdgeTag& after)
{
    return before == after && after.chord != no_index && after.source != edge_internal;
}

void drop_straight_vertices(CutPolygon& polygon, double slack)
{
    for (std::size_t i = polygon.vertices.size(); i-- > 0 && polygon.vertices.size() > 3;)
    {
        const std::size_t last = previous(i, polygon.edges.size());
        const Vec2 before = polygon.vertices[i] - polygon.vertices[last];
        const Vec2 after = polygon.vertices[next(i, polygon.vertices.size())] - polygon.vertices[i];
        if (are_one_side(polygon.edges[last], polygon.edges[i]) &&
            std::abs(turn(polygon.vertices, i)) <= straight_sine_of(before, after, slack))
        {
            polygon.vertices.erase(polygon.vertices.begin() + static_cast<std::ptrdiff_t>(i));
            polygon.edges.erase(polygon.edges.begin() + static_cast<std::ptrdiff_t>(i));
        }
    }
}

/// Parts as rings of half-edges, which grow together across seams: internal edges that two parts share end to end.
class Merger
{
  public:
    Merger(const std::vector<CutPolygon>& parts, double slack) : part_(parts.size()), slack_(slack)
    {
        for (const CutPolygon& part : parts)
            add(part);
        for (std::size_t h = 0; h < half_.size(); ++h)
            if (half_[h].twin == none || half_[h].twin < h)  // once a seam
                offer(h);
    }

    std::vector<CutPolygon> run()
    {
        while (!seams_.empty())
        {
            const std::size_t half = seams_.top().half;
            seams_.pop();
            merge_across(half);  // one that fails is tried again when an end of it has changed
        }
        std::vector<CutPolygon> merged;
        for (std::size_t p = 0; p < part_.size(); ++p)
            if (part_[p].joined == none)
                merged.push_back(ring(part_[p]));
        return merged;
    }

  private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    /// An edge as one part has it, from `at` to the next one's.
    struct Half
    {
        Vec2 at;
        EdgeTag edge;
        std::size_t before;
        std::size_t after;
        std::size_t part;         ///< the first one that it belonged to
        std::size_t twin = none;  ///< the same edge in the other part
    };

    struct Part
    {
        std::size_t start = none;  ///< a half-edge of its ring
        std::size_t edges = 0;
        std::size_t joined = none;  ///< the part that it has become one with
        bool is_union = false;
    };

    /// The longest goes first, of equal ones the first that was found.
    struct Seam
    {
        double length2;
        std::size_t half;  ///< that of the later part

        friend bool operator<(const Seam& s, const Seam& t)
        {
            return s.length2 != t.length2 ? s.length2 < t.length2 : s.half > t.half;
        }
    };

    /// Edges of one part that are edges of another one too, one behind the other.
    struct Chain
    {
        std::size_t first, last;      ///< in part a
        std::size_t b_last, b_first;  ///< the same in b, which runs against it
        std::size_t edges;
    };

    void add(const CutPolygon& polygon)
    {
        const std::size_t begin = half_.size();
        const std::size_t n = polygon.vertices.size();
        const std::size_t p = begin == 0 ? 0 : half_.back().part + 1;
        for (std::size_t i = 0; i < n; ++i)
        {
            half_.push_back({polygon.vertices[i], polygon.edges[i], begin + previous(i, n), begin + next(i, n), p});
            if (polygon.edges[i].source == edge_internal)
                find_twin(begin + i, polygon.vertices[next(i, n)]);
        }
        part_[p] = {.start = begin, .edges = n};
    }

    void find_twin(std::size_t h, const Vec2& end)
    {
        const Vec2& begin = half_[h].at;
        const auto opposite = open_.find({end.x(), end.y(), begin.x(), begin.y()});
        open_[{begin.x(), begin.y(), end.x(), end.y()}] = h;
        if (opposite == open_.end() || half_[opposite->second].twin != none)
            return;
        half_[h].twin = opposite->second;
        half_[opposite->second].twin = h;
    }

    [[nodiscard]] const Vec2& end(std::size_t h) const { return half_[half_[h].after].at; }

    /// An edge that is shared.
    void offer(std::size_t h)
    {
        if (half_[h].twin != none)
            seams_.push({(end(h) - half_[h].at).squaredNorm(), std::max(h, half_[h].twin)});
    }

    std::size_t part_of(std::size_t h)
    {
        std::size_t p = half_[h].part;
        while (part_[p].joined != none)
        {
            std::size_t& up = part_[p].joined;
            if (part_[up].joined != none)
                up = part_[up].joined;  // a shorter way next time
            p = up;
        }
        half_[h].part = p;
        return p;
    }

    /// May the boundary go on from one edge to the other?
    [[nodiscard]] bool turns_left_or_straight(std::size_t in, std::size_t out) const
    {
        const Vec2 before = end(in) - half_[in].at;
        const Vec2 after = end(out) - half_[out].at;
        const double sine = cross(before, after) / (before.norm() * after.norm());
        // Edges of one line may have two chords: those of two cuts.
        const bool is_side = half_[in].edge.source == half_[out].edge.source && half_[in].edge.source != edge_internal;
        const double straight = straight_sine_of(before, after, is_side ? slack_ : 0.0);
        return sine > straight || (sine >= -straight && before.dot(after) > 0.0);
    }

    [[nodiscard]] Chain chain_at(std::size_t h, std::size_t most) const
    {
        Chain c{h, h, half_[h].twin, half_[h].twin, 1};
        while (c.edges < most && half_[half_[c.first].before].twin == half_[c.b_first].after)
        {
            c.first = half_[c.first].before;
            c.b_first = half_[c.b_first].after;
            ++c.edges;
        }
        while (c.edges < most && half_[half_[c.last].after].twin == half_[c.b_last].before)
        {
            c.last = half_[c.last].after;
            c.b_last = half_[c.b_last].before;
            ++c.edges;
        }
        return c;
    }

    /// If the union is convex.
    void merge_across(std::size_t half)
    {
        if (half_[half].twin == none)
            return;  // the parts are one by now
        std::size_t a = part_of(half);
        std::size_t b = part_of(half_[half].twin);
        std::size_t h = half;
        if (a > b)
        {
            std::swap(a, b);
            h = half_[half].twin;
        }
        if (a == b)
            return;
        const Chain chain = chain_at(h, std::min(part_[a].edges, part_[b].edges) - 1);
        const std::size_t begin_a = half_[chain.last].after;
        const std::size_t end_a = half_[chain.first].before;
        const std::size_t begin_b = half_[chain.b_first].after;
        const std::size_t end_b = half_[chain.b_last].before;
        if (!turns_left_or_straight(end_a, begin_b) || !turns_left_or_straight(end_b, begin_a))
            return;
        for (std::size_t gone = chain.first; gone != begin_a; gone = half_[gone].after)
            half_[gone].twin = half_[half_[gone].twin].twin = none;
        link(end_a, begin_b);
        link(end_b, begin_a);
        part_[a] = {.start = begin_a, .edges = part_[a].edges + part_[b].edges - 2 * chain.edges, .is_union = true};
        part_[b].joined = a;
        for (const std::size_t joint : {begin_b, begin_a})
        {
            offer(half_[joint].before);
            offer(joint);
        }
    }

    void link(std::size_t before, std::size_t after)
    {
        half_[before].after = after;
        half_[after].before = before;
    }

    [[nodiscard]] CutPolygon ring(const Part& part) const
    {
        CutPolygon out;
        std::size_t h = part.start;
        for (std::size_t i = 0; i < part.edges; ++i, h = half_[h].after)
            out.add(half_[h].at, half_[h].edge);
        if (part.is_union)
            drop_straight_vertices(out, slack_);
        return out;
    }

    std::vector<Half> half_;
    std::vector<Part> part_;
    double slack_;
    std::unordered_map<Ends, std::size_t, HashOfEnds> open_;  ///< half-edges by their ends
    std::priority_queue<Seam> seams_;
};
}  // namespace

std::vector<CutPolygon> convex_parts(const CutPolygon& polygon)
{
    if (is_convex(polygon.vertices, straight_sine))
    {
        return {polygon};
    }
    std::vector<CutPolygon> parts = cut_ears(polygon);
    merge_convex_parts(parts);
    return parts;
}

void merge_convex_parts(std::vector<CutPolygon>& parts, double slack)
{
    if (parts.size() > 1)
        parts = Merger(parts, slack).run();
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
