#include "core/geometry/unit_direction.h"
#include "parallel/stages.h"
#include "verification/unit/core/boundary/sides.h"

#include <map>

namespace hdem
{
namespace
{
using namespace test;

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

/// More stress on two sides, rollers behind the others: the static solution finds what the cycles come to.
TEST(SideForces, AreKnownToTheStaticSolution)
{
    std::map<RestSolver, double> ways;
    for (const RestSolver solver : {RestSolver::statics, RestSolver::dynamics})
    {
        CaseDef scene = square_pattern(15.0, 15.0);
        scene.contact.method = Method::hybrid;
        scene.gravity = {0.0, -9.81};
        scene.insitu = {
            .given = true, .stress = StressDef{-1e6, -1e6, 0.0}, .gradient = {0.0, 2700.0 * 9.81, 0.0}, .reference = 15.0};
        scene.boundaries = {side("left", BoundaryKind::roller), side("bottom", BoundaryKind::roller), pressed("top", 3e6),
                            pressed("right", 1e6)};
        scene.stages = {{.name = "press", .until_converged = true, .solver = solver}};
        CaseRun run(scene);
        EXPECT_EQ(run.state().statics.size(), solver == RestSolver::statics ? 1U : 0U);
        if (solver == RestSolver::statics)
        {
            ASSERT_EQ(run.state().statics[0].end, StaticOutcome::Kind::balanced);
            EXPECT_LT(ledger_residual(run), 1e-9);
            EXPECT_GT(run.state().ledger.boundary, 0.5 * 2e6 * 15.0 * 15.0 * 2e-4) << "at least what the springs take";
        }
        const StageResult stage = run_stages(run.simulation, {}).front();
        EXPECT_TRUE(stage.at_rest);
        ways[solver] = run.displacement("b225").y();
        EXPECT_NEAR(ways[solver], -15.0 * 2e-4, 1e-4 * 3e-3);
    }
}

TEST(SideForces, AreTheSameOnSeveralThreads)
{
    CaseDef scene = pressed_all_around();
    scene.domain.width = scene.domain.height = 20.0;
    scene.boundaries[0].is_insitu = false;
    scene.boundaries[0].stress = Vec2(7e6, 1e6);
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
    {
        scene.contact.method = method;
        CaseRun one(scene, 1), three(scene, 3);
        one.advance(300);
        three.advance(300);
        EXPECT_EQ(one.hash(), three.hash());
        EXPECT_EQ(one.state().ledger.boundary, three.state().ledger.boundary);
        EXPECT_NE(one.state().ledger.boundary, 0.0);
    }
}
}  // namespace
}  // namespace hdem
