#include "core/boundary/side_forces.h"
#include "core/geometry/unit_direction.h"
#include "core/rock/side_walls.h"
#include "verification/unit/core/boundary/sides.h"

namespace hdem
{
namespace
{
using namespace test;

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

/// 1 -> 2 MPa on 3 m: 2.0 and 2.5 MN at the ends; the block's centroid lies in the middle.
TEST(SideForces, HaveTheMomentOfALinearTraction)
{
    const BoundaryFace face{.block = 0, .from = {1, 0}, .to = {1, 3}, .body_from = {0.5, -1.5}, .body_to = {0.5, 1.5}};
    const BoundaryForce force = force_of_traction(face, {-1e6, 0.0}, {-2e6, 0.0});
    EXPECT_NEAR(force.x, -4.5e6, 1e-6);
    EXPECT_NEAR(force.moment, 1.5 * (2.5e6 - 2.0e6), 1e-6);
    EXPECT_NEAR(force.xx, 0.5 * -4.5e6, 1e-6);
    EXPECT_NEAR(force.yy, 0.0, 1e-6);
    EXPECT_NEAR(force.xy, 0.5 * 1.5 * (2.0e6 - 2.5e6), 1e-6);
}

/// A block that a traction presses on one face and its neighbour on the other carries the stress of the side, and so do those farther inside.
TEST(Boundary, StressIsThatOfTheBlocksAtTheSide)
{
    CaseDef scene = square_pattern(6.0, 6.0);
    scene.domain.fixed = {"left", "bottom"};
    scene.boundaries = {pressed("right", 3e6), pressed("top", 2e6)};
    scene.insitu = {.given = true, .stress = StressDef{-3e6, -2e6, 0.0}};
    const CaseRun run(scene);
    const std::vector<MeanStress> stresses = mean_stresses(run.model(), run.state());
    for (Index block = 0; block < run.state().blocks.size(); ++block)
    {
        if (!run.state().blocks.is_free(block))
            continue;
        const MeanStress& stress = stresses[block];
        EXPECT_NEAR(stress.xx, 3e6, 1.0);
        EXPECT_NEAR(stress.yy, 2e6, 1.0);
        EXPECT_NEAR(stress.xy, 0.0, 1.0);
    }
}

/// 3 MPa at y = 4 m, 0.2 MPa less a metre upwards, and a shear that grows upwards: force and moment of the whole side.
TEST(Boundary, StressMayChangeWithDepth)
{
    for (const double height : {0.0, 1000.0})  // far away rock is moved to the origin of the model
    {
        CaseDef scene = square_pattern(6.0, 10.0);
        scene.domain.origin.y() += height;
        scene.domain.fixed = {"left"};
        scene.boundaries = {side("right", BoundaryKind::stress)};
        scene.boundaries[0].stress = Vec2(3e6, 0.0);
        scene.boundaries[0].stress_gradient = {-2e5, 1e4};
        scene.boundaries[0].stress_height = scene.domain.origin.y() + 4.0;
        const CaseRun run(scene);
        const Vec2 foot = scene.domain.origin + Vec2(6.0, 0.0) - run.model().origin;  // of the side
        Triple sum;
        for (const BoundaryForce& force : run.model().boundaries[0].forces)
        {
            const BlockMotion& m = run.state().blocks.motion[force.block];
            sum = {sum.x + force.x, sum.y + force.y, sum.w + force.moment + cross(Vec2(m.x, m.y) - foot, Vec2(force.x, force.y))};
        }
        EXPECT_NEAR(sum.x, -(3e7 - 2e5 * (50.0 - 40.0)), 1.0) << height;
        EXPECT_NEAR(sum.y, 1e4 * (50.0 - 40.0), 1.0) << height;
        EXPECT_NEAR(sum.w, 3.8e6 * 50.0 - 2e5 * 1000.0 / 3.0, 10.0) << height;
    }
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
