/// Blocks with hollow corners, arms and spikes that fall onto each other: which way each one goes is chance, but they get no energy from anywhere, and come to rest.

#include "verification/rest/falling.h"
#include "verification/rest/families.h"

#include <algorithm>
#include <array>
#include <functional>

namespace hdem::verification::rest
{
namespace
{
Polygon angle_shape(Draw& draw)
{
    const double foot = draw.between(0.2, 0.5), post = draw.between(0.2, 0.5);
    return {{0.0, 0.0}, {1.0, 0.0}, {1.0, foot}, {post, foot}, {post, 1.0}, {0.0, 1.0}};
}

Polygon tee_shape(Draw& draw)
{
    const double half = draw.between(0.1, 0.25), low = draw.between(0.4, 0.75);
    return {{-half, 0.0}, {half, 0.0}, {half, low}, {0.5, low}, {0.5, 1.0}, {-0.5, 1.0}, {-0.5, low}, {-half, low}};
}

Polygon channel_shape(Draw& draw)
{
    const double left = draw.between(0.2, 0.35), right = 1.0 - draw.between(0.2, 0.35), foot = draw.between(0.2, 0.5);
    return {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {right, 1.0}, {right, foot}, {left, foot}, {left, 1.0}, {0.0, 1.0}};
}

/// Corners far from the middle and near to it in turn.
Polygon star_shape(Draw& draw)
{
    const int points = draw.count(3, 6);
    const double inner = draw.between(0.4, 0.7);
    Polygon polygon;
    for (int i = 0; i < 2 * points; ++i)
        polygon.push_back((i % 2 == 0 ? 1.0 : inner) * direction(180.0 / points * (i + draw.between(-0.2, 0.2))));
    return polygon;
}

Polygon random_shape(Draw& draw)
{
    const int corners = draw.count(5, 9);
    Polygon polygon;
    for (int i = 0; i < corners; ++i)
        polygon.push_back(draw.between(0.35, 1.0) * direction(360.0 / corners * (i + draw.between(-0.3, 0.3))));
    return polygon;
}

/// Turned by a right angle as often as by any angle: sides that lie on each other, and corners on sides.
Polygon draw_polygon(const Vec2& centre, double radius, Draw& draw)
{
    static const std::array<std::function<Polygon(Draw&)>, 6> shapes{
        angle_shape, tee_shape, channel_shape, star_shape, random_shape, [](Draw&) { return rectangle(0.0, 0.0, 1.0, 0.6); }};
    Polygon polygon = draw.one_of(shapes)(draw);
    const Placement turn = turned_by(draw.chance(0.5) ? 90.0 * draw.count(0, 3) : draw.between(0.0, 360.0));
    const Vec2 middle = area_moments(polygon).centroid;
    double farthest = 0.0;
    for (const Vec2& v : polygon)
        farthest = std::max(farthest, (v - middle).norm());
    for (Vec2& v : polygon)
        v = centre + radius / farthest * turn.turned(v - middle);
    return polygon;
}

/// Even, or with teeth: blocks fall onto tips and into hollow corners.
Polygon draw_ground(double wide, double half, double radius, Draw& draw)
{
    Polygon polygon{{-wide, -6.0 * radius}, {wide, -6.0 * radius}, {wide, 0.0}};
    const int teeth = draw.chance(0.5) ? 0 : draw.count(1, 6);
    const double width = 2.0 * half / std::max(teeth, 1);
    for (int i = 0; i < teeth; ++i)
    {
        const double right = half - i * width;
        polygon.emplace_back(right, 0.0);
        polygon.emplace_back(right - width * draw.between(0.2, 0.8), -radius * draw.between(0.1, 1.5));
    }
    if (teeth > 0)
        polygon.emplace_back(-half, 0.0);
    polygon.emplace_back(-wide, 0.0);
    return polygon;
}
}  // namespace

Scene concave_scene(int number)
{
    static const FallingBlocks kind{.family = "concave",
                                    .kind = " with hollow corners",
                                    .blocks = {1, 12},
                                    .columns = {1, 4},
                                    .draw_block = draw_polygon,
                                    .draw_ground = [](double wide, double half, double radius, Draw& draw)
                                    { return draw_ground(wide, 0.9 * half, radius, draw); },
                                    .hollow = 1.5,
                                    .landings = 8.0};
    return falling_scene(number, kind);
}
}  // namespace hdem::verification::rest
