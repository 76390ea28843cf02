#include "verification/checks/robust_scenes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr double pi = std::numbers::pi;

/// A triangle 1 m long and `thick` at its end lies between two blocks that fit it.
SceneBlocks wedge(double thick)
{
    return {ground(),
            {.polygon = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0 - thick}, {0.0, 1.0}}},
            {.polygon = {{0.0, 1.0}, {1.0, 1.0 - thick}, {1.0, 1.0}}},
            {.polygon = rectangle(0.0, 1.0, 1.0, 2.0)}};
}

/// The same triangle stands on its tip in the gap between two blocks.
SceneBlocks gap(double thick)
{
    return {ground(),
            {.polygon = rectangle(-1.0, 0.0, 0.0, 1.0)},
            {.polygon = {{0.0, 0.0}, {thick, 1.0}, {0.0, 1.0}}},
            {.polygon = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {thick, 1.0}}}};
}

constexpr double length = 10.0, width = 0.1;  ///< of needles [m]

SceneBlocks needle(double angle, double height)
{
    return turned_at({ground(), {.polygon = rectangle(0.0, 0.0, length, width)}}, angle, height);
}

SceneBlocks supports(double angle)
{
    const SceneBlocks parts{ground(),
                            fixed_block(rectangle(1.0, 0.0, 2.0, 1.0)),
                            fixed_block(rectangle(8.0, 0.0, 9.0, 1.0)),
                            {.polygon = rectangle(0.0, 0.0, length, width)}};
    return turned_at(parts, angle, 2.0, 3);
}

SceneBlocks bundle(int count)
{
    SceneBlocks blocks{ground()};
    for (int i = 0; i < count; ++i)
        blocks.push_back({.polygon = rectangle(0.0, width * i, length, width * (i + 1))});
    return blocks;
}

/// A unit block thrown down at 50 m/s onto what `rock` holds.
Scene thrown(const std::string& name, SceneBlocks rock, double angle, double spin, double slant)
{
    constexpr double speed = 50.0, g = 9.81, height = 1.0, gyration_squared = 1.0 / 6.0;
    const std::size_t number = rock.size();
    double top = 0.0;
    for (const SceneBlock& block : rock)
        for (const Vec2& v : block.polygon)
            top = std::max(top, v.y());
    rock.push_back({.polygon = rectangle_at({0.0, 0.0}, 1.0, 1.0),
                    .velocity = {speed * std::sin(slant), -speed * std::cos(slant)},
                    .angular_velocity = spin});
    Scene scene = make_scene(name, turned_at(rock, angle, top + height, number), 10.0);
    if (rock[number - 1].fixed)
        scene.greatest_speed = std::sqrt(speed * speed + 2.0 * g * (height + 1.0) + gyration_squared * spin * spin);
    return scene;
}

/// Fixed rock of this thickness.
SceneBlocks plate(double thickness)
{
    return {fixed_block(rectangle(-400.0, -thickness, 400.0, 0.0))};
}
}  // namespace

std::vector<Scene> sliver_scenes(int seeds)
{
    std::vector<Scene> scenes;
    for (const double thick : {1e-2, 1e-3})
    {
        const double seconds = thick < 5e-3 ? 0.5 : 1.5;  // a light sliver has a small step
        const auto name = [&](const char* what) { return fmt::format("{} 1:{:g}", what, 1.0 / thick); };
        scenes.push_back(make_scene(name("sliver between blocks"), wedge(thick), seconds));
        scenes.push_back(make_scene(name("sliver in a gap"), gap(thick), seconds));
        for (int seed = 1; seed <= seeds; ++seed)
        {
            const double tilt = Draw(seed).between(-0.4, 0.4);
            scenes.push_back(make_scene(seeded(name("sliver between falling blocks").c_str(), seed),
                                        turned_at(wedge(thick), tilt, 0.3), seconds));
            scenes.back().comes_to_rest = false;
        }
    }
    for (int seed = 1; seed <= seeds; ++seed)
        scenes.push_back({.name = seeded("rock", seed),
                          .case_file = "robust/slivers.toml",
                          .overrides = {set("generator.seed", static_cast<double>(seed))},
                          .comes_to_rest = false});
    return scenes;
}

std::vector<Scene> needle_scenes(int seeds)
{
    std::vector<Scene> scenes{make_scene("needle stands", needle(0.5 * pi, 0.0), 2.0),
                              make_scene("needle lies", needle(0.0, 0.0), 2.0), make_scene("six needles lie", bundle(6), 2.0),
                              make_scene("needle falls flat on supports", supports(0.0), 4.0)};
    for (int seed = 1; seed <= seeds; ++seed)
    {
        Draw draw(seed);
        const double lean = draw.between(0.45, 0.55);
        const double tilt = draw.between(-0.3, 0.3);
        scenes.push_back(make_scene(seeded("needle topples", seed), needle(lean * pi, 0.0), 16.0));
        scenes.push_back(make_scene(seeded("needle falls on supports", seed), supports(tilt), 6.0));
        scenes.push_back(make_scene(seeded("six needles fall", seed), turned_at(bundle(6), tilt, 1.0), 6.0));
    }
    return scenes;
}

std::vector<Scene> throw_scenes(int seeds)
{
    const SceneBlocks joint{fixed_block(rectangle(-400.0, -2.0, 0.0, 0.0)), fixed_block(rectangle(0.0, -2.0, 400.0, 0.0))};
    const SceneBlocks loose_joint{
        ground(), {.polygon = rectangle(-2.0, 0.0, 0.0, 2.0)}, {.polygon = rectangle(0.0, 0.0, 2.0, 2.0)}};
    const SceneBlocks loose_plate{ground(), {.polygon = rectangle(-1.0, 0.0, 1.0, 0.1)}};
    std::vector<Scene> scenes;
    const auto add = [&](const char* where, const SceneBlocks& rock)
    {
        scenes.push_back(thrown(fmt::format("face first at {}", where), rock, 0.0, 0.0, 0.0));
        scenes.push_back(thrown(fmt::format("corner first at {}", where), rock, 0.25 * pi, 0.0, 0.0));
        scenes.back().comes_to_rest = false;  // may balance on its corner
        for (int seed = 1; seed <= seeds; ++seed)
        {
            Draw draw(seed);
            const double angle = draw.between(0.0, 0.5 * pi);
            const double spin = draw.between(-20.0, 20.0);
            scenes.push_back(thrown(seeded(fmt::format("at {}", where).c_str(), seed), rock, angle, spin, draw.between(-0.2, 0.2)));
        }
    };
    add("rock", {ground()});
    add("a plate of 10 cm", plate(0.1));
    add("a plate of 1 mm", plate(1e-3));
    add("a joint", joint);
    add("two loose blocks", loose_joint);
    add("a loose plate of 10 cm", loose_plate);
    return scenes;
}
}  // namespace hdem::verification
