#include "core/contact/block_forces.h"
#include "core/energy_ledger.h"
#include "core/motion/flight.h"
#include "core/motion/step_control.h"
#include "verification/unit/case_run.h"

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;

constexpr double dt = 5e-5;

/// A block 3 m over the ground; one that slides without friction, and counts as standing rock, keeps the given step.
CaseDef fall_beside_moving_rock()
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "ground", rectangle({-3, -1}, {9, 0}));
    scenes::add_block(scene, "block", rectangle({-0.5, 3.0}, {0.5, 4.0}));
    scenes::add_block(scene, "rock", rectangle({2.0, 0.0}, {3.0, 1.0})).velocity = {0.1, 0.0};
    scene.joints[0].friction_angle_deg = 0.0;
    scene.time.step = dt;
    scene.contact.restitution = 0.1;
    scene.convergence.loose_distance = 0.1;
    scene.stages = {{.name = "fall", .until_converged = true, .max_cycles = 100'000}};
    return scene;
}

class FlyAhead : public testing::Test
{
  protected:
    FlyAhead() : run_(fall_beside_moving_rock()), state_(run_.state()), block_(run_.slot("block"))
    {
        state_.blocks.motion[block_].vx = 1.0;
        state_.blocks.motion[block_].vy = -2.0;
        state_.blocks.motion[block_].w = 0.3;
        state_.blocks.margin[block_] = 0.5;
        state_.blocks.reference_position[block_].y() += 0.2;
    }

    double fly() { return fly_ahead({block_}, 0.1, run_.model(), state_.blocks, ledger_); }
    BlockMotion& motion() { return state_.blocks.motion[block_]; }

    CaseRun run_;
    State state_;
    Index block_;
    EnergyLedger ledger_;
};

TEST_F(FlyAhead, GoesWhereCyclesWouldTakeIt)
{
    BlockMotion m = motion();
    const BlockMotion start = m;
    const double used = fly();
    int steps = 0;
    while (m.vy > motion().vy + 1e-9)
    {
        m.vy -= 9.81 * dt;
        m.x += m.vx * dt;
        m.y += m.vy * dt;
        m.angle += m.w * dt;
        ++steps;
    }
    EXPECT_GT(steps, 100);
    EXPECT_NEAR(motion().vy, m.vy, 1e-12);
    EXPECT_NEAR(motion().x, m.x, 1e-12);
    EXPECT_NEAR(motion().y, m.y, 1e-12);
    EXPECT_NEAR(motion().angle, m.angle, 1e-12);
    EXPECT_NEAR(motion().c, std::cos(m.angle), 1e-12);
    EXPECT_NEAR(motion().s, std::sin(m.angle), 1e-12);
    EXPECT_EQ(motion().w, start.w);
    EXPECT_LE(used, flight_share);
    EXPECT_GT(used, 0.9 * flight_share);
}

TEST_F(FlyAhead, BooksTheWorkOfItsWeight)
{
    const double before = kinetic_energy(run_.model(), state_.blocks, block_);
    fly();
    EXPECT_NEAR(ledger_.gravity_work, kinetic_energy(run_.model(), state_.blocks, block_) - before, 1e-9);
    EXPECT_GT(ledger_.gravity_work, 0.0);
}

TEST_F(FlyAhead, GoesStepByStepWhereItsMarginIsShort)
{
    const BlockMotion start = motion();
    state_.blocks.margin[block_] = 15.0 * 2.4 * dt;
    EXPECT_EQ(fly(), 0.0);
    EXPECT_EQ(motion().y, start.y);
}

TEST_F(FlyAhead, IsForLooseBlocks)
{
    const BlockMotion start = motion();
    state_.blocks.reference_position[block_] = {start.x, start.y + 0.05};
    EXPECT_EQ(fly(), 0.0);
    EXPECT_EQ(motion().y, start.y);
}

TEST_F(FlyAhead, IsForFreeBlocksWithNothingNear)
{
    std::vector<Index> flying;
    const auto find = [&]
    {
        BlockContacts list;
        list_block_contacts(state_.contacts, state_.blocks.size(), list);
        find_flying({0, state_.blocks.size()}, list, state_.blocks, flying);
        return flying;
    };
    EXPECT_EQ(find(), std::vector<Index>{block_});
    state_.blocks.inertia[block_].inverse_mass_x = 0.0;
    EXPECT_TRUE(find().empty());
}

TEST(Flight, TakesFewCyclesWhileRockMoves)
{
    CaseRun run(fall_beside_moving_rock());
    const double fall = std::sqrt(2.0 * 3.0 / 9.81);
    double fastest = 0.0, worst = 0.0;
    while (run.displacement("block").y() > -2.999 && run.state().cycle < 100'000)
    {
        run.advance();
        fastest = std::max(fastest, -run.velocity("block").y());
        worst = std::max(worst, std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))));
        ASSERT_EQ(run.state().blocks.step.next, dt);
    }
    EXPECT_LT(static_cast<double>(run.state().cycle), 0.3 * fall / dt);
    EXPECT_NEAR(fastest, std::sqrt(2.0 * 9.81 * 3.0), 0.005);
    EXPECT_LT(worst, 1e-9);
    EXPECT_NEAR(run.displacement("rock").x(), 0.1 * run.state().time, 1e-6);
}

TEST(Flight, KeepsTheClockWhereNothingElseMoves)
{
    CaseDef scene = fall_beside_moving_rock();
    scene.blocks.pop_back();
    scene.convergence.loose_distance = 0.01;
    CaseRun run(scene);
    while (run.displacement("block").y() > -2.999 && run.state().cycle < 100'000)
        run.advance();
    EXPECT_NEAR(run.state().time, std::sqrt(2.0 * 3.0 / 9.81), 0.001);
}

TEST(Flight, IsTheSameOnAnyNumberOfThreadsAndAfterARestart)
{
    CaseRun one(fall_beside_moving_rock(), 1), three(fall_beside_moving_rock(), 3);
    one.advance(3000);
    ASSERT_TRUE(one.state().flies_ahead);
    Simulation restarted(one.model(), one.state(), 2);
    one.advance(900);
    restarted.advance(900);
    three.advance(3900);
    EXPECT_EQ(state_hash(restarted.model(), restarted.state()), one.hash());
    EXPECT_EQ(three.hash(), one.hash());
    EXPECT_EQ(three.state().ledger.gravity_work, one.state().ledger.gravity_work);
}

TEST(Flight, IsNotForStagesOfACertainDuration)
{
    CaseDef scene = fall_beside_moving_rock();
    scene.stages = {{.name = "fall", .cycles = 1000}};
    CaseRun run(scene);
    run.advance(1000);
    EXPECT_FALSE(run.state().flies_ahead);
    EXPECT_NEAR(run.velocity("block").y(), -9.81 * 1000 * dt, 1e-9);
}
}  // namespace
}  // namespace hdem
