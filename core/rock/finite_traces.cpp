#include "core/rock/finite_traces.h"

#include "core/geometry/unit_direction.h"
#include "core/model/edge_sources.h"
#include "core/rock/joint_sets.h"
#include "core/rock/line_stretches.h"
#include "core/rock/rock_checks.h"

#include <boost/random/poisson_distribution.hpp>

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// Longer traces than all but this share have do not reach into the domain from outside.
constexpr double share_of_longest = 1e-4;

/// Where the middles of traces lie that reach into a box.
Box around_traces(Box box, const Distribution& length)
{
    const double by = 0.5 * length.quantile(1.0 - share_of_longest);
    box.low.array() -= by;
    box.high.array() += by;
    return box;
}

/// Draws one set.
class SetLines
{
  public:
    SetLines(const CaseDef& def, const Polygon& domain, const Regions& regions, std::size_t number)
        : def_(def),
          domain_(domain),
          regions_(regions),
          set_(def.joint_sets[number]),
          number_(static_cast<std::int32_t>(number)),
          source_(EdgeSources(def).set(number))
    {
        drawn_.name = set_.name;
    }

    DrawnSet draw(std::vector<SourceLine>& lines)
    {
        out_ = &lines;
        if (!set_.trace)
            draw_through_going();
        else if (set_.p21 > 0.0)
            draw_anywhere();
        else
            draw_along_lines();
        return std::move(drawn_);
    }

  private:
    [[nodiscard]] std::uint64_t seed(RandomUse use) const { return stream_seed(def_.generator, set_, number_, use); }

    void draw_through_going()
    {
        const Box box = bounding_box(domain_);
        const JointTraces joints = draw_joints(set_, number_, def_.generator, box);
        const double far = 2.0 * (box.high - box.low).norm();
        drawn_.dip.expected = expected_dip(dip_within_reach(set_));
        double before = std::numeric_limits<double>::quiet_NaN();
        for (std::size_t i = 0; i < joints.lines.size(); ++i)
        {
            const CutLine& line = joints.lines[i];
            const double reach = far + (line.point - box.low).norm();
            const bool is_in = place(line.point - reach * line.direction, line.point + reach * line.direction);
            if (is_in)
                drawn_.dip.add(joints.dips[i]);
            note_spacing(joints.across.dot(line.point - joints.origin), is_in, before);
        }
    }

    void draw_anywhere()
    {
        const Distribution length(*set_.trace);
        const Box box = around_traces(bounding_box(domain_), length);
        boost::random::mt19937_64 places(seed(RandomUse::place)), lengths(seed(RandomUse::trace));
        DipSource dip(set_, set_.dip_law, seed(RandomUse::dip));
        expect(length, dip);
        const Vec2 size = box.high - box.low;
        boost::random::poisson_distribution<std::int64_t, double> count(set_.p21 * size.x() * size.y() / drawn_.trace.expected);
        for (std::int64_t left = count(places); left > 0; --left)
        {
            const double x = draw_share(places), y = draw_share(places);
            place_trace({box.low.x() + x * size.x(), box.low.y() + y * size.y()}, length.draw(lengths), dip.draw());
        }
    }

    void draw_along_lines()
    {
        const Distribution length(*set_.trace), gap(*set_.gap);
        const Box box = around_traces(bounding_box(domain_), length);
        JointSetDef carrier = set_;
        carrier.origin = set_.origin.value_or(Vec2(0.5 * (box.low + box.high)));
        carrier.dip_law = {};
        carrier.deviation_deg = 0.0;
        const JointTraces carriers = draw_joints(carrier, number_, def_.generator, box);
        boost::random::mt19937_64 places(seed(RandomUse::place)), lengths(seed(RandomUse::trace)), gaps(seed(RandomUse::gap));
        DipSource dip(set_, set_.dip_law, seed(RandomUse::dip));
        expect(length, dip);
        drawn_.gap.expected = gap.mean();
        const double period = drawn_.trace.expected + drawn_.gap.expected;
        double before = std::numeric_limits<double>::quiet_NaN();
        for (const CutLine& line : carriers.lines)
        {
            const auto [low, high] = extent(box, line);
            // A few periods before the box, so that where it begins has been forgotten.
            for (double at = low - (4.0 + draw_share(places)) * period; at < high;)
            {
                const double of_trace = length.draw(lengths), of_gap = gap.draw(gaps);
                const Vec2 middle = line.point + (at + 0.5 * of_trace) * line.direction;
                if (place_trace(middle, of_trace, dip.draw()))
                    drawn_.gap.add(of_gap);
                at += of_trace + of_gap;
            }
            const double far = std::abs(low) + std::abs(high);
            note_spacing(carriers.across.dot(line.point - carriers.origin),
                         length_inside(domain_, line.point - far * line.direction, line.point + far * line.direction) > 0.0,
                         before);
        }
    }

