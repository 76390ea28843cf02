#include "core/contact/impulse_law.h"
#include "parallel/stages.h"
#include "verification/unit/block_pair.h"
#include "verification/unit/case_run.h"
#include "verification/unit/core/contact/impulse_scenes.h"

#include <rapidcheck/gtest.h>

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;
using test::ContactInvariants;
using test::number;
using test::two_blocks;
using test::without_gravity;

class Impact : public ContactInvariants
{
};

TEST_F(Impact, OnTheGroundReboundsWithRestitutionTimesItsSpeed)
{
    for (const double e : {0.0, 0.1, 0.5, 1.0})
    {
        CaseDef scene = without_gravity(scenes::block_on_ground(), e);
        scene.blocks[1].velocity = {0.0, -2.0};
        CaseRun run(scene);
        run.advance(1);
        // Two points solved one after another: fifty sweeps shrink the error by more than 4 each.
        EXPECT_NEAR(run.velocity("block").y(), 2.0 * e, 1e-12) << "e = " << e;
        EXPECT_NEAR(run.motion("block").w, 0.0, 1e-12);
    }
}

TEST_F(Impact, OfTwoEqualBlocksExchangesTheirVelocitiesWithoutLoss)
{
    CaseRun run(two_blocks(1.0));
    expect_momentum_kept(run, 1);
    EXPECT_NEAR(run.velocity("left").x(), -1.0, 1e-12);
    EXPECT_NEAR(run.velocity("right").x(), 2.0, 1e-12);
}

TEST_F(Impact, OfTwoBlocksReversesTheirRelativeVelocityByTheRestitution)
{
    for (const double e : {0.0, 0.3, 0.8})
    {
        CaseRun run(two_blocks(e));
        expect_momentum_kept(run, 1);
        EXPECT_NEAR(run.velocity("right").x() - run.velocity("left").x(), 3.0 * e, 1e-12);
        EXPECT_NEAR(run.velocity("right").x() + run.velocity("left").x(), 1.0, 1e-12);
    }
}

TEST_F(Impact, OfAJointWithItsOwnRestitutionUsesThat)
{
    CaseDef scene = two_blocks(0.1);
    scene.joints[0].restitution = 0.6;
    CaseRun run(scene);
    run.advance(1);
    EXPECT_NEAR(run.velocity("right").x() - run.velocity("left").x(), 1.8, 1e-12);
}

/// A unit square that lands on one corner on frictionless ground: J = m_c (1 + e) v with m_c = m / (1 + 6 x^2), by hand.
TEST_F(Impact, OnACornerSpinsTheBlockByItsMomentOfInertia)
{
    CaseDef scene = without_gravity(scenes::block_on_ground(), 0.5);
    scene.joints[0].friction_angle_deg = 0.0;
    const double angle = 0.2, c = std::cos(angle), s = std::sin(angle);
    for (Vec2& p : scene.blocks[1].polygon)
    {
        const Vec2 arm = p - Vec2(-0.5, 0.0);
        p = Vec2(c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y());
    }
    scene.blocks[1].velocity = {0.0, -2.0};
    CaseRun run(scene);
    run.advance(1);
    const double x = -(0.5 * c - 0.5 * s);  // of the corner from the centroid
    const double mass = 2700.0, inertia = mass / 6.0;
    const double impulse = 1.5 * 2.0 / (1.0 / mass + x * x / inertia);
    EXPECT_NEAR(run.velocity("block").y(), -2.0 + impulse / mass, 1e-9);
    EXPECT_NEAR(run.motion("block").w, x * impulse / inertia, 1e-9);
}

