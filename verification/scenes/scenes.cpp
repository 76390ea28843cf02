#include "verification/scenes/scenes.h"

#include "core/geometry/unit_direction.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace hdem::scenes
{
namespace
{
/// In [0, 1), the same on every platform; standard distributions are not.
double uniform(std::mt19937_64& engine)
{
    return std::ldexp(static_cast<double>(engine() >> 11), -53);
}

/// What of a convex polygon lies nearer to `here` than to `there`.
Polygon nearer_part(const Polygon& polygon, const Vec2& here, const Vec2& there)
{
    const Vec2 direction = there - here;
    const Vec2 middle = 0.5 * (here + there);
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        const Vec2& p = polygon[i];
        const Vec2& q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
        const double side_p = direction.dot(p - middle);
        const double side_q = direction.dot(q - middle);
        if (side_p <= 0.0)
            kept.push_back(p);
        if ((side_p < 0.0 && side_q > 0.0) || (side_p > 0.0 && side_q < 0.0))
            kept.push_back(p + side_p / (side_p - side_q) * (q - p));
    }
    return kept;
}

template <typename Change>
void change_vectors(CaseDef& scene, const Change& direction)
{
    scene.gravity = direction(scene.gravity);
    for (BlockDef& block : scene.blocks)
        block.velocity = direction(block.velocity);
    for (LoadDef& load : scene.loads)
    {
        load.acceleration = direction(load.acceleration);
        load.force = direction(load.force);
        if (load.point)
            load.point = direction(*load.point);  // turned and mirrored about the origin
    }
}
}  // namespace

CaseDef empty_scene(std::int64_t cycles)
{
    CaseDef scene;
    scene.materials = {{.name = "rock", .density = 2700.0}};
    scene.joints = {{.name = "default", .normal_stiffness = 7e9, .shear_stiffness = 5e8, .friction_angle_deg = 30.0}};
    scene.stages = {{.name = "run", .cycles = cycles}};
    return scene;
}

