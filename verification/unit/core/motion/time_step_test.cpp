#include "core/contact/block_forces.h"
#include "core/detection/contact_tracking.h"
#include "core/motion/time_step.h"
#include "verification/unit/block_pair.h"
#include "verification/unit/case_run.h"

#include <Eigen/Eigenvalues>

#include <numbers>

namespace hdem
{
namespace
{
using test::CaseRun;

TEST(PaperTimeStep, GivesThePrintedSteps)
{
    EXPECT_NEAR(paper_time_step(2700.0, 7e9, 0.1), 8.78e-5, 0.005e-5);           // sect. 4.1, one block of 1 m2
    EXPECT_NEAR(paper_time_step(0.3627 * 2700.0, 7e9, 0.1), 5.29e-5, 0.005e-5);  // sect. 4.4
}

TEST(PaperTimeStep, OfAModelBelongsToItsLightestFreeBlock)
{
    CaseDef scene = scenes::stack(2);
    scene.blocks[2].polygon = scenes::rectangle({0.0, 1.0}, {0.5, 1.5});
    scenes::add_fixed_block(scene, "pebble", scenes::rectangle({10.0, 0.0}, {10.01, 0.01}));
    const CaseRun run(scene);
    EXPECT_DOUBLE_EQ(run.model().time_step, paper_time_step(0.25 * 2700.0, 7e9, 0.1));
    scene.time.fraction = 0.2;
    EXPECT_DOUBLE_EQ(CaseRun(scene).model().time_step, 2.0 * run.model().time_step);
}

TEST(DefaultTimeStep, CountsLongSidesAsStiffer)
{
    CaseDef scene = scenes::block_on_ground(10.0, 0.1);
    EXPECT_DOUBLE_EQ(CaseRun(scene).model().time_step, paper_time_step(2700.0 / 2.5, 7e9, 0.1)) << "10 m: 2.5 times as stiff";
    scene.damping.preset = DampingPreset::paper;
    EXPECT_DOUBLE_EQ(CaseRun(scene).model().time_step, paper_time_step(2700.0, 7e9, 0.1)) << "to the letter";
    scene.damping.preset = DampingPreset::automatic;
    scenes::add_block(scene, "light", scenes::rectangle({20.0, 0.0}, {20.5, 0.5}));
    EXPECT_DOUBLE_EQ(CaseRun(scene).model().time_step, paper_time_step(0.25 * 2700.0, 7e9, 0.1))
        << "lighter than a quarter of 10 m deserves";
    scene.blocks[2].polygon = scenes::rectangle({20.0, 0.0}, {24.0, 4.0});
    scene.blocks[1].polygon = scenes::rectangle({-2.0, 0.0}, {2.0, 4.0});
    EXPECT_DOUBLE_EQ(CaseRun(scene).model().time_step, CaseRun(scene).model().paper_time_step) << "sides of 4 m";
}

double critical(const CaseRun& run, int iterations)
{
    return critical_time_step(run.model(), run.state().blocks, run.state().contacts, iterations);
}

TEST(CriticalTimeStep, OfABlockThatOnlyMovesUpAndDownIsTwoOverOmega)
{
    CaseDef scene = scenes::block_on_ground();
    scene.blocks[1].fix_x = scene.blocks[1].fix_rotation = true;
    EXPECT_NEAR(critical(CaseRun(scene), 60), 2.0 / std::sqrt(7e9 / 2700.0), 1e-9);  // one degree of freedom: exact
}

/// omega_max^2 of a free square of side 1 on immovable ground: up and down, or rocking, in which sway and rotation are coupled. Springs K_N/2, K_S/2 at
/// two points half a metre to the sides and below.
double greatest_on_ground(double mass)
{
    const double k_n = 7e9, k_s = 5e8, inertia = mass / 6.0, coupling = 0.5 * k_s / std::sqrt(mass * inertia);
    Eigen::Matrix2d stiffness;  // by mass: sway, rotation
    stiffness << k_s / mass, coupling, coupling, (0.25 * k_n + 0.25 * k_s) / inertia;
    return std::max(stiffness.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff(), k_n / mass);
}

TEST(CriticalTimeStep, OfAFreeBlockIsThatOfItsRockingMode)
{
    const double greatest = greatest_on_ground(2700.0);
    const CaseRun run(scenes::block_on_ground());
    EXPECT_NEAR(critical(run, 2000), 2.0 / std::sqrt(greatest), 1e-6 * 2.0 / std::sqrt(greatest)) << "converged power iteration";
    const double estimate = critical(run, 60);
    EXPECT_GE(estimate, 2.0 / std::sqrt(greatest) * (1.0 - 1e-9)) << "from above";
    EXPECT_LE(estimate, 2.0 / std::sqrt(greatest) * 1.05);
}

TEST(CriticalTimeStep, OfAChainIsThatOfItsHighestMode)
{
    for (const int n : {2, 5, 10})
    {
        CaseDef scene = scenes::stack(n);
        for (BlockDef& block : scene.blocks)
            block.fix_x = block.fix_rotation = true;
        const double omega = 2.0 * std::sqrt(7e9 / 2700.0) * std::sin((2 * n - 1) * std::numbers::pi / (2.0 * (2 * n + 1)));
        const CaseRun run(scene);
        EXPECT_NEAR(critical(run, 5000), 2.0 / omega, 1e-6 * 2.0 / omega) << n << " blocks";
        EXPECT_NEAR(critical(run, 60), 2.0 / omega, 0.05 * 2.0 / omega) << n << " blocks, few iterations";
    }
}

/// The stiffest mode is the turning of the one against the other, with k_n / 4 each to the two inertias.
TEST(CriticalTimeStep, OfTwoSquaresOnEachOtherIsThatOfTheirTurning)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "low", scenes::rectangle({0, 0}, {1, 1}));
    scenes::add_block(scene, "high", scenes::rectangle({0, 1}, {1, 2}));
    const double limit = 2.0 / std::sqrt(0.25 * 7e9 * 2.0 / (2700.0 / 6.0));
    EXPECT_NEAR(critical(CaseRun(scene), 2000), limit, 1e-6 * limit);
    EXPECT_NEAR(critical(CaseRun(scene), 60), limit, 0.05 * limit);
}

