/// Terms of the energy ledger: each alone, by numbers found by hand.

#include "verification/unit/core/boundary/sides.h"

namespace hdem
{
namespace
{
using namespace test;

constexpr double pressure = 1e6, speed = 0.01;  // [Pa], [m/s]

/// A block of 1 m x 0.5 m on a wider one, under constant pressure, held against turning and pushed to the right from 0.1 s on.
CaseDef shear_box(const JointDef& joint)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "base", scenes::rectangle({-1.5, -1.0}, {1.5, 0.0}));
    scenes::add_block(scene, "block", scenes::rectangle({-0.5, 0.0}, {0.5, 0.5}));
    scene.joints = {joint};
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::force;
    scene.blocks.back().fix_rotation = scene.blocks.back().fix_x = true;
    scene.loads = {{.blocks = {"block"}, .force = {0.0, -pressure}},
                   {.blocks = {"block"}, .velocity_x = speed, .interval = {.from_time = 0.1}}};
    scene.stages = {{.name = "shear", .cycles = 1}};
    return scene;
}

JointDef coulomb()
{
    return {.name = "default",
            .normal_stiffness = 1e10,
            .shear_stiffness = 1e9,
            .friction_angle_deg = 30.0,
            .residual_friction_angle_deg = 30.0};
}

void run_until(CaseRun& run, double time)
{
    run.advance(static_cast<std::int64_t>((time - run.state().time) / run.model().time_step));
}

TEST(EnergyTerms, AllStandInTheListOnce)
{
    EnergyLedger one, two;
    double value = 1.0;
    for (const LedgerTerm& term : ledger_terms)
        one.*term.value = value *= 2.0;
    two.add(one);
    two.add(one);
    value = 1.0;
    for (const LedgerTerm& term : ledger_terms)
        EXPECT_EQ(two.*term.value, 2.0 * (value *= 2.0)) << term.name;
}

/// Slip s under sigma with tan psi: friction is tau s l, of which sigma tan(psi) s l lifts the load.
TEST(EnergyTerms, DilationIsWorkAgainstTheNormalForce)
{
    JointDef joint = coulomb();
    joint.dilation_angle_deg = 8.0;
    CaseRun run(shear_box(joint));
    run_until(run, 0.6);
    const double rad = std::acos(-1.0) / 180.0;
    const double tau = pressure * std::tan(30.0 * rad), slip = run.displacement("block").x() - tau / 1e9;
    const EnergyLedger& e = run.state().ledger;
    EXPECT_NEAR(e.friction, tau * slip, 0.01 * tau * slip);
    EXPECT_NEAR(e.dilation, pressure * std::tan(8.0 * rad) * slip, 0.01 * pressure * slip);
    EXPECT_GT(e.dilation, 0.1 * e.friction);
    EXPECT_EQ(e.bond_breaking, 0.0);
    EXPECT_LT(ledger_residual(run), 1e-6);
}

/// Without dilation there is none of it.
TEST(EnergyTerms, FrictionAloneIsShearForceTimesSlip)
{
    CaseRun run(shear_box(coulomb()));
    run_until(run, 0.6);
    EXPECT_GT(run.state().ledger.friction, 1e3);
    EXPECT_EQ(run.state().ledger.dilation, 0.0);
    EXPECT_EQ(run.state().ledger.boundary, 0.0);
}

/// The shear stress falls from c + sigma tan(phi) to sigma tan(phi): (tau_p^2 - tau_r^2) / (2 K_S) per area is freed.
TEST(EnergyTerms, CohesionThatDropsFreesTheShearSpring)
{
    JointDef joint = coulomb();
    joint.cohesion = 5e5;
    CaseRun run(shear_box(joint));
    run_until(run, 0.6);
    const double residual = pressure * std::tan(std::acos(-1.0) / 6.0), peak = residual + 5e5;
    const double freed = (peak * peak - residual * residual) / 2e9;
    EXPECT_NEAR(run.state().ledger.bond_breaking, freed, 0.02 * freed);
    EXPECT_LT(ledger_residual(run), 1e-6);
}

