#include "core/motion/released_forces.h"
#include "core/state/state_hash.h"
#include "parallel/stages.h"
#include "verification/unit/case_run.h"

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;

constexpr std::int64_t settled = 20'000;
constexpr std::int64_t relaxed = 400;

/// A block of 1 m on the ground, a second one on it a quarter of a metre to the right.
CaseDef two_on_ground(const std::string& gone)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "ground", rectangle({-3, -1}, {6, 0}));
    scenes::add_block(scene, "lower", rectangle({0, 0}, {1, 1}));
    scenes::add_block(scene, "upper", rectangle({0.25, 1}, {1.25, 2}));
    scene.contact.method = Method::force;
    scene.stages = {{.name = "settle", .cycles = settled},
                    {.name = "dig", .cycles = 2 * relaxed, .relax_cycles = relaxed, .excavate = {gone}}};
    return scene;
}

double weight(const CaseRun& run, const std::string& block)
{
    return run.model().mass[run.slot(block)] * run.model().gravity.norm();
}

/// Sum of the normal forces between the lower block and the ground.
double on_ground(const CaseRun& run)
{
    const Contacts& contacts = run.state().contacts;
    const Index ground = run.slot("ground"), lower = run.slot("lower");
    double sum = 0.0;
    for (Index i = 0; i < contacts.size(); ++i)
        if (std::minmax(contacts.ref[i], contacts.inc[i]) == std::minmax(ground, lower))
            sum += contacts.normal_force(0, i) + contacts.normal_force(1, i);
    return sum;
}

TEST(ReleasedForces, AreWhatTheBlocksGave)
{
    CaseRun run(two_on_ground("upper"));
    run.advance(settled);
    run.simulation.begin_stage(1);
    ASSERT_EQ(run.state().released.size(), 1U);
    const ReleasedForce& force = run.state().released.front();
    EXPECT_EQ(force.block, run.slot("lower"));
    const double load = weight(run, "upper");
    EXPECT_NEAR(force.x, 0.0, 1e-5 * load);
    EXPECT_NEAR(force.y, -load, 1e-5 * load);
    EXPECT_NEAR(force.moment, -0.25 * load, 1e-5 * load) << "a quarter of a metre to the right: it turns clockwise";
}

TEST(ReleasedForces, AreTakenOffEvenly)
{
    CaseRun run(two_on_ground("upper"));
    run.advance(settled);
    run.simulation.begin_stage(1);
    const double load = weight(run, "upper"), own = weight(run, "lower");
    run.advance(1);
    EXPECT_NEAR(on_ground(run), own + load, 1e-4 * load) << "nothing happens at once";
    run.advance(relaxed / 2 - 1);
    EXPECT_NEAR(on_ground(run), own + 0.5 * load, 0.03 * load);
    EXPECT_FALSE(run.state().released.empty());
    run.advance(relaxed / 2);
    EXPECT_TRUE(run.state().released.empty());
    run.advance(relaxed);
    EXPECT_NEAR(on_ground(run), own, 0.01 * load);
    EXPECT_LT(relative_residual(run.state().ledger, stored_energy(run.model(), run.state())), 1e-9);
}

/// A share that is left acts until its stage ends; the next one takes it off.
TEST(ReleasedForces, StopAtTheShareThatIsToBeLeft)
{
    CaseDef scene = two_on_ground("upper");
    scene.stages[1].relax_to = 0.4;
    scene.stages[1].cycles = 10 * relaxed;
    scene.stages.push_back({.name = "rest", .cycles = 10 * relaxed, .relax_cycles = relaxed});
    CaseRun run(scene);
    run.advance(settled);
    run.simulation.begin_stage(1);
    const double load = weight(run, "upper"), own = weight(run, "lower");
    run.advance(10 * relaxed);
    EXPECT_FALSE(run.state().released.empty());
    EXPECT_NEAR(on_ground(run), own + 0.4 * load, 1e-3 * load);
    EXPECT_LT(relative_residual(run.state().ledger, stored_energy(run.model(), run.state())), 1e-9);
    hdem::Setup again = build_model(scene);
    Simulation going_on(std::move(again.model), run.state(), 1);
    for (Simulation* simulation : {&run.simulation, &going_on})
    {
        simulation->begin_stage(2);
        simulation->advance(relaxed / 2);
    }
    EXPECT_NEAR(on_ground(run), own + 0.2 * load, 0.02 * load);
    run.advance(9 * relaxed);
    going_on.advance(9 * relaxed);
    EXPECT_EQ(state_hash(going_on.model(), going_on.state()), run.hash());
    EXPECT_TRUE(run.state().released.empty());
    EXPECT_NEAR(on_ground(run), own, 1e-3 * load);
}

