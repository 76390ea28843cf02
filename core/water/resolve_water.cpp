#include "core/water/resolve_water.h"

#include "core/rock/problem_text.h"
#include "core/water/crack_faces.h"
#include "core/water/pore_pressure.h"

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double near_line = 1e-4;      ///< share of the mean block size
constexpr double least_on_face = 0.95;  ///< share of a straight piece of a crack

std::vector<Vec2> moved(const std::vector<Vec2>& points, const Vec2& origin)
{
    std::vector<Vec2> local;
    for (const Vec2& p : points)
        local.push_back(p - origin);
    return local;
}

class WaterResolver
{
  public:
    WaterResolver(const CaseDef& def, const Vec2& origin, const Blocks& blocks, Model& model)
        : def_(def),
          origin_(origin),
          blocks_(blocks),
          model_(model),
          water_(model.water)
    {
    }

    std::vector<Problem> run()
    {
        water_.given = true;
        water_.unit_weight = def_.water.density * model_.gravity.norm();
        water_.up = -model_.gravity.normalized();
        water_.ponded = def_.water.ponded;
        water_.tolerance = near_line * model_.mean_size;
        water_.drawn.resize(model_.user_number.size());
        for (std::size_t b = 0; b < model_.user_number.size(); ++b)
            water_.drawn[model_.user_number[b]] = {blocks_.motion[b].x, blocks_.motion[b].y};
        add_tables();
        add_joints();
        for (const std::string& name : model_.excavation_names)
            water_.wet_opening.push_back(std::ranges::count(def_.water.flooded, name) > 0 ? 1 : 0);
        for (std::size_t i = 0; i < def_.water_cracks.size(); ++i)
        {
            add_crack(def_.water_cracks[i]);
            look_at_crack(water_.cracks.back(), "water_crack[" + std::to_string(i) + "]", "water crack " + std::to_string(i + 1));
        }
        add_field();
        return std::move(problems_);
    }

  private:
    [[nodiscard]] double height_of(double level) const { return level - origin_.dot(water_.up); }

    [[nodiscard]] WaterTable table_of(const std::optional<double>& level, const Polygon& points) const
    {
        WaterTable table;
        if (level)
            table.points.push_back({0.0, height_of(*level)});
        for (const Vec2& p : points)
        {
            const Vec2 at = p - origin_;
            table.points.push_back({at.x() * water_.up.y() - at.y() * water_.up.x(), at.dot(water_.up)});
        }
        return table;
    }

    Index add_table(const std::string& key, const std::optional<double>& level, const Polygon& points)
    {
        water_.tables.push_back(table_of(level, points));
        const std::vector<Vec2>& line = water_.tables.back().points;
        for (std::size_t i = 0; i + 1 < line.size(); ++i)
            if (!(line[i].x() < line[i + 1].x()))
            {
                problems_.push_back({.key = key,
                                     .text = key + ": point " + std::to_string(i + 1) +
                                             " lies behind the one before it (a water table runs from left to right, seen with "
                                             "gravity downwards). Give its points in that order."});
                break;
            }
        return static_cast<Index>(water_.tables.size()) - 1;
    }

    void add_tables()
    {
        Index now = no_index;
        if (def_.water.level || !def_.water.table.empty())
            now = add_table("water.table", def_.water.level, def_.water.table);
        for (std::size_t i = 0; i < def_.stages.size(); ++i)
        {
            const StageDef& stage = def_.stages[i];
            if (stage.water_level || !stage.water_table.empty())
                now = add_table("stage[" + std::to_string(i) + "].water_table", stage.water_level, stage.water_table);
            water_.table_of_stage.push_back(now);
        }
    }

    void add_joints()
    {
        const JointTable& joints = model_.joints;
        std::vector<std::uint8_t> named;
        for (const std::string& name : joints.names)
            named.push_back(def_.water.joints.empty() || std::ranges::count(def_.water.joints, name) > 0 ? 1 : 0);
        water_.wet_law.assign(joints.laws.size(), 1);  // walls stand where rock goes on
        for (std::size_t j = 0; j < named.size(); ++j)
            for (const Index law : {static_cast<Index>(j), joints.unbonded_of(static_cast<Index>(j))})
                water_.wet_law[law] = named[j];
    }

