#include "core/contact/contact_forces.h"
#include "verification/unit/block_pair.h"
#include "verification/unit/case_run.h"

#include <cmath>

namespace hdem
{
namespace
{
using test::CaseRun;

constexpr double mass = 2700.0;
constexpr double weight = mass * 9.81;
constexpr double step = 5e-5;
constexpr std::int64_t settled = 8000;  // cycles

/// A unit block at rest on its springs, then pushed to `speed` within one cycle. The ground weighs twice as much, and its centre does not lie
/// below that of the block.
CaseDef pushed_block(double speed, bool fixed_mass_counts)
{
    CaseDef scene = scenes::block_on_ground();
    scene.blocks[0].polygon = scenes::rectangle({-0.5, -1.0}, {1.5, 0.0});
    scene.blocks[1].fix_rotation = true;
    scene.time.step = step;
    scene.contact.method = Method::force;
    scene.contact.threshold_scale = 1.0;
    scene.contact.fixed_mass_counts = fixed_mass_counts;
    scene.stages = {{.name = "settle", .cycles = settled},
                    {.name = "push", .cycles = 2, .method = Method::hybrid, .damping = DampingPreset::dynamic}};
    LoadDef push{.blocks = {"block"}, .acceleration = {speed / step, 0.0}};
    push.interval.from_cycle = settled;
    push.interval.until_cycle = settled + 1;
    scene.loads.push_back(push);
    return scene;
}

Index impulse_points(double speed, bool fixed_mass_counts)
{
    CaseRun run(pushed_block(speed, fixed_mass_counts));
    run.advance(settled);
    run.simulation.begin_stage(1);
    run.advance(1);
    EXPECT_NEAR(run.velocity("block").x(), speed, 1e-6 * speed);
    EXPECT_EQ(run.simulation.count_contacts().points[static_cast<int>(Regime::impulse)], 0);
    run.advance(1);
    return run.simulation.count_contacts().points[static_cast<int>(Regime::impulse)];
}

/// u_th = dt g + sqrt(K u^2 / m_c) with K u = W; m_c = m against an immovable ground, 1/m_c = 1/m + 1/(2 m) where its mass counts. A fixed block
/// does not turn in either case.
TEST(ThresholdVelocity, CountsTheMassOfAFixedBlockWhereTheCaseSaysSo)
{
    for (const bool counts : {false, true})
    {
        const double inverse_mass = counts ? 1.5 / mass : 1.0 / mass;
        const double threshold = step * 9.81 + weight * std::sqrt(inverse_mass / 7e9);
        EXPECT_EQ(impulse_points(0.999 * threshold, counts), 0) << counts;
        EXPECT_EQ(impulse_points(1.001 * threshold, counts), 2) << counts;
    }
}

/// Who answers when block `a` hits block `b` from above.
class RockKeepsSprings : public testing::Test
{
  protected:
    enum class Is
    {
        standing,
        loose,
        fixed
    };

    static test::BlockPair above(Is a, Is b, double speed)
    {
        CaseDef scene = test::pair_scene(scenes::rectangle({0, 0}, {1, 1}), scenes::rectangle({0, 0}, {2, 1}));
        for (int k = 0; k < 2; ++k)
            scene.blocks[k].fix_x = scene.blocks[k].fix_y = scene.blocks[k].fix_rotation = (k == 0 ? a : b) == Is::fixed;
        test::BlockPair pair(scene);
        const auto place = [&](Index block, const Vec2& at, Is is)
        {
            const double way = (is == Is::loose ? 1.01 : 0.99) * pair.model.convergence.loose_distance;
            pair.place(block, at, 0.0);
            pair.state.blocks.reference_position[block] = at + Vec2(way, 0.0);
        };
        place(pair.a, {0.0, 1.0 - 1e-6}, a);
        place(pair.b, {0.0, 0.0}, b);
        pair.motion(pair.a).vy = -speed;
        pair.search();
        return pair;
    }

    static Regime regime(Is a, Is b, double speed, const RegimeRule& rule)
    {
        test::BlockPair pair = above(a, b, speed);
        pair.evaluate(rule);
        EXPECT_EQ(pair.state.contacts.size(), 1);
        EXPECT_EQ(pair.state.contacts.regime[0][0], pair.state.contacts.regime[1][0]);
        return static_cast<Regime>(pair.state.contacts.regime[0][0]);
    }

    static Regime relaxing(Is a, Is b, double speed)
    {
        return regime(a, b, speed, {.law = ContactLaw::by_speed, .rock_keeps_springs = true});
    }

