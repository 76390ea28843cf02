#include "verification/rest/falling.h"

#include "verification/rest/springs.h"

#include <fmt/format.h>

#include <cmath>

namespace hdem::verification::rest
{
namespace
{
/// Of all blocks in rows of cells above the ground.
struct Layout
{
    int count, columns;
    double radius, smallest, cell, low, half, high, wide;
};

Layout draw_layout(const FallingBlocks& kind, Draw& draw)
{
    Layout l{};
    l.count = draw.count(kind.blocks.first, kind.blocks.second);
    l.columns = draw.count(kind.columns.first, kind.columns.second);
    l.radius = draw.scale(0.05, 2.0);
    l.smallest = draw.between(0.3, 1.0);
    l.cell = 2.2 * l.radius;
    l.low = l.radius * draw.scale(0.01, 3.0);
    l.half = 0.5 * l.cell * l.columns + 0.1 * l.radius;
    l.high = l.low + l.cell * (l.count / l.columns + 1);
    l.wide = 20.0 * l.high;
    return l;
}
}  // namespace

Scene falling_scene(int number, const FallingBlocks& kind)
{
    Draw draw(kind.family, number);
    Scene scene = new_scene(kind.family, number);
    draw_stiffness(scene, draw);
    joint(scene).friction_angle_deg = draw.between(10.0, 45.0);
    const Layout l = draw_layout(kind, draw);
    const bool in_bin = draw.chance(0.5);
    add_fixed(scene, "ground", kind.draw_ground(l.wide, l.half, l.radius, draw));
    if (in_bin)
    {
        add_fixed(scene, "left", rectangle(-l.half - 4.0 * l.radius, 0.0, -l.half, l.high));
        add_fixed(scene, "right", rectangle(l.half, 0.0, l.half + 4.0 * l.radius, l.high));
    }
    for (int i = 0; i < l.count; ++i)
    {
        const Vec2 centre(l.cell * (i % l.columns - 0.5 * (l.columns - 1)), l.low + l.cell * (i / l.columns + 0.5));
        add_block(scene, fmt::format("b{}", i + 1), kind.draw_block(centre, l.radius * draw.scale(l.smallest, 1.0), draw),
                  Fate::open);
    }
    const double reach = in_bin ? l.half : l.wide;
    scene.region = Box{{-reach, -kind.hollow * l.radius}, {reach, l.high}};
    scene.settle = rock * g * l.radius * static_cast<double>(l.count) / l.columns / joint(scene).normal_stiffness;
    scene.same_in_twin = false;
    scene.what = fmt::format("{} blocks of up to {:.3g} m{} fall {}, friction {:.3g}°", l.count, 2.0 * l.radius, kind.kind,
                             in_bin ? "into a bin" : "on the ground", joint(scene).friction_angle_deg);
    const double limit = stable_limit(scene, kind.landings);
    draw_step(scene, draw, limit);
    scene.def.stages[0].max_cycles = 100000 + static_cast<std::int64_t>(20.0 * std::sqrt(l.high / g) / least_step(scene, limit));
    draw_placements(scene, draw);
    return scene;
}
}  // namespace hdem::verification::rest