/// A stage that looks for rest ends with what is left, and its blocks rest.
TEST(ReleasedForces, ThatAreLeftLetBlocksRest)
{
    CaseDef scene = two_on_ground("upper");
    scene.contact.method = Method::hybrid;
    scene.stages[1] = {.name = "dig", .until_converged = true, .relax_cycles = relaxed, .relax_to = 0.5, .excavate = {"upper"}};
    hdem::Setup setup = build_model(scene);
    Simulation simulation(std::move(setup.model), std::move(setup.state), 1);
    const std::vector<StageResult> results = run_stages(simulation, {});
    EXPECT_TRUE(results[1].at_rest);
    EXPECT_GT(results[1].cycles, relaxed);
    EXPECT_FALSE(simulation.state().released.empty());
}

/// Forces of rock under in-situ stress, in a stage of cycles: what is excavated leaves slowly, and the ledger explains all.
TEST(ReleasedForces, OfStressedRockInAStageOfCycles)
{
    CaseDef scene = scenes::joints(12.0, 12.0, 1.5, 0.0);
    scene.domain.fixed = {"left", "right", "bottom", "top"};
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::force;
    scene.insitu = {.given = true, .stress = StressDef{-2e6, -1e6, 0.0}};
    scene.excavations = {{.name = "room", .shape = OutlineShape::rectangle, .position = {6.0, 4.5}, .width = 3.0, .height = 3.0}};
    scene.stages = {{.name = "hold", .cycles = 200}, {.name = "dig", .cycles = 6000, .excavate = {"room"}}};
    CaseDef slowly = scene;
    slowly.stages[1].relax_cycles = 3000;
    const auto greatest_kinetic = [](const CaseDef& def)
    {
        CaseRun run(def);
        run.advance(200);
        EXPECT_LT(run.state().ledger.friction, 1e-9) << "J: nothing moves before";
        run.simulation.begin_stage(1);
        EXPECT_EQ(run.state().released.empty(), def.stages[1].relax_cycles == 0);
        double most = 0.0;
        for (int i = 0; i < 600; ++i)
        {
            run.advance(10);
            most = std::max(most, stored_energy(run.model(), run.state()).kinetic);
        }
        EXPECT_TRUE(run.state().released.empty());
        EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-6);
        return most;
    };
    EXPECT_LT(greatest_kinetic(slowly), 0.1 * greatest_kinetic(scene));
}

/// What stood on the removed block falls with a(t) = g t / T, so far as g T^2 / 6.
TEST(ReleasedForces, OfASupportLetItsLoadFallSlowly)
{
    CaseDef scene = two_on_ground("lower");
    scene.damping.preset = DampingPreset::dynamic;
    scene.blocks[2].polygon = rectangle({0.0, 1.0}, {1.0, 2.0});
    scene.stages = {
        {.name = "settle", .cycles = settled, .damping = DampingPreset::paper},
        {.name = "dig", .cycles = relaxed, .relax_cycles = relaxed, .excavate = {"lower"}, .damping = DampingPreset::dynamic}};
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(settled);
    run.simulation.begin_stage(1);
    run.advance(relaxed);
    const double t = relaxed * run.model().time_step;
    EXPECT_NEAR(run.displacement("upper").y(), -run.model().gravity.norm() * t * t / 6.0, 0.01 * t * t);
    EXPECT_LT(relative_residual(run.state().ledger, stored_energy(run.model(), run.state())), 1e-9);
}