    static constexpr double fast = 3.0;
    const double limit = gentle_impact * std::sqrt(9.81 * 1.0);  ///< of the loose block, 1 m large [m/s]
};

TEST_F(RockKeepsSprings, UnderALooseBlockThatHitsHard)
{
    EXPECT_EQ(relaxing(Is::loose, Is::standing, fast), Regime::stick);
    EXPECT_EQ(relaxing(Is::loose, Is::standing, 1.01 * limit), Regime::stick);
    EXPECT_EQ(relaxing(Is::loose, Is::standing, 0.99 * limit), Regime::impulse) << "gently";
}

TEST_F(RockKeepsSprings, WhicheverOfTheTwoIsLoose)
{
    const double of_b = gentle_impact * std::sqrt(9.81 * std::sqrt(2.0));  // 2 m2
    EXPECT_EQ(relaxing(Is::standing, Is::loose, 1.01 * of_b), Regime::stick);
    EXPECT_EQ(relaxing(Is::standing, Is::loose, 0.99 * of_b), Regime::impulse);
}

TEST_F(RockKeepsSprings, AmongItself)
{
    EXPECT_EQ(relaxing(Is::standing, Is::standing, fast), Regime::stick);
    EXPECT_EQ(relaxing(Is::standing, Is::standing, 0.01), Regime::stick);
    EXPECT_EQ(relaxing(Is::standing, Is::fixed, fast), Regime::stick);
}

TEST_F(RockKeepsSprings, NotWhereNoRockStands)
{
    EXPECT_EQ(relaxing(Is::loose, Is::fixed, fast), Regime::impulse);
    EXPECT_EQ(relaxing(Is::fixed, Is::loose, fast), Regime::impulse) << "one whose motion is prescribed";
    EXPECT_EQ(relaxing(Is::loose, Is::loose, fast), Regime::impulse);
}

/// Springs that the block would press by 0.16 m, and by 0.016 m.
TEST_F(RockKeepsSprings, UnlessTheyCannotBearTheBlock)
{
    for (const auto& [stiffness, expected] : {std::pair(1e6, Regime::impulse), std::pair(1e8, Regime::stick)})
    {
        test::BlockPair pair = above(Is::loose, Is::standing, fast);
        for (CoulombSlip& law : pair.model.joints.laws)
            law.normal_stiffness = stiffness;
        pair.evaluate({.law = ContactLaw::by_speed, .rock_keeps_springs = true});
        EXPECT_EQ(static_cast<Regime>(pair.state.contacts.regime[0][0]), expected) << stiffness;
    }
}

/// Diagonal neighbours in rock: they have a corner in common, and no face.
TEST(CornersKeepSprings, OfBlocksThatLieWhereTheyWere)
{
    const auto regime = [](double length, double way, bool keeps)
    {
        test::BlockPair pair(test::pair_scene(scenes::rectangle({0, 0}, {1, 1}), scenes::rectangle({0, 0}, {2, 1})));
        pair.place(pair.a, {-1.5 + length, 1.0 - 1e-6}, 0.0);
        pair.place(pair.b, {0.0, 0.0}, 0.0);
        for (const Index block : {pair.a, pair.b})
            pair.state.blocks.reference_position[block] = Vec2(pair.motion(block).x + way, pair.motion(block).y);
        pair.motion(pair.a).vy = -0.5;
        pair.search();
        pair.evaluate({.law = ContactLaw::by_speed, .corners_keep_springs = keeps});
        EXPECT_EQ(pair.state.contacts.size(), 1);
        return static_cast<Regime>(pair.state.contacts.regime[0][0]);
    };
    EXPECT_EQ(regime(4e-4, 0.0, true), Regime::stick);
    EXPECT_EQ(regime(4e-4, 0.0, false), Regime::impulse);
    EXPECT_EQ(regime(4e-4, 0.1, true), Regime::impulse) << "one has come from elsewhere";
    EXPECT_EQ(regime(0.5, 0.0, true), Regime::impulse) << "a face";
}

TEST_F(RockKeepsSprings, InStagesThatLookForRestAndUnderTheHybridMethodOnly)
{
    for (const Is b : {Is::standing, Is::loose, Is::fixed})
    {
        EXPECT_EQ(regime(Is::loose, b, fast, {.law = ContactLaw::by_speed}), Regime::impulse);
        EXPECT_EQ(regime(Is::loose, b, fast, {.law = ContactLaw::impulses, .rock_keeps_springs = true}), Regime::impulse);
        EXPECT_EQ(regime(Is::loose, b, fast, {.law = ContactLaw::springs, .rock_keeps_springs = true}), Regime::stick);
    }
}
}  // namespace
}  // namespace hdem
