#include "verification/unit/block_pair.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>
#include <random>

namespace hdem
{
namespace
{
using test::CaseRun;

/// Pairs of parts that overlap by more than `least` at the present poses, each searched from scratch.
std::vector<std::uint64_t> overlapping_pairs(const Model& model, const State& state, double least)
{
    std::vector<std::uint64_t> pairs;
    const Shapes& shapes = model.shapes;
    for (Index a = 0; a < shapes.parts(); ++a)
        for (Index b = a + 1; b < shapes.parts(); ++b)
        {
            const Index block_a = shapes.part_block[a], block_b = shapes.part_block[b];
            if (block_a == block_b || !(state.blocks.is_free(block_a) || state.blocks.is_free(block_b)))
                continue;
            Contact contact{.part_a = a, .part_b = b};
            if (find_features(model, state.blocks, contact) < -least)
                pairs.push_back(pair_key(a, b));
        }
    return pairs;
}

std::set<std::uint64_t> tracked_pairs(const State& state)
{
    std::set<std::uint64_t> pairs;
    for (Index i = 0; i < state.contacts.size(); ++i)
        pairs.insert(pair_key(state.contacts.part_a[i], state.contacts.part_b[i]));
    return pairs;
}

CaseDef moving_pile(int seed)
{
    CaseDef scene = scenes::pile(12, 4, static_cast<std::uint64_t>(seed));
    std::mt19937_64 engine(static_cast<std::uint64_t>(seed));
    const auto number = [&] { return std::ldexp(static_cast<double>(engine() >> 11), -52) - 1.0; };
    for (BlockDef& block : scene.blocks)
        if (!block.fix_x)
        {
            block.velocity = {2.0 * number(), 2.0 * number()};
            block.angular_velocity = 5.0 * number();
        }
    scene.time.step = 2e-4;
    return scene;
}

/// Whatever moves and turns: a pair that overlaps at the start of a cycle is among the contacts of that cycle.
RC_GTEST_PROP(ContactTracking, NeverMissesAContact, ())
{
    CaseRun run(moving_pile(*rc::gen::inRange(0, 1000)));
    for (int i = 0; i < 60; ++i)
    {
        run.advance(9);
        const std::vector<std::uint64_t> must = overlapping_pairs(run.model(), run.state(), 1e-9);
        run.advance(1);  // looks for contacts at these poses
        const std::set<std::uint64_t> tracked = tracked_pairs(run.state());
        for (const std::uint64_t pair : must)
            RC_ASSERT(tracked.count(pair) == 1u);
    }
    RC_ASSERT(run.state().broad_phase_runs < 600);
}

/// The width of the skin decides how often the broad phase runs, not what happens.
TEST(ContactTracking, GivesTheSameMotionForEverySkin)
{
    std::map<double, Vec2> positions;
    std::map<double, std::int64_t> rebuilds;
    for (const double skin : {0.01, 0.05, 0.3})
    {
        CaseDef scene = moving_pile(3);
        scene.contact.skin = skin;
        scene.contact.method = Method::force;
        CaseRun run(scene);
        run.advance(400);
        positions[skin] = run.position("block1");
        rebuilds[skin] = run.state().broad_phase_runs;
    }
    // Only the features of a first touch may differ, among edges within a tenth of the length floor: 1e-4 m.
    EXPECT_NEAR((positions[0.01] - positions[0.05]).norm(), 0.0, 1e-6);
    EXPECT_NEAR((positions[0.3] - positions[0.05]).norm(), 0.0, 1e-6);
    EXPECT_GT(rebuilds[0.01], 2 * rebuilds[0.3]);
}

TEST(Skin, IsOutrunAfterHalfOfItByMovingOrTurning)
{
    test::BlockPair pair(test::pair_scene(scenes::rectangle({0, 0}, {1, 1}), scenes::rectangle({0, 0}, {1, 1})));
    const std::vector<BlockMotion> then = pair.state.blocks.motion;
    const double half = 0.5 * skin_width(pair.model);
    const IndexRange all{0, pair.state.blocks.size()};
    set_margins(pair.model, pair.state.blocks);
    const auto outrun = [&] { return margin_used(all, pair.model, pair.state.blocks, then) > 1.0; };
    EXPECT_FALSE(outrun());
    pair.motion(pair.a).x += 0.99 * half;
    EXPECT_FALSE(outrun());
    pair.motion(pair.a).x += 0.02 * half;
    EXPECT_TRUE(outrun());
    pair.motion(pair.a).x -= 0.5 * half;
    EXPECT_FALSE(outrun());
    pair.motion(pair.a).angle = 0.6 * half / std::sqrt(0.5);  // the corner is sqrt(1/2) m from the centroid
    EXPECT_TRUE(outrun()) << "moving and turning add up";
    pair.state.blocks.present[pair.a] = 0;
    EXPECT_FALSE(outrun()) << "excavated";
}

TEST(Skin, OfAFastBlockReachesAsFarAsItGoesInManyCycles)
{
    test::BlockPair pair(test::pair_scene(scenes::rectangle({0, 0}, {1, 1}), scenes::rectangle({0, 0}, {1, 1})));
    const double half = 0.5 * skin_width(pair.model), dt = pair.model.time_step;
    const auto margin_at = [&](double speed)
    {
        pair.motion(pair.a).vx = speed;
        set_margins(pair.model, pair.state.blocks);
        return pair.state.blocks.margin[pair.a];
    };
    EXPECT_EQ(margin_at(0.0), half);
    EXPECT_EQ(margin_at(0.5 * half / (64.0 * dt)), half);
    EXPECT_DOUBLE_EQ(margin_at(3.0 * half / (64.0 * dt)), 3.0 * half);
    EXPECT_DOUBLE_EQ(margin_at(1e6), 8.0 * half);
    EXPECT_EQ(margin_at(std::nan("")), half) << "a run that has become unstable ends with its own error";
}

TEST(Boxes, HoldTheTurnedPartsAndHalfTheSkinAndAreEmptyOnceExcavated)
{
    test::BlockPair pair(test::pair_scene(scenes::rectangle({0, 0}, {1, 1}), scenes::rectangle({0, 0}, {1, 1})));
    pair.place(pair.a, {3.0, 4.0}, radians(45.0));
    pair.state.blocks.present[pair.b] = 0;
    set_margins(pair.model, pair.state.blocks);
    std::vector<Box> boxes(2);
    compute_boxes({0, 2}, pair.model, pair.state.blocks, boxes);
    const double reach = std::sqrt(0.5) + 0.5 * skin_width(pair.model);
    EXPECT_NEAR((boxes[pair.a].high - Vec2(3.0 + reach, 4.0 + reach)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((boxes[pair.a].low - Vec2(3.0 - reach, 4.0 - reach)).norm(), 0.0, 1e-12);
    EXPECT_TRUE(is_empty(boxes[pair.b]));
}
}  // namespace
}  // namespace hdem
