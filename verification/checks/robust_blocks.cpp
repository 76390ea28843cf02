#include "verification/checks/robust_blocks.h"

#include "core/geometry/polygon.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hdem::verification
{
namespace
{
void turn(SceneBlocks& blocks, std::size_t first, double angle, const Vec2& about)
{
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    for (std::size_t i = first; i < blocks.size(); ++i)
        for (Vec2& v : blocks[i].polygon)
        {
            const Vec2 from = v - about;
            v = about + Vec2(c * from.x() - s * from.y(), s * from.x() + c * from.y());
        }
}

/// As the case file has it, in one line.
std::string text(const SceneBlock& block)
{
    return fmt::format("{{polygon = {}, material = \"{}\", fixed = {}, velocity = {}, angular_velocity = {:.17g}}}",
                       set("", block.polygon).value, block.material, block.fixed, set("", block.velocity).value,
                       block.angular_velocity);
}
}  // namespace

Polygon rectangle(double x0, double y0, double x1, double y1)
{
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Polygon rectangle_at(const Vec2& centre, double width, double height)
{
    return rectangle(centre.x() - 0.5 * width, centre.y() - 0.5 * height, centre.x() + 0.5 * width, centre.y() + 0.5 * height);
}

SceneBlock fixed_block(Polygon polygon)
{
    return {.polygon = std::move(polygon), .fixed = true};
}

SceneBlock ground()
{
    return fixed_block(rectangle(-400.0, -2.0, 400.0, 0.0));
}

SceneBlocks column(int count, double bottom)
{
    SceneBlocks blocks{ground()};
    for (int i = 0; i < count; ++i)
        blocks.push_back({.polygon = rectangle(-0.5, bottom + i, 0.5, bottom + i + 1.0)});
    return blocks;
}

SceneBlocks turned_at(SceneBlocks blocks, double angle, double height, std::size_t first)
{
    turn(blocks, first, angle, area_moments(blocks[first].polygon).centroid);
    double lowest = bounding_box(blocks[first].polygon).low.y();
    for (std::size_t i = first; i < blocks.size(); ++i)
        lowest = std::min(lowest, bounding_box(blocks[i].polygon).low.y());
    for (std::size_t i = first; i < blocks.size(); ++i)
        for (Vec2& v : blocks[i].polygon)
            v.y() += height - lowest;
    return blocks;
}

Scene make_scene(const std::string& name, const SceneBlocks& blocks, double duration)
{
    std::string all;
    for (const SceneBlock& block : blocks)
        all += (all.empty() ? "[" : ", ") + text(block);
    return {
        .name = name, .case_file = "robust/blocks.toml", .overrides = {{"block", all + ']'}, set("stage[0].duration", duration)}};
}

std::string seeded(const char* name, int seed)
{
    return fmt::format("{}, seed {}", name, seed);
}
}  // namespace hdem::verification