TEST_F(Impact, WithFrictionCarriesAtMostItsTangentAndCohesion)
{
    CaseDef scene = without_gravity(scenes::block_on_ground(4.0, 0.1), 0.0);
    scene.joints[0].friction_angle_deg = 20.0;
    scene.joints[0].cohesion = 1e5;
    scene.blocks[1].velocity = {3.0, -1.0};
    CaseRun run(scene);
    run.advance(1);
    const Vec2 force = run.forces_between("ground", "block");
    const double dt = run.model().time_step;
    const double most = force.x() * std::tan(radians(20.0)) + 1e5 * 4.0;
    EXPECT_NEAR(std::abs(force.y()), most, 1e-9 * most) << "it slides: the limit is reached";
    // A flat plate is hardly tipped by friction; the momentum it loses is the impulse the contact reports.
    EXPECT_NEAR(1080.0 * (3.0 - run.velocity("block").x()), most * dt, 1e-9 * most * dt);
    EXPECT_NEAR(force.x() * dt, 1080.0 * 1.0, 0.05 * 1080.0);
}

TEST_F(Impact, WithMuchFrictionSticks)
{
    CaseDef scene = without_gravity(scenes::block_on_ground(4.0, 0.1), 0.0);
    scene.joints[0].friction_angle_deg = 60.0;
    scene.blocks[1].velocity = {0.5, -1.0};
    CaseRun run(scene);
    run.advance(1);
    EXPECT_NEAR(run.velocity("block").x(), 0.0, 1e-9) << "of the centroid, 5 cm above the face: it does not turn";
}

/// Frictionless at any restitution, with friction at none: kinetic energy never grows; momentum is kept.
RC_GTEST_PROP(RandomImpact, KeepsMomentumAndAddsNoKineticEnergy, ())
{
    const bool rough = *rc::gen::inRange(0, 2) == 1;
    CaseDef scene = without_gravity(test::pair_scene(test::random_convex(), test::random_convex()), rough ? 0.0 : number(0.0, 1.0));
    scene.joints[0].friction_angle_deg = rough ? number(0.0, 60.0) : 0.0;
    scene.blocks[1].velocity = {0.0, 0.0};
    CaseRun run(scene,
                [](const Model& model, State& state)
                {
                    // One beside the other, touching within a hair, moving towards each other.
                    const Index a = model.find_block("a"), b = model.find_block("b");
                    Contact contact{.part_a = 0, .part_b = 1};
                    double near = 0.0, far = 10.0;
                    const double angle = number(0.0, 6.28);
                    const double x = state.blocks.motion[a].x;
                    for (int i = 0; i < 60; ++i)
                    {
                        const double middle = 0.5 * (near + far);
                        state.blocks.motion[b].x = x + middle * std::cos(angle);
                        state.blocks.motion[b].y = state.blocks.motion[a].y + middle * std::sin(angle);
                        contact.ref_edge = no_index;
                        (find_features(model, state.blocks, contact) < -1e-5 ? near : far) = middle;
                    }
                    BlockMotion& m = state.blocks.motion[b];
                    m.vx = -std::cos(angle) + number(-0.3, 0.3);
                    m.vy = -std::sin(angle) + number(-0.3, 0.3);
                    m.w = number(-1.0, 1.0);
                });
    const double before = run.simulation.equilibrium().kinetic_energy;
    const test::Momentum momentum = run.momentum();
    run.advance(1);
    RC_ASSERT(run.simulation.equilibrium().kinetic_energy <= before * (1.0 + 1e-12));
    RC_ASSERT((run.momentum().linear - momentum.linear).norm() <= 1e-12 * momentum.linear.norm());
}

TEST_F(Impact, LeavesARestingBlockAtRestUnderGravity)
{
    for (const double e : {0.0, 0.5, 1.0})
    {
        CaseDef scene = scenes::block_on_ground();
        scene.contact.method = Method::impulse;
        scene.contact.restitution = e;
        CaseRun run(scene);
        run.advance(2000);
        const double gravity_step = 9.81 * run.model().time_step;
        EXPECT_LT(run.velocity("block").norm(), 2.0 * gravity_step) << "e = " << e;
        EXPECT_LT(run.displacement("block").norm(), 2e-6);
        if (e == 1.0)
            continue;  // without any loss it rattles within a step of gravity
        EXPECT_NEAR(run.forces_between("ground", "block").x(), 2700.0 * 9.81, 1e-3 * 2700.0 * 9.81)
            << "J / dt is the weight, Eq. (29)";
    }
}

