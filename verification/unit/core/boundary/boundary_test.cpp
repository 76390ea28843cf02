#include "core/boundary/servo.h"
#include "core/boundary/side_forces.h"
#include "core/geometry/unit_direction.h"
#include "core/rock/side_walls.h"
#include "core/stress/insitu_stress.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
using test::CaseRun;

/// Square blocks of 1 m without gravity.
CaseDef square_pattern(double width, double height)
{
    CaseDef scene = scenes::empty_scene();
    scene.domain = {.given = true, .width = width, .height = height};
    for (const double dip : {0.0, 90.0})
        scene.joint_sets.push_back({.name = "dip" + std::to_string(dip), .dip_deg = dip, .spacing = 1.0, .origin = Vec2(0.0, 0.0)});
    scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = 1e10;
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::force;
    return scene;
}

BoundaryDef side(const std::string& name, BoundaryKind kind)
{
    BoundaryDef boundary;
    boundary.name = boundary.side = name;
    boundary.kind = kind;
    return boundary;
}

BoundaryDef pressed(const std::string& name, double compression, double shear = 0.0)
{
    BoundaryDef boundary = side(name, BoundaryKind::stress);
    boundary.stress = Vec2(compression, shear);
    return boundary;
}

BoundaryDef in_situ(BoundaryDef boundary)
{
    boundary.is_insitu = true;
    return boundary;
}

void expect_nothing_moves(CaseDef scene, std::int64_t cycles = 1000)
{
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
    {
        scene.contact.method = method;
        CaseRun run(scene);
        EXPECT_LT(summarise_insitu(run.model(), run.state()).unbalance, 1e-12);
        run.advance(cycles);
        for (Index b = 0; b < run.model().blocks(); ++b)
        {
            EXPECT_LT(run.state().blocks.displacement(b).norm(), 1e-12) << run.model().name[b] << ", method " << name_of(method);
            EXPECT_LT(std::abs(run.state().blocks.motion[b].angle), 1e-12);
        }
    }
}

double ledger_residual(const CaseRun& run)
{
    return std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state())));
}

/// E = K_N s = 1e10 Pa, nu = 0: 1 MPa on 10 m of blocks and 10 joints, that of the wall included, is 1 mm.
TEST(Boundary, StressOnAColumnBetweenRollersGivesItsShortening)
{
    CaseDef scene = square_pattern(6.0, 10.0);
    scene.boundaries = {side("left", BoundaryKind::roller), side("bottom", BoundaryKind::roller), pressed("top", 1e6)};
    CaseRun run(scene);
    run.advance(6000);
    for (const char* name : {"b55", "b58", "b60"})
    {
        EXPECT_NEAR(run.displacement(name).y(), -1e-3, 1e-3 * 1e-4) << name;
        EXPECT_NEAR(run.displacement(name).x(), 0.0, 1e-9);
    }
    // What the wall presses back with is its force: it has no weight.
    EXPECT_NEAR(run.state().blocks.force[run.slot("bottom")].y, -6e6, 10.0);
    EXPECT_LT(ledger_residual(run), 1e-9);
}

/// Of 2 MPa 1 MPa is left in the second stage: each of the five joints opens by sigma / K.
TEST(Boundary, StressThatEndsLetsTheColumnExpand)
{
    CaseDef scene = square_pattern(1.0, 5.0);
    scene.insitu = {.given = true, .stress = StressDef{0.0, -2e6, 0.0}};
    scene.boundaries = {side("bottom", BoundaryKind::roller), in_situ(side("top", BoundaryKind::stress))};
    scene.boundaries[1].stages = {"held"};
    scene.boundaries.push_back(pressed("top", 1e6));
    scene.boundaries[2].stages = {"off"};
    scene.stages = {{.name = "held", .cycles = 100}, {.name = "off", .cycles = 4000}};
    for (const std::int64_t relax : {0, 500})
    {
        scene.stages[1].relax_cycles = relax;
        CaseRun run(scene);
        run.advance(100);
        run.simulation.begin_stage(1);
        run.advance(4000);
        for (int i = 1; i <= 5; ++i)
            EXPECT_NEAR(run.displacement("b" + std::to_string(i)).y(), i * 1e-4, 1e-9) << "relax_cycles " << relax;
        EXPECT_LT(ledger_residual(run), 1e-9);
    }
}