TEST(CriticalTimeStep, IsInfiniteWithoutContacts)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "block", scenes::rectangle({0, 0}, {1, 1}));
    EXPECT_EQ(critical(CaseRun(scene), 60), std::numeric_limits<double>::infinity());
}

double stable(const Model& model, const State& state)
{
    BlockContacts list;
    list_block_contacts(state.contacts, state.blocks.size(), list);
    return stable_step({0, state.blocks.size()}, model, list, state.contacts, state.blocks);
}

double stable(const CaseRun& run)
{
    return stable(run.model(), run.state());
}

TEST(StableStepBound, OfABlockOnTheGroundIsTheLimit)
{
    const double limit = 2.0 / std::sqrt(greatest_on_ground(2700.0));
    EXPECT_NEAR(stable(CaseRun(scenes::block_on_ground())), limit, 1e-9 * limit);
}

/// A corner stands on the middle of a face: one normal spring through both centroids, and a shear spring of next to nothing. Then two masses swing on one
/// spring, omega^2 = k (1/m_a + 1/m_b).
TEST(StableStepBound, OfOneSpringBetweenTwoBlocksIsTheLimit)
{
    const double r = std::sqrt(0.5);
    CaseDef scene = test::pair_scene(scenes::rectangle({0, 0}, {4, 1}), {{0, -r}, {r, 0}, {0, r}, {-r, 0}});
    scene.joints[0].shear_stiffness = 1.0;
    test::BlockPair pair(scene);
    pair.place(pair.a, {0.0, 0.0}, 0.0);
    pair.place(pair.b, {0.0, 0.5 + r - 1e-6}, 0.0);
    pair.search();
    ASSERT_EQ(pair.state.contacts.size(), 1);
    const Contact contact = pair.state.contacts.get(0);
    const double stiffness = 7e9 * point_length(pair.touch(contact).length, contact.length_floor);
    const double limit = 2.0 / std::sqrt(stiffness * (1.0 / 2700.0 + 1.0 / (4.0 * 2700.0)));
    EXPECT_NEAR(stable(pair.model, pair.state), limit, 1e-6 * limit);
    EXPECT_NEAR(critical_time_step(pair.model, pair.state.blocks, pair.state.contacts, 2000), limit, 1e-6 * limit);
}

/// Of large models, only the part around the stiffest blocks is looked at.
TEST(CriticalTimeStep, OfALargeModelIsThatOfItsPattern)
{
    const auto limit = [](int columns, int rows)
    {
        CaseRun run(scenes::grid(columns, rows));
        run.advance(1);
        return critical(run, 300);
    };
    const double small = limit(12, 12), large = limit(160, 130);
    EXPECT_NEAR(large, small, 0.02 * small);
}

TEST(CriticalTimeStep, OfALargeModelIsThatOfItsLightestBlock)
{
    const auto limit = [](int columns, int rows)
    {
        CaseDef scene = scenes::grid(columns, rows);
        scene.materials.push_back({.name = "light", .density = 50.0});
        scene.blocks[static_cast<std::size_t>(columns * (rows / 2) + columns / 2)].material = "light";
        CaseRun run(scene);
        run.advance(1);
        return critical(run, 300);
    };
    const double small = limit(12, 12), large = limit(160, 130);
    EXPECT_NEAR(large, small, 1e-3 * small);
}

/// 0.83 to 0.99 of it in these.
TEST(StableStepBound, IsBelowTheLimitOfAnyPackingButNotByMuch)
{
    const auto expect_below = [](const CaseDef& scene, std::int64_t cycles)
    {
        CaseRun run(scene);
        run.advance(cycles);
        const double limit = critical(run, 3000);
        EXPECT_LE(stable(run), limit * (1.0 + 1e-6));
        EXPECT_GE(stable(run), 0.6 * limit);
    };
    for (const std::uint64_t seed : {1, 2, 3, 4, 5})
    {
        SCOPED_TRACE(seed);
        expect_below(scenes::voronoi(8, 8, seed), 2000);
        expect_below(scenes::pile(40, 8, seed), 25'000);  // has fallen
    }
    expect_below(scenes::joints(10.0, 10.0, 1.0, 3.0), 2000);
}

TEST(StableStepBound, IsInfiniteWithoutContacts)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "block", scenes::rectangle({0, 0}, {1, 1}));
    EXPECT_EQ(stable(CaseRun(scene)), std::numeric_limits<double>::infinity());
}

TEST(CriticalTimeStep, IsNamedWhenTheStepIsAboveIt)
{
    CaseDef scene = scenes::block_on_ground();
    scene.contact.method = Method::force;
    scene.time.step = 2e-3;
    CaseRun run(scene);
    const std::vector<Problem> problems = run.simulation.find_problems();
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].key, "time.step");
    EXPECT_NE(problems[0].text.find("0.002"), std::string::npos) << problems[0].text;
    scene.time.step = 1e-4;
    EXPECT_TRUE(CaseRun(scene).simulation.find_problems().empty());
}
}  // namespace
}  // namespace hdem