Polygon rectangle(const Vec2& low, const Vec2& high)
{
    return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

BlockDef& add_block(CaseDef& scene, const std::string& name, const Polygon& polygon)
{
    scene.blocks.push_back({.name = name, .polygon = polygon});
    return scene.blocks.back();
}

BlockDef& add_fixed_block(CaseDef& scene, const std::string& name, const Polygon& polygon)
{
    BlockDef& block = add_block(scene, name, polygon);
    block.fix_x = block.fix_y = block.fix_rotation = true;
    return block;
}

CaseDef block_on_ground(double width, double height)
{
    CaseDef scene = empty_scene();
    add_fixed_block(scene, "ground", rectangle({-2.0 * width, -1.0}, {2.0 * width, 0.0}));
    add_block(scene, "block", rectangle({-0.5 * width, 0.0}, {0.5 * width, height}));
    return scene;
}

CaseDef stack(int n)
{
    CaseDef scene = empty_scene();
    add_fixed_block(scene, "ground", rectangle({-2.0, -1.0}, {2.0, 0.0}));
    for (int i = 0; i < n; ++i)
        add_block(scene, "block" + std::to_string(i + 1), rectangle({-0.5, i}, {0.5, i + 1.0}));
    return scene;
}

CaseDef wall(int courses, int bricks_per_course)
{
    CaseDef scene = empty_scene();
    add_fixed_block(scene, "ground", rectangle({-2.0, -1.0}, {2.0 * bricks_per_course + 3.0, 0.0}));
    for (int c = 0; c < courses; ++c)
        for (int k = 0; k < bricks_per_course; ++k)
        {
            const double left = 2.0 * k + c % 2;
            add_block(scene, std::to_string(c + 1) + "." + std::to_string(k + 1), rectangle({left, c}, {left + 2.0, c + 1.0}));
        }
    return scene;
}

CaseDef grid(int columns, int rows)
{
    CaseDef scene = empty_scene();
    add_fixed_block(scene, "ground", rectangle({-1.0, -1.0}, {columns + 1.0, 0.0}));
    add_fixed_block(scene, "left", rectangle({-1.0, 0.0}, {0.0, rows}));
    add_fixed_block(scene, "right", rectangle({columns, 0.0}, {columns + 1.0, rows}));
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
            add_block(scene, std::to_string(c + 1) + "." + std::to_string(r + 1), rectangle({c, r}, {c + 1.0, r + 1.0}));
    return scene;
}

CaseDef pile(int n, int columns, std::uint64_t seed)
{
    constexpr double pitch = 1.25;  // blocks reach 0.6 m from their centres
    CaseDef scene = empty_scene();
    const int rows = (n + columns - 1) / columns;
    const double width = pitch * columns;
    const double height = pitch * rows;
    add_fixed_block(scene, "ground", rectangle({-1.0, -1.0}, {width + 1.0, 0.0}));
    add_fixed_block(scene, "left", rectangle({-1.0, 0.0}, {0.0, height}));
    add_fixed_block(scene, "right", rectangle({width, 0.0}, {width + 1.0, height}));
    std::mt19937_64 engine(seed);
    for (int i = 0; i < n; ++i)
    {
        const Vec2 centre(pitch * (i % columns + 0.5), pitch * (i / columns + 0.5));
        const int corners = 4 + static_cast<int>(3.0 * uniform(engine));
        const double radius = 0.4 + 0.2 * uniform(engine);
        const double start = 360.0 * uniform(engine);
        Polygon polygon;  // corners on a circle, hence convex; none near the next
        for (int k = 0; k < corners; ++k)
            polygon.push_back(centre + radius * unit_direction(start + 360.0 / corners * (k + 0.5 * uniform(engine))));
        add_block(scene, "block" + std::to_string(i + 1), polygon);
    }
    return scene;
}

CaseDef voronoi(int columns, int rows, std::uint64_t seed)
{
    CaseDef scene = empty_scene();
    std::mt19937_64 engine(seed);
    std::vector<Vec2> points;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
        {
            // A distance of 0.2 m between points keeps slivers away.
            const double x = c + 0.1 + 0.8 * uniform(engine);
            points.emplace_back(x, r + 0.1 + 0.8 * uniform(engine));
        }
    // A circle without points holds no whole unit square, so its radius is below sqrt(2): neighbours are within three squares.
    constexpr int reach = 3;
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
        {
            Polygon cell = rectangle({0.0, 0.0}, {columns, rows});
            for (int s = std::max(0, r - reach); s <= std::min(rows - 1, r + reach); ++s)
                for (int d = std::max(0, c - reach); d <= std::min(columns - 1, c + reach); ++d)
                    if (s != r || d != c)
                        cell = nearer_part(cell, points[r * columns + c], points[s * columns + d]);
            const std::string name = std::to_string(c + 1) + "." + std::to_string(r + 1);
            const bool at_side = std::any_of(cell.begin(), cell.end(),
                                             [&](const Vec2& p) { return p.x() == 0.0 || p.x() == columns || p.y() == 0.0; });
            at_side ? add_fixed_block(scene, name, cell) : add_block(scene, name, cell);
        }
    return scene;
}

CaseDef joints(double width, double height, double spacing, double deviation_deg)
{
    CaseDef scene = empty_scene();
    scene.domain = {.given = true, .width = width, .height = height, .fixed = {"left", "right", "bottom"}};
    scene.joint_sets = {{.name = "flat", .dip_deg = 10.0, .spacing = spacing, .deviation_deg = deviation_deg},
                        {.name = "steep", .dip_deg = -80.0, .spacing = spacing, .deviation_deg = deviation_deg}};
    scene.generator.smallest_block_area = 0.05 * spacing * spacing;
    scene.generator.smallest_edge = 0.05 * spacing;
    return scene;
}

CaseDef three_joint_sets(double spacing, double friction_angle_deg, double cohesion)
{
    CaseDef scene = empty_scene();
    scene.domain = {.given = true, .width = 35.0, .height = 33.0, .fixed = {"left", "right", "bottom"}};
    scene.joint_sets = {{.name = "inclined", .dip_deg = 25.0, .spacing = spacing, .deviation_deg = 2.0},
                        {.name = "steep", .dip_deg = 75.0, .spacing = 2.0 * spacing, .deviation_deg = 2.0},
                        {.name = "steep_back", .dip_deg = -55.0, .spacing = spacing, .deviation_deg = 2.0}};
    scene.generator.seed = 10;
    scene.generator.smallest_block_area = 0.12 * spacing * spacing;
    scene.joints[0].friction_angle_deg = friction_angle_deg;
    scene.joints[0].cohesion = cohesion;
    return scene;
}

CaseDef turned(CaseDef scene, double angle_deg)
{
    const Vec2 d = unit_direction(angle_deg);
    const auto turn = [&](const Vec2& v) { return Vec2(v.x() * d + v.y() * turned_left(d)); };
    for (BlockDef& block : scene.blocks)
        for (Vec2& p : block.polygon)
            p = turn(p);
    change_vectors(scene, turn);
    return scene;
}

CaseDef mirrored(CaseDef scene)
{
    const auto mirror = [](const Vec2& v) { return Vec2(-v.x(), v.y()); };
    for (BlockDef& block : scene.blocks)
    {
        for (Vec2& p : block.polygon)
            p = mirror(p);
        block.angular_velocity = -block.angular_velocity;
    }
    for (LoadDef& load : scene.loads)
        load.moment = -load.moment;
    change_vectors(scene, mirror);
    return scene;
}

CaseDef moved(CaseDef scene, const Vec2& by)
{
    for (BlockDef& block : scene.blocks)
        for (Vec2& p : block.polygon)
            p += by;
    for (LoadDef& load : scene.loads)
        if (load.point)
            *load.point += by;
    return scene;
}
}  // namespace hdem::scenes
