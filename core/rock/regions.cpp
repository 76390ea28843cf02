#include "core/rock/regions.h"

#include "core/rock/fault_lines.h"
#include "core/rock/line_stretches.h"
#include "core/rock/problem_text.h"

#include <algorithm>
#include <map>

namespace hdem
{
namespace
{
/// Lines are known to line_slack only: less than this share of a block across a boundary is none.
constexpr double accepted_share = 1e-4;

const FaultDef& fault_named(const CaseDef& def, const std::string& name, std::size_t region)
{
    const auto found = std::find_if(def.faults.begin(), def.faults.end(), [&](const FaultDef& f) { return f.name == name; });
    if (found == def.faults.end())
        throw InputError(Problem{.key = "region[" + std::to_string(region) + "]",
                                 .text = "region \"" + def.regions[region].name + "\": fault \"" + name +
                                         "\" (no fault has this name). Add it, or correct the name."});
    return *found;
}

Vec2 point_inside(const CutBlock& block)
{
    const auto largest = std::max_element(block.parts.begin(), block.parts.end(),
                                          [](const CutPolygon& a, const CutPolygon& b)
                                          { return signed_area(a.vertices) < signed_area(b.vertices); });
    return area_moments(largest->vertices).centroid;
}
}  // namespace

Regions::Regions(const CaseDef& def, const Polygon& domain) : def_(def), limits_(def.regions.size())
{
    for (std::size_t i = 0; i < def.regions.size(); ++i)
    {
        const RegionDef& region = def.regions[i];
        if (!region.polygon.empty())
            add_limit(i, region.polygon, true, {});
        if (!region.above.empty())
            add_limit(i, area_above(fault_named(def, region.above, i), domain), true, region.above);
        if (!region.below.empty())
            add_limit(i, area_above(fault_named(def, region.below, i), domain), false, region.below);
    }
}

void Regions::add_limit(std::size_t region, Polygon area, bool is_inside, const std::string& fault)
{
    make_anticlockwise(area);
    CutPolygon whole{area, {}};
    whole.edges.assign(area.size(), {edge_plain, no_index});
    limits_[region].push_back({.area = std::move(area), .parts = convex_parts(whole), .is_inside = is_inside, .fault = fault});
}

double Regions::share_within(const Limit& limit, const CutBlock& block)
{
    double common = 0.0;
    for (const CutPolygon& of_block : block.parts)
        for (const CutPolygon& part : limit.parts)
            if (bounding_box(of_block.vertices).meets(bounding_box(part.vertices)))
                common += convex_overlap_area(of_block.vertices, part.vertices);
    const double share = common / total_area(block.parts);
    return limit.is_inside ? share : 1.0 - share;
}

std::vector<Problem> Regions::find_problems(const CutMass& mass) const
{
    std::vector<Problem> problems;
    for (std::size_t i = 0; i < limits_.size(); ++i)
    {
        const std::string key = "region[" + std::to_string(i) + "]";
        const std::string object = "region \"" + def_.regions[i].name + "\": ";
        bool is_empty = true;
        for (const CutBlock& block : mass.blocks)
        {
            const Limit* across = nullptr;
            bool is_outside = false;
            for (const Limit& limit : limits_[i])
            {
                const double share = share_within(limit, block);
                is_outside = is_outside || share < accepted_share;
                across = share >= accepted_share && share <= 1.0 - accepted_share ? &limit : across;
            }
            is_empty = is_empty && is_outside;
            if (is_outside || across == nullptr)
                continue;
            const std::string boundary = across->fault.empty() ? "its outline" : "fault \"" + across->fault + "\"";
            problems.push_back({.key = key,
                                .text = object + "block around " + text(point_inside(block)) + " (it lies on both sides of " +
                                        boundary +
                                        ", which ends inside it). Let the fault run to the domain's boundary or to another "
                                        "fault, or limit the region by that one too."});
            break;
        }
        if (is_empty)
            problems.push_back(
                {.key = key, .text = object + "blocks = 0 (nothing of the domain lies in it). Move it, or drop it."});
    }
    return problems;
}

bool Regions::holds(std::size_t region, const Vec2& point) const
{
    return std::all_of(limits_[region].begin(), limits_[region].end(), [&](const Limit& limit) { return limit.holds(point); });
}

bool Regions::holds(const std::string& region, const Vec2& point) const
{
    for (std::size_t i = 0; i < limits_.size(); ++i)
        if (def_.regions[i].name == region)
            return holds(i, point);
    throw InputError(Problem{.key = "region", .text = "region \"" + region + "\": not defined. Add [[region]] with this name."});
}

bool Regions::is_meant(const JointSetDef& set, const CutBlock& block) const
{
    if (set.region.empty() && set.outside.empty())
        return true;
    return is_meant(set, point_inside(block));
}

bool Regions::is_meant(const JointSetDef& set, const Vec2& point) const
{
    return (set.region.empty() || holds(set.region, point)) && (set.outside.empty() || !holds(set.outside, point));
}

void Regions::add_boundary(const std::string& region, const Vec2& from, const Vec2& to, std::vector<double>& shares) const
{
    for (std::size_t i = 0; i < def_.regions.size(); ++i)
        if (def_.regions[i].name == region)
            for (const Limit& limit : limits_[i])
                add_crossings(limit.area, true, from, to, shares);
}

void Regions::add_boundaries(const JointSetDef& set, const Vec2& from, const Vec2& to, std::vector<double>& shares) const
{
    for (const std::string& region : {set.region, set.outside})
        if (!region.empty())
            add_boundary(region, from, to, shares);
}

const std::string& Regions::material(const CutBlock& block) const
{
    if (limits_.empty())
        return def_.domain.material;
    const auto region_of = [&](const CutPolygon& part)
    {
        const Vec2 point = area_moments(part.vertices).centroid;
        for (std::size_t i = 0; i < limits_.size(); ++i)
            if (!def_.regions[i].material.empty() && holds(i, point))
                return i;
        return limits_.size();
    };
    std::map<std::size_t, double> areas;
    for (const CutPolygon& part : block.parts)
        areas[region_of(part)] += signed_area(part.vertices);
    const auto smaller = [](const auto& a, const auto& b) { return a.second < b.second; };
    const std::size_t most = std::ranges::max_element(areas, smaller)->first;
    return most < limits_.size() ? def_.regions[most].material : def_.domain.material;
}
}  // namespace hdem
