/// Many blocks that fall into a heap: which way each one goes is chance, but they come to rest, on each other and on the ground.

#include "verification/rest/falling.h"
#include "verification/rest/families.h"

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
    static const FallingBlocks kind{.family = "heap",
                                    .kind = "",
                                    .blocks = {5, 30},
                                    .columns = {1, 5},
                                    .draw_block = draw_polygon,
                                    .draw_ground = [](double wide, double, double radius, Draw&)
                                    { return rectangle(-wide, -4.0 * radius, wide, 0.0); }};
    return falling_scene(number, kind);
}
}  // namespace hdem::verification::rest