/// Impulses go on from those of the cycle before, so that a stack at rest finds its forces even with one sweep a cycle.
TEST(ImpulseStack, CarriesItsWeightWithAnyNumberOfSweeps)
{
    for (const int sweeps : {1, 10, 100})
    {
        CaseDef scene = scenes::stack(5);
        scene.contact.method = Method::impulse;
        scene.contact.impulse_sweeps = sweeps;
        CaseRun run(scene);
        run.advance(500);
        const double weight = 5.0 * 2700.0 * 9.81;
        EXPECT_NEAR(run.forces_between("ground", "block1").x() / weight, 1.0, 1e-9) << sweeps << " sweeps";
    }
}

/// A light block under one of a million times its mass, both by impulses.
CaseRun heavy_on_light(double speed)
{
    CaseDef scene = scenes::stack(2);
    scene.materials.push_back({.name = "light", .density = 2700.0 * 1e-6});
    scene.blocks[1].material = "light";
    scene.contact.method = Method::impulse;
    scene.time.step = 3e-6;
    return CaseRun(scene, [&](const Model& model, State& state) { state.blocks.motion[model.find_block("block2")].vy = -speed; });
}

/// Impulses begin with those of the cycle before. After an impact, or where masses differ much, these may be far too great, and the sweeps
/// do not take all of it back: without a limit the heavy block is thrown up and falls, again and again.
TEST(ImpulseStack, LetsAHeavyBlockRestOnALightOne)
{
    CaseRun run = heavy_on_light(0.0);
    run.advance(200000);
    EXPECT_LE(run.velocity("block2").y(), 30.0 * 9.81 * run.model().time_step) << "it was thrown up";
    EXPECT_LE(run.displacement("block2").y(), 1e-6);
}

/// It would hop from one cycle to the next at g dt / (1 + R) for ever.
TEST(ImpulseStack, ABlockThatFallsOnAnotherComesToRest)
{
    for (const double restitution : {0.1, 0.5, 0.9})
    {
        CaseDef scene = scenes::empty_scene();
        scenes::add_fixed_block(scene, "ground", scenes::rectangle({-30, -9}, {30, 0}));
        scenes::add_block(scene, "stands", scenes::rectangle({-4.6, 0.0}, {4.6, 5.9}));
        scenes::add_block(scene, "falls", scenes::rectangle({-4.1, 6.5}, {4.1, 17.4}));
        scene.contact.method = Method::impulse;
        scene.contact.restitution = restitution;
        scene.time.step = 3e-4;
        scene.stages = {{.name = "rest", .until_converged = true, .max_cycles = 100'000}};
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state));
        EXPECT_TRUE(run_stages(simulation, {}).front().at_rest) << restitution;
    }
}

TEST(ImpulseStack, GainsNoEnergyAfterAnImpact)
{
    constexpr double speed = 2.0;
    CaseRun run = heavy_on_light(speed);
    const double fall = 0.5 * 2700.0 * speed * speed;
    double least = run.energy();
    for (int cycle = 0; cycle < 2000; ++cycle)
    {
        run.advance();
        ASSERT_LE(run.energy() - least, 2e-5 * fall) << "cycle " << cycle;
        least = std::min(least, run.energy());
    }
}

