#include "core/water/pore_pressure.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hdem
{
double WaterTable::height(double across) const
{
    const auto after = std::ranges::upper_bound(points, across, {}, [](const Vec2& p) { return p.x(); });
    if (after == points.begin())
        return points.front().y();
    if (after == points.end())
        return points.back().y();
    const Vec2 &a = *(after - 1), &b = *after;
    return a.y() + (b.y() - a.y()) * (across - a.x()) / (b.x() - a.x());
}

namespace
{
constexpr double steepest = 0.01;  ///< sine of the angle of a face that runs along a crack

/// Where a point lies along a polyline, if it lies on it.
std::optional<double> way_along(const std::vector<Vec2>& line, const Vec2& at, double tolerance)
{
    double way = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
    {
        const Vec2 side = line[i + 1] - line[i], to = at - line[i];
        const double length = side.norm(), s = to.dot(side) / length;
        if (s >= -tolerance && s <= length + tolerance && std::abs(cross(side, to)) <= tolerance * length)
            return way + std::clamp(s, 0.0, length);
        way += length;
    }
    return std::nullopt;
}

double length_of(const std::vector<Vec2>& line)
{
    double length = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
        length += (line[i + 1] - line[i]).norm();
    return length;
}

/// Pressures before they are cut to 0 where there is no water.
class Pressure
{
  public:
    Pressure(const Water& water, Index stage) : water_(water)
    {
        const Index table = water.table_of_stage.empty() ? no_index : water.table_of_stage[static_cast<std::size_t>(stage)];
        if (table != no_index)
            table_ = &water.tables[static_cast<std::size_t>(table)];
    }

    [[nodiscard]] bool has_table() const { return table_ != nullptr && water_.field.triangle.empty(); }
    [[nodiscard]] const WaterTable& table() const { return *table_; }
    [[nodiscard]] double across(const Vec2& at) const { return at.x() * water_.up.y() - at.y() * water_.up.x(); }

    /// Of a crack or an outlet on which both ends and the middle lie.
    [[nodiscard]] std::optional<std::array<double, 2>> on_crack(const Vec2& a, const Vec2& b) const
    {
        for (const WaterCrack& crack : water_.cracks)
        {
            const auto lies_on = [&](const std::vector<Vec2>& line, const auto& pressure) -> std::optional<std::array<double, 2>>
            {
                const double e = water_.tolerance * (1.0 + 1e-9);  // places where a face leaves it are on it
                const auto first = way_along(line, a, e), last = way_along(line, b, e);
                if (!first || !last || !way_along(line, 0.5 * (a + b), e))
                    return std::nullopt;
                return std::array<double, 2>{pressure(a, *first), pressure(b, *last)};
            };
            if (const auto stands = lies_on(crack.crack, [&](const Vec2& at, double) { return below(crack.level, at); }))
                return stands;
            const double foot = std::max(below(crack.level, crack.outlet.front()), 0.0), length = length_of(crack.outlet);
            if (const auto seeps = lies_on(crack.outlet, [&](const Vec2&, double way) { return foot * (1.0 - way / length); }))
                return seeps;
        }
        return std::nullopt;
    }

    [[nodiscard]] double at(const Vec2& place) const
    {
        if (!water_.field.triangle.empty())
            return of_field(place);
        return table_ == nullptr ? 0.0 : below(table_->height(across(place)), place);
    }

  private:
    [[nodiscard]] double below(double level, const Vec2& at) const { return water_.unit_weight * (level - at.dot(water_.up)); }

    [[nodiscard]] double of_field(const Vec2& at) const
    {
        const PressureField& f = water_.field;
        for (const auto& [i, j, k] : f.triangle)
        {
            const Vec2 &a = f.points[i], &b = f.points[j], &c = f.points[k];
            const double whole = cross(b - a, c - a), slack = -1e-9 * whole;
            const double at_a = cross(b - at, c - at), at_b = cross(c - at, a - at), at_c = whole - at_a - at_b;
            if (at_a >= slack && at_b >= slack && at_c >= slack)
                return (at_a * f.pressure[i] + at_b * f.pressure[j] + at_c * f.pressure[k]) / whole;
        }
        return 0.0;
    }

    const Water& water_;
    const WaterTable* table_ = nullptr;
};

/// Add a piece on which p runs straight from p0 at s0 to p1 at s1; below 0 there is no water.
void add_piece(double s0, double p0, double s1, double p1, PressureSum& sum)
{
    if (p0 <= 0.0 && p1 <= 0.0)
        return;
    if (p0 < 0.0)
        s0 += (s1 - s0) * p0 / (p0 - p1), p0 = 0.0;
    else if (p1 < 0.0)
        s1 -= (s1 - s0) * p1 / (p1 - p0), p1 = 0.0;
    const double length = s1 - s0, mean = 0.5 * (p0 + p1);
    sum.force += mean * length;
    sum.moment += length * (mean * s0 + length * (p0 + 2.0 * p1) / 6.0);
}

/// Unit vector along a stretch.
Vec2 direction(const Vec2& from, const Vec2& to)
{
    return (to - from).normalized();
}

/// Part of a stretch that lies in one triangle of the field: its pressure runs straight there.
struct FieldSpan
{
    double from, to;  ///< along the stretch [m]
    double p_from, p_to;

    [[nodiscard]] double at(double way) const { return to > from ? p_from + (p_to - p_from) * (way - from) / (to - from) : p_from; }
};

/// Of all triangles that a stretch crosses. One along a side of two triangles lies in both.
std::vector<FieldSpan> field_spans(const PressureField& field, const Vec2& from, const Vec2& to)
{
    std::vector<FieldSpan> spans;
    const double length = (to - from).norm();
    const Vec2 low = from.cwiseMin(to), high = from.cwiseMax(to);
    for (const auto& corners : field.triangle)
    {
        const std::array<Vec2, 3> p{field.points[corners[0]], field.points[corners[1]], field.points[corners[2]]};
        const Vec2 lowest = p[0].cwiseMin(p[1]).cwiseMin(p[2]), highest = p[0].cwiseMax(p[1]).cwiseMax(p[2]);
        const double slack_of_box = 1e-9 * (highest - lowest).maxCoeff();
        if ((low - highest).maxCoeff() > slack_of_box || (lowest - high).maxCoeff() > slack_of_box)
            continue;
        const double whole = cross(p[1] - p[0], p[2] - p[0]), slack = 1e-9 * whole;
        double begin = 0.0, end = 1.0, p_from = 0.0, p_to = 0.0;
        for (std::size_t k = 0; k < 3; ++k)  // areas of the triangles over the side that faces corner k: its share of the pressure
        {
            const Vec2 &a = p[(k + 1) % 3], &b = p[(k + 2) % 3];
            const double at_from = cross(b - a, from - a), at_to = cross(b - a, to - a);
            const double pressure = field.pressure[corners[k]] / whole;
            p_from += pressure * at_from;
            p_to += pressure * at_to;
            if (at_from < -slack && at_to < -slack)
                end = -1.0;
            else if (at_from < -slack)
                begin = std::max(begin, (at_from + slack) / (at_from - at_to));
            else if (at_to < -slack)
                end = std::min(end, (at_from + slack) / (at_from - at_to));
        }
        if (begin < end)
            spans.push_back({begin * length, end * length, p_from + begin * (p_to - p_from), p_from + end * (p_to - p_from)});
    }
    return spans;
}

/// Adds ways along a face at which it comes within the tolerance of a line that it runs almost along, or leaves it.
void add_band(const FaceStretch& face, double length, const std::vector<Vec2>& line, double tolerance, std::vector<double>& ways)
{
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
    {
        const Vec2 along = direction(line[i], line[i + 1]);
        const double off_from = cross(along, face.drawn_from - line[i]), off_to = cross(along, face.drawn_to - line[i]);
        if (std::abs(off_to - off_from) > steepest * length)
            continue;
        for (const double edge : {-tolerance, tolerance})
            if ((off_from < edge) != (off_to < edge))
                ways.push_back(length * std::clamp((edge - off_from) / (off_to - off_from), 0.0, 1.0));
    }
}

/// Ways along a face at which its pressure may bend, ascending, with both ends.
std::vector<double> bends(const Water& water, const Pressure& pressure, const FaceStretch& face, double length,
                          const std::vector<FieldSpan>& spans)
{
    std::vector<double> ways{0.0, length};
    const auto add = [&](double way)
    {
        if (way > 0.0 && way < length)
            ways.push_back(way);
    };
    if (pressure.has_table() && face.table_acts)
    {
        const double start = pressure.across(face.from), slope = pressure.across(direction(face.from, face.to));
        for (const Vec2& p : pressure.table().points)
            if (slope != 0.0)
                add((p.x() - start) / slope);
    }
    const Vec2 along = direction(face.drawn_from, face.drawn_to);
    for (const WaterCrack& crack : water.cracks)
        for (const std::vector<Vec2>* line : {&crack.crack, &crack.outlet})
        {
            if (!face.cracks_act)
                continue;
            for (const Vec2& p : *line)
                if (std::abs(cross(along, p - face.drawn_from)) <= water.tolerance)
                    add((p - face.drawn_from).dot(along));
            add_band(face, length, *line, water.tolerance, ways);
        }
    for (const FieldSpan& span : spans)
    {
        add(span.from);
        add(span.to);
    }
    std::ranges::sort(ways);
    return ways;
}
}  // namespace

double pressure_at(const Water& water, Index stage, const Vec2& at)
{
    const Pressure pressure(water, stage);
    const auto on_crack = pressure.on_crack(at, at);
    return std::max(on_crack ? on_crack->front() : pressure.at(at), 0.0);
}

PressureSum pressure_along(const Water& water, Index stage, const FaceStretch& face)
{
    PressureSum sum;
    const double length = (face.to - face.from).norm();
    if (length == 0.0)
        return sum;
    const Vec2 along = direction(face.from, face.to), drawn_along = direction(face.drawn_from, face.drawn_to);
    const Pressure pressure(water, stage);
    const bool has_field = face.table_acts && !water.field.triangle.empty();
    const std::vector<FieldSpan> spans = has_field ? field_spans(water.field, face.from, face.to) : std::vector<FieldSpan>{};
    const std::vector<double> ways = bends(water, pressure, face, length, spans);
    for (std::size_t i = 0; i + 1 < ways.size(); ++i)
    {
        std::optional<std::array<double, 2>> ends;
        if (face.cracks_act && !water.cracks.empty())
            ends = pressure.on_crack(face.drawn_from + ways[i] * drawn_along, face.drawn_from + ways[i + 1] * drawn_along);
        if (!ends && has_field)
        {
            const double middle = 0.5 * (ways[i] + ways[i + 1]);
            const auto span = std::ranges::find_if(spans, [&](const FieldSpan& s) { return s.from <= middle && middle <= s.to; });
            if (span != spans.end())
                ends = {span->at(ways[i]), span->at(ways[i + 1])};
        }
        else if (!ends && face.table_acts)
            ends = {pressure.at(face.from + ways[i] * along), pressure.at(face.from + ways[i + 1] * along)};
        if (ends)
            add_piece(ways[i], (*ends)[0], ways[i + 1], (*ends)[1], sum);
    }
    return sum;
}
}  // namespace hdem
