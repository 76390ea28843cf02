#include "verification/unit/case_run.h"

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;
using test::ContactInvariants;

/// Two unit blocks in free flight towards each other, hitting off centre.
CaseDef off_centre(Method method)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "left", rectangle({-1, 0}, {0, 1}));
    scenes::add_block(scene, "right", rectangle({0.001, 0.4}, {1.001, 1.4}));
    scene.blocks[0].velocity = {1.0, 0.2};
    scene.blocks[0].angular_velocity = 0.1;
    scene.blocks[1].velocity = {-1.0, -0.1};
    scene.gravity = {0.0, 0.0};
    scene.contact.method = method;
    scene.contact.correction_fraction = 0.0;  // which moves blocks without velocity, and so the arm of their momentum
    scene.damping.preset = DampingPreset::dynamic;
    return scene;
}

class EveryMethod : public ContactInvariants, public testing::WithParamInterface<Method>
{
};

TEST_P(EveryMethod, KeepsMomentumInAnOffCentreImpact)
{
    CaseRun run(off_centre(GetParam()));
    const Vec2 before = run.velocity("left");
    // The force method adds and takes away some hundred forces of which only a part remains.
    const double share = GetParam() == Method::force ? 1e-11 : 1e-13;
    expect_momentum_kept(run, 3000, share);
    EXPECT_GT((run.velocity("left") - before).norm(), 0.1) << "they have met";
}

TEST_P(EveryMethod, GivesOppositeForcesToTheTwoBlocks)
{
    CaseDef scene = scenes::stack(3);
    scene.contact.method = GetParam();
    scene.blocks[2].velocity = {0.3, -0.2};
    scene.blocks[3].velocity = {-0.1, -0.5};
    CaseRun run(scene);
    for (int i = 0; i < 20; ++i)
    {
        expect_action_is_reaction(run);
        run.advance(20);
    }
    EXPECT_GT(run.simulation.count_contacts().closed(), 0);
}

TEST_P(EveryMethod, GivesOppositeForcesInAPile)
{
    CaseDef scene = scenes::pile(12, 4);
    scene.contact.method = GetParam();
    CaseRun run(scene);
    run.advance(8000);
    expect_action_is_reaction(run);
    EXPECT_GT(run.simulation.contact_point_updates(), 1000);
}

TEST_P(EveryMethod, AddsNoEnergyInAFallWithFriction)
{
    CaseDef scene = scenes::block_on_ground();
    for (Vec2& p : scene.blocks[1].polygon)
        p.y() += 0.01;
    scene.blocks[1].velocity = {0.5, 0.0};
    scene.contact.method = GetParam();
    scene.damping.preset = DampingPreset::dynamic;
    CaseRun run(scene);
    // Weight times the fall of one step at 0.7 m/s: energies are taken with the velocity half a step off the position.
    const double tolerance = 2700.0 * 9.81 * 0.7 * run.model().time_step;
    // A spring adds its force times such a step, too: 7e9 N/m times the deflection of a 0.44 m/s impact, 2.7e-4 m.
    const double spring = GetParam() == Method::impulse ? 0.0 : 7e9 * 2.8e-4 * 0.44 * run.model().time_step;
    expect_no_energy_without_work(run, 3000, tolerance + spring);
    expect_ledger_closed(run);
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod, testing::Values(Method::force, Method::impulse, Method::hybrid),
                         [](const auto& method) {
                             return std::string(method.param == Method::force
                                                    ? "Force"
                                                    : (method.param == Method::impulse ? "Impulse" : "Hybrid"));
                         });

// ---- force method against closed forms ------------------------------------------------------------------------------

TEST(BlockOnGround, RestsAtItsStaticDeflection)
{
    CaseDef scene = scenes::block_on_ground();
    scene.contact.method = Method::force;
    CaseRun run(scene);
    run.advance(3000);
    const double weight = 2700.0 * 9.81;
    EXPECT_NEAR(run.forces_between("ground", "block").x(), weight, 1e-6 * weight);  // local damping leaves the exact static force
    EXPECT_NEAR(run.displacement("block").y(), -weight / 7e9, 1e-6 * weight / 7e9);
    EXPECT_NEAR(run.motion("block").angle, 0.0, 1e-12);
}

