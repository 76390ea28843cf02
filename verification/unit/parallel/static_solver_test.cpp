#include "parallel/stages.h"
#include "parallel/static_solver.h"
#include "verification/unit/case_run.h"

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;
using Kind = StaticOutcome::Kind;

CaseDef seeking_rest(CaseDef scene)
{
    scene.contact.method = Method::force;
    scene.stages = {{.name = "rest", .until_converged = true, .solver = RestSolver::dynamics}};  // the tests call it themselves
    return scene;
}

/// A case, its static solution, and cycles that go on from it.
struct StaticRun
{
    explicit StaticRun(const CaseDef& scene, int threads = 1)
        : run(seeking_rest(scene)),
          state(run.state()),
          outcome(solve_statics(run.model(), state, threads, static_rule(run.model())))
    {
    }

    [[nodiscard]] std::set<std::string> loose() const
    {
        std::set<std::string> names;
        for (const Index b : outcome.loose)
            names.insert(run.model().name[b]);
        return names;
    }

    /// Displacements are counted from the static solution on.
    [[nodiscard]] CaseRun cycles(std::int64_t count) const
    {
        Setup setup{.model = run.model(), .state = state};
        setup.state.contacts_outdated = true;
        CaseRun after(std::move(setup));
        after.advance(count);
        return after;
    }

    CaseRun run;
    State state;
    StaticOutcome outcome;
};

/// A flat block on a plane that slopes by the angle at which friction of 30 degrees has this factor of safety.
CaseDef block_on_slope(double factor)
{
    CaseDef scene = scenes::block_on_ground(2.0, 0.5);
    const double slope = std::atan(std::tan(radians(30.0)) / factor);
    scene.gravity = 9.81 * Vec2(std::sin(slope), -std::cos(slope));
    return scene;
}

TEST(StaticSolver, ABlockOnASlopeSticksBelowItsFrictionAngle)
{
    const StaticRun slope(block_on_slope(1.01));
    ASSERT_EQ(slope.outcome.kind, Kind::balanced);
    EXPECT_TRUE(slope.outcome.loose.empty());
    const CaseRun after = slope.cycles(1);
    const Vec2 weight = slope.run.model().mass[slope.run.slot("block")] * slope.run.model().gravity;
    const Vec2 forces = after.forces_between("ground", "block");
    EXPECT_NEAR(forces.x(), -weight.y(), 1e-4 * weight.norm());
    EXPECT_NEAR(std::abs(forces.y()), weight.x(), 1e-4 * weight.norm());
}

TEST(StaticSolver, ABlockOnASlopeAboveItHasNoEquilibrium)
{
    const StaticRun slope(block_on_slope(0.99));
    EXPECT_EQ(slope.outcome.kind, Kind::no_equilibrium);
    EXPECT_EQ(slope.loose(), std::set<std::string>{"block"});
    EXPECT_EQ(state_hash(slope.run.model(), slope.state), slope.run.hash()) << "the state is left alone";
    EXPECT_EQ(slope.state.ledger.gravity_work, slope.run.state().ledger.gravity_work);
}

TEST(StaticSolver, APillarBearsTheWeightOfWhatStandsOnIt)
{
    const StaticRun pillar(scenes::stack(5));
    ASSERT_EQ(pillar.outcome.kind, Kind::balanced);
    const CaseRun after = pillar.cycles(1);
    const double weight = 2700.0 * 9.81;
    double sunk = 0.0;
    for (int k = 1; k <= 5; ++k)
    {
        const std::string name = "block" + std::to_string(k);
        const std::string below = k == 1 ? "ground" : "block" + std::to_string(k - 1);
        EXPECT_NEAR(after.forces_between(below, name).x(), (6 - k) * weight, 1e-4 * weight);
        sunk += (6 - k) * weight / 7e9;
        EXPECT_NEAR(pillar.state.blocks.displacement(pillar.run.slot(name)).y(), -sunk, 1e-3 * sunk);
    }
}

TEST(StaticSolver, CyclesFindTheBlocksAtRest)
{
    const StaticRun rock(scenes::grid(6, 8));
    ASSERT_EQ(rock.outcome.kind, Kind::balanced);
    const CaseRun one = rock.cycles(1);
    const Equilibrium now = one.simulation.equilibrium();
    EXPECT_LT(now.unbalanced_force_ratio(), rock.run.model().convergence.unbalanced_force_ratio);
    EXPECT_LT(now.unbalanced.value, rock.run.model().convergence.block_unbalanced_ratio);
    const CaseRun after = rock.cycles(1000);
    for (Index b = 0; b < rock.run.model().blocks(); ++b)
        EXPECT_LT(after.state().blocks.displacement(b).norm(), 1e-9);
}

