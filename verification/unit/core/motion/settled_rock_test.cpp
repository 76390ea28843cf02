/// Rock that settles as a whole, and blocks that fall: which of them have left what they lay beside.

#include "core/motion/equilibrium.h"
#include "core/motion/settled_rock.h"
#include "parallel/stages.h"
#include "verification/scenes/scenes.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

#include <string>

namespace hdem
{
namespace
{
using test::CaseRun;

/// Twenty blocks of 1 m on joints so soft that the upper ones settle by 0.5 m, each by at most 0.05 m more than the one below. Beside them a block falls by 2 m.
CaseDef column_and_falling_block()
{
    CaseDef scene = scenes::empty_scene();
    scene.contact.method = Method::force;
    scene.joints[0].normal_stiffness = 1e7;
    scene.joints[0].shear_stiffness = 5e6;
    scenes::add_fixed_block(scene, "ground", scenes::rectangle({-1.0, -1.0}, {6.0, 0.0}));
    for (int i = 0; i < 20; ++i)
        scenes::add_block(scene, "b" + std::to_string(i), scenes::rectangle({0.0, 1.0 * i}, {1.0, i + 1.0}));
    scenes::add_block(scene, "falls", scenes::rectangle({4.0, 2.0}, {5.0, 3.0}));
    scene.stages = {{.name = "settle", .until_converged = true, .max_cycles = 200'000},
                    {.name = "stay", .until_converged = true, .max_cycles = 200'000}};
    return scene;
}

TEST(SettledRock, IsToldFromABlockThatFell)
{
    for (const double angle : {0.0, 37.0})
    {
        CaseRun run(scenes::turned(column_and_falling_block(), angle));
        run_stages(run.simulation, {});
        const Index top = run.slot("b19"), fallen = run.slot("falls");
        const BlockMotion& motion = run.state().blocks.motion[top];
        ASSERT_GT((Vec2(motion.x, motion.y) - run.model().start[top]).norm(), 0.3);
        const auto settled = settled_rock(run.model(), run.state(), run.model().convergence.detached_distance);
        EXPECT_NE(settled[top], 0);
        EXPECT_EQ(settled[fallen], 0);
        EXPECT_EQ(report_displacements(run.model(), run.state()).before, std::vector<Index>{fallen});
        const auto none = settled_rock(run.model(), run.state(), 1e-3);
        EXPECT_EQ(none[top], 0);
    }
}
}  // namespace
}  // namespace hdem
