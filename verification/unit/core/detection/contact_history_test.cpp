#include "verification/unit/block_pair.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::BlockPair;
using test::CaseRun;

const Polygon unit_square = rectangle({-0.5, -0.5}, {0.5, 0.5});

PointHistory loaded(double normal, double shear, Regime regime)
{
    return {.normal_force = normal, .shear_force = shear, .regime = regime};
}

/// Force on block b that the contact's history stands for, and its moment about b's centroid.
struct Carried
{
    Vec2 force = {0.0, 0.0};
    double normal = 0.0;
};

Carried carried_by_b(const BlockPair& pair, const Contact& contact)
{
    const EdgeTouch touch = pair.touch(contact);
    const Vec2 t(touch.ex, touch.ey);
    Carried sum;
    for (const PointHistory& p : contact.point)
    {
        sum.force += p.shear_force * t - p.normal_force * turned_left(t);
        sum.normal += p.normal_force;
    }
    if (contact.inc != pair.b)
        sum.force = -sum.force;
    return sum;
}

/// Upper square b standing half off the lower one, a: each block's face is cut by a corner of the other.
BlockPair staggered(double tilt)
{
    BlockPair pair(test::pair_scene(unit_square, unit_square));
    pair.place(pair.a, {0, 0}, 0.0);
    pair.place(pair.b, {0.5, 1.0 - 1e-3}, tilt);
    return pair;
}

TEST(ContactHistory, FollowsASwapOfTheReferenceEdge)
{
    BlockPair pair = staggered(0.0);
    pair.search();
    ASSERT_EQ(pair.state.contacts.size(), 1);
    Contact contact = pair.state.contacts.get(0);
    const Index first_ref = contact.ref;
    contact.point = {loaded(1000.0, 300.0, Regime::stick), loaded(2000.0, 500.0, Regime::slip)};
    const Carried before = carried_by_b(pair, contact);
    // Tilted either way, one of the two faces has clearly less overlap: one of the ways must swap.
    bool swapped = false;
    for (const double tilt : {2e-3, -2e-3})
    {
        Contact turned = contact;
        pair.place(pair.b, {0.5, 1.0 - 1e-3}, tilt);
        find_features(pair.model, pair.state.blocks, turned);
        const Carried after = carried_by_b(pair, turned);
        swapped = swapped || turned.ref != first_ref;
        EXPECT_NEAR(after.normal, before.normal, 1e-9);
        // The edge turned by at most 2e-3 rad.
        EXPECT_NEAR((after.force - before.force).norm(), 0.0, 3e-3 * before.force.norm());
        EXPECT_EQ(std::max(turned.point[0].regime, turned.point[1].regime), Regime::slip);
    }
    EXPECT_TRUE(swapped) << "the test must see a swap";
}

TEST(ContactHistory, StaysWithItsEndOfTheContact)
{
    BlockPair pair = staggered(0.0);
    pair.search();
    Contact contact = pair.state.contacts.get(0);
    contact.point = {loaded(1000.0, 0.0, Regime::stick), loaded(2000.0, 0.0, Regime::stick)};
    const auto moment_about_a = [&](const Contact& c)
    {
        const EdgeTouch touch = pair.touch(c);
        double moment = 0.0;
        for (int k = 0; k < 2; ++k)
            moment += c.point[k].normal_force * (c.ref == pair.a ? touch.point[k].ref_t : -touch.point[k].inc_t);
        return moment;
    };
    const double before = moment_about_a(contact);
    for (const double tilt : {2e-3, -2e-3})
    {
        Contact turned = contact;
        pair.place(pair.b, {0.5, 1.0 - 1e-3}, tilt);
        find_features(pair.model, pair.state.blocks, turned);
        EXPECT_NEAR(moment_about_a(turned), before, 5e-3 * 3000.0) << "points at most 3 mm from where they were";
    }
}

TEST(ContactHistory, KeepsTheReferenceEdgeWithinAMargin)
{
    BlockPair pair = staggered(0.0);
    pair.search();
    Contact contact = pair.state.contacts.get(0);
    const Index edge = contact.ref_edge;
    for (const double tilt : {1e-7, -1e-7, 3e-6, -3e-6})
    {
        pair.place(pair.b, {0.5, 1.0 - 1e-3}, tilt);
        find_features(pair.model, pair.state.blocks, contact);
        EXPECT_EQ(contact.ref_edge, edge) << "tilt " << tilt;
    }
}

