#include "core/motion/equilibrium.h"
#include "core/motion/rest.h"
#include "verification/unit/block_pair.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hdem
{
namespace
{
/// update_rest, one cycle at a time, of a block that moves and carries what the test says.
class UpdateRest : public testing::Test
{
  protected:
    UpdateRest() : pair_(test::pair_scene(scenes::rectangle({0, 0}, {1, 1}), scenes::rectangle({0, 0}, {1, 1}))) {}

    bool update(bool check, std::int64_t cycle = rest_every)
    {
        return update_rest({pair_.a, pair_.a + 1}, pair_.model, rule_, check ? cycle : cycle + 1, pair_.state.blocks, ledger_,
                           woken_);
    }
    BlockMotion& motion() { return pair_.motion(pair_.a); }
    BlockForce& force() { return pair_.state.blocks.force[pair_.a]; }
    std::uint8_t& rest() { return pair_.state.blocks.rest[pair_.a]; }
    [[nodiscard]] double mass() const { return pair_.model.mass[pair_.a]; }
    [[nodiscard]] double radius() const { return pair_.model.radius[pair_.a]; }

    test::BlockPair pair_;
    EnergyLedger ledger_;
    std::vector<Index> woken_;
    const RestRule rule_{.leaves_out = true, .quiet_speed = 1e-4, .quiet = 5e-4, .waking = 0.1};
};

TEST_F(UpdateRest, StopsABlockThatWasQuietAtEightChecks)
{
    motion().vx = 0.5 * rule_.quiet_speed;
    force().y = 0.5 * rule_.quiet * mass();
    const double energy = kinetic_energy(pair_.model, pair_.state.blocks, pair_.a);
    for (int k = 1; k < stopped; ++k)
    {
        EXPECT_FALSE(update(true));
        EXPECT_FALSE(update(false));
        EXPECT_EQ(rest(), k) << "only checks count";
    }
    EXPECT_FALSE(update(true)) << "its contacts have to be evaluated at rest first";
    EXPECT_EQ(rest(), stopped);
    EXPECT_EQ(motion().vx, 0.0);
    EXPECT_EQ(ledger_.local_damping, energy);
    EXPECT_TRUE(pair_.state.blocks.takes_part(pair_.a));
    EXPECT_TRUE(update(false));
    EXPECT_EQ(rest(), left_out);
    EXPECT_FALSE(pair_.state.blocks.takes_part(pair_.a));
    EXPECT_FALSE(update(true)) << "nothing changes any more";
}

TEST_F(UpdateRest, BeginsAnewAfterWhatIsNotQuiet)
{
    const auto quiet_after = [&](const auto& disturb)
    {
        motion() = {};
        force() = {};
        rest() = stopped - 1;
        disturb();
        update(true);
        return rest() == stopped;
    };
    EXPECT_TRUE(quiet_after([] {}));
    EXPECT_FALSE(quiet_after([&] { motion().vy = 1.01 * rule_.quiet_speed; }));
    EXPECT_FALSE(quiet_after([&] { motion().w = 1.01 * rule_.quiet_speed / radius(); }));
    EXPECT_FALSE(quiet_after([&] { force().x = 1.01 * rule_.quiet * mass(); }));
    EXPECT_FALSE(quiet_after([&] { force().moment = 1.01 * rule_.quiet * mass() * radius(); }));
    EXPECT_FALSE(quiet_after([&] { force().contacts = contact_force | contact_impulse; }));
    EXPECT_FALSE(quiet_after([&] { motion().vx = std::nan(""); }));
    EXPECT_FALSE(quiet_after([&] { force().x = std::nan(""); }));
}

TEST_F(UpdateRest, WakesInAnyCycleByAForceOrAnImpulse)
{
    const auto woken_by = [&](const auto& disturb)
    {
        motion() = {};
        force() = {};
        rest() = left_out;
        woken_.clear();
        disturb();
        const bool changed = update(false);
        EXPECT_EQ(changed, rest() == 0);
        EXPECT_EQ(woken_, changed ? std::vector<Index>{pair_.a} : std::vector<Index>{});
        return rest() == 0;
    };
    const double limit = rule_.waking * mass();
    EXPECT_FALSE(woken_by([] {}));
    EXPECT_FALSE(woken_by([&] { force().x = 0.99 * limit; }));
    EXPECT_TRUE(woken_by([&] { force().x = 1.01 * limit; }));
    EXPECT_TRUE(woken_by([&] { force().moment = 1.01 * limit * radius(); }));
    EXPECT_TRUE(woken_by([&] { force().contacts = contact_impulse; }));
    EXPECT_TRUE(woken_by([&] { force().y = std::nan(""); }));
}

TEST_F(UpdateRest, LeavesOutOnlyContactsThatAnotherEvaluationWouldNotChange)
{
    pair_.place(pair_.a, {0.0, 0.0}, 0.0);
    pair_.place(pair_.b, {0.2, 0.999}, 0.0);
    pair_.search();
    ASSERT_EQ(pair_.state.contacts.size(), 1);
    State& state = pair_.state;
    BlockContacts list;
    list_block_contacts(state.contacts, state.blocks.size(), list);
    const auto takes_part = [&]
    {
        std::vector<IndexRange> contacts, blocks;
        find_active_contacts({0, 1}, state.blocks, state.contacts, contacts);
        find_active_blocks({0, state.blocks.size()}, list, state.contacts, state.blocks, blocks);
        EXPECT_EQ(contacts.empty(), blocks.empty()) << "what a contact gives acts on its blocks";
        return !contacts.empty();
    };
    std::uint8_t& other = state.blocks.rest[pair_.b];
    rest() = other = left_out;
    state.contacts.regime[0][0] = state.contacts.regime[1][0] = static_cast<std::uint8_t>(Regime::stick);
    EXPECT_FALSE(takes_part());
    for (auto& regime : state.contacts.regime)
    {
        regime[0] = static_cast<std::uint8_t>(Regime::slip);
        EXPECT_TRUE(takes_part()) << "a restart would evaluate it and find it sticking";
        regime[0] = static_cast<std::uint8_t>(Regime::stick);
    }
    state.contacts.stale[0] = 1;
    EXPECT_TRUE(takes_part());
    state.contacts.stale[0] = 0;
    other = stopped;
    EXPECT_TRUE(takes_part()) << "it has not been evaluated at rest yet";
}
}  // namespace
}  // namespace hdem