/// Two blocks between two walls, nothing below them: they bear themselves by leaning on each other, if friction at the walls bears their weight.
CaseDef flat_arch(double friction_angle_deg)
{
    CaseDef scene = scenes::empty_scene();
    scene.joints[0].friction_angle_deg = friction_angle_deg;
    scenes::add_fixed_block(scene, "left_wall", rectangle({-1, -1}, {0, 2}));
    scenes::add_fixed_block(scene, "right_wall", rectangle({4, -1}, {5, 2}));
    scenes::add_block(scene, "left", rectangle({0, 0}, {2, 1}));
    scenes::add_block(scene, "right", rectangle({2, 0}, {4, 1}));
    return scene;
}

TEST(StaticSolver, TwoBlocksBetweenWallsBearThemselvesAsAnArch)
{
    const StaticRun arch(flat_arch(60.0));
    ASSERT_EQ(arch.outcome.kind, Kind::balanced);
    EXPECT_TRUE(arch.outcome.loose.empty());
    const CaseRun after = arch.cycles(1);
    const double weight = 2.0 * 2700.0 * 9.81;
    const Vec2 left = after.forces_between("left_wall", "left"), right = after.forces_between("right", "right_wall");
    const Vec2 crown = after.forces_between("left", "right");
    EXPECT_NEAR(std::abs(left.y()), weight, 1e-4 * weight);
    EXPECT_NEAR(std::abs(right.y()), weight, 1e-4 * weight);
    EXPECT_NEAR(crown.y(), 0.0, 1e-4 * weight);
    EXPECT_NEAR(crown.x(), left.x(), 1e-4 * weight);
    // The thrust turns each block against its weight, with an arm of 1 m at most.
    EXPECT_GT(crown.x(), weight);
    EXPECT_LT(crown.x(), 1.01 * weight);
}

TEST(StaticSolver, AnArchThatSlidesOutHasNoEquilibrium)
{
    const StaticRun arch(flat_arch(35.0));
    EXPECT_EQ(arch.outcome.kind, Kind::no_equilibrium);
    EXPECT_EQ(arch.loose(), (std::set<std::string>{"left", "right"}));
}

/// Thirty pillars, and a block on a steep face.
CaseDef pillars_and_a_sliding_block()
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "ground", rectangle({-1, -1}, {70, 0}));
    scenes::add_fixed_block(scene, "slope", {{-12, 0}, {-2, 0}, {-12, 10}});
    for (int i = 0; i < 30; ++i)
        scenes::add_block(scene, "pillar" + std::to_string(i), rectangle({2.0 * i, 0.0}, {2.0 * i + 1.0, 1.0}));
    scenes::add_block(scene, "sliding", {{-7, 5}, {-6, 4}, {-5, 5}, {-6, 6}});
    return scene;
}

TEST(StaticSolver, ABlockThatComesAwayIsNamedAndFallsInTheCyclesThatFollow)
{
    const StaticRun pillars(pillars_and_a_sliding_block());
    ASSERT_EQ(pillars.outcome.kind, Kind::balanced);
    EXPECT_EQ(pillars.loose(), std::set<std::string>{"sliding"});
    const CaseRun after = pillars.cycles(3000);
    EXPECT_GT(after.displacement("sliding").norm(), 0.05);
    EXPECT_LT(after.displacement("pillar7").norm(), 1e-9);
}

CaseDef jointed_rock()
{
    CaseDef scene = scenes::joints(16.0, 16.0, 0.8, 2.0);
    scene.joints[0].cohesion = 5e4;
    return scene;
}

TEST(StaticSolver, WhatNewFeaturesTakeFromASpringIsGivenBack)
{
    const StaticRun rock(scenes::three_joint_sets(1.7, 35.0, 1e5));
    ASSERT_EQ(rock.outcome.kind, Kind::balanced);
    for (Index i = 0; i < rock.state.contacts.size(); ++i)
        for (int k = 0; k < 2; ++k)
            EXPECT_EQ(rock.state.contacts.rest_overlap(k, i), 0.0) << i;
}

TEST(StaticSolver, WeakJointsComeToRest)
{
    const StaticRun rock(scenes::three_joint_sets(1.0, 15.0, 1000.0));
    EXPECT_EQ(rock.outcome.kind, Kind::balanced);
    EXPECT_LT(rock.outcome.iterations, 200);  // of all parts of the weight
}

/// All lengths, and the cohesion with them: pressures and overlaps then grow as lengths do.
CaseDef scaled(CaseDef scene, double scale)
{
    scene.domain.width *= scale;
    scene.domain.height *= scale;
    for (JointSetDef& set : scene.joint_sets)
        set.spacing *= scale;
    scene.generator.smallest_block_area *= scale * scale;
    scene.generator.smallest_edge *= scale;
    for (BlockDef& block : scene.blocks)
        for (Vec2& p : block.polygon)
            p *= scale;
    for (JointDef& joint : scene.joints)
        joint.cohesion *= scale;
    return scene;
}

