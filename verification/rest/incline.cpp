/// One block on an inclined plane: stays, slides for ever, slides against a wall, is thrown and stopped by friction, topples.
///
///   factor of safety against sliding   F = (W cos(beta) tan(phi) + c L) / (W sin(beta))
///   against toppling                   F_t = L / (h tan(beta))               L base, h height of the block
///
/// rest.tiles: the same on a plane of many blocks. Their joints end in the plane, which may have steps there, far below the settlement of the block.

#include "verification/rest/families.h"
#include "verification/rest/springs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hdem::verification::rest
{
namespace
{
struct Incline
{
    double beta_deg = 0.0;
    double base = 0.0;         ///< L [m]
    double height = 0.0;       ///< h [m]
    double factor = 1.0;       ///< F
    double by_cohesion = 0.0;  ///< share of the strength that is cohesion
    [[nodiscard]] double weight() const { return rock * base * height * g; }
    [[nodiscard]] double beta() const { return radians(beta_deg); }
    [[nodiscard]] Vec2 down() const { return direction(-beta_deg); }
    /// Of a block that slides, down the plane [m/s2].
    [[nodiscard]] double acceleration() const { return (1.0 - factor) * g * std::sin(beta()); }
};

Scene build(const Incline& incline, int number, Draw& draw)
{
    Scene scene = new_scene("incline", number);
    draw_stiffness(scene, draw);
    const double strength = incline.factor * incline.weight() * std::sin(incline.beta());
    joint(scene).friction_angle_deg = std::atan((1.0 - incline.by_cohesion) * incline.factor * std::tan(incline.beta())) /
                                      radians(1.0);
    joint(scene).cohesion = incline.by_cohesion * strength / incline.base;
    const Vec2 down = incline.down();
    add_fixed(scene, "plane",
              rectangle_along(-50.0 * incline.base * down - 2.0 * incline.base * turned_left(down), down, 450.0 * incline.base,
                              2.0 * incline.base));
    add_block(scene, "block", rectangle_along({0.0, 0.0}, down, incline.base, incline.height), Fate::open);
    const double length = incline.base;
    scene.settle = incline.weight() / length *
                   (std::cos(incline.beta()) / joint(scene).normal_stiffness +
                    std::sin(incline.beta()) / joint(scene).shear_stiffness);
    scene.what = fmt::format("{:.3g} x {:.3g} m on {:.4g}°, F = {:.4g}, {:.2g} of it cohesion", incline.base, incline.height,
                             incline.beta_deg, incline.factor, incline.by_cohesion);
    return scene;
}

/// The block swings on the joint's springs as it is set down, which may take it beyond its strength: speeds up to (g sin(beta) u_s)^1/2, u_s how far the shear springs give way,
/// and F - 1 stops it within u_s / (2 (F - 1)).
double stay_bar(double settle, double factor)
{
    return settle * (5.0 + 1.0 / (factor - 1.0));
}

void set_stays(Scene& scene, double factor)
{
    scene.fate[1] = Fate::stays;
    scene.stay = stay_bar(scene.settle, factor);
    scene.def.stages[0].max_cycles = 60000;
}

/// Cycles in which a block slides so far, at a fifth of its acceleration: local damping of 0.8 may act on it.
double cycles_to_slide(const Incline& incline, double way, double step)
{
    return std::sqrt(2.0 * way / (0.2 * incline.acceleration())) / step;
}

void set_endless(Scene& scene, const Incline& incline, double step)
{
    const double to_the_end = std::sqrt(2.0 * 300.0 * incline.base / incline.acceleration()) / step;  // of the plane, undamped
    const auto cycles = static_cast<std::int64_t>(std::min(40000.0, to_the_end));
    const double slow_way = 0.5 * 0.2 * incline.acceleration() * std::pow(static_cast<double>(cycles) * step, 2);
    scene.fate[1] = Fate::moves;
    scene.end = End::never;
    scene.least_way = std::min(0.5 * incline.base, 0.25 * slow_way);
    scene.def.stages[0].max_cycles = cycles;
    scene.what += ", endless plane";
}

/// A given step that bears the springs of a second face, too.
void bear_wall(Scene& scene, double share)
{
    if (scene.def.time.step)
        scene.def.time.step = std::min(*scene.def.time.step, share * stable_limit(scene, 1.0));
}

void set_wall(Scene& scene, const Incline& incline, Draw& draw, double step)
{
    constexpr double most_cycles = 200000;
    const double reach = 0.1 * incline.acceleration() * std::pow(0.3 * most_cycles * step, 2);
    const double way = std::min(incline.base * draw.between(0.2, 3.0), reach);
    const Vec2 down = incline.down();
    add_fixed(scene, "wall", rectangle_along((incline.base + way) * down, down, incline.base, 1.5 * incline.height));
    scene.fate[1] = Fate::moves;
    scene.least_way = 0.9 * way;
    scene.places.push_back({1, area_moments(scene.def.blocks[1].polygon).centroid + way * down,
                            1e-3 * std::max(incline.base, incline.height) + 10.0 * scene.settle});
    scene.def.stages[0].max_cycles = 20000 + static_cast<std::int64_t>(3.0 * cycles_to_slide(incline, way, step));
    scene.what += fmt::format(", a wall after {:.3g} m", way);
}

/// Up or down the plane at v, stopped after v^2 / (2 a): less where local damping helps, more by what it goes until the joint's normal springs bear, within
/// (u / g)^1/2 or two.
void set_thrown(Scene& scene, const Incline& incline, Draw& draw)
{
    const double speed = draw.scale(0.1, 3.0);
    const bool up = draw.chance(0.5);
    const double braking = g * std::sin(incline.beta()) * (up ? incline.factor + 1.0 : incline.factor - 1.0);
    scene.def.blocks[1].velocity = (up ? -speed : speed) * incline.down();
    scene.most_ways.push_back({1, 1.02 * speed * speed / (2.0 * braking) + 2.0 * speed * std::sqrt(scene.settle / g) +
                                      stay_bar(scene.settle, incline.factor)});
    scene.def.stages[0].max_cycles = 200000;
    scene.what += fmt::format(", thrown {} at {:.3g} m/s", up ? "up" : "down", speed);
}

Scene toppling_scene(int number, Draw& draw)
{
    constexpr std::array<double, 6> factors{1.25, 1.1, 1.05, 0.95, 0.85, 0.7};
    const double topple = draw.one_of(factors);
    Incline incline{.beta_deg = draw.between(10.0, 35.0), .base = draw.scale(0.1, 10.0), .factor = 2.0};
    incline.height = incline.base / (topple * std::tan(incline.beta()));
    Scene scene = build(incline, number, draw);
    const double limit = stable_limit(scene);
    draw_step(scene, draw, limit);
    scene.what += fmt::format(", F = {:.4g} against toppling", topple);
    scene.settle *= 1.0 + incline.height / incline.base;
    if (topple > 1.0)
    {
        set_stays(scene, topple);
        return scene;
    }
    scene.fate[1] = Fate::moves;
    scene.least_way = 0.2 * incline.base;
    scene.end = End::open;
    scene.same_in_twin = false;
    const double slow_fall = 3.0 * std::sqrt(incline.height / g / 0.2) * (1.0 + 1.0 / std::sqrt(1.0 / topple - 1.0));
    scene.def.stages[0].max_cycles = 20000 + static_cast<std::int64_t>(slow_fall / least_step(scene, limit));
    return scene;
}

enum class Ground
{
    plane,
    tiles
};

Scene sliding_scene(int number, Draw& draw, Ground ground, Incline& incline)
{
    constexpr std::array<double, 10> factors{0.5, 0.8, 0.95, 0.99, 1.01, 1.02, 1.05, 1.3, 2.0, 4.0};
    incline = {.beta_deg = draw.between(3.0, 60.0), .base = draw.scale(0.1, 10.0), .factor = draw.one_of(factors)};
    incline.height = incline.base * std::min(draw.scale(0.2, 3.0), 0.7 / std::tan(incline.beta()));
    incline.by_cohesion = draw.chance(0.5) ? 0.0 : draw.between(0.1, 0.9);
    if (ground == Ground::tiles && 3.0 * incline.height * std::tan(incline.beta()) > 0.9 * incline.base)
        incline.by_cohesion = 0.0;  // the upper end of the base opens, and a joint that has opened as a whole has no cohesion
    const bool thrown = incline.factor > 1.2 && draw.chance(0.3);
    if (thrown)
    {
        incline.by_cohesion = 0.0;
        incline.height = std::min(incline.height, 0.7 * incline.base / (incline.factor * std::tan(incline.beta())));
    }
    Scene scene = build(incline, number, draw);
    const double share = ground == Ground::tiles ? 0.8 : 1.0;  // short contacts are stiffer
    const double limit = share * stable_limit(scene);
    draw_step(scene, draw, limit);
    if (thrown)
        set_thrown(scene, incline, draw);
    else if (incline.factor > 1.0)
        set_stays(scene, incline.factor);
    else if (draw.chance(0.5))
        set_endless(scene, incline, least_step(scene, limit));
    else
    {
        bear_wall(scene, 0.95 * share);
        set_wall(scene, incline, draw, least_step(scene, limit));
    }
    return scene;
}

/// Cut the plane below and in front of the block into tiles. In a third of the scenes the block's lower corner lies above a joint.
void lay_tiles(Scene& scene, const Incline& incline, Draw& draw)
{
    constexpr double reach = 12.0;  // of the bases below which the plane is of tiles
    const Vec2 down = incline.down();
    const bool has_steps = incline.by_cohesion == 0.0 && draw.chance(0.5);
    const double length = draw.scale(0.3, 3.0), depth = draw.scale(0.3, 3.0), base = incline.base;
    const double first = draw.chance(1.0 / 3.0) ? 1.0 : draw.between(0.0, length);
    double from = -50.0;
    const double begin = first - length * std::ceil((first + reach) / length);
    const auto wall = std::ranges::find(scene.def.blocks, "wall", &BlockDef::name);
    const double wall_at = wall == scene.def.blocks.end() ? 400.0 : wall->polygon.front().dot(down) / base;
    for (int tile = 0; from < 400.0; ++tile)
    {
        const double joint_at = begin + length * tile, until = joint_at > reach ? 400.0 : joint_at;
        const bool is_below = (from < 1.0 && until > 0.0) || until > wall_at;  // block or wall, which must not overlap it as drawn
        const double step = has_steps ? draw.scale(1e-12 * base, 0.1 * scene.settle) * (draw.chance(0.5) && !is_below ? 1.0 : -1.0)
                                      : 0.0;
        const Polygon polygon = rectangle_along(from * base * down - (depth * base - step) * turned_left(down), down,
                                                (until - from) * base, depth * base);
        if (tile == 0)
            scene.def.blocks[0].polygon = polygon;
        else
            add_fixed(scene, fmt::format("tile{}", tile), polygon);
        from = until;
    }
    scene.what += fmt::format(", tiles of {:.3g} x {:.3g} m{}", length * base, depth * base, has_steps ? " with steps" : "");
}
}  // namespace

Scene tiles_scene(int number)
{
    Draw draw("tiles", number);
    Incline incline;
    Scene scene = sliding_scene(number, draw, Ground::tiles, incline);
    scene.family = "tiles";
    scene.same_settle = 0.4;  // more joints than one
    lay_tiles(scene, incline, draw);
    draw_placements(scene, draw);
    return scene;
}

Scene incline_scene(int number)
{
    Draw draw("incline", number);
    Incline incline;
    Scene scene = draw.chance(0.15) ? toppling_scene(number, draw) : sliding_scene(number, draw, Ground::plane, incline);
    draw_placements(scene, draw);
    return scene;
}
}  // namespace hdem::verification::rest