TEST(ContactHistory, DropsTheShearForceAcrossACorner)
{
    // A slab whose upper right corner is cut off at 45 degrees.
    BlockPair pair(test::pair_scene({{-2, -1}, {2, -1}, {2, -0.5}, {1.5, 0}, {-2, 0}}, unit_square));
    const Vec2 origin = pair.model.origin;
    pair.place(pair.b, Vec2(0.5, 0.5 - 1e-3) - origin, 0.0);
    pair.search();
    ASSERT_EQ(pair.state.contacts.size(), 1);
    Contact contact = pair.state.contacts.get(0);
    const Index on_top = contact.ref_edge;
    contact.point = {loaded(1000.0, 300.0, Regime::stick), loaded(1000.0, 300.0, Regime::stick)};
    pair.place(pair.b, Vec2(1.75 + 0.5 - 1e-3, -0.25 + 0.5 - 1e-3) - origin, 0.0);  // its lower left corner in the cut
    find_features(pair.model, pair.state.blocks, contact);
    ASSERT_NE(contact.ref_edge, on_top);
    EXPECT_EQ(contact.point[0].shear_force, 0.0);
    EXPECT_EQ(contact.point[1].shear_force, 0.0);
    EXPECT_EQ(contact.point[0].normal_force + contact.point[1].normal_force, 2000.0);
}

/// A block far away flies and makes the broad phase run; the resting block's shear force must not notice.
TEST(ContactHistory, OutlivesARebuild)
{
    CaseDef scene = scenes::block_on_ground();
    scenes::add_block(scene, "flyer", rectangle({20, 20}, {21, 21})).velocity = {10.0, 0.0};
    scene.loads = {{.blocks = {"block"}, .force = {5000.0, 0.0}}};
    scene.contact.method = Method::force;
    CaseRun run(scene);
    run.advance(3000);
    const double before = run.forces_between("ground", "block").y();
    EXPECT_NEAR(std::abs(before), 5000.0, 5.0) << "local damping has brought it to rest";
    const std::int64_t rebuilds = run.state().broad_phase_runs;
    run.advance(500);
    ASSERT_GT(run.state().broad_phase_runs, rebuilds + 3);
    EXPECT_NEAR(run.forces_between("ground", "block").y(), before, 1.0);
}

// ---- recycled features ----------------------------------------------------------------------------------------------

double greatest_difference(CaseDef scene, std::int64_t cycles, std::int64_t& searches)
{
    scene.contact.recycling_distance = 1e-4;
    CaseRun recycled(scene);
    scene.contact.recycling_distance = 0.0;
    CaseRun searched(scene);
    double most = 0.0;
    for (std::int64_t i = 0; i < cycles; i += 50)
    {
        recycled.advance(50);
        searched.advance(50);
        most = std::max(most, (recycled.position("block") - searched.position("block")).norm());
        most = std::max(most, std::abs(recycled.motion("block").angle - searched.motion("block").angle));
    }
    searches = searched.state().feature_searches - recycled.state().feature_searches;
    return most;
}

CaseDef moving_block(const Vec2& velocity, double angular_velocity, double tilt)
{
    CaseDef scene = scenes::block_on_ground();
    const double c = std::cos(tilt), s = std::sin(tilt);
    for (Vec2& p : scene.blocks[1].polygon)
    {
        const Vec2 arm = p - Vec2(0.5, 0.0);  // about its right corner
        p = Vec2(0.5, 0.0) + Vec2(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y());
    }
    scene.blocks[1].velocity = velocity;
    scene.blocks[1].angular_velocity = angular_velocity;
    scene.time.step = 5e-5;
    return scene;
}

TEST(RecycledFeatures, SlideABlockAsIfSearchedEveryCycle)
{
    std::int64_t saved = 0;
    EXPECT_LT(greatest_difference(moving_block({1.0, 0.0}, 0.0, 0.0), 4000, saved), 1e-12);  // the same features: round-off
    EXPECT_GT(saved, 1000) << "searches left out";
}

TEST(RecycledFeatures, RockABlockAsIfSearchedEveryCycle)
{
    std::int64_t saved = 0;
    CaseDef scene = moving_block({0.0, 0.0}, 0.0, -0.05);
    scene.contact.method = Method::force;
    EXPECT_LT(greatest_difference(scene, 8000, saved), 1e-6) << "features change a little later: 1e-4 of the size";
    EXPECT_GT(saved, 1000);
}

TEST(RecycledFeatures, TurnABlockOverAsIfSearchedEveryCycle)
{
    std::int64_t saved = 0;
    CaseDef scene = moving_block({0.0, 0.0}, -3.0, -0.05);
    scene.joints[0].friction_angle_deg = 45.0;
    EXPECT_LT(greatest_difference(scene, 12000, saved), 1e-3) << "it falls over an edge, whose change comes a little later";
}
}  // namespace
}  // namespace hdem
