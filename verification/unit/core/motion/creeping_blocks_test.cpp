#include "core/motion/creeping_blocks.h"
#include "core/stage/rules.h"
#include "parallel/stages.h"
#include "verification/unit/block_pair.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;

/// Two blocks far from each other that are moved between the looks.
class WatchCreep : public testing::Test
{
  protected:
    WatchCreep() : pair_(test::pair_scene(rectangle({0, 0}, {1, 1}), rectangle({0, 0}, {1, 1}))), a_(pair_.a)
    {
        blocks().reference_position[a_] = Vec2(motion().x, motion().y - 1.0);
        motion().vx = 1e-4;
    }

    /// @return whether the first block creeps then
    bool look_after(double x, double y, double turn)
    {
        motion().x += x;
        motion().y += y;
        motion().angle += turn / pair_.model.radius[a_];
        return look();
    }
    bool look()
    {
        watch_creep(pair_.model, rule_, blocks(), bolted_, slow_);
        return !slow_.empty() && creeps(slow_.front());
    }
    /// @return looks until it creeps; 100: it does not
    int looks_until_it_creeps(double x, double y, double turn)
    {
        for (int k = 1; k < 100; ++k)
            if (look_after(x, y, turn))
                return k;
        return 100;
    }
    Blocks& blocks() { return pair_.state.blocks; }
    BlockMotion& motion() { return blocks().motion[a_]; }

    test::BlockPair pair_;
    Index a_;
    GroupRule rule_{.speed = 0.08, .seeks_rest = true, .loose_distance = 0.05};
    std::vector<Index> bolted_;
    std::vector<CreepingBlock> slow_;
};

TEST_F(WatchCreep, TellsOfABlockThatGoesOnInItsDirectionOrTurnsOn)
{
    const std::vector<Triple> ways{{1e-6, 0.0, 0.0}, {0.0, -1e-6, 0.0}, {0.0, 0.0, 1e-6}, {-1e-9, 1e-9, -1e-9}};
    for (const Triple& way : ways)
    {
        slow_.clear();
        EXPECT_FALSE(look());
        EXPECT_EQ(looks_until_it_creeps(way.x, way.y, way.w), 5) << "the first way has nothing to compare with";
    }
    ASSERT_EQ(slow_.size(), 1u);
    EXPECT_EQ(slow_.front().block, a_) << "the other one is not loose";
}

TEST_F(WatchCreep, IsOverAfterSixteenLooksAndThenBeginsAnew)
{
    look();
    looks_until_it_creeps(1e-6, 0.0, 0.0);
    for (int k = 1; k < 16; ++k)
        EXPECT_TRUE(look_after(1e-6, 0.0, 0.0)) << k;
    EXPECT_FALSE(look_after(1e-6, 0.0, 0.0));
    EXPECT_EQ(looks_until_it_creeps(1e-6, 0.0, 0.0), 4);
}

TEST_F(WatchCreep, EndsWhereABlockTurnsAsideOrBack)
{
    const auto goes_on_after = [&](double x, double y, double turn)
    {
        slow_.clear();
        look();
        looks_until_it_creeps(1e-6, 0.0, 0.0);
        return look_after(x, y, turn);
    };
    EXPECT_TRUE(goes_on_after(1e-8, 0.0, 0.0)) << "it may become slower";
    EXPECT_TRUE(goes_on_after(1e-6, 1.7e-6, 0.0)) << "less than 60 degrees";
    EXPECT_FALSE(goes_on_after(1e-6, 1.8e-6, 0.0));
    EXPECT_FALSE(goes_on_after(1e-6, 0.0, 1.8e-6));
    EXPECT_FALSE(goes_on_after(-1e-8, 0.0, 0.0));
    EXPECT_FALSE(goes_on_after(0.0, 0.0, 0.0));
}

TEST_F(WatchCreep, LooksAtLooseSlowBlocksThatAreFreeOnly)
{
    const auto is_followed = [&]
    {
        look();
        return !slow_.empty();
    };
    EXPECT_TRUE(is_followed());
    bolted_ = {a_};
    EXPECT_FALSE(is_followed());
    bolted_.clear();
    motion().vx = 0.081;
    EXPECT_FALSE(is_followed());
    motion().vx = 0.079;
    EXPECT_TRUE(is_followed());
    const double inverse_inertia = std::exchange(blocks().inertia[a_].inverse_inertia, 0.0);
    EXPECT_FALSE(is_followed()) << "it cannot turn";
    blocks().inertia[a_].inverse_inertia = inverse_inertia;
    blocks().rest[a_] = left_out;
    EXPECT_FALSE(is_followed());
    blocks().rest[a_] = 0;
    EXPECT_TRUE(is_followed());
    rule_.loose_distance = 1.1;
    EXPECT_FALSE(is_followed());
}

TEST_F(WatchCreep, MarksWhatCreepsAsIfNoJointBoreIt)
{
    blocks().force[a_].contacts = 1;
    blocks().force[a_].mobilised = 0.4F;
    blocks().force[a_].reserve = 7.0;
    look();
    mark_creeping({0, blocks().size()}, slow_, blocks());
    EXPECT_EQ(blocks().force[a_].mobilised, 0.4F);
    looks_until_it_creeps(1e-6, 0.0, 0.0);
    mark_creeping({a_ + 1, blocks().size() + 1}, slow_, blocks());
    EXPECT_EQ(blocks().force[a_].mobilised, 0.4F) << "not in the range";
    mark_creeping({0, blocks().size()}, slow_, blocks());
    EXPECT_EQ(blocks().force[a_].mobilised, -1.0F);
    EXPECT_EQ(blocks().force[a_].reserve, 0.0);
}