TEST(BlockOnGround, DoesNotDependOnWhereTheOriginIs)
{
    // Offsets that doubles hold exactly beside the polygons' coordinates.
    for (const Vec2& by : {Vec2(1e6, -1e6), Vec2(0.0, 123456.0)})
    {
        CaseRun here(scenes::block_on_ground());
        CaseRun there(scenes::moved(scenes::block_on_ground(), by));
        here.advance(500);
        there.advance(500);
        EXPECT_NEAR((here.displacement("block") - there.displacement("block")).norm(), 0.0, 1e-14) << "round-off of metres";
        EXPECT_NEAR((here.velocity("block") - there.velocity("block")).norm(), 0.0, 1e-9);
    }
}

/// The same scene turned, mirrored: everything turns or mirrors along.
TEST(Pile, TurnsWithItsSceneAndWithGravity)
{
    CaseDef scene = scenes::pile(6, 3);
    scene.damping.preset = DampingPreset::dynamic;  // local damping acts on components along the axes, which do not turn along
    CaseRun here(scene), turned(scenes::turned(scene, 37.0)), mirrored(scenes::mirrored(scene));
    for (CaseRun* run : {&here, &turned, &mirrored})
        run->advance(5000);
    EXPECT_GT(here.simulation.contact_point_updates(), 100);
    const Vec2 d(std::cos(radians(37.0)), std::sin(radians(37.0)));
    for (int i = 1; i <= 6; ++i)
    {
        const std::string name = "block" + std::to_string(i);
        const Vec2 u = here.displacement(name);
        EXPECT_NEAR((turned.displacement(name) - (u.x() * d + u.y() * turned_left(d))).norm(), 0.0, 1e-9) << name;
        EXPECT_NEAR((mirrored.displacement(name) - Vec2(-u.x(), u.y())).norm(), 0.0, 1e-9) << name;
        EXPECT_NEAR(mirrored.motion(name).angle, -here.motion(name).angle, 1e-9) << name;
    }
}

TEST(ForceMethod, SlidesABlockWithNewtonsAccelerationWithoutLocalDamping)
{
    CaseDef scene = scenes::block_on_ground(1.0, 0.5);
    scene.gravity = Vec2(9.81 * std::sin(radians(30.0)), -9.81 * std::cos(radians(30.0)));
    scene.joints[0].friction_angle_deg = 20.0;
    for (const Method method : {Method::force, Method::impulse, Method::hybrid})
    {
        scene.contact.method = method;
        scene.damping.preset = DampingPreset::dynamic;
        CaseRun run(scene);
        const auto cycles = static_cast<std::int64_t>(0.2 / run.model().time_step);
        run.advance(cycles);  // it has begun to slide, after the 8 um of its shear spring
        const double begin = run.velocity("block").x();
        run.advance(cycles);
        const double a = 9.81 * (std::sin(radians(30.0)) - std::cos(radians(30.0)) * std::tan(radians(20.0)));
        const double time = static_cast<double>(cycles) * run.model().time_step;
        // The undamped bounce in the normal spring, 100 Hz and more, leaves a part of its last period.
        EXPECT_NEAR(run.velocity("block").x() - begin, a * time, 5e-3 * a * time);
    }
}

TEST(ForceMethod, HoldsABlockBelowTheFrictionAngleAndLetsItGoAboveIt)
{
    for (const auto& [slope, slides] : {std::pair(29.9, false), std::pair(30.1, true)})
    {
        CaseDef scene = scenes::block_on_ground(1.0, 0.5);
        scene.contact.method = Method::force;
        scene.damping.preset = DampingPreset::paper;
        scene.gravity = Vec2(9.81 * std::sin(radians(slope)), -9.81 * std::cos(radians(slope)));
        CaseRun run(scene);
        run.advance(20000);  // slides at 0.0034 m/s2, a fifth of 0.017, for 1.2 s
        EXPECT_EQ(run.velocity("block").x() > 1e-4, slides) << slope << " degrees of 30";
    }
}

TEST(HybridMethod, TakesAFastImpactAsImpulseAndRestAsForce)
{
    CaseDef scene = scenes::block_on_ground();
    scene.blocks[1].velocity = {0.0, -1.0};
    scene.contact.threshold_scale = 1.0;
    CaseRun run(scene);
    run.advance(1);
    EXPECT_EQ(run.simulation.count_contacts().points[static_cast<int>(Regime::impulse)], 2);
    run.advance(20000);
    EXPECT_EQ(run.simulation.count_contacts().points[static_cast<int>(Regime::impulse)], 0);
    EXPECT_EQ(run.simulation.count_contacts().points[static_cast<int>(Regime::stick)], 2);
    EXPECT_NEAR(run.forces_between("ground", "block").x(), 2700.0 * 9.81, 1.0);
}