/// A wall that ends is taken away; one that begins touches the rock without force.
TEST(Boundary, WallsBeginAndEndWithTheirStages)
{
    CaseDef scene = square_pattern(1.0, 5.0);
    scene.insitu = {.given = true, .stress = StressDef{0.0, -2e6, 0.0}};
    scene.gravity = {0.0, -9.81};
    scene.insitu.gradient.yy = 2700.0 * 9.81;
    scene.insitu.reference = 5.0;
    scene.boundaries = {side("bottom", BoundaryKind::fixed), side("top", BoundaryKind::roller)};
    scene.boundaries[1].stages = {"held", "again"};
    scene.stages = {
        {.name = "held", .cycles = 100}, {.name = "off", .cycles = 5000, .relax_cycles = 2000}, {.name = "again", .cycles = 500}};
    CaseRun run(scene);
    run.advance(100);
    const Index wall = run.slot("top");
    EXPECT_NEAR(run.state().blocks.force[wall].y, 2e6, 1e-3);
    run.simulation.begin_stage(1);
    EXPECT_EQ(run.state().blocks.present[wall], 0);
    run.advance(4000);
    EXPECT_NEAR(run.displacement("b5").y(), 8e-4, 1e-9) << "four joints, the lowest block is fixed";
    run.simulation.begin_stage(2);
    EXPECT_EQ(run.state().blocks.present[wall], 1);
    run.advance(500);
    EXPECT_NEAR(run.state().blocks.force[wall].y, 0.0, 1.0);
    const double rise = run.position("top").y() - run.model().boundaries[1].walls[0].centre.y();
    EXPECT_NEAR(rise, 8e-4, 1e-9) << "the wall stands where the block has come to";
}

TEST(Boundary, FixedSideThatEndsFreesItsBlocks)
{
    CaseDef scene = square_pattern(3.0, 3.0);
    scene.insitu = {.given = true, .stress = StressDef{-1e6, -1e6, 0.0}};
    scene.boundaries = {side("bottom", BoundaryKind::fixed), side("top", BoundaryKind::fixed), side("left", BoundaryKind::fixed),
                        side("right", BoundaryKind::fixed)};
    scene.boundaries[1].stages = {"held"};
    scene.stages = {{.name = "held", .cycles = 10}, {.name = "off", .cycles = 4000}};
    CaseRun run(scene);
    run.advance(10);
    EXPECT_FALSE(run.state().blocks.is_free(run.slot("b8")));
    run.simulation.begin_stage(1);
    EXPECT_TRUE(run.state().blocks.is_free(run.slot("b8")));
    EXPECT_FALSE(run.state().blocks.is_free(run.slot("b9"))) << "the right side still holds it";
    run.advance(4000);
    EXPECT_GT(run.displacement("b8").y(), 1e-5) << "the stress of the joint below it moves it";
    EXPECT_LT(ledger_residual(run), 1e-9);
}

TEST(Boundary, RollersWithInsituStressHoldTheRockWhereItIsDrawn)
{
    CaseDef scene = square_pattern(6.0, 5.0);
    scene.insitu = {.given = true, .stress = StressDef{-8e6, -5e6, 0.0}};
    for (const char* name : {"left", "right", "bottom", "top"})
        scene.boundaries.push_back(side(name, BoundaryKind::roller));
    expect_nothing_moves(scene);
    // Under gravity, with a ground: 2700 kg/m3, K0 = 1.5.
    scene.insitu = {.given = true, .surface = 5.0, .ratio = 1.5};
    scene.gravity = {0.0, -9.81};
    scene.boundaries.pop_back();
    expect_nothing_moves(scene);
}

