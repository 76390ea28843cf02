/// A rock face cut by two joint sets, held on one side and below, open on the other: falls, or stands, by limit analysis.
///
/// Where no admissible forces balance the weights, even with a twentieth more friction and cohesion, some block moves for certain. Where friction and cohesion could be
/// divided by 1.5, and gravity be turned by three degrees, and a slow run agrees, all of them stay.

#include "verification/rest/families.h"
#include "verification/rest/limit_analysis.h"
#include "verification/rest/springs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hdem::verification::rest
{
namespace
{
/// The part of a convex polygon on the left of a line.
Polygon left_of(const Polygon& polygon, const Vec2& start, const Vec2& along)
{
    Polygon part;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const Vec2& p = polygon[i];
        const Vec2& q = polygon[next(i, polygon.size())];
        const double at_p = cross(along, p - start), at_q = cross(along, q - start);
        if (at_p >= 0.0)
            part.push_back(p);
        if ((at_p > 0.0 && at_q < 0.0) || (at_p < 0.0 && at_q > 0.0))
            part.push_back(p + at_p / (at_p - at_q) * (q - p));
    }
    return part;
}

/// All polygons cut by one line; a cut that leaves a small piece is not made.
std::vector<Polygon> cut(const std::vector<Polygon>& polygons, const Vec2& start, const Vec2& along, double least_area)
{
    std::vector<Polygon> pieces;
    for (const Polygon& polygon : polygons)
    {
        const Polygon left = left_of(polygon, start, along), right = left_of(polygon, start, -along);
        const bool both = left.size() > 2 && right.size() > 2 && area_moments(left).area > least_area &&
                          area_moments(right).area > least_area;
        if (both)
            pieces.insert(pieces.end(), {left, right});
        else
            pieces.push_back(polygon);
    }
    return pieces;
}

std::vector<Polygon> jointed(double width, double height, Draw& draw)
{
    std::vector<Polygon> polygons{rectangle(0.0, 0.0, width, height)};
    const double first_deg = draw.between(-40.0, 60.0);
    for (const double dip_deg : {first_deg, first_deg + draw.between(60.0, 110.0)})
    {
        const Vec2 along = direction(dip_deg);
        const double spacing = draw.between(0.25, 0.5) * std::min(width, height);
        for (double at = -width - height + spacing * draw.between(0.0, 1.0); at < width + height; at += spacing)
            polygons = cut(polygons, at * turned_left(along), direction(dip_deg + draw.between(-3.0, 3.0)), 0.02 * width * height);
    }
    return polygons;
}

void judge_by_limit_analysis(Scene& scene)
{
    const std::vector<Body> bodies = bodies_of(scene);
    const std::vector<TouchingPoint> points = touching_at_start(scene, bodies);
    const Strength strength{std::tan(radians(joint(scene).friction_angle_deg)), joint(scene).cohesion};
    const double factor = strength_factor(bodies, points, strength, scene.def.gravity);
    scene.what += fmt::format(", strength factor {:.3g}", factor);
    scene.end = End::open;
    scene.same_in_twin = false;
    if (factor < 0.95)
    {
        scene.someone_moves = true;
        scene.least_way = 0.05 * least_size(scene);
        return;
    }
    const Strength reduced{strength.friction / 1.5, strength.cohesion / 1.5};
    for (const double tilt : {-3.0, 0.0, 3.0})
        if (least_unbalance(bodies, points, reduced, g * direction(tilt - 90.0)) > 1e-7)
            return;
    for (std::size_t i = 0; i < scene.fate.size(); ++i)
        scene.fate[i] = scene.is_fixed(i) ? Fate::open : Fate::stays;
    scene.end = End::rests;
    scene.same_in_twin = true;
    scene.same_settle = 0.5;
    scene.slow_run = 2.0;
}
}  // namespace

Scene rubble_scene(int number)
{
    Draw draw("rubble", number);
    Scene scene = new_scene("rubble", number);
    draw_stiffness(scene, draw);
    joint(scene).friction_angle_deg = draw.between(15.0, 50.0);
    const double width = draw.scale(1.0, 10.0), height = width * draw.between(0.6, 1.5);
    add_fixed(scene, "ground", rectangle(-10.0 * height, -height, 2.0 * width, 0.0));
    add_fixed(scene, "behind", rectangle(width, 0.0, 2.0 * width, height));
    for (const Polygon& polygon : jointed(width, height, draw))
        add_block(scene, fmt::format("b{}", scene.fate.size() - 1), polygon, Fate::open);
    joint(scene).cohesion = draw.chance(0.3) ? rock * g * height * draw.scale(0.01, 0.3) : 0.0;
    scene.what = fmt::format("{} blocks in {:.3g} x {:.3g} m, friction {:.3g}°, cohesion {:.2g} Pa", scene.fate.size() - 2, width,
                             height, joint(scene).friction_angle_deg, joint(scene).cohesion);
    scene.settle = rock * g * height / joint(scene).normal_stiffness * 10.0;
    scene.region = Box{{-10.0 * height, 0.0}, {width, height}};
    scene.stay = 0.01 * least_size(scene);
    judge_by_limit_analysis(scene);
    const double limit = stable_limit(scene, 4.0);
    draw_step(scene, draw, limit);
    scene.def.stages[0].max_cycles = 100000 + static_cast<std::int64_t>(10.0 * std::sqrt(height / g) / least_step(scene, limit));
    draw_placements(scene, draw);
    return scene;
}
}  // namespace hdem::verification::rest