TEST(HybridMethod, ObeysAGivenThresholdVelocity)
{
    for (const auto& [threshold, impulses] : {std::pair(0.09, 2), std::pair(0.11, 0)})
    {
        CaseDef scene = scenes::block_on_ground();
        scene.blocks[1].velocity = {0.0, -0.1};
        scene.contact.threshold_velocity = threshold;
        CaseRun run(scene);
        run.advance(1);
        EXPECT_EQ(run.simulation.count_contacts().points[static_cast<int>(Regime::impulse)], impulses) << threshold << " m/s";
    }
}

class HandOver : public ContactInvariants
{
};

/// Two free blocks pressed on each other and pushed past each other, until springs have handed them to impulses and impulses back to springs.
TEST_F(HandOver, KeepsMomentumAndEnergy)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "low", rectangle({-2, -1}, {3, 0}));
    scenes::add_block(scene, "high", rectangle({0, 0}, {1, 1}));
    scene.gravity = {0.0, 0.0};
    scene.contact.threshold_velocity = 0.05;
    scene.joints[0].friction_angle_deg = 30.0;
    scene.damping.preset = DampingPreset::dynamic;
    const double normal = 2e4;  // N
    const auto push = [&](double shear, std::int64_t from, std::int64_t until)
    {
        for (const double side : {1.0, -1.0})
        {
            LoadDef load;
            load.blocks = {side > 0.0 ? "high" : "low"};
            load.force = side * Vec2(shear, -normal);
            load.interval.from_cycle = from;
            load.interval.until_cycle = until;
            scene.loads.push_back(load);
        }
    };
    for (BlockDef& block : scene.blocks)
        block.fix_rotation = true;  // a couple of the loads turns them otherwise
    push(0.9 * normal, 0, 2500);
    push(0.0, 2500, 8000);
    CaseRun run(scene);
    int to_impulses = 0, to_springs = 0;
    double fastest = 0.0;
    bool were_impulses = false;
    for (int cycle = 0; cycle < 8000; ++cycle)
    {
        run.advance(1);
        const bool are_impulses = run.simulation.count_contacts().points[static_cast<int>(Regime::impulse)] > 0;
        to_impulses += are_impulses && !were_impulses ? 1 : 0;
        to_springs += were_impulses && !are_impulses ? 1 : 0;
        were_impulses = are_impulses;
        const test::Momentum now = test::momentum(run.model(), run.state().blocks);
        fastest = std::max(fastest, std::abs(run.velocity("high").x()));
        ASSERT_LT(now.linear.norm(), 1e-12 * 2700.0) << "cycle " << cycle << ", against the momentum at 1 m/s";
    }
    EXPECT_GT(fastest, 0.1);
    EXPECT_GE(to_impulses, 1);
    EXPECT_GE(to_springs, 1);
    EXPECT_LT(std::abs(run.velocity("high").x()), 1e-3) << "stopped";
    expect_ledger_closed(run);
}

/// Handing a contact from impulses to springs must not turn its overlap into speed.
TEST(HybridMethod, ThrowsNothingUpAtTheHandOver)
{
    CaseDef scene = scenes::stack(4);
    for (std::size_t i = 1; i < scene.blocks.size(); ++i)
        for (Vec2& p : scene.blocks[i].polygon)
            p.y() += 0.05 * static_cast<double>(i);
    CaseRun run(scene);
    run.advance(3000);
    double greatest = 0.0;
    for (int i = 0; i < 200; ++i)
    {
        run.advance(50);
        for (int k = 1; k <= 4; ++k)
            greatest = std::max(greatest, run.velocity("block" + std::to_string(k)).y());
    }
    EXPECT_LT(greatest, 0.2) << "the highest falls 0.2 m, to 2 m/s; restitution 0.1 throws it up at 0.2 m/s once";
    EXPECT_NEAR(run.forces_between("ground", "block1").x(), 4 * 2700.0 * 9.81, 10.0);
}
}  // namespace
}  // namespace hdem