/// Joints of three directions, sigma n on all sides; one block is fixed.
CaseDef pressed_all_around()
{
    CaseDef scene = square_pattern(8.0, 7.0);
    scene.joint_sets.clear();
    for (const double dip : {25.0, -55.0, 90.0})
        scene.joint_sets.push_back({.name = "dip" + std::to_string(dip), .dip_deg = dip, .spacing = 1.7});
    scene.generator.smallest_block_area = scene.generator.smallest_edge = 0.02;
    scene.joints[0].friction_angle_deg = 50.0;
    scene.insitu = {.given = true, .stress = StressDef{-8e6, -5e6, 1e6}, .gradient = {0.0, 2700.0 * 9.81, 0.0}};
    scene.gravity = {0.0, -9.81};
    for (const char* name : {"left", "right", "bottom", "top"})
        scene.boundaries.push_back(in_situ(side(name, BoundaryKind::stress)));
    scene.stages[0].fix = {"b1"};
    return scene;
}

TEST(Boundary, InsituStressOnAllSidesLeavesTheRockWhereItIsDrawn)
{
    expect_nothing_moves(pressed_all_around());
}

/// The same turned by 23 degrees: a polygon, its edges and a turned tensor.
TEST(Boundary, InsituStressOnTheSidesOfATurnedModelLeavesTheRockWhereItIsDrawn)
{
    CaseDef scene = pressed_all_around();
    const Vec2 x = unit_direction(23.0);
    const auto turned = [&](double a, double b) { return Vec2(a * x.x() - b * x.y(), a * x.y() + b * x.x()); };
    scene.domain = {.given = true, .polygon = {turned(0, 0), turned(8, 0), turned(8, 7), turned(0, 7)}};
    for (JointSetDef& set : scene.joint_sets)
        set.dip_deg += 23.0;
    scene.insitu.gradient = {};
    scene.gravity = {0.0, 0.0};
    scene.boundaries.resize(2);
    scene.boundaries[0].side = scene.boundaries[1].side = "";
    scene.boundaries[0].edges = {0, 2};
    scene.boundaries[1].edges = {1, 3};
    expect_nothing_moves(scene);
}

/// [compression, shear]: shear anticlockwise on all four sides balances a stress of (-3, -3, -1) MPa:
/// on the right side, whose normal is x, the traction is (sigma_xx, sigma_xy).
TEST(Boundary, StressHasItsSigns)
{
    CaseDef scene = square_pattern(4.0, 3.0);
    scene.insitu = {.given = true, .stress = StressDef{-3e6, -2e6, 0.5e6}};
    scene.boundaries = {pressed("right", 3e6, 0.5e6), pressed("left", 3e6, 0.5e6), pressed("top", 2e6, -0.5e6),
                        pressed("bottom", 2e6, -0.5e6)};
    scene.stages[0].fix = {"b1"};
    expect_nothing_moves(scene);
}

TEST(Boundary, TractionsOnRockThatNothingHoldsAreRefused)
{
    CaseDef scene = pressed_all_around();
    scene.stages[0].fix.clear();
    try
    {
        build_model(scene);
        FAIL() << "built";
    }
    catch (const InputError& error)
    {
        EXPECT_EQ(error.problems().size(), 1U);
        EXPECT_NE(error.problems()[0].text.find("nothing holds it"), std::string::npos);
        EXPECT_NE(error.problems()[0].text.find("Fix a block"), std::string::npos);
    }
}

