/// Rock that stands comes to rest at the same places however the model is turned or mirrored: no rule may ask round-off.
#include "verification/unit/case_run.h"

#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
using test::CaseRun;

constexpr std::int64_t cycles = 3000;  // then it is at rest

/// Two sets of joints, dips of 37 and -52 degrees, in a hollow of fixed blocks. Corners meet in fours.
CaseDef rock()
{
    constexpr int rows = 6;
    const auto along = [](double dip_deg)
    {
        const double dip = dip_deg * std::numbers::pi / 180.0;
        return Vec2(std::cos(dip), std::sin(dip));
    };
    const Vec2 a = 1.5 * along(37.0), b = 1.3 * along(128.0);
    CaseDef scene = scenes::empty_scene();
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < rows; ++j)
        {
            const Vec2 corner = i * a + j * b;
            const bool is_fixed = i == 0 || j == 0 || (i == rows - 1 && j < 3) || (j == rows - 1 && i < 3);
            const auto add = is_fixed ? scenes::add_fixed_block : scenes::add_block;
            add(scene, std::to_string(i) + "." + std::to_string(j), {corner, corner + a, corner + a + b, corner + b});
        }
    return scene;
}

/// Of the free blocks, as they are in the rock as drawn.
std::vector<Vec2> displacements(const CaseDef& scene, double turned_deg, bool mirrored)
{
    CaseRun run(mirrored ? scenes::mirrored(scenes::turned(scene, turned_deg)) : scenes::turned(scene, turned_deg));
    run.advance(cycles);
    const double angle = -turned_deg * std::numbers::pi / 180.0;
    std::vector<Vec2> found;
    for (const BlockDef& block : scene.blocks)
    {
        Vec2 u = run.displacement(block.name);
        if (mirrored)
            u.x() = -u.x();
        found.emplace_back(std::cos(angle) * u.x() - std::sin(angle) * u.y(), std::sin(angle) * u.x() + std::cos(angle) * u.y());
    }
    return found;
}

TEST(TurnedRock, RockComesToRestAtTheSamePlaces)
{
    for (const Method method : {Method::force, Method::hybrid})
    {
        CaseDef scene = rock();
        scene.contact.method = method;
        const std::vector<Vec2> drawn = displacements(scene, 0.0, false);
        double greatest = 0.0;
        for (const Vec2& u : drawn)
            greatest = std::max(greatest, u.norm());
        ASSERT_GT(greatest, 1e-5);
        ASSERT_LT(greatest, 1e-3) << "it stands";
        for (const double angle : {0.0, 23.0, 90.0})
            for (const bool mirrored : {false, true})
            {
                const std::vector<Vec2> other = displacements(scene, angle, mirrored);
                for (std::size_t i = 0; i < drawn.size(); ++i)
                    EXPECT_LT((other[i] - drawn[i]).norm(), 1e-3 * greatest)
                        << scene.blocks[i].name << ", turned by " << angle << (mirrored ? ", mirrored" : "");
            }
    }
}
}  // namespace
}  // namespace hdem
