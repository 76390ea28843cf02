#include "core/contact/contact_report.h"
#include "core/water/wet_faces.h"
#include "io/stage_end_text.h"
#include "parallel/stages.h"
#include "verification/unit/core/boundary/sides.h"

namespace hdem
{
namespace
{
using namespace test;

constexpr double weight_of_water = 9810.0;  ///< [N/m3]

/// A block of 1 m x 1.5 m in the floor of a drained opening.
CaseDef floor_block(double level)
{
    CaseDef scene = scenes::empty_scene();
    scene.joints[0].normal_stiffness = 5e9;
    scene.joints[0].shear_stiffness = 1e9;
    scene.joints[0].friction_angle_deg = 0.0;
    scenes::add_fixed_block(scene, "base", scenes::rectangle({-2, -3}, {6, -1.5}));
    scenes::add_fixed_block(scene, "beside", scenes::rectangle({-2, -1.5}, {1.5, 0}));
    scenes::add_block(scene, "k", scenes::rectangle({1.5, -1.5}, {2.5, 0}));
    scenes::add_fixed_block(scene, "behind", scenes::rectangle({2.5, -1.5}, {6, 0}));
    scenes::add_block(scene, "room", scenes::rectangle({0, 0}, {4, 3}));
    scenes::add_fixed_block(scene, "roof", scenes::rectangle({-2, 3}, {6, 4}));
    scene.water = {.given = true, .level = level};
    scene.stages = {{.name = "stand", .until_converged = true, .max_cycles = 20'000},
                    {.name = "dig", .until_converged = true, .max_cycles = 20'000, .excavate = {"room"}}};
    return scene;
}

/// A face stays dry as its block is pressed away from the opening, by a millimetre here, and so does what lies on it.
TEST(DrainedOpenings, DoNotWetFacesThatLeaveADrainedOpening)
{
    for (const bool carries : {false, true})
    {
        CaseDef scene = floor_block(98.5);
        scene.loads = {{.blocks = {"k"}, .force = {0.0, -6e6}}};
        if (carries)
        {
            scene.joints[0].friction_angle_deg = 20.0;
            scenes::add_block(scene, "stone", scenes::rectangle({1.6, 0.01}, {2.4, 0.51}));
            scene.blocks[4].polygon = scenes::rectangle({0, 0}, {4, 0.01});
        }
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state));
        EXPECT_TRUE(run_stages(simulation, {}).back().met_end());
        const Index base = simulation.model().find_block("base"), k = simulation.model().find_block("k");
        const Index stone = simulation.model().find_block("stone");
        const double weight = simulation.model().mass[k] * 9.81;
        double bears = 0.0;
        for (Index i = 0; i < simulation.state().contacts.size(); ++i)
        {
            const ContactReport c = report_contact(simulation.state(), i);
            if (std::set<Index>{c.first, c.second} == std::set<Index>{base, k})
                bears += c.normal_force;
            if (carries && std::set<Index>{c.first, c.second} == std::set<Index>{stone, k})
            {
                EXPECT_EQ(JointPressure(simulation.model(), simulation.state()).mean(i, c.point[0], c.point[1]), 0.0);
            }
        }
        if (!carries)  // around the stone there is water, outside of what was removed
        {
            EXPECT_NEAR(bears, 6e6 + weight - weight_of_water * 100.0, 1e3);
        }
    }
}

/// Water that was last found while the block was pressed down would hold it.
TEST(DrainedOpenings, AreThoseOfThePoseWhereAStageEndsAtRest)
{
    for (const double level : {2.2, 2.3, 2.6, 2.8, 3.0})
    {
        CaseDef scene = floor_block(level);
        scene.joints[0].friction_angle_deg = 20.0;
        scene.stages[1].ends = {read_stage_end("displacement:k > 0.01").end};
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state));
        const StageResult result = run_stages(simulation, {}).back();
        const Index k = simulation.model().find_block("k");
        const double lift = weight_of_water * (level + 1.5) - simulation.model().mass[k] * 9.81;
        EXPECT_EQ(result.ended_by, lift > 0.0 ? 0 : ended_by::rest) << level;
    }
}

/// There is none between a block that has fallen into it and its floor or walls. Water that lifts what touches, and not what does not, threw a block about at 28 m/s.
TEST(DrainedOpenings, DoNotThrowWhatHasFallenIntoADrainedOpening)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "floor", scenes::rectangle({-2, -1}, {6, 0}));
    scenes::add_fixed_block(scene, "left", scenes::rectangle({-2, 0}, {0, 6}));
    scenes::add_fixed_block(scene, "right", scenes::rectangle({4, 0}, {6, 6}));
    scenes::add_fixed_block(scene, "roof1", scenes::rectangle({0, 4}, {1.5, 6}));
    scenes::add_fixed_block(scene, "roof2", scenes::rectangle({2.5, 4}, {4, 6}));
    scenes::add_block(scene, "key", scenes::rectangle({1.5, 4}, {2.5, 5}));
    scenes::add_block(scene, "room", scenes::rectangle({0, 0}, {4, 4}));
    scene.joints[0].friction_angle_deg = 20.0;
    scene.water = {.given = true, .level = 24.0};
    scene.stages = {{.name = "stand", .cycles = 500},
                    {.name = "dig", .until_converged = true, .max_cycles = 100'000, .excavate = {"room"}}};
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
    {
        scene.contact.method = method;
        CaseRun run(scene);
        run.simulation.begin_stage(0);
        run.advance(500);
        const double water_before = run.state().ledger.water;
        run.simulation.begin_stage(1);
        double fastest = 0.0;
        for (int i = 0; i < 400; ++i)
        {
            run.advance(100);
            fastest = std::max(fastest, run.state().blocks.velocity(run.slot("key")).norm());
        }
        const double push = weight_of_water * (24.0 - 5.0);  // of the water above it, while it leaves its place
        EXPECT_LT(fastest, std::sqrt(2.0 * (9.81 * 4.0 + push / run.model().mass[run.slot("key")])));
        EXPECT_NEAR(run.displacement("key").y(), -4.0, 0.01);
        EXPECT_LT(run.state().blocks.velocity(run.slot("key")).norm(), 1e-3);
        EXPECT_LT(std::abs(run.state().ledger.water - water_before), push);
    }
}
}  // namespace
}  // namespace hdem