/// T^2 / (2 K_N) per area of a joint that is pulled apart.
TEST(EnergyTerms, TensionThatIsCutOffFreesTheNormalSpring)
{
    JointDef joint = coulomb();
    joint.cohesion = 5e5;
    joint.tension = 2e5;
    CaseDef scene = shear_box(joint);
    scene.loads = {{.blocks = {"block"}, .force = {0.0, 3e5}, .factor = {.ramp_cycles = Vec2(0.0, 30'000.0)}}};
    CaseRun run(scene);
    run.advance(19'000);
    EXPECT_EQ(run.state().ledger.bond_breaking, 0.0);
    run.advance(2000);
    const double freed = 2e5 * 2e5 / 2e10;
    EXPECT_NEAR(run.state().ledger.bond_breaking, freed, 0.02 * freed);
    EXPECT_LT(ledger_residual(run), 1e-6);
}

/// Two blocks press on each other as they leave. Once both are held they have no contact, and what it stored is gone like their speed.
TEST(EnergyTerms, BlocksThatLeaveTakeWhatTheirJointStores)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "back", scenes::rectangle({-1.0, 0.0}, {0.0, 1.0})).velocity = {50.0, 0.0};
    scenes::add_block(scene, "front", scenes::rectangle({0.0, 0.0}, {1.0, 1.0})).velocity = {50.0, 0.0};
    scene.joints = {coulomb()};
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::force;
    scene.convergence.lost_distance = 1.0;
    scene.loads = {{.blocks = {"back"}, .force = {1e7, 0.0}}, {.blocks = {"front"}, .force = {-1e7, 0.0}}};
    scene.stages = {{.name = "leave", .until_converged = true}};
    CaseRun run(scene);
    while (run.displacement("back").x() < 5.0)
        run.advance();
    const StoredEnergy before = stored_energy(run.model(), run.state());
    ASSERT_GT(before.total() - before.kinetic, 1e-6 * before.total());
    run.simulation.hold_lost_blocks();
    EXPECT_EQ(run.state().contacts.size(), 0);
    EXPECT_LT(ledger_residual(run), 1e-9);
    run.advance();
    EXPECT_EQ(stored_energy(run.model(), run.state()).total(), 0.0);
    EXPECT_LT(ledger_residual(run), 1e-9);
}

/// It is held where it is. What comes after it does not hit it.
TEST(EnergyTerms, NothingMeetsABlockThatHasLeft)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "first", scenes::rectangle({0.0, 0.0}, {1.0, 1.0})).velocity = {50.0, 0.0};
    scenes::add_block(scene, "second", scenes::rectangle({-1.5, 0.0}, {-0.5, 1.0})).velocity = {50.0, 0.0};
    scene.joints = {coulomb()};
    scene.gravity = {0.0, 0.0};
    scene.convergence.lost_distance = 1.0;
    scene.stages = {{.name = "leave", .until_converged = true}};
    CaseRun run(scene);
    while (run.displacement("first").x() < 2.0)
        run.advance();
    run.simulation.hold_lost_blocks();
    ASSERT_FALSE(run.state().blocks.is_free(run.slot("first")));
    ASSERT_TRUE(run.state().blocks.is_free(run.slot("second")));
    while (run.displacement("second").x() < 4.0)
        run.advance();
    EXPECT_EQ(run.state().contacts.size(), 0);
    EXPECT_EQ(run.state().blocks.motion[run.slot("second")].vx, 50.0);
}

/// What [insitu] has stored stands apart from what moves at the start.
TEST(EnergyTerms, InsituIsWhatJointsHoldAtTheStart)
{
    CaseDef scene = square_pattern(3.0, 3.0);
    scene.domain.fixed = {"left", "right", "bottom", "top"};
    scene.insitu = {.given = true, .stress = StressDef{-2e6, -1e6, 0.0}};
    CaseRun run(scene);
    const EnergyLedger& e = run.state().ledger;
    EXPECT_EQ(e.initial, 0.0);
    // The middle block alone is free: joints of 1 m, two under each stress.
    EXPECT_NEAR(e.insitu, 2.0 * (4e12 + 1e12) / (2.0 * 1e10), 1e-6 * e.insitu);
    EXPECT_LT(ledger_residual(run), 1e-12);
    CaseDef moving = scenes::block_on_ground();
    moving.blocks.back().velocity = {0.1, 0.0};
    CaseRun thrown(moving);
    EXPECT_GT(thrown.state().ledger.initial, 0.0);
    EXPECT_EQ(thrown.state().ledger.insitu, 0.0);
}

/// A wall that presses squares: what it gives is in the springs, and no load has worked.
TEST(EnergyTerms, BoundaryIsWhatSidesGive)
{
    for (const BoundaryKind kind : {BoundaryKind::velocity, BoundaryKind::stress})
        for (const Method method : {Method::force, Method::hybrid})
        {
            CaseDef scene = square_pattern(3.0, 3.0);
            scene.contact.method = method;
            scene.domain.fixed = {"bottom"};
            scene.boundaries = {side("left", BoundaryKind::roller), side("right", BoundaryKind::roller),
                                kind == BoundaryKind::stress ? pressed("top", 1e6) : side("top", kind)};
            scene.boundaries.back().velocity = {0.0, -0.01};
            scene.boundaries.back().factor.table = {{0.0, 0.0}, {500.0, 1.0}, {1000.0, kind == BoundaryKind::stress ? 1.0 : 0.0}};
            scene.stages[0].cycles = 10'000;
            CaseRun run(scene);
            run.advance(8000);
            const EnergyLedger& e = run.state().ledger;
            const StoredEnergy stored = stored_energy(run.model(), run.state());
            EXPECT_NEAR(e.load_work, 0.0, 1e-12 * e.boundary);
            EXPECT_GT(e.boundary, 1.0);
            EXPECT_GT(stored.total(), 1.0) << "in the springs of pressed joints, by hybrid too";
            EXPECT_NEAR(e.boundary,
                        stored.total() + e.local_damping + e.friction + e.contact_changes + e.impulse_loss - e.position_correction,
                        1e-5 * e.boundary);
            // Springs that take over from impulses begin with their force, and those of contacts that become longer keep theirs: contact_changes below 0.
            const double given = std::max(-e.contact_changes, 0.0);
            EXPECT_GT(e.boundary + given, stored.total() * (1.0 - 1e-5));
            EXPECT_LT(given, (method == Method::hybrid ? 0.01 : 0.002) * e.boundary);
        }
}
}  // namespace
}  // namespace hdem
