#include "core/state/state_hash.h"
#include "verification/unit/case_run.h"

#include <bit>

namespace hdem
{
namespace
{
using test::CaseRun;

/// Resting on each other, sheared, so that every part of the history holds something.
CaseRun settled()
{
    CaseDef scene = scenes::stack(3);
    scene.gravity = {1.0, -9.81};
    return CaseRun(scene, [](const Model&, State&) {});
}

void flip_last_bit(double& value)
{
    value = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1u);
}

TEST(StateHash, SeesTheLastBitOfEveryPoseAndVelocity)
{
    CaseRun run = settled();
    run.advance(500);
    const std::uint64_t hash = run.hash();
    for (double BlockMotion::*member : {&BlockMotion::x, &BlockMotion::y, &BlockMotion::c, &BlockMotion::s, &BlockMotion::vx,
                                        &BlockMotion::vy, &BlockMotion::w, &BlockMotion::angle})
        for (Index i = 0; i < run.model().blocks(); ++i)
        {
            State changed = run.state();
            flip_last_bit(changed.blocks.motion[i].*member);
            EXPECT_NE(state_hash(run.model(), changed), hash) << "block " << i;
        }
}

TEST(StateHash, SeesTheLastBitOfEveryForceAndTheRegimeOfClosedPoints)
{
    CaseRun run = settled();
    run.advance(500);
    const std::uint64_t hash = run.hash();
    ASSERT_EQ(run.state().contacts.size(), 3);
    for (Index i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k)
        {
            State changed = run.state();
            flip_last_bit(changed.contacts.normal_force(k, i));
            EXPECT_NE(state_hash(run.model(), changed), hash);
            changed = run.state();
            flip_last_bit(changed.contacts.shear_force(k, i));
            EXPECT_NE(state_hash(run.model(), changed), hash);
            changed = run.state();
            changed.contacts.regime[k][i] ^= 1u;
            EXPECT_NE(state_hash(run.model(), changed), hash);
        }
}

TEST(StateHash, DoesNotSeeTheOrderOfContactsInMemory)
{
    CaseRun run = settled();
    run.advance(500);
    State permuted = run.state();
    const Index n = permuted.contacts.size();
    for (Index i = 0; i < n; ++i)
        permuted.contacts.put(i, run.state().contacts.get(n - 1 - i));
    EXPECT_EQ(state_hash(run.model(), permuted), run.hash());
}

TEST(StateHash, DoesNotSeeTheSignOfZero)
{
    CaseRun run = settled();
    run.advance(500);
    State changed = run.state();
    const Index ground = run.slot("ground");
    ASSERT_EQ(changed.blocks.motion[ground].vx, 0.0);
    changed.blocks.motion[ground].vx = -0.0;
    EXPECT_EQ(state_hash(run.model(), changed), run.hash());
}

/// Faces that have been found stay until blocks have moved far enough: they decide what an open contact does when it closes.
TEST(StateHash, SeesContactsThatAreOpen)
{
    CaseRun run = settled();
    run.advance(500);
    State changed = run.state();
    const Index n = changed.contacts.size();
    changed.contacts.resize(n + 1);
    Contact open = changed.contacts.get(0);
    open.point = {};
    open.part_b += 1;
    changed.contacts.put(n, open);
    EXPECT_NE(state_hash(run.model(), changed), run.hash());
}

TEST(StateHash, IsTheSameForTheSameRun)
{
    CaseRun one(scenes::pile(10, 4)), other(scenes::pile(10, 4)), longer(scenes::pile(10, 4));
    one.advance(1500);
    other.advance(700);
    other.advance(800);
    longer.advance(1501);
    EXPECT_EQ(one.hash(), other.hash());
    EXPECT_NE(one.hash(), longer.hash());
}

TEST(Contacts, GiveBackWhatWasPut)
{
    Contact contact{.part_a = 1,
                    .part_b = 2,
                    .ref = 3,
                    .inc = 4,
                    .ref_edge = 5,
                    .inc_edge = 6,
                    .law = 7,
                    .moved_limit = 8.0f,
                    .seen = {9.0f, 10.0f, 11.0f, 12.0f},
                    .length_floor = 13.0,
                    .edges = {14, 15, 16, 17, 18, 19, 20, 21, 22},
                    .point = {}};
    contact.point[0] = {.normal_force = 23, .shear_force = 24, .rest_overlap = 25, .regime = Regime::slip};
    contact.point[1] = {.normal_force = 26, .shear_force = 27, .rest_overlap = 28, .regime = Regime::impulse};
    Contacts contacts;
    contacts.resize(2);
    contacts.put(1, contact);
    const Contact back = contacts.get(1);
    EXPECT_EQ(contacts.size(), 2);
    EXPECT_EQ((std::vector<Index>{back.part_a, back.part_b, back.ref, back.inc, back.ref_edge, back.inc_edge, back.law}),
              (std::vector<Index>{1, 2, 3, 4, 5, 6, 7}));
    EXPECT_EQ(back.moved_limit, 8.0f);
    EXPECT_EQ(back.seen, contact.seen);
    EXPECT_EQ(back.length_floor, 13.0);
    const EdgePair& e = back.edges;
    EXPECT_EQ((std::vector<double>{e.tx, e.ty, e.start_t, e.start_m, e.length, e.p0x, e.p0y, e.p1x, e.p1y}),
              (std::vector<double>{14, 15, 16, 17, 18, 19, 20, 21, 22}));
    for (int k = 0; k < 2; ++k)
    {
        EXPECT_EQ(back.point[k].normal_force, contact.point[k].normal_force);
        EXPECT_EQ(back.point[k].shear_force, contact.point[k].shear_force);
        EXPECT_EQ(back.point[k].rest_overlap, contact.point[k].rest_overlap);
        EXPECT_EQ(back.point[k].regime, contact.point[k].regime);
    }
}
}  // namespace
}  // namespace hdem
