#include "core/rock/rock_checks.h"

#include "core/geometry/convex_decomposition.h"
#include "core/geometry/polygon.h"
#include "core/geometry/unit_direction.h"
#include "core/rock/excavation.h"
#include "core/rock/finite_traces.h"
#include "core/rock/joint_sets.h"
#include "core/rock/polygon_error.h"
#include "core/rock/problem_text.h"
#include "core/rock/region_checks.h"
#include "core/rock/voronoi_edges.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem
{
namespace
{
/// More than this many blocks do not fit the memory of any machine the program is meant for.
constexpr double most_blocks = 1e8;
constexpr double most_joints = 1e6;
constexpr double most_arc_segments = 10'000;

class RockChecker
{
  public:
    explicit RockChecker(const CaseDef& def) : def_(def) {}

    std::vector<Problem> run()
    {
        check_generator();
        const bool domain_is_good = !def_.domain.given || check_domain();
        bool sets_are_good = true;
        for (std::size_t i = 0; i < def_.joint_sets.size(); ++i)
        {
            sets_are_good = check_joint_set(def_.joint_sets[i], i) && sets_are_good;
        }
        if (def_.domain.given && domain_is_good && sets_are_good)
        {
            check_number_of_blocks();
        }
        if (domain_is_good)
        {
            std::ranges::move(find_region_problems(def_), std::back_inserter(problems_));
        }
        for (std::size_t i = 0; i < def_.excavations.size(); ++i)
        {
            if (check_excavation(def_.excavations[i], key("excavation", i)) && domain_is_good)
            {
                check_position(def_.excavations[i], key("excavation", i));
            }
        }
        for (std::size_t i = 0; i < def_.blocks.size(); ++i)
        {
            check_polygon(def_.blocks[i].polygon, key("block", i) + ".polygon", "block \"" + def_.blocks[i].name + "\"");
        }
        return std::move(problems_);
    }

  private:
    static std::string key(const char* table, std::size_t number)
    {
        return std::string(table) + "[" + std::to_string(number) + "]";
    }

    bool fail(const std::string& key, const std::string& text)
    {
        problems_.push_back({Problem::Severity::error, key, text});
        return false;
    }

    bool check_positive(double value, const std::string& key, const std::string& what, const std::string& remedy)
    {
        return (std::isfinite(value) && value > 0.0) || fail(key, what + " = " + text(value) + " (must be positive). " + remedy);
    }

    bool check_polygon(const Polygon& polygon, const std::string& key, const std::string& object)
    {
        const std::string error = polygon_error(polygon);
        return error.empty() || fail(key, object + ": polygon: " + error);
    }

    void check_generator()
    {
        const GeneratorDef& generator = def_.generator;
        for (const auto& [name, value] :
             {std::pair("smallest_block_area", generator.smallest_block_area), std::pair("smallest_edge", generator.smallest_edge)})
        {
            if (!std::isfinite(value) || value < 0.0)
            {
                fail(std::string("generator.") + name, std::string("generator: ") + name + " = " + text(value) +
                                                           " (must not be negative). Give 0 to accept every piece.");
            }
        }
    }

    bool check_domain()
    {
        const DomainDef& domain = def_.domain;
        if (domain.polygon.empty())
        {
            const bool width = check_positive(domain.width, "domain.width", "domain: width", "Give it in m.");
            const bool height = check_positive(domain.height, "domain.height", "domain: height", "Give it in m.");
            if (!width || !height)
            {
                return false;
            }
            if (!domain.origin.allFinite())
            {
                return fail("domain.origin", "domain: origin = " + text(domain.origin) + " (must be finite). Correct it.");
            }
        }
        else if (!check_polygon(domain.polygon, "domain.polygon", "domain"))
        {
            return false;
        }
        const Polygon polygon = domain_polygon(domain);
        const double area = std::abs(signed_area(polygon));
        if (area < def_.generator.smallest_block_area)
        {
            fail("domain",
                 "domain: area = " + text(area) + " m2 (smaller than generator.smallest_block_area). Enlarge the domain.");
        }
        return check_fixed(polygon.size());
    }

    bool check_fixed(std::size_t edges)
    {
        constexpr std::array<const char*, 4> sides = {"left", "right", "bottom", "top"};
        bool good = true;
        for (const std::string& side : def_.domain.fixed)
        {
            if (std::find(sides.begin(), sides.end(), side) == sides.end())
            {
                good = fail("domain.fixed", "domain: fixed = \"" + side + "\" (no such side). Give left, right, bottom or top.");
            }
        }
        for (const int edge : def_.domain.fixed_edges)
        {
            if (edge < 0 || static_cast<std::size_t>(edge) >= edges)
            {
                good = fail("domain.fixed_edges", "domain: fixed_edges = " + std::to_string(edge) + " (edges are 0 to " +
                                                      std::to_string(edges - 1) + "). Give the number of an edge.");
            }
        }
        return good;
    }

    bool check_joint_set(const JointSetDef& set, std::size_t number)
    {
        const std::string at = key("joint_set", number);
        const std::string object = "joint set \"" + set.name + "\": ";
        const bool has_p21 = set.trace && set.p21 > 0.0;
        bool good = has_p21 ||
                    check_positive(set.spacing, at + ".spacing", object + "spacing", "Give the distance between joints in m.");
        if (!std::isfinite(set.dip_deg))
        {
            good = fail(at + ".dip_deg", object + "dip_deg = " + text(set.dip_deg) + " (must be finite). Correct it.");
        }
        if (!(set.deviation_deg >= 0.0 && set.deviation_deg < 90.0))
        {
            good = fail(at + ".deviation_deg", object + "deviation_deg = " + text(set.deviation_deg) +
                                                   " (must be at least 0 and below 90). Give half the range of dips.");
        }
        if (!(set.persistence > 0.0 && set.persistence <= 1.0))
        {
            good = fail(at + ".persistence", object + "persistence = " + text(set.persistence) +
                                                 " (a chance above 0, at most 1). Give 1 for joints that cut every block.");
        }
        if (set.origin && !set.origin->allFinite())
        {
            good = fail(at + ".origin", object + "origin = " + text(*set.origin) + " (must be finite). Correct it.");
        }
        return good;
    }

    /// Lines of two sets meet |sin(θ_i - θ_j)| / (s_i s_j) times per area; every meeting, and every joint, adds a block.
    void check_number_of_blocks()
    {
        const Polygon polygon = domain_polygon(def_.domain);
        double blocks = 1.0;
        for (std::size_t i = 0; i < def_.joint_sets.size(); ++i)
        {
            const JointSetDef& set = def_.joint_sets[i];
            const double joints = set.p21 > 0.0 ? 0.0 : count_joints(set, bounding_box(polygon));
            const double traces = set.trace ? count_traces(set, bounding_box(polygon)) : 0.0;
            if (joints > most_joints || traces > most_joints)
            {
                const bool by_p21 = set.p21 > 0.0;
                fail(key("joint_set", i) + (by_p21 ? ".p21" : ".spacing"),
                     "joint set \"" + set.name +
                         "\": " + (by_p21 ? "p21 = " + text(set.p21) + " m/m2" : "spacing = " + text(set.spacing) + " m") +
                         " (makes " + text(std::max(joints, traces)) + " joints across the domain). Give " +
                         (by_p21 ? "a smaller p21, or longer traces." : "a greater spacing."));
                continue;
            }
            blocks += set.trace ? traces : joints;
            for (std::size_t j = 0; j < i; ++j)
            {
                const double sine = unit_direction(set.dip_deg - def_.joint_sets[j].dip_deg).y();
                const double area = std::min(cut_area(set, polygon), cut_area(def_.joint_sets[j], polygon));
                blocks += std::abs(area * sine) * trace_intensity(set) * trace_intensity(def_.joint_sets[j]);
            }
        }
        if (def_.voronoi.given)
        {
            const double cells = count_cells(def_);
            if (cells > most_joints)
            {
                fail("voronoi.edge", "[voronoi]: edge = " + text(def_.voronoi.edge) + " m (makes about " + text(cells) +
                                         " cells). Give a greater one.");
            }
        }
        if (blocks > most_blocks)
        {
            fail("joint_set[0].spacing", "joint sets: spacings make about " + text(blocks) + " blocks (more than " +
                                             text(most_blocks) + "). Give greater spacings or a smaller domain.");
        }
    }

    /// At most this is cut by the set [m2].
    double cut_area(const JointSetDef& set, const Polygon& domain) const
    {
        double least = std::abs(signed_area(domain));
        for (const RegionDef& region : def_.regions)
        {
            if (region.name == set.region && region.polygon.size() > 2)
            {
                least = std::min(least, std::abs(signed_area(region.polygon)));
            }
        }
        return least;
    }

    bool check_excavation(const ExcavationDef& excavation, const std::string& at)
    {
        const std::string object = "excavation \"" + excavation.name + "\": ";
        if (excavation.shape == OutlineShape::polygon)
        {
            return check_polygon(excavation.polygon, at + ".polygon", "excavation \"" + excavation.name + "\"");
        }
        bool good = excavation.position.allFinite() ||
                    fail(at + ".position", object + "position = " + text(excavation.position) + " (must be finite). Correct it.");
        const bool is_circle = excavation.shape == OutlineShape::circle;
        if (is_circle)
        {
            good = check_positive(excavation.diameter, at + ".diameter", object + "diameter", "Give it in m.") && good;
        }
        else
        {
            good = check_positive(excavation.width, at + ".width", object + "width", "Give it in m.") && good;
            good = check_positive(excavation.height, at + ".height", object + "height", "Give it in m.") && good;
        }
        if (good && excavation.shape == OutlineShape::horseshoe && excavation.height <= 0.5 * excavation.width)
        {
            good = fail(at + ".height", object + "height = " + text(excavation.height) +
                                            " m (a half circle over the width is already " + text(0.5 * excavation.width) +
                                            " m high). Give a greater height or a smaller width.");
        }
        const int least = is_circle ? 3 : 2;
        if (excavation.shape != OutlineShape::rectangle &&
            (excavation.arc_segments < least || excavation.arc_segments > most_arc_segments))
        {
            good = fail(at + ".arc_segments", object + "arc_segments = " + std::to_string(excavation.arc_segments) + " (must be " +
                                                  std::to_string(least) + " to " + text(most_arc_segments) + "). Give e.g. 16.");
        }
        return good;
    }

    void check_position(const ExcavationDef& excavation, const std::string& at)
    {
        const std::string object = "excavation \"" + excavation.name + "\": ";
        if (!def_.domain.given)
        {
            fail(at, object + "there is no [domain] (an outline cuts generated blocks). Give a domain, or remove blocks by name.");
            return;
        }
        const Polygon domain = domain_polygon(def_.domain);
        const Polygon outline = outline_polygon(excavation);
        if (overlap_area(outline, domain) <= 1e-12 * std::abs(signed_area(outline)))
        {
            const Box box = bounding_box(domain);
            const bool by_position = excavation.shape != OutlineShape::polygon;
            fail(at + (by_position ? ".position" : ".polygon"),
                 object + (by_position ? "position = " + text(excavation.position) : "polygon") +
                     " (the outline lies outside the domain, which spans " + text(box.low) + " to " + text(box.high) +
                     "). Move it.");
        }
    }

    const CaseDef& def_;
    std::vector<Problem> problems_;
};
}  // namespace

Polygon domain_polygon(const DomainDef& domain)
{
    if (!domain.polygon.empty())
    {
        return domain.polygon;
    }
    const Vec2& low = domain.origin;
    const Vec2 high = low + Vec2(domain.width, domain.height);
    return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

std::vector<Problem> find_rock_problems(const CaseDef& def)
{
    return RockChecker(def).run();
}
}  // namespace hdem