TEST(ReleasedForces, KeepAStageFromBeingAtRest)
{
    CaseDef scene = two_on_ground("upper");
    scene.convergence.least_cycles = 1;
    scene.stages[1] = {.name = "dig", .until_converged = true, .max_cycles = 100'000, .relax_cycles = 3000, .excavate = {"upper"}};
    CaseRun run(scene);
    const std::vector<StageResult> results = run_stages(run.simulation, {}, nullptr);
    EXPECT_TRUE(results.back().at_rest);
    EXPECT_GE(results.back().cycles, 3000);
    EXPECT_NEAR(on_ground(run), weight(run, "lower"), 1e-3 * weight(run, "lower"));
}

/// Steps that vary, blocks that rest afterwards: however the run is cut into calls.
TEST(ReleasedForces, EndInTheirCycleHoweverARunIsCut)
{
    CaseDef scene = two_on_ground("upper");
    scene.stages[1] = {.name = "dig", .until_converged = true, .max_cycles = 100'000, .relax_cycles = 401, .excavate = {"upper"}};
    CaseRun whole(scene), cut(scene);
    for (CaseRun* run : {&whole, &cut})
    {
        run->advance(settled);
        run->simulation.begin_stage(1);
    }
    whole.advance(1000);
    for (const std::int64_t cycles : {1, 399, 2, 1, 597})
        cut.advance(cycles);
    EXPECT_EQ(state_hash(whole.model(), whole.state()), state_hash(cut.model(), cut.state()));
    EXPECT_EQ(whole.state().time, cut.state().time);
}
/// In the first stage loads grow with the weight: a slab that is pushed and lifted while it weighs nothing would slide away.
TEST(ReleasedForces, OfTheFirstStageHoldBackLoads)
{
    constexpr std::int64_t grown = 5000;
    CaseDef scene = scenes::empty_scene();
    scene.joints[0].friction_angle_deg = 30.0;
    scenes::add_fixed_block(scene, "ground", rectangle({-5, -1}, {25, 0}));
    scenes::add_block(scene, "lower", rectangle({0, 0}, {3, 1}));
    scene.contact.method = Method::force;
    scene.loads.push_back({.name = "quake", .blocks = {"lower"}, .acceleration = {2.0, 4.0}});
    scene.loads.push_back({.name = "short", .blocks = {"lower"}, .force = {0.0, -1e4}});
    scene.loads.back().interval.until_cycle = grown / 2;  // ends before: acts in full
    scene.stages = {{.name = "rest", .cycles = 3 * grown, .relax_cycles = grown}};
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    const double pressed = weight(run, "lower") * (1.0 - 4.0 / 9.81);
    run.advance(grown / 4);
    EXPECT_NEAR(on_ground(run), 0.25 * pressed + 1e4, 0.02 * pressed);
    run.advance(grown / 2);
    EXPECT_NEAR(on_ground(run), 0.75 * pressed, 0.02 * pressed);
    run.advance(2 * grown);
    EXPECT_NEAR(on_ground(run), pressed, 1e-3 * pressed);
    EXPECT_LT(run.displacement("lower").norm(), 1e-3);
}
/// A bolt that would drag a slab without weight along: 30 kN, when the slab weighs 81 kN with a friction angle of 30 degrees.
TEST(ReleasedForces, OfTheFirstStageHoldBackPretension)
{
    constexpr std::int64_t grown = 5000;
    CaseDef scene = scenes::empty_scene();
    scene.joints[0].friction_angle_deg = 30.0;
    scenes::add_fixed_block(scene, "ground", rectangle({-8, -2}, {25, 0}));
    scenes::add_block(scene, "lower", rectangle({0, 0}, {3, 1}));
    scene.contact.method = Method::force;
    BoltDef& bolt = scene.bolts.emplace_back();
    bolt.name = "bolt";
    bolt.from = Vec2(0.1, 0.5);
    bolt.to = Vec2(-6.0, -0.5);
    bolt.stiffness = 1e4;
    bolt.pretension = 3e4;
    scene.stages = {{.name = "rest", .cycles = 3 * grown, .relax_cycles = grown}};
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    const double pull = 3e4 * 1.0 / std::hypot(6.1, 1.0), own = weight(run, "lower");
    run.advance(grown / 2);
    EXPECT_NEAR(on_ground(run), 0.5 * (own + pull), 0.02 * own);
    run.advance(2 * grown);
    EXPECT_NEAR(on_ground(run), own + pull, 1e-3 * own);
    EXPECT_LT(run.displacement("lower").norm(), 1e-3);
}
/// Impulses press nothing into springs: in the stage that follows they begin empty. A joint with 1.2 times the strength that it needs breaks unless the weight
/// grows.
TEST(ReleasedForces, GrowAfterImpulses)
{
    for (const bool grows : {false, true})
    {
        CaseDef scene = scenes::empty_scene();
        scene.joints[0].cohesion = 5e6;
        scene.joints[0].tension = 1.2 * 2700.0 * 9.81 * 1.5;
        scenes::add_fixed_block(scene, "roof", rectangle({-1, 0}, {3, 1}));
        scenes::add_block(scene, "lower", rectangle({0, -1.5}, {2, 0}));
        scene.contact.method = Method::impulse;
        scene.stages = {{.name = "hang", .cycles = 2000},
                        {.name = "springs", .cycles = 20'000, .relax_cycles = grows ? 5000 : 0, .method = Method::force}};
        CaseRun run(scene);
        run.simulation.begin_stage(0);
        run.advance(2000);
        EXPECT_LT(run.displacement("lower").norm(), 1e-6);
        run.simulation.begin_stage(1);
        run.advance(20'000);
        EXPECT_EQ(run.displacement("lower").norm() < 1e-3, grows);
    }
}
}  // namespace
}  // namespace hdem