/// 1 -> 2 MPa on 3 m: 2.0 and 2.5 MN at the ends; the block's centroid lies in the middle.
TEST(SideForces, HaveTheMomentOfALinearTraction)
{
    const BoundaryFace face{.block = 0, .from = {1, 0}, .to = {1, 3}, .body_from = {0.5, -1.5}, .body_to = {0.5, 1.5}};
    const BoundaryForce force = force_of_traction(face, {-1e6, 0.0}, {-2e6, 0.0});
    EXPECT_NEAR(force.x, -4.5e6, 1e-6);
    EXPECT_NEAR(force.moment, 1.5 * (2.5e6 - 2.0e6), 1e-6);
}

/// Loads go on with resting blocks, long steps and static solutions; a constant traction does not end these.
TEST(SideForces, LeaveTheRulesOfAStageAsTheyAre)
{
    CaseDef scene = pressed_all_around();
    scene.stages[0] = {.name = "run", .until_converged = true, .solver = RestSolver::statics, .fix = {"b1"}};
    scene.contact.method = Method::hybrid;
    CaseRun run(scene);
    const StageRules rules = resolve_rules(run.model(), run.state());
    EXPECT_TRUE(rules.rest.leaves_out);
    EXPECT_TRUE(rules.step.varies);
    EXPECT_TRUE(rules.tries_statics);
    EXPECT_FALSE(rules.has_loads);
}

/// The servo's force is its target, the other sides answer by themselves.
TEST(Servo, BringsAColumnToItsTarget)
{
    for (const Method method : {Method::force, Method::hybrid})
    {
        CaseDef scene = square_pattern(4.0, 8.0);
        scene.contact.method = method;
        scene.gravity = {0.0, -9.81};
        scene.insitu = {.given = true, .surface = 8.0, .ratio = 0.5};
        scene.boundaries = {side("left", BoundaryKind::roller), side("right", BoundaryKind::servo),
                            side("bottom", BoundaryKind::roller), side("top", BoundaryKind::servo)};
        scene.boundaries[1].target = 0.5e6;
        scene.boundaries[3].target = 2e6;
        scene.boundaries[3].max_velocity = 0.05;
        scene.boundaries[1].max_velocity = 0.05;
        CaseRun run(scene);
        EXPECT_FALSE(servos_press(run.model(), run.state()));
        run.advance(12000);
        EXPECT_NEAR(run.state().blocks.force[run.slot("top")].y, 2e6 * 4.0, 1e-3 * 8e6);
        EXPECT_NEAR(run.state().blocks.force[run.slot("right")].x, 0.5e6 * 8.0, 1e-3 * 4e6);
        EXPECT_TRUE(servos_press(run.model(), run.state()));
        EXPECT_LT(ledger_residual(run), 1e-6);
    }
}

TEST(Servo, IsNoFasterThanItMay)
{
    EXPECT_EQ(servo_velocity({.normal = 0.0, .stiffness = 0.0}, 1e6, 0.01, 1e-4), 0.01);
    EXPECT_EQ(servo_velocity({.normal = 0.0, .stiffness = 1e9}, 1e6, 0.01, 1e-4), 0.01);
    EXPECT_EQ(servo_velocity({.normal = 9e6, .stiffness = 1e9}, 1e6, 0.01, 1e-4), -0.01);
    EXPECT_NEAR(servo_velocity({.normal = 1e6, .stiffness = 1e9}, 1e6 + 100.0, 0.01, 1e-4), 0.05 * 100.0 / 1e5, 1e-15);
}

/// 1 mm in 10 m: the lid moves as given, and the column takes K_N u / n.
TEST(Boundary, VelocityMovesTheWall)
{
    CaseDef scene = square_pattern(2.0, 4.0);
    scene.boundaries = {side("bottom", BoundaryKind::roller), side("top", BoundaryKind::velocity)};
    scene.boundaries[1].velocity = {0.0, -0.01};
    scene.boundaries[1].stages = {"press"};
    scene.stages = {{.name = "press", .cycles = 2000}, {.name = "off", .cycles = 10}};
    CaseRun run(scene);
    EXPECT_TRUE(resolve_rules(run.model(), run.state()).moves_walls);
    EXPECT_EQ(run.velocity("top"), Vec2(0.0, -0.01));
    run.advance(2000);
    const double way = 0.01 * run.state().time;
    EXPECT_NEAR(run.displacement("top").y(), -way, 1e-12);
    EXPECT_NEAR(run.state().blocks.force[run.slot("top")].y, 2.0 * 1e10 * way / 5.0, 0.03 * 2.0 * 1e10 * way / 5.0);
    EXPECT_LT(ledger_residual(run), 1e-9);
    run.simulation.begin_stage(1);
    EXPECT_FALSE(resolve_rules(run.model(), run.state()).moves_walls);
    EXPECT_EQ(run.velocity("top"), Vec2(0.0, 0.0));
}

