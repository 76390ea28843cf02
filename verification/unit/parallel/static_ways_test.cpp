#include "io/case_reader.h"
#include "parallel/stages.h"
#include "parallel/static_search.h"
#include "parallel/static_solver.h"
#include "parallel/static_ways.h"
#include "verification/unit/case_run.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace hdem
{
namespace
{
using test::CaseRun;
using Kind = StaticOutcome::Kind;

CaseDef jointed_rock()
{
    CaseDef scene = scenes::joints(16.0, 16.0, 0.8, 2.0);
    scene.joints[0].cohesion = 5e4;
    return scene;
}

/// A tunnel in rock without cohesion or with little, by static solutions.
CaseDef tunnel_in_weak_rock(double friction_angle_deg, double cohesion)
{
    CaseDef scene = scenes::three_joint_sets(1.7, friction_angle_deg, cohesion);
    scene.joint_sets[0].dip_deg = 20.0;
    scene.joint_sets[1].dip_deg = 70.0;
    scene.joint_sets[1].spacing = 3.5;
    scene.joint_sets[2].dip_deg = -60.0;
    scene.generator.seed = 1;
    scene.generator.smallest_block_area = 0.3626;
    scene.contact.method = Method::force;
    scene.excavations = {{.name = "tunnel",
                          .shape = OutlineShape::horseshoe,
                          .position = {17.5, 12.5},
                          .width = 9.0,
                          .height = 8.0,
                          .inside = InsideOutline::one_block}};
    scene.stages = {
        {.name = "gravity", .until_converged = true, .max_cycles = 20, .solver = RestSolver::statics},
        {.name = "dig", .until_converged = true, .max_cycles = 20, .solver = RestSolver::statics, .excavate = {"tunnel"}}};
    return scene;
}

/// Bricks between two columns that are held in x and do not turn; one brick of the lowest course is taken out.
CaseDef bricks_between_rollers(RestSolver solver, int side = 16)
{
    CaseDef scene = scenes::empty_scene();
    scene.contact.method = Method::force;
    scene.joints[0].cohesion = 1e6;
    scenes::add_fixed_block(scene, "ground", scenes::rectangle({-1.0, -1.0}, {side + 1.0, 0.0}));
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i)
        {
            const std::string name = "b" + std::to_string(i) + "_" + std::to_string(j);
            BlockDef& block = scenes::add_block(scene, name, scenes::rectangle({i, j}, {i + 1.0, j + 1.0}));
            block.fix_x = block.fix_rotation = i == 0 || i == side - 1;
        }
    scene.stages = {{.name = "weight", .until_converged = true, .max_cycles = 100'000, .solver = solver},
                    {.name = "dig", .until_converged = true, .max_cycles = 100'000, .solver = solver, .excavate = {"b8_0"}}};
    return scene;
}

/// The same, many more; the brick is taken out slowly.
CaseDef many_bricks()
{
    CaseDef scene = bricks_between_rollers(RestSolver::automatic, 33);
    scene.stages[0].solver = RestSolver::statics;
    scene.stages[1].relax_cycles = 3000;
    return scene;
}

TEST(StaticWays, BlocksHeldInOneDirectionMoveInTheOther)
{
    std::vector<Vec2> sunk;
    for (const RestSolver solver : {RestSolver::statics, RestSolver::dynamics})
    {
        hdem::Setup setup = build_model(bricks_between_rollers(solver));
        Simulation bricks(std::move(setup.model), std::move(setup.state));
        const std::vector<StageResult> results = run_stages(bricks, {});
        EXPECT_EQ(results[1].statics.has_value(), solver == RestSolver::statics);
        const Blocks& blocks = bricks.state().blocks;
        sunk.push_back(blocks.displacement(bricks.model().find_block("b8_1")));
        const Index held = bricks.model().find_block("b0_8");
        EXPECT_EQ(blocks.displacement(held).x(), 0.0);
        EXPECT_LT(blocks.displacement(held).y(), 0.0);
        EXPECT_EQ(blocks.motion[held].angle, 0.0);
    }
    EXPECT_LT(sunk[1].y(), -1e-5);
    EXPECT_LT((sunk[0] - sunk[1]).norm(), 0.01 * sunk[1].norm()) << sunk[0].y() << " " << sunk[1].y();
}

TEST(StaticWays, AreTheDefaultInLargeModelsWhoseForcesAreTakenOffSlowly)
{
    const auto solves = [](const CaseDef& scene)
    {
        hdem::Setup setup = build_model(scene);
        Simulation bricks(std::move(setup.model), std::move(setup.state));
        bricks.begin_stage(1);
        return !bricks.state().statics.empty();
    };
    EXPECT_TRUE(solves(many_bricks()));
    CaseDef dynamic = many_bricks(), sudden = dynamic, recorded = dynamic;
    dynamic.stages[1].solver = RestSolver::dynamics;
    EXPECT_FALSE(solves(dynamic));
    sudden.stages[1].relax_cycles = 0;
    EXPECT_FALSE(solves(sudden));
    recorded.histories = {{.name = "sinks", .block = "b8_1", .quantities = {"displacement"}}};
    EXPECT_FALSE(solves(recorded));
    CaseDef few = bricks_between_rollers(RestSolver::automatic);
    few.stages[1].relax_cycles = 3000;
    EXPECT_FALSE(solves(few));
}

TEST(StaticWays, ByDefaultGiveTheAnswerOfCycles)
{
    std::vector<std::vector<Vec2>> moved;
    for (const RestSolver solver : {RestSolver::automatic, RestSolver::dynamics})
    {
        CaseDef scene = many_bricks();
        scene.stages[1].solver = solver;
        hdem::Setup setup = build_model(scene);
        Simulation bricks(std::move(setup.model), std::move(setup.state));
        const std::vector<StageResult> results = run_stages(bricks, {});
        EXPECT_EQ(results[1].statics.has_value(), solver == RestSolver::automatic);
        EXPECT_TRUE(bricks.state().released.empty());
        std::vector<Vec2>& of = moved.emplace_back();
        for (const char* const name : {"b8_1", "b7_0", "b9_0", "b8_2"})
            of.push_back(bricks.state().blocks.displacement(bricks.model().find_block(name)));
    }
    for (std::size_t i = 0; i < moved[0].size(); ++i)
        EXPECT_LT((moved[0][i] - moved[1][i]).norm(), 0.01 * moved[1][0].norm());
}

/// Here a search that begins again finds a balance that slow removal of the tunnel does not come to: by cycles over 5000 and over 50 000 cycles 116 blocks are lost.
TEST(StaticWays, ABalanceFoundAfterBeginningAgainIsLookedForInParts)
{
    hdem::Setup setup = build_model(tunnel_in_weak_rock(10.0, 0.0));
    Simulation tunnel(std::move(setup.model), std::move(setup.state));
    const std::vector<StageResult> results = run_stages(tunnel, {});
    ASSERT_TRUE(results[1].statics);
    EXPECT_EQ(results[1].statics->outcome, "no_equilibrium");
    EXPECT_GT(results[1].statics->loose.size(), 47U);
}

TEST(StaticWays, WhatIsLetGoInPartsIsNoLoadAndEndsWhereOneSearchDoes)
{
    CaseDef scene = tunnel_in_weak_rock(35.0, 1e5);
    scene.stages[1].solver = RestSolver::dynamics;  // the tunnel is made, and nothing is brought to rest
    hdem::Setup setup = build_model(scene);
    Simulation tunnel(std::move(setup.model), std::move(setup.state));
    tunnel.begin_stage(0);
    tunnel.advance(1);
    tunnel.begin_stage(1);
    const StaticRule rule = static_rule(tunnel.model());
    State at_once = tunnel.state(), in_parts = tunnel.state();
    ASSERT_EQ(search_at_once(tunnel.model(), at_once, 1, rule).kind, Kind::balanced);
    ASSERT_EQ(search_in_parts(tunnel.model(), in_parts, 1, rule).kind, Kind::balanced);
    EXPECT_EQ(in_parts.ledger.load_work, tunnel.state().ledger.load_work);
    const DisplacementReport one = report_displacements(tunnel.model(), at_once),
                             other = report_displacements(tunnel.model(), in_parts);
    EXPECT_GT(one.mean, 1e-4);
    EXPECT_NEAR(other.mean, one.mean, 0.02 * one.mean);
}

/// Stiff rock in which weight that acts at once leaves roof joints open: by slow cycles the tunnel moves by 0.04 mm, from such a start by 22 mm.
TEST(StaticWays, WeightInPartsLeavesJointsThatBear)
{
    const std::string text = R"(
[domain]
width = 30
height = 22
fixed = ["left", "right", "bottom"]
[[joint_set]]
dip_deg = 53.6
spacing = 1.22
[[joint_set]]
dip_deg = -83.2
spacing = 1.12
deviation_deg = 1
[[joint_set]]
dip_deg = -17.2
spacing = 2.8
deviation_deg = 2
[generator]
seed = 9
smallest_block_area = 0.149
smallest_edge = 0
[[excavation]]
name = "tunnel"
shape = "horseshoe"
position = [15, 8.8]
width = 5.96405
height = 4.14554
inside = "jointed"
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 3e10
shear_stiffness = 3e10
friction_angle_deg = 35
cohesion = 100000
[contact]
method = "force"
[[stage]]
until = "converged"
solver = "static"
[[stage]]
excavate = ["tunnel"]
until = "converged"
solver = "static"
)";
    CaseRun run(read_case_text(text, "case.toml").def);
    const std::vector<StageResult> results = run_stages(run.simulation, {});
    ASSERT_EQ(results.size(), 2U);
    EXPECT_TRUE(results[1].at_rest);
    double greatest = 0.0;
    for (Index b = 0; b < run.state().blocks.size(); ++b)
        if (run.state().blocks.is_free(b))
            greatest = std::max(greatest, run.state().blocks.displacement(b).norm());
    EXPECT_LT(greatest, 1e-4);
}

TEST(StaticWays, NearlyInBalanceIsTakenUnlessTheRuleForbidsIt)
{
    const CaseRun rock(jointed_rock());
    StaticRule rule = static_rule(rock.model());
    rule.accepted = 1e-14;  // less than a search is carried to
    State near = rock.state();
    const StaticOutcome taken = solve_statics(rock.model(), near, 1, rule);
    ASSERT_EQ(taken.kind, Kind::nearly_balanced);
    EXPECT_TRUE(taken.is_taken());
    EXPECT_LE(taken.residual, rule.nearly);
    EXPECT_NE(state_hash(rock.model(), near), rock.hash());
    for (Index b = 0; b < rock.model().blocks(); ++b)
        EXPECT_EQ(near.blocks.velocity(b).norm(), 0.0);
    rule.nearly = 1e-14;
    State left = rock.state();
    const StaticOutcome refused = solve_statics(rock.model(), left, 1, rule);
    EXPECT_EQ(refused.kind, Kind::not_converged);
    EXPECT_FALSE(refused.is_taken());
    EXPECT_EQ(state_hash(rock.model(), left), rock.hash());
}

/// Edges by which a block that stands on a corner faces the ground, after it has been turned over that corner's middle.
std::pair<Index, Index> edges_after_turning(int searches)
{
    CaseDef scene = scenes::block_on_ground(1.0, 1.0);
    const double half = std::sqrt(0.5);
    scene.blocks[1].polygon = {{0.0, 0.0}, {half, half}, {0.0, 2.0 * half}, {-half, half}};
    const CaseRun run(scene);
    State state = run.state();
    StaticSearch search(run.model(), state, 1, static_rule(run.model()));
    BlockMotion& motion = state.blocks.motion[run.slot("block")];
    const auto turn_to = [&](double angle)
    {
        motion.angle = angle;
        motion.c = std::cos(angle);
        motion.s = std::sin(angle);
    };
    turn_to(radians(3.0));
    for (int i = 0; i < searches; ++i)
        search.find_contacts();
    turn_to(radians(-3.0));
    search.find_contacts();
    EXPECT_EQ(state.contacts.size(), 1);
    return {state.contacts.ref_edge[0], state.contacts.inc_edge[0]};
}

TEST(StaticSearch, KeepsFeaturesFromTheSixthSearchOn)
{
    EXPECT_EQ(edges_after_turning(1), edges_after_turning(2));
    EXPECT_NE(edges_after_turning(4), edges_after_turning(5));
    EXPECT_EQ(edges_after_turning(5), edges_after_turning(7));
}
}  // namespace
}  // namespace hdem
