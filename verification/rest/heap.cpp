/// Many blocks that fall into a heap: which way each one goes is chance, but they come to rest, on each other and on the ground.

#include "verification/rest/families.h"
#include "verification/rest/springs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hdem::verification::rest
{
namespace
{
/// Convex, its corners on an ellipse, none of its sides very short.
Polygon draw_polygon(const Vec2& centre, double radius, Draw& draw)
{
    const int corners = draw.count(3, 7);
    const double flat = draw.between(0.5, 1.0);
    const Placement turn = turned_by(draw.between(0.0, 360.0));
    Polygon polygon;
    for (int i = 0; i < corners; ++i)
    {
        const double angle = 360.0 / corners * (i + draw.between(-0.3, 0.3));
        const Vec2 on_circle = radius * direction(angle);
        polygon.push_back(centre + turn.turned({on_circle.x(), flat * on_circle.y()}));
    }
    return polygon;
}
}  // namespace

Scene heap_scene(int number)
{
    Draw draw("heap", number);
    Scene scene = new_scene("heap", number);
    draw_stiffness(scene, draw);
    joint(scene).friction_angle_deg = draw.between(10.0, 45.0);
    const int count = draw.count(5, 30), columns = draw.count(1, 5);
    const double radius = draw.scale(0.05, 2.0), smallest = draw.between(0.3, 1.0), cell = 2.2 * radius;
    const double low = radius * draw.scale(0.01, 3.0);
    const bool in_bin = draw.chance(0.5);
    const double half = 0.5 * cell * columns + 0.1 * radius;
    const double high = low + cell * (count / columns + 1);
    const double wide = 20.0 * high;
    add_fixed(scene, "ground", rectangle(-wide, -4.0 * radius, wide, 0.0));
    if (in_bin)
    {
        add_fixed(scene, "left", rectangle(-half - 4.0 * radius, 0.0, -half, high));
        add_fixed(scene, "right", rectangle(half, 0.0, half + 4.0 * radius, high));
    }
    for (int i = 0; i < count; ++i)
    {
        const Vec2 centre(cell * (i % columns - 0.5 * (columns - 1)), low + cell * (i / columns + 0.5));
        add_block(scene, fmt::format("b{}", i + 1), draw_polygon(centre, radius * draw.scale(smallest, 1.0), draw), Fate::open);
    }
    const double reach = in_bin ? half : wide;
    scene.region = Box{{-reach, 0.0}, {reach, high}};
    scene.settle = rock * g * radius * static_cast<double>(count) / columns / joint(scene).normal_stiffness;
    scene.same_in_twin = false;
    scene.what = fmt::format("{} blocks of up to {:.3g} m fall {}, friction {:.3g}°", count, 2.0 * radius,
                             in_bin ? "into a bin" : "on the ground", joint(scene).friction_angle_deg);
    const double limit = stable_limit(scene, 4.0);
    draw_step(scene, draw, limit);
    scene.def.stages[0].max_cycles = 100000 + static_cast<std::int64_t>(20.0 * std::sqrt(high / g) / least_step(scene, limit));
    draw_placements(scene, draw);
    return scene;
}
}  // namespace hdem::verification::rest