/// Walls change nothing that follows from the size of the rock.
TEST(Boundary, WallsDoNotCountAsRock)
{
    CaseDef scene = square_pattern(6.0, 5.0);
    const hdem::Setup plain = build_model(scene);
    for (const char* name : {"left", "right", "bottom", "top"})
        scene.boundaries.push_back(side(name, BoundaryKind::roller));
    const hdem::Setup walled = build_model(scene);
    EXPECT_EQ(walled.model.blocks(), plain.model.blocks() + 4);
    EXPECT_EQ(walled.model.mean_size, plain.model.mean_size);
    EXPECT_EQ(walled.model.threshold_scale, plain.model.threshold_scale);
    EXPECT_EQ(walled.model.origin, plain.model.origin);
    EXPECT_EQ(walled.model.lost_beyond, plain.model.lost_beyond);
    EXPECT_EQ(walled.model.time_step, plain.model.time_step);
    EXPECT_EQ(walled.model.paper_time_step, plain.model.paper_time_step);
    for (Index b = 0; b < walled.model.blocks(); ++b)
        if (walled.model.user_number[b] >= plain.model.blocks())
        {
            EXPECT_EQ(walled.model.mass[b], 0.0);
        }
}

/// An L: the wall ends on the bisector of the concave corner, and is longer than its edge at convex ones.
TEST(SideWalls, DoNotReachIntoTheRock)
{
    const Polygon l = {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}};
    const Polygon beside = wall_behind(l, 3, 0.5);  // from (2, 2) to (2, 4)
    const Polygon expected = {{2, 4.5}, {2, 2}, {2.5, 2.5}, {2.5, 4.5}};
    ASSERT_EQ(beside.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_LT((beside[i] - expected[i]).norm(), 1e-12) << i;
    CaseDef scene = square_pattern(1.0, 1.0);
    scene.domain = {.given = true, .polygon = l};
    scene.insitu = {.given = true, .stress = StressDef{-1e6, -1e6, 0.0}};
    scene.boundaries = {side("wall", BoundaryKind::roller)};
    scene.boundaries[0].side = "";
    scene.boundaries[0].edges = {0, 1, 2, 3, 4, 5};
    CaseRun run(scene);
    EXPECT_NE(run.model().find_block("wall.6"), no_index);
    expect_nothing_moves(scene, 200);
}

/// The force of a [[load]] at a point has a moment about the centroid, whose arm turns with the block.
TEST(Load, ActsAtItsPoint)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "block", scenes::rectangle({0.0, 0.0}, {1.0, 1.0}));
    scene.gravity = {0.0, 0.0};
    scene.damping.preset = DampingPreset::dynamic;
    scene.loads = {{.blocks = {"block"}, .force = {0.0, 100.0}, .point = Vec2(1.0, 0.5)}};
    scene.time.step = 1e-3;
    CaseRun run(scene);
    run.advance(1);
    const double inertia = run.model().inertia[0];
    EXPECT_NEAR(run.motion("block").w, 50.0 / inertia * 1e-3, 1e-12);
    run.advance(6000);
    // Turned by 90 degrees and more the arm has changed its sign: a pendulum about the force's direction, energy 50 N m (sin a).
    const BlockMotion& m = run.motion("block");
    const double lift = 100.0 * (m.y + m.s * 0.5 + 0.0 - run.state().blocks.reference_position[0].y());
    const double kinetic = kinetic_energy(run.model(), run.state().blocks, 0);
    EXPECT_GT(std::abs(m.angle), 0.1);
    EXPECT_NEAR(kinetic, lift, 2e-3 * lift) << "work of the force along the way of its point";
    EXPECT_LT(ledger_residual(run), 1e-12);
}