/// Steps differ, since the linear solver's residual has forces and moments in it. Friction allows neighbouring answers, and a corner that begins to bear in one may not in the
/// other: one block is off by 3 % of the greatest way.
TEST(StaticSolver, AModelOfAnySizeHasTheSameAnswer)
{
    const StaticRun rock(jointed_rock()), pillars(pillars_and_a_sliding_block());
    for (const double scale : {1.0 / 128.0, 128.0})
    {
        const StaticRun same_rock(scaled(jointed_rock(), scale)), same_pillars(scaled(pillars_and_a_sliding_block(), scale));
        EXPECT_EQ(same_pillars.outcome.kind, pillars.outcome.kind) << scale;
        EXPECT_EQ(same_pillars.loose(), pillars.loose()) << scale;
        ASSERT_EQ(same_rock.outcome.kind, rock.outcome.kind) << scale;
        double greatest = 0.0, off = 0.0, squares = 0.0;
        for (Index b = 0; b < rock.state.blocks.size(); ++b)
        {
            const Vec2 way = rock.state.blocks.displacement(b);
            greatest = std::max(greatest, way.norm());
            const double by = (same_rock.state.blocks.displacement(b) / scale - way).norm();
            off = std::max(off, by);
            squares += by * by;
        }
        EXPECT_LT(off, 4e-2 * greatest) << scale;
        EXPECT_LT(std::sqrt(squares / static_cast<double>(rock.state.blocks.size())), 1e-2 * greatest) << scale;
    }
}

TEST(StaticSolver, GivesTheSameBitsOnAnyNumberOfThreads)
{
    const StaticRun one(jointed_rock(), 1), three(jointed_rock(), 3);
    ASSERT_EQ(one.outcome.kind, Kind::balanced);
    EXPECT_EQ(one.outcome.iterations, three.outcome.iterations);
    EXPECT_EQ(state_hash(one.run.model(), one.state), state_hash(three.run.model(), three.state));
    EXPECT_EQ(one.state.ledger.local_damping, three.state.ledger.local_damping);
}

TEST(StaticSolver, TheLedgerStaysClosed)
{
    const StaticRun rock(jointed_rock());
    ASSERT_EQ(rock.outcome.kind, Kind::balanced);
    const EnergyLedger &before = rock.run.state().ledger, &after = rock.state.ledger;
    EXPECT_GT(after.gravity_work, before.gravity_work);
    EXPECT_GT(after.friction, before.friction);
    EXPECT_GT(after.local_damping, before.local_damping);
    EXPECT_NEAR(residual(after, stored_energy(rock.run.model(), rock.state)),
                residual(before, stored_energy(rock.run.model(), rock.run.state())), 1e-9 * after.gravity_work);
}

/// A room in jointed rock whose forces are taken off over 4000 cycles, and over the parts of a static solution.
TEST(StaticSolver, TakesForcesOfExcavatedBlocksOffInPartsAsCyclesDo)
{
    CaseDef scene = scenes::three_joint_sets(1.7, 35.0, 1e5);
    scene.contact.method = Method::force;
    scene.excavations = {{.name = "room", .shape = OutlineShape::circle, .position = {17.5, 12.5}, .diameter = 6.0}};
    scene.stages = {{.name = "gravity", .until_converged = true, .solver = RestSolver::statics},
                    {.name = "dig", .until_converged = true, .max_cycles = 60'000, .relax_cycles = 4000, .excavate = {"room"}}};
    CaseDef by_parts = scene;
    by_parts.stages[1].solver = RestSolver::statics;
    hdem::Setup slow = build_model(scene), fast = build_model(by_parts);
    Simulation cycles(std::move(slow.model), std::move(slow.state)), parts(std::move(fast.model), std::move(fast.state));
    run_stages(cycles, {});
    const std::vector<StageResult> results = run_stages(parts, {});
    ASSERT_TRUE(results[1].statics && results[1].statics->outcome == "balanced");
    EXPECT_TRUE(parts.state().released.empty());
    EXPECT_LT(results[1].cycles, 4000);
    EXPECT_TRUE(results[1].to_come.empty()) << results[1].to_come.front();
    EXPECT_NE(parts.state().ledger.load_work, 0.0);
    EXPECT_LT(std::abs(relative_residual(parts.state().ledger, stored_energy(parts.model(), parts.state()))), 1e-9);
    const DisplacementReport one = report_displacements(cycles.model(), cycles.state()),
                             other = report_displacements(parts.model(), parts.state());
    EXPECT_GT(one.mean, 1e-4);
    EXPECT_NEAR(other.mean, one.mean, 0.02 * one.mean);
}

TEST(StaticSolver, IsTriedWhereAStageEndsAtRest)
{
    CaseDef scene = seeking_rest(jointed_rock());
    scene.stages[0].solver = RestSolver::statics;
    EXPECT_TRUE(CaseRun(scene).simulation.statics().has_value());
    scene.stages[0].solver = RestSolver::dynamics;
    EXPECT_FALSE(CaseRun(scene).simulation.statics().has_value());
    scene.stages[0] = {.name = "run", .cycles = 10};
    EXPECT_FALSE(CaseRun(scene).simulation.statics().has_value());
}
}  // namespace
}  // namespace hdem
