#include "core/motion/time_step.h"
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

/// A free square of side 1 on ground: sway and rotation are coupled. Springs K_N/2, K_S/2 at two points half a metre to the sides and below.
TEST(CriticalTimeStep, OfAFreeBlockIsThatOfItsRockingMode)
{
    const double k_n = 7e9, k_s = 5e8, mass = 2700.0, inertia = mass / 6.0;
    Eigen::Matrix2d stiffness;  // by mass: sway, rotation
    stiffness << k_s / mass, 0.5 * k_s / std::sqrt(mass * inertia), 0.5 * k_s / std::sqrt(mass * inertia),
        (0.25 * k_n + 0.25 * k_s) / inertia;
    const double greatest = std::max(stiffness.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff(), k_n / mass);
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

TEST(CriticalTimeStep, IsInfiniteWithoutContacts)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "block", scenes::rectangle({0, 0}, {1, 1}));
    EXPECT_EQ(critical(CaseRun(scene), 60), std::numeric_limits<double>::infinity());
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