/// A parallelogram cut by two sets through it, to which (-8, -5, 1) kPa are added on all sides. Rigid blocks follow the gradient J = sum of C sigma n (x) n / s over the sets,
/// C = n n / K_N + e e / K_S, without turning; its symmetric part is the strain of the continuum (Morland 1974): -2.75878e-6, 1.50619e-6, 2.07974e-6.
TEST(Boundary, StressOnTwoSetsOfJointsStrainsTheRockAsTheirComplianceSays)
{
    CaseDef scene = scenes::empty_scene();
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::force;
    scene.joints[0].friction_angle_deg = 85.0;
    scene.contact.length_floor = 1e-6;  // corners that meet are no joints
    scene.joint_sets = {{.name = "one", .dip_deg = 25.0, .spacing = 1.7, .origin = Vec2(0.0, 0.0)},
                        {.name = "two", .dip_deg = -55.0, .spacing = 1.2, .origin = Vec2(0.0, 0.0)}};
    const Vec2 along_one = 6.0 * 1.2 / std::sin(radians(80.0)) * unit_direction(25.0);
    const Vec2 along_two = 5.0 * 1.7 / std::sin(radians(80.0)) * unit_direction(125.0);
    scene.domain = {.given = true, .polygon = {{0.0, 0.0}, along_one, along_one + along_two, along_two}};
    scene.stages[0].fix = {"b1"};
    const double before = 1e5;  // keeps the joints closed while waves run through the rock
    scene.insitu = {.given = true, .stress = StressDef{-before, -before, 0.0}};
    Eigen::Matrix2d stress, gradient = Eigen::Matrix2d::Zero();
    stress << -8e3, 1e3, 1e3, -5e3;
    for (const JointSetDef& set : scene.joint_sets)
    {
        const Vec2 e = unit_direction(set.dip_deg), n = turned_left(e);
        const Vec2 jump = n * n.dot(stress * n) / 7e9 + e * e.dot(stress * n) / 5e8;
        gradient += jump * n.transpose() / set.spacing;
    }
    EXPECT_NEAR(gradient(0, 0), -2.75878e-6, 1e-11);
    EXPECT_NEAR(gradient(1, 1), 1.50619e-6, 1e-11);
    EXPECT_NEAR(gradient(0, 1) + gradient(1, 0), 2.07974e-6, 1e-11);
    for (int edge = 0; edge < 4; ++edge)
    {
        const Vec2 t = (edge % 2 == 0 ? along_one : along_two).normalized() * (edge < 2 ? 1.0 : -1.0), out = -turned_left(t);
        BoundaryDef boundary = pressed("", before - out.dot(stress * out), t.dot(stress * out));
        boundary.name = "side" + std::to_string(edge);
        boundary.edges = {edge};
        scene.boundaries.push_back(boundary);
    }
    CaseRun run(scene);
    EXPECT_EQ(run.model().blocks(), 30);
    run.advance(20000);
    const double most = gradient.norm() * 10.0;
    for (Index b = 0; b < run.model().blocks(); ++b)
    {
        const Vec2 from_first = run.state().blocks.reference_position[b] - run.state().blocks.reference_position[run.slot("b1")];
        EXPECT_LT((run.state().blocks.displacement(b) - gradient * from_first).norm(), 1e-3 * most) << run.model().name[b];
        EXPECT_LT(std::abs(run.state().blocks.motion[b].angle), 1e-9);
    }
}
}  // namespace
}  // namespace hdem