/// Neither block can turn: which of a face's two points carries what is not determined, and is shared as before.
TEST(ImpulseFace, KeepsItsLoadOnBothEndsWhenTheBlockCannotTurn)
{
    CaseDef scene = scenes::block_on_ground();
    scene.blocks[1].fix_rotation = true;
    scene.contact.method = Method::impulse;
    CaseRun run(scene);
    run.advance(10);
    const Contacts& contacts = run.simulation.state().contacts;
    ASSERT_EQ(contacts.size(), 1);
    for (int k = 0; k < 2; ++k)
        EXPECT_NEAR(contacts.normal_force(k, 0), 0.5 * 2700.0 * 9.81, 1e-9);
}

/// A block that turns about its fixed centroid: the end of its face that goes into the ground stops it, in the first cycle, and throws it back unless the other end is on
/// the ground too. Ends on both sides of the axis, one right below it, and both on one side.
TEST(ImpulseFace, OfABlockThatOnlyTurnsStopsIt)
{
    for (const double left : {-2.0, 0.0, 0.1})
        for (const double e : {0.0, 0.5})
            for (const bool is_mirrored : {false, true})
            {
                CaseDef scene = without_gravity(scenes::block_on_ground(), e);
                const double sense = is_mirrored ? -1.0 : 1.0;
                scene.joints[0].friction_angle_deg = 0.0;
                scene.blocks[0].polygon = is_mirrored ? rectangle({-3.0, -1.0}, {-left, 0.0}) : rectangle({left, -1.0}, {3.0, 0.0});
                scene.blocks[1].fix_x = scene.blocks[1].fix_y = true;
                scene.blocks[1].angular_velocity = -sense;
                CaseRun run(scene);
                run.advance(1);
                EXPECT_NEAR(run.motion("block").w, left < 0.0 ? 0.0 : e * sense, 1e-12) << left << ", " << e;
            }
}

/// A block that comes down under gravity, met by the ground a share of a cycle after it has touched it, flies on as if it had been turned there and then.
TEST_F(Impact, LetsABlockFlyOnFromWhereItHit)
{
    for (const double share : {0.05, 0.4, 0.95})
        for (const double e : {0.0, 0.5, 1.0})
        {
            CaseDef scene = without_gravity(scenes::block_on_ground(), e);
            scene.gravity = Vec2(0.0, -9.81);
            scene.contact.allowed_overlap = 0.0;
            const double speed = 2.0;
            scene.blocks[1].velocity = {0.0, -speed};
            CaseRun run(scene, [&](const Model& model, State& state)
                        { state.blocks.motion[model.find_block("block")].y -= share * speed * model.time_step; });
            const double dt = run.model().time_step;
            const double after = std::max(0.0, e * speed - 9.81 * dt);
            run.advance(1);
            EXPECT_NEAR(run.velocity("block").y(), after, 1e-12) << e;
            EXPECT_NEAR(run.displacement("block").y() - share * speed * dt, after * (1.0 + share) * dt, 1e-15)
                << e << ", " << share;
        }
}
/// Correcting the overlap of one corner lifts the other one, where the block is tall. It must not hop from corner to corner for ever.
TEST(ImpulseLaw, BringsATallBlockThatFallsToRest)
{
    for (const double step : {3e-4, 5e-4, 7.18e-4, 1e-3})
        for (const double restitution : {0.0, 0.3, 0.5})
        {
            CaseDef scene = scenes::empty_scene();
            scene.contact.method = Method::impulse;
            scene.time.step = step;
            scene.joints[0].restitution = restitution;
            scenes::add_fixed_block(scene, "ground", scenes::rectangle({-5.0, -1.0}, {5.0, 0.0}));
            scenes::add_block(scene, "tall", {{0, 0.001}, {0.755, 0.021}, {0.7176, 1.4326}, {-0.0374, 1.4126}});
            scene.stages = {{.name = "fall", .until_converged = true, .max_cycles = 4000}};
            hdem::Setup setup = build_model(scene);
            Simulation simulation(std::move(setup.model), std::move(setup.state));
            EXPECT_TRUE(run_stages(simulation, {}).back().at_rest) << step << ", " << restitution;
        }
}
}  // namespace
}  // namespace hdem