/// What moves blocks along may move them one way, and the cycles that approach a static solution are to name what moves.
TEST(CreepingBlocks, AreLookedForWhereRestIsSoughtOnly)
{
    const DampingDef damping{.local = 0.8};
    const ConvergenceDef convergence{.loose_distance = 0.07};
    const StageSetting rest{.damping = damping, .convergence = convergence, .until_converged = true};
    EXPECT_EQ(resolve_rules(rest).groups.loose_distance, 0.07);
    const auto never = std::numeric_limits<double>::infinity();
    StageSetting other = rest;
    other.until_converged = false;
    EXPECT_EQ(resolve_rules(other).groups.loose_distance, never);
    other = rest;
    other.preset = DampingPreset::paper;
    EXPECT_EQ(resolve_rules(other).groups.loose_distance, never);
    other = rest;
    other.is_driven = true;
    EXPECT_EQ(resolve_rules(other).groups.loose_distance, never);
    other = rest;
    other.loads_change = true;
    EXPECT_EQ(resolve_rules(other).groups.loose_distance, never);
    CaseDef scene = scenes::block_on_ground();
    scene.stages = {{.name = "rest", .until_converged = true}};
    const CaseRun run(scene);
    EXPECT_LT(resolve_rules(run.model(), run.state()).groups.loose_distance, 1.0);
    EXPECT_EQ(approach_rules(run.model(), run.state()).groups.loose_distance, never);
}

TEST(CreepingBlocks, AreForgottenWhereAStageBegins)
{
    CaseDef scene = scenes::block_on_ground();
    scene.stages = {{.name = "rest", .until_converged = true}};
    const CaseRun run(scene, [](const Model& model, State& state) { state.creeping = {{.block = model.find_block("block")}}; });
    EXPECT_TRUE(run.state().creeping.empty());
}

/// Four blocks with hollow corners that fall into a bin and lean on its walls (rest.concave, scene 44).
CaseDef hollow_blocks_in_a_bin()
{
    CaseDef scene = scenes::empty_scene();
    scene.contact.method = Method::hybrid;
    scene.joints[0].normal_stiffness = 2.85e9;
    scene.joints[0].shear_stiffness = 3.92e8;
    scene.joints[0].friction_angle_deg = 24.08;
    scene.time.step = 2.527e-4;
    scenes::add_fixed_block(scene, "ground", rectangle({-10.0, -3.6}, {10.0, 0.0}));
    scenes::add_fixed_block(scene, "left", rectangle({-3.1, 0.0}, {-0.717, 6.7}));
    scenes::add_fixed_block(scene, "right", rectangle({0.717, 0.0}, {3.1, 6.7}));
    scenes::add_block(scene, "b1", {{0.4021, 0.58395}, {-0.02954, 1.204875}, {-0.4021, 0.945894}, {0.02954, 0.32497}});
    scenes::add_block(scene, "b2",
                      {{0.28379, 1.704776},
                       {0.464326, 2.007006},
                       {0.127188, 2.20839},
                       {0.226203, 2.374151},
                       {-0.070412, 2.551329},
                       {-0.448973, 1.917576},
                       {-0.152358, 1.740399},
                       {-0.053344, 1.90616}});
    scenes::add_block(scene, "b3",
                      {{0.270804, 3.055014},
                       {0.270804, 3.71639},
                       {-0.390572, 3.71639},
                       {-0.390572, 3.538732},
                       {-0.00911, 3.538732},
                       {-0.00911, 3.195118},
                       {-0.390572, 3.195118},
                       {-0.390572, 3.055014}});
    scenes::add_block(scene, "b4", {{-0.44205, 4.543417}, {0.353371, 4.395618}, {0.44205, 4.87287}, {-0.353371, 5.020669}});
    scene.stages = {{.name = "rest", .until_converged = true, .max_cycles = 165'000}};
    return scene;
}

/// They crept for longer than that.
TEST(CreepingBlocks, OfAHeapComeToRestFromEveryStart)
{
    for (const double angle : {0.0, 40.0, 200.0})
    {
        CaseRun run(scenes::turned(hollow_blocks_in_a_bin(), angle));
        const StageResult result = run_stages(run.simulation, {}).front();
        EXPECT_TRUE(result.at_rest) << "turned by " << angle << ": " << result.cycles << " cycles";
    }
}

TEST(CreepingBlocks, ThatARestartFindsGoOnAlike)
{
    CaseRun run(hollow_blocks_in_a_bin());
    while (!std::ranges::any_of(run.state().creeping, creeps) && run.state().cycle < 60'000)
        run.advance(256);
    ASSERT_TRUE(std::ranges::any_of(run.state().creeping, creeps));
    State forgetful = run.state();
    forgetful.creeping.clear();
    Simulation taken_up(run.model(), run.state()), without(run.model(), std::move(forgetful));
    for (Simulation* other : {&taken_up, &without})
        other->advance(300);
    run.advance(300);
    EXPECT_EQ(state_hash(taken_up.model(), taken_up.state()), run.hash());
    EXPECT_NE(state_hash(without.model(), without.state()), run.hash());
}
}  // namespace
}  // namespace hdem
