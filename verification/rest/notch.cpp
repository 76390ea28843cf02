/// A block in a notch of two planes, and a plug between walls that close in: normals alone hold them, at any friction. A block in a shaft: nothing does.
///
/// Where forces across the faces alone balance the weight, no motion that the faces allow lets the block sink: without friction normality holds,
/// and both theorems of limit analysis apply. Friction only resists besides.

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
/// Do normals alone hold the blocks, with gravity turned by up to two degrees either way?
bool stands_without_friction(const Scene& scene)
{
    const std::vector<Body> bodies = bodies_of(scene);
    const std::vector<TouchingPoint> points = touching_at_start(scene, bodies);
    for (const double tilt : {-2.0, 2.0})
        if (least_unbalance(bodies, points, {}, g * direction(tilt - 90.0)) > 1e-7)
            return false;
    return true;
}

/// A parallelogram whose lower corner fills the notch.
void add_corner_block(Scene& scene, Draw& draw)
{
    const double size = draw.scale(0.1, 10.0);
    const double left_deg = draw.between(20.0, 70.0), right_deg = draw.between(20.0, 70.0);
    const double a = size * draw.between(0.5, 1.5), b = size * draw.between(0.5, 1.5);
    const Vec2 left = direction(180.0 - left_deg), right = direction(right_deg);
    add_fixed(scene, "left", rectangle_along({0.0, 0.0}, left, 5.0 * size, 2.0 * size));
    add_fixed(scene, "right", rectangle_along(5.0 * size * right, -right, 5.0 * size, 2.0 * size));
    add_block(scene, "block", {{0.0, 0.0}, b * right, b * right + a * left, a * left}, Fate::stays);
    scene.what = fmt::format("{:.3g} x {:.3g} m between planes of {:.3g} and {:.3g}°", a, b, left_deg, right_deg);
}

/// A trapezium between two walls.
void add_plug(Scene& scene, Draw& draw)
{
    const double width = draw.scale(0.1, 10.0), height = width * draw.between(0.3, 1.5);
    const double half_deg = draw.between(3.0, 40.0);
    const double wider = height * std::tan(radians(half_deg));
    const double long_wall = 3.0 * height / std::cos(radians(half_deg));
    const double below = std::min(0.3 * long_wall, 0.3 * width / std::sin(radians(half_deg)));  // the walls do not meet
    const Vec2 left = direction(90.0 + half_deg), right = direction(90.0 - half_deg);
    const Vec2 low_left(-0.5 * width, 0.0), low_right(0.5 * width, 0.0);
    add_fixed(scene, "left", rectangle_along(low_left - below * left, left, long_wall, width));
    add_fixed(scene, "right", rectangle_along(low_right + (long_wall - below) * right, -right, long_wall, width));
    add_block(scene, "plug", {low_left, low_right, low_right + Vec2(wider, height), low_left + Vec2(-wider, height)}, Fate::stays);
    scene.what = fmt::format("plug of {:.3g} x {:.3g} m between walls at {:.3g}°", width, height, half_deg);
}
/// A block that fits between vertical walls without friction, and hangs on their cohesion: 2 c h < W, so that it slides down to the ground.
Scene shaft_scene(int number, Draw& draw)
{
    Scene scene = new_scene("notch", number);
    draw_stiffness(scene, draw);
    const double width = draw.scale(0.1, 10.0), height = width * draw.between(0.5, 1.5), depth = height * draw.between(0.1, 1.0);
    const double share = draw.between(0.0, 0.9);
    add_fixed(scene, "ground", rectangle(-2.0 * width, -width, 2.0 * width, 0.0));
    add_fixed(scene, "left", rectangle(-2.0 * width, 0.0, -0.5 * width, 4.0 * height));
    add_fixed(scene, "right", rectangle(0.5 * width, 0.0, 2.0 * width, 4.0 * height));
    const std::size_t block = add_block(scene, "block", rectangle(-0.5 * width, depth, 0.5 * width, depth + height), Fate::moves);
    joint(scene)
        .friction_angle_deg = 0.0;  // with friction, forces across the walls that hold each other would hold the block as well
    joint(scene).cohesion = share * rock * g * width / 2.0;
    scene.settle = rock * g * height / joint(scene).normal_stiffness;
    scene.least_way = 0.9 * depth;
    scene.places.push_back({block, {0.0, 0.5 * height}, 1e-3 * std::max(width, height) + 10.0 * scene.settle});
    const double limit = stable_limit(scene, 1.0);
    draw_step(scene, draw, limit);
    const double slide = std::sqrt(2.0 * depth / (0.2 * (1.0 - share) * g));
    scene.def.stages[0].max_cycles = 60000 + static_cast<std::int64_t>(3.0 * slide / least_step(scene, limit));
    scene.what = fmt::format("{:.3g} x {:.3g} m in a shaft, {:.2g} of its weight held by cohesion", width, height, share);
    draw_placements(scene, draw);
    return scene;
}
}  // namespace

Scene notch_scene(int number)
{
    Draw draw("notch", number);
    if (draw.chance(0.2))
        return shaft_scene(number, draw);
    Scene scene = new_scene("notch", number);
    draw_stiffness(scene, draw);
    const bool plug = draw.chance(0.4);
    plug ? add_plug(scene, draw) : add_corner_block(scene, draw);
    joint(scene).friction_angle_deg = draw.between(0.0, 45.0);
    joint(scene).cohesion = draw.chance(0.3) ? draw.scale(1e2, 1e5) : 0.0;
    scene.what += fmt::format(", friction {:.3g}°, cohesion {:.2g} Pa", joint(scene).friction_angle_deg, joint(scene).cohesion);
    scene.settle = elastic_settle(scene);
    scene.stay = 20.0 * scene.settle;
    if (!stands_without_friction(scene))
    {
        scene.fate.back() = Fate::open;
        scene.end = End::open;
        scene.same_in_twin = false;
        scene.what += ", may tip";
        scene.settle = scene.stay = rock * g * area_moments(scene.def.blocks.back().polygon).area / joint(scene).normal_stiffness /
                                    least_size(scene);
    }
    draw_step(scene, draw, stable_limit(scene));
    scene.def.stages[0].max_cycles = 60000;
    draw_placements(scene, draw);
    return scene;
}
}  // namespace hdem::verification::rest