    /// True when its middle is in the domain.
    bool place_trace(const Vec2& middle, double length, double dip)
    {
        const Vec2 half = 0.5 * length * unit_direction(dip);
        place(middle - half, middle + half);
        if (!contains(domain_, middle))
            return false;
        drawn_.dip.add(dip);
        drawn_.trace.add(length);
        return true;
    }

    /// Where a joint may be becomes a line; true when some of it is in the domain.
    bool place(const Vec2& from, const Vec2& to)
    {
        bool is_in = false;
        for (const Stretch& stretch : find_stretches(def_, regions_, set_, domain_, from, to))
        {
            out_->push_back({source_, {stretch.from, stretch.to}});
            drawn_.length += stretch.length;
            is_in = is_in || stretch.length > 0.0;
        }
        drawn_.joints += is_in ? 1 : 0;
        return is_in;
    }

    void expect(const Distribution& length, const DipSource& dip)
    {
        drawn_.trace.expected = length.mean();
        drawn_.dip.expected = dip.expected();
    }

    [[nodiscard]] double expected_dip(const DistributionDef& law) const
    {
        return set_.dip_law.is_random() ? Distribution(law).mean() : set_.dip_deg;
    }

    /// @param before  place of the line before on the axis, if it was in the domain
    void note_spacing(double at, bool is_in, double& before)
    {
        drawn_.spacing.expected = set_.spacing_law.is_random() ? Distribution(set_.spacing_law).mean() : set_.spacing;
        if (is_in && !std::isnan(before))
            drawn_.spacing.add(at - before);
        before = is_in ? at : std::numeric_limits<double>::quiet_NaN();
    }

    /// Of a box along a line, from the line's point [m].
    static std::pair<double, double> extent(const Box& box, const CutLine& line)
    {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Vec2& corner : {box.low, Vec2(box.high.x(), box.low.y()), box.high, Vec2(box.low.x(), box.high.y())})
        {
            const double at = line.direction.dot(corner - line.point);
            low = std::min(low, at);
            high = std::max(high, at);
        }
        return {low, high};
    }

    const CaseDef& def_;
    const Polygon& domain_;
    const Regions& regions_;
    const JointSetDef& set_;
    std::int32_t number_;
    std::int32_t source_;
    DrawnSet drawn_;
    std::vector<SourceLine>* out_ = nullptr;
};
}  // namespace

bool is_finite(const JointSetDef& set)
{
    return set.trace.has_value() || !set.stops_at.empty();
}

bool is_cut_as_lines(const CaseDef& def, const JointSetDef& set)
{
    return is_finite(set) || (set.persistence >= 1.0 && (def.voronoi.given || std::ranges::any_of(def.joint_sets, is_finite)));
}

double trace_intensity(const JointSetDef& set)
{
    if (set.p21 > 0.0)
        return set.p21;
    if (!set.trace)
        return 1.0 / set.spacing;
    const double length = Distribution(*set.trace).mean();
    return length / (length + Distribution(*set.gap).mean()) / set.spacing;
}

double count_traces(const JointSetDef& set, const Box& box)
{
    const Distribution length(*set.trace);
    const Box around = around_traces(box, length);
    return trace_intensity(set) * (around.high - around.low).prod() / length.mean();
}

std::vector<SourceLine> draw_lines(const CaseDef& def, std::vector<DrawnSet>& drawn)
{
    std::vector<SourceLine> lines;
    Polygon domain = domain_polygon(def.domain);
    make_anticlockwise(domain);
    const Regions regions(def, domain);
    for (std::size_t i = 0; i < def.joint_sets.size(); ++i)
        drawn.push_back(is_cut_as_lines(def, def.joint_sets[i]) ? SetLines(def, domain, regions, i).draw(lines) : DrawnSet{});
    return lines;
}
}  // namespace hdem
