#include "core/contact/impulse_law.h"
#include "verification/unit/block_pair.h"
#include "verification/unit/case_run.h"
#include "verification/unit/core/contact/impulse_scenes.h"

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;
using test::two_blocks;
using test::without_gravity;

/// A bar lifted at one end must not be turned into the ground with the other, which has nothing to be taken back.
TEST(PositionCorrection, PressesNoOtherPointIntoTheGround)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "ground", rectangle({-10, -1}, {10, 0}));
    scenes::add_block(scene, "bar", rectangle({-2, 0}, {2, 0.1}));
    scene = without_gravity(scene, 0.5);
    const double allowed = scene.contact.allowed_overlap = 1e-6;
    const double left = 1e-9, right = 1e-5;  // overlaps at the ends
    CaseRun run(scene,
                [&](const Model& model, State& state)
                {
                    BlockMotion& m = state.blocks.motion[model.find_block("bar")];
                    m.y -= 0.5 * (left + right);
                    m.angle = (left - right) / 4.0;
                    m.s = std::sin(m.angle);
                    m.c = std::cos(m.angle);
                });
    run.advance(1);
    const BlockMotion& m = run.motion("bar");
    const double y = run.displacement("bar").y() - 0.5 * (left + right);
    EXPECT_NEAR(y + 2.0 * m.angle, -allowed, 1e-9) << "the right end is lifted";
    EXPECT_GT(y - 2.0 * m.angle, -allowed - 1e-9);
}

TEST(PositionCorrection, TakesTheOverlapBackWithoutKineticEnergy)
{
    CaseDef scene = without_gravity(scenes::block_on_ground(), 0.5);
    CaseRun run(scene, [](const Model& model, State& state) { state.blocks.motion[model.find_block("block")].y -= 1e-3; });
    run.advance(1);
    EXPECT_NEAR(run.displacement("block").y(), 1e-3 - 1e-7, 1e-12) << "all but the allowed overlap, at once";
    EXPECT_EQ(run.velocity("block").norm(), 0.0);
    EXPECT_EQ(run.motion("block").w, 0.0);
    run.advance(10);
    EXPECT_EQ(run.velocity("block").norm(), 0.0);
    EXPECT_NEAR(run.displacement("block").y(), 1e-3 - 1e-7, 1e-12);
}

/// Overlap that no approach explains is taken back little by little: at once it would be pressed into springs elsewhere.
TEST(PositionCorrection, TakesOldOverlapBackSlowly)
{
    for (const double rate : {0.02, 2.0})
    {
        CaseDef scene = test::pair_scene(scenes::rectangle({-0.5, -0.5}, {0.5, 0.5}), scenes::rectangle({-0.5, -0.5}, {0.5, 0.5}));
        scene.gravity = Vec2(0, 0);
        scene.contact.correction_rate = rate;
        test::BlockPair pair(scene);
        pair.place(pair.a, {0, 0}, 0.0);
        pair.place(pair.b, {0.0, 1.0 - 5e-3}, 0.0);
        const double speed = 2.0;
        pair.motion(pair.b).vy = -speed;
        pair.search();
        pair.evaluate(ContactLaw::impulses);
        std::vector<ImpulsePoint> points;
        collect_impulse_points({0, 1}, pair.model, pair.state.blocks, pair.state.contacts, points);
        ASSERT_EQ(points.size(), 2U);
        for (const ImpulsePoint& p : points)
            EXPECT_NEAR(p.excess_overlap, (speed + rate) * pair.model.time_step, 1e-15);
    }
}

TEST(PositionCorrection, TakesTheGivenShareOfTheOverlap)
{
    CaseDef scene = without_gravity(scenes::block_on_ground(), 0.5);
    scene.contact.correction_fraction = 0.25;
    CaseRun run(scene, [](const Model& model, State& state) { state.blocks.motion[model.find_block("block")].y -= 1e-3; });
    run.advance(1);
    EXPECT_NEAR(run.displacement("block").y(), 0.25 * (1e-3 - 1e-7), 1e-12);
}

TEST(PositionCorrection, SharesTheWayByMass)
{
    CaseDef scene = without_gravity(two_blocks(0.0), 0.0);
    scene.blocks[1].polygon = rectangle({0, -1}, {3, 2});  // nine times the mass
    scene.blocks[0].velocity = scene.blocks[1].velocity = {0.0, 0.0};
    CaseRun run(scene, [](const Model& model, State& state) { state.blocks.motion[model.find_block("left")].x += 1e-3; });
    run.advance(1);
    EXPECT_NEAR(run.displacement("left").x(), -0.9 * (1e-3 - 1e-7), 1e-9);
    EXPECT_NEAR(run.displacement("right").x(), 0.1 * (1e-3 - 1e-7), 1e-9);
}
}  // namespace
}  // namespace hdem
