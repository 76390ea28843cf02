#include "perf/bench_scenes.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hdem::perf
{
namespace
{
void add_side(CaseDef& def, const std::string& name, double left, double right, double height)
{
    scenes::add_fixed_block(def, name, scenes::rectangle({left, 0.0}, {right, height}));
}

/// Fixed sides of a running-bond wall, and half bricks there, so that its head joints stay closed.
void close_sides(CaseDef& def, int courses, double width, double half_brick)
{
    add_side(def, "left", -1.0, 0.0, courses);
    add_side(def, "right", width, width + 1.0, courses);
    for (int c = 0; c < courses; ++c)
    {
        const double left = c % 2 == 0 ? width - half_brick : 0.0;
        scenes::add_fixed_block(def, "half" + std::to_string(c + 1), scenes::rectangle({left, c}, {left + half_brick, c + 1.0}));
    }
}

CaseDef wall_between_sides(int courses, int bricks)
{
    CaseDef def = scenes::wall(courses, bricks);
    close_sides(def, courses, 2.0 * bricks + 1.0, 1.0);
    return def;
}

/// The same with rough joints. Its normal springs are those of the wall, so that all joints are closed alike.
CaseDef rough_wall(int courses, int bricks)
{
    CaseDef def = wall_between_sides(courses, bricks);
    JointDef& joint = def.joints.front();
    joint.law = JointLaw::barton_bandis;
    joint.jrc = 10.0;
    joint.jcs = 1e8;
    joint.residual_friction_angle_deg = joint.friction_angle_deg;
    joint.friction_angle_deg = 0.0;
    return def;
}

/// Bricks 3 m x 1 m, also with half a brick of offset.
CaseDef long_bricks(int courses, int bricks)
{
    const double length = 3.0, width = length * (bricks + 0.5);
    CaseDef def = scenes::empty_scene();
    scenes::add_fixed_block(def, "ground", scenes::rectangle({-1.0, -1.0}, {width + 1.0, 0.0}));
    for (int c = 0; c < courses; ++c)
        for (int k = 0; k < bricks; ++k)
        {
            const double left = length * (k + 0.5 * (c % 2));
            scenes::add_block(def, std::to_string(c + 1) + "." + std::to_string(k + 1),
                              scenes::rectangle({left, c}, {left + length, c + 1.0}));
        }
    close_sides(def, courses, width, 0.5 * length);
    return def;
}

/// Regular hexagons of 1 m2 that stand on a corner; those at the sides and at the bottom are fixed.
CaseDef hexagons(int columns, int rows)
{
    const double radius = std::sqrt(2.0 / (3.0 * std::sqrt(3.0)));
    const double half_width = 0.5 * std::sqrt(3.0) * radius, half_radius = 0.5 * radius;
    CaseDef def = scenes::empty_scene();
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
        {
            // Corners on one grid, so that neighbours have the same ones to the bit.
            const auto corner = [&](int across, int up)
            { return Vec2((2 * c + r % 2 + across) * half_width, (3 * r + up) * half_radius); };
            const Polygon cell{corner(1, 0), corner(2, 1), corner(2, 3), corner(1, 4), corner(0, 3), corner(0, 1)};
            const std::string name = std::to_string(c + 1) + "." + std::to_string(r + 1);
            const bool at_side = c == 0 || c + 1 == columns || r == 0;
            at_side ? scenes::add_fixed_block(def, name, cell) : scenes::add_block(def, name, cell);
        }
    return def;
}

/// Joint sets neither level nor upright.
CaseDef dips(double width, double height)
{
    CaseDef def = scenes::joints(width, height, 1.0, 3.0);
    def.joint_sets[0].dip_deg = 35.0;
    def.joint_sets[1].dip_deg = -40.0;
    return def;
}
}  // namespace

CaseDef make_scene(const std::string& scene, Index blocks, Method method)
{
    const auto side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(blocks))));
    CaseDef def;
    if (scene == "wall")
        def = wall_between_sides(side, side);
    else if (scene == "rough_wall")
        def = rough_wall(side, side);
    else if (scene == "voronoi")
        def = scenes::voronoi(side, side);
    else if (scene == "joints")
        def = scenes::joints(side, side, 1.0, 3.0);
    else if (scene == "hexagons")
        def = hexagons(side, side);
    else if (scene == "long_bricks")
        def = long_bricks(side, side);
    else if (scene == "dips")
        def = dips(side, side);
    else
        throw std::invalid_argument("no scene \"" + scene + "\"");
    def.contact.method = method;
    // The stress at the foot is that of 100 m of rock, whatever the size: what changes from size to size is the size.
    def.gravity *= std::min(1.0, 100.0 / side);
    return def;
}
}  // namespace hdem::perf
