#include "core/stage/rules.h"
#include "parallel/stages.h"
#include "parallel/state_check.h"
#include "verification/unit/case_run.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace hdem
{
namespace
{
using test::CaseRun;
using testing::ElementsAre;
using testing::HasSubstr;

/// Notes what it is shown.
class Witness : public Observer
{
  public:
    explicit Witness(std::int64_t every) : every_(every) {}
    std::int64_t next_cycle(std::int64_t now) const override { return next_multiple(now, every_); }
    void begin_stage(const Model&, const State&) override { events.push_back("begin"); }
    void observe(const Model&, const State& state) override { events.push_back(std::to_string(state.cycle)); }
    void end_stage(const Model&, const State&) override { events.push_back("end"); }

    std::vector<std::string> events;

  private:
    std::int64_t every_;
};

std::vector<StageResult> run_all(const CaseDef& scene, std::vector<Observer*> observers = {})
{
    hdem::Setup setup = build_model(scene);
    Simulation simulation(std::move(setup.model), std::move(setup.state));
    return run_stages(simulation, observers);
}

TEST(Stages, SayWhatAStaticSolutionFoundAtTheirBeginning)
{
    CaseDef scene = scenes::joints(16.0, 16.0, 0.8, 2.0);
    scene.joints[0].cohesion = 5e4;
    scene.contact.method = Method::force;
    scene.stages = {{.name = "settle", .cycles = 10}, {.name = "rest", .until_converged = true, .solver = RestSolver::statics}};
    const std::vector<StageResult> results = run_all(scene);
    EXPECT_FALSE(results[0].statics.has_value());
    ASSERT_TRUE(results[1].statics.has_value());
    EXPECT_EQ(results[1].statics->outcome, "balanced");
    EXPECT_GT(results[1].statics->iterations, 0);
    EXPECT_LT(results[1].statics->residual, 1e-5);
}

TEST(Stages, TellTheirKeeperOfEachIterationOfAStaticSolution)
{
    class Follower : public Keeper
    {
      public:
        [[nodiscard]] std::int64_t next_cycle(std::int64_t) const override { return std::numeric_limits<std::int64_t>::max(); }
        [[nodiscard]] bool keep(const Simulation&) override { return true; }
        void follow_statics(int iterations, double ratio) override
        {
            EXPECT_EQ(iterations, ++count);
            last = ratio;
        }
        int count = 0;
        double last = 1.0;
    };
    CaseDef scene = scenes::joints(16.0, 16.0, 0.8, 2.0);
    scene.joints[0].cohesion = 5e4;
    scene.contact.method = Method::force;
    scene.stages = {{.name = "rest", .until_converged = true, .solver = RestSolver::statics}};
    hdem::Setup setup = build_model(scene);
    Simulation simulation(std::move(setup.model), std::move(setup.state));
    Follower keeper;
    const std::vector<StageResult> results = run_stages(simulation, {}, &keeper);
    ASSERT_TRUE(results[0].statics.has_value());
    EXPECT_GE(keeper.count, results[0].statics->iterations);
    EXPECT_GT(results[0].statics->iterations, 0);
    EXPECT_LT(keeper.last, 1e-3);
}

/// The step of what moves is found anew where a load ends within a stage: it was taken as 0, and positions were not numbers any more.
TEST(Stages, GoOnWhereALoadEndsWithinThem)
{
    for (const Method method : {Method::force, Method::impulse, Method::hybrid})
    {
        CaseDef scene = scenes::block_on_ground(1.0, 0.5);
        scene.contact.method = method;
        scene.loads = {{.blocks = {"block"}, .force = {20e3, 0.0}, .interval = {.until_time = 0.3}}};
        scene.stages = {{.name = "pushed", .until_converged = true, .max_cycles = 50'000}};
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state));
        const std::vector<StageResult> results = run_stages(simulation, {});
        EXPECT_TRUE(results[0].at_rest) << name_of(method);
        // Pushed at a = F/m - g tan(phi), then held back by friction alone. On springs what is slower than the speed of settling is damped as it begins.
        const double friction = 9.81 * std::tan(30.0 * std::numbers::pi / 180.0), a = 20e3 / 1350.0 - friction, v = 0.3 * a;
        const double way = 0.5 * 0.3 * v + 0.5 * v * v / friction;
        EXPECT_NEAR(simulation.state().blocks.displacement(simulation.model().find_block("block")).x(), way,
                    (method == Method::impulse ? 0.01 : 0.1) * way)
            << name_of(method);
    }
}

TEST(Stages, EndAtRestWhereNothingIsFree)
{
    CaseDef scene = scenes::block_on_ground();
    scene.stages = {{.name = "a", .cycles = 10}, {.name = "b", .until_converged = true, .max_cycles = 5000, .fix = {"block"}}};
    const std::vector<StageResult> results = run_all(scene);
    EXPECT_TRUE(results[1].at_rest);
    EXPECT_EQ(results[1].cycles, 1000) << "convergence.least_cycles";
}

/// What is excavated may be a single block: that on it falls, at once or as its force is taken off.
TEST(Stages, MayExcavateABlockByItsName)
{
    for (const std::int64_t relax : {0, 500})
    {
        CaseDef scene = scenes::stack(3);
        scene.stages = {{.name = "stand", .until_converged = true},
                        {.name = "dig", .until_converged = true, .max_cycles = 100'000, .excavate = {"block2"}}};
        scene.stages[1].relax_cycles = relax;
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state));
        const std::vector<StageResult> results = run_stages(simulation, {});
        EXPECT_TRUE(results[1].at_rest) << relax;
        const Model& model = simulation.model();
        const Blocks& blocks = simulation.state().blocks;
        EXPECT_EQ(blocks.present[model.find_block("block2")], 0);
        EXPECT_LT(blocks.displacement(model.find_block("block1")).norm(), 1e-4);
        EXPECT_NEAR(blocks.displacement(model.find_block("block3")).y(), -1.0, 1e-4) << relax;
        EXPECT_EQ(simulation.state().next_to_excavation.size(), 2U);
    }
}

TEST(Stages, LastAsManyCyclesOrSecondsAsTheySay)
{
    CaseDef scene = scenes::block_on_ground();
    scene.time.step = 1e-4;
    scene.stages = {{.name = "cycles", .cycles = 123},
                    {.name = "seconds", .duration = 0.01},
                    {.name = "odd", .duration = 0.00101},
                    {.name = "none", .cycles = 0}};
    const std::vector<StageResult> results = run_all(scene);
    ASSERT_EQ(results.size(), 4u);
    EXPECT_EQ(results[0].cycles, 123);
    EXPECT_EQ(results[1].cycles, 100) << "0.01 s / 1e-4 s, in spite of rounding";
    EXPECT_EQ(results[1].first_cycle, 123);
    EXPECT_EQ(results[2].cycles, 11) << "begun is finished";
    EXPECT_EQ(results[3].cycles, 0);
    EXPECT_FALSE(results[0].at_rest);
}

TEST(Stages, ShowObserversTheCyclesTheyAskedForAndTheEnds)
{
    CaseDef scene = scenes::block_on_ground();
    scene.stages = {{.name = "one", .cycles = 25}, {.name = "two", .cycles = 10}};
    Witness tens(10), sevens(7), ends(0);
    run_all(scene, {&tens, &sevens, &ends});
    EXPECT_THAT(tens.events, ElementsAre("0", "begin", "10", "20", "25", "end", "begin", "30", "35", "end"));
    EXPECT_THAT(sevens.events, ElementsAre("0", "begin", "7", "14", "21", "25", "end", "begin", "28", "35", "end"));
    EXPECT_THAT(ends.events, ElementsAre("0", "begin", "25", "end", "begin", "35", "end"));
}

TEST(Stages, DoNotDependOnWhoWatches)
{
    CaseDef scene = scenes::pile(8, 4);
    scene.stages[0].cycles = 500;
    std::vector<std::uint64_t> hashes;
    for (const std::int64_t every : {0, 1, 37})
    {
        Witness witness(every);
        Observer* const observers[] = {&witness};
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state));
        run_stages(simulation, observers);
        hashes.push_back(state_hash(simulation.model(), simulation.state()));
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

CaseDef until_converged(const std::string& criterion)
{
    CaseDef scene = scenes::block_on_ground();
    scene.contact.method = Method::force;
    scene.stages = {{.name = "settle", .until_converged = true, .max_cycles = 20000}};
    scene.convergence = {.criteria = {criterion}, .least_cycles = 100, .check_every = 10};
    return scene;
}

TEST(Stages, EndOnceConvergedByEitherCriterion)
{
    for (const std::string criterion : {"kinetic_energy", "unbalanced_force_ratio"})
    {
        const std::vector<StageResult> results = run_all(until_converged(criterion));
        EXPECT_TRUE(results[0].at_rest) << criterion;
        EXPECT_TRUE(results[0].sought_rest);
        EXPECT_LT(results[0].cycles, 5000) << criterion;
        EXPECT_EQ(results[0].cycles % 10, 0);
        EXPECT_GE(results[0].cycles, 100);
    }
}

TEST(Stages, AreNotConvergedBeforeTheLeastCyclesNorAfterTheLimit)
{
    CaseDef scene = until_converged("kinetic_energy");
    scene.convergence.least_cycles = 3000;
    EXPECT_EQ(run_all(scene)[0].cycles, 3000);
    scene = until_converged("unbalanced_force_ratio");
    scene.convergence.unbalanced_force_ratio = 0.0;
    scene.stages[0].max_cycles = 555;
    const StageResult result = run_all(scene)[0];
    EXPECT_EQ(result.cycles, 555);
    EXPECT_FALSE(result.at_rest);
}

/// One block is pushed, without gravity. What wakes no block that has stopped is more than the criterion allows, which goes by the load.
TEST(Stages, ComeToRestWhereLoadsAreFarBelowWeights)
{
    CaseDef scene = scenes::joints(10.0, 8.66025403784, 0.866025403784);
    scene.joint_sets.clear();
    scene.domain.fixed = {"left", "right", "bottom", "top"};
    for (const double dip : {0.0, 60.0, -60.0})
        scene.joint_sets.push_back({.name = fmt::format("set {}", dip), .dip_deg = dip, .spacing = 0.866025403784});
    scene.joints[0].normal_stiffness = 5e9;
    scene.joints[0].shear_stiffness = 2e9;
    scene.joints[0].friction_angle_deg = 35.0;
    scene.gravity = {0.0, 0.0};
    scene.insitu = {.given = true, .stress = StressDef{-1e6, -1e6, 0.0}};
    scene.loads.push_back({.blocks = {"b100"}, .force = {3e4, 1e4}});
    scene.contact.method = Method::force;
    scene.stages = {{.name = "push", .until_converged = true, .max_cycles = 50'000}};
    EXPECT_TRUE(run_all(scene)[0].at_rest);
}
}  // namespace
}  // namespace hdem
