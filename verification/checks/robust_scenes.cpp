#include "verification/checks/robust_scenes.h"

#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr double quarter_turn = 0.5 * std::numbers::pi;

/// Two unit blocks of these materials on each other.
SceneBlocks pair_of(const char* lower, const char* upper)
{
    SceneBlocks blocks = column(2, 0.0);
    blocks[1].material = lower;
    blocks[2].material = upper;
    return blocks;
}

SceneBlocks with_soft(SceneBlocks blocks, std::size_t which)
{
    blocks[which].material = "soft";
    return blocks;
}
}  // namespace

/// Masses 1 to 1e6, by density and by size.
std::vector<Scene> mass_scenes(int seeds)
{
    constexpr double side = 10.0, tiny = 0.01;
    const SceneBlocks sizes{
        ground(), {.polygon = rectangle(0.0, 0.0, side, side)}, {.polygon = rectangle_at({3.0, side + 0.5 * tiny}, tiny, tiny)}};
    // On a fixed step and on the tiny block, which carries half of it: 0.13 GPa, so joints a hundred times as stiff.
    const SceneBlocks under{ground(),
                            fixed_block(rectangle(0.0, 0.0, 1.0, tiny)),
                            {.polygon = rectangle(side - tiny, 0.0, side, tiny)},
                            {.polygon = rectangle(0.0, tiny, side, side + tiny)}};
    std::vector<Scene> scenes{make_scene("heavy rests on light", pair_of("light", "heavy"), 1.0),
                              make_scene("light rests on heavy", pair_of("heavy", "light"), 1.0),
                              make_scene("1 cm rests on 10 m", sizes, 0.5), make_scene("10 m rests on 1 cm", under, 0.1)};
    scenes.back().overrides.push_back(set("joint.default.normal_stiffness", 7e11));
    scenes.back().overrides.push_back(set("joint.default.shear_stiffness", 5e10));
    for (int seed = 1; seed <= seeds; ++seed)
    {
        const double angle = Draw(seed).between(0.0, quarter_turn);
        scenes.push_back(
            make_scene(seeded("heavy falls on light", seed), turned_at(pair_of("light", "heavy"), angle, 1.3, 2), 0.8));
        scenes.push_back(
            make_scene(seeded("light falls on heavy", seed), turned_at(pair_of("heavy", "light"), angle, 1.3, 2), 0.8));
        scenes.back().comes_to_rest = (scenes.end() - 2)->comes_to_rest = false;  // a second later
        scenes.push_back(make_scene(seeded("1 cm falls on 10 m", seed), turned_at(sizes, angle, side + 0.03, 2), 0.3));
    }
    return scenes;
}

/// Joints of 7e9 and 7e6 Pa/m in one stack.
std::vector<Scene> stiffness_scenes(int seeds)
{
    std::vector<Scene> scenes{make_scene("stack rests", with_soft(column(4, 0.0), 2), 3.0)};
    for (int seed = 1; seed <= seeds; ++seed)
    {
        Draw draw(seed);
        const double tilt = draw.between(-0.6, 0.6);
        const double angle = draw.between(0.0, quarter_turn);
        scenes.push_back(make_scene(seeded("stack falls", seed), turned_at(with_soft(column(4, 0.0), 2), tilt, 1.0), 10.0));
        scenes.push_back(
            make_scene(seeded("soft block falls on a stack", seed), turned_at(with_soft(column(3, 0.0), 3), angle, 3.0, 3), 6.0));
    }
    return scenes;
}

std::vector<Scene> fall_scenes(int seeds)
{
    constexpr double height = 20.0;
    std::vector<Scene> scenes{make_scene("one block on its face", column(1, height), 8.0),
                              make_scene("ten blocks upright", column(10, height), 12.0)};
    for (int seed = 1; seed <= seeds; ++seed)
    {
        Draw draw(seed);
        const double angle = draw.between(0.0, quarter_turn);
        const double tilt = draw.between(-0.3, 0.3);
        scenes.push_back(make_scene(seeded("one block", seed), turned_at(column(1, 0.0), angle, height), 10.0));
        scenes.push_back(make_scene(seeded("ten blocks", seed), turned_at(column(10, 0.0), tilt, height), 15.0));
    }
    for (Scene& s : scenes)
        if (s.name.starts_with("one block"))
            s.greatest_speed = std::sqrt(2.0 * 9.81 * height);
    return scenes;
}
}  // namespace hdem::verification