    void add_crack(const WaterCrackDef& from)
    {
        water_.cracks.push_back({moved(from.crack, origin_), moved(from.outlet, origin_), height_of(from.level)});
    }

    void warn(const std::string& key, std::string said)
    {
        problems_.push_back({.severity = Problem::Severity::warning, .key = key, .text = std::move(said)});
    }

    void look_at_crack(const WaterCrack& crack, const std::string& key, const std::string& object)
    {
        const std::vector<Vec2> wet = wet_part(crack, water_.up);
        if (wet.empty())
            return warn(key + ".level", object + ": level = " + text(crack.level + origin_.dot(water_.up)) +
                                            " m (its foot is not below: there is no water in it). Give a greater one.");
        look_at_line(wet, key + ".crack", object + ": crack");
        look_at_line(crack.outlet, key + ".outlet", object + ": outlet");
    }

    /// A line beside the joint that is meant is a likely slip, and its water would be missing silently.
    void look_at_line(const std::vector<Vec2>& line, const std::string& key, const std::string& object)
    {
        const std::vector<double> shares = shares_on_faces(line, model_, blocks_);
        for (std::size_t i = 0; i < shares.size(); ++i)
            if (shares[i] < least_on_face)
                warn(key, object + " from " + text(Vec2(line[i] + origin_)) + " to " + text(Vec2(line[i + 1] + origin_)) + " m (" +
                              (shares[i] == 0.0 ? "no face of a block lies on it"
                                                : "faces of blocks lie on " + text(100.0 * shares[i]) + " % of it") +
                              " within " + text(water_.tolerance) + " m: its water presses on nothing" +
                              (shares[i] == 0.0 ? "" : " elsewhere") + "). Give the points of the joint as it is drawn.");
    }

    void add_field()
    {
        if (def_.water.pressures.empty())
            return;
        for (const auto& [x, y, pressure] : def_.water.pressures)
        {
            water_.field.points.push_back(Vec2(x, y) - origin_);
            water_.field.pressure.push_back(pressure);
        }
        if (!make_triangles(water_.field))
            problems_.push_back({.key = "water.pressure",
                                 .text = "[water]: pressure = \"" + def_.water.pressure +
                                         "\" (its points lie on one line: nothing can be interpolated). Give points around the "
                                         "rock."});
        else
            check_reach();
    }

    /// The triangles fill the convex hull of the points: all corners of free blocks must lie in it.
    void check_reach()
    {
        using Point = boost::geometry::model::d2::point_xy<double>;
        boost::geometry::model::multi_point<Point> points;
        for (const Vec2& p : water_.field.points)
            boost::geometry::append(points, Point(p.x(), p.y()));
        boost::geometry::model::polygon<Point> hull;
        boost::geometry::convex_hull(points, hull);
        Point centre(0.0, 0.0);
        boost::geometry::centroid(hull, centre);
        constexpr double rounding = 1e-9;
        for (Index part = 0; part < model_.shapes.parts(); ++part)
            for (Index v = model_.shapes.vertex_begin[part]; v < model_.shapes.vertex_begin[part + 1]; ++v)
            {
                const Index block = model_.shapes.part_block[part];
                const BlockMotion& motion = blocks_.motion[block];
                const Vec2 at = Vec2(motion.x, motion.y) + model_.shapes.vertex[v];  // as drawn, blocks are not turned
                const Vec2 inner = at + rounding * (Vec2(centre.x(), centre.y()) - at);
                if (!blocks_.is_free(block) || boost::geometry::covered_by(Point(inner.x(), inner.y()), hull))
                    continue;
                const Vec2 place = at + origin_;
                problems_.push_back({.key = "water.pressure",
                                     .text = "[water]: pressure = \"" + def_.water.pressure + "\" (its points do not reach block " +
                                             model_.name[block] + " at " + std::to_string(place.x()) + ", " +
                                             std::to_string(place.y()) + "). Give points around the rock."});
                return;
            }
    }

    const CaseDef& def_;
    Vec2 origin_;
    const Blocks& blocks_;
    Model& model_;
    Water& water_;
    std::vector<Problem> problems_;
};
}  // namespace

std::vector<Problem> resolve_water(const CaseDef& def, const Vec2& origin, const Blocks& blocks, Model& model)
{
    return def.water.given ? WaterResolver(def, origin, blocks, model).run() : std::vector<Problem>{};
}
}  // namespace hdem
