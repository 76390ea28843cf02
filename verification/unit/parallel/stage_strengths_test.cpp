/// Strengths that change over some cycles.

#include "core/joint/all_laws.h"
#include "core/stage/load_changes.h"
#include "core/stage/properties.h"
#include "parallel/stages.h"
#include "verification/scenes/sample_joints.h"
#include "verification/unit/parallel/stage_changes.h"

namespace hdem
{
namespace
{
using test::CaseRun;
using test::ledger_residual;
using test::with_change;

/// A block on a slope whose friction falls evenly slips when its tangent has come down to that of the slope.
TEST(StageStrengths, ComeDownOverCycles)
{
    for (const bool has_memory : {false, true})
    {
        const double slope = std::tan(20.0 * std::acos(-1.0) / 180.0);
        CaseDef scene = scenes::block_on_ground();
        scene.gravity = 9.81 * Vec2(std::sin(std::atan(slope)), -std::cos(std::atan(slope)));
        scene.contact.method = Method::force;
        scene.joints[0].friction_angle_deg = 45.0;
        scene.joints[0].cohesion = 0.0;
        if (has_memory)
            scene.joints[0].residual_friction_angle_deg = 45.0;
        scene = with_change(scene,
                            [&](JointDef& j)
                            {
                                j.friction_angle_deg = 0.0;
                                if (has_memory)
                                    j.residual_friction_angle_deg = 0.0;
                            });
        scene.stages[0].cycles = 20'000;
        scene.stages[1].set_cycles = 10'000;
        scene.stages[1].cycles = 20'000;
        CaseRun run(scene);
        run.advance(20'000);
        run.simulation.begin_stage(1);
        EXPECT_EQ(steady_from(run.model(), run.state()), 30'001);
        std::int64_t slips_at = 0;
        while (slips_at == 0 && run.state().cycle < 30'000)
        {
            run.advance(10);
            if (run.velocity("block").norm() > 1e-3)
                slips_at = run.state().cycle - 20'000;
        }
        EXPECT_NEAR(static_cast<double>(slips_at), 10'000 * (1.0 - slope), 400.0) << has_memory;
        EXPECT_LT(ledger_residual(run), 1e-6);
        run.advance(30'000 - run.state().cycle);
        run.advance(1);
        EXPECT_EQ(run.model().joints.laws[0].friction_coefficient, 0.0);
    }
}

/// Halfway, numbers of a law that follow from others still do. With K_S and 1 / K_S each halfway, a joint that slips would bear too much or too little, and even pull
/// the other way.
TEST(StageStrengths, KeepNumbersThatFollowFromOthers)
{
    const auto halfway = [](JointLaw law, const std::function<void(JointDef&)>& change)
    {
        CaseDef scene = scenes::block_on_ground();
        scene.contact.method = Method::force;
        for (const JointDef& joint : scenes::sample_joints())
            if (joint.law == law)
                scene.joints = {joint};
        if (law == JointLaw::barton_bandis)
            scene.joints[0].shear_stiffness = 1e6;  // so that K_S follows from the residual angle
        scene = with_change(scene, change);
        scene.stages[1].set_cycles = 1000;
        CaseRun run(scene);
        run.simulation.begin_stage(1);
        run.advance(501);
        return run.model().joints.rows[0].numbers;
    };
    const JointNumbers rough = halfway(JointLaw::barton_bandis, [](JointDef& j) { j.residual_friction_angle_deg = 10.0; });
    EXPECT_NEAR(rough[BartonBandis::residual_friction], radians(20.0), 1e-15);
    EXPECT_NEAR(rough[BartonBandis::shear_stiffness] * rough[BartonBandis::shear_compliance], 1.0, 1e-15);
    const JointNumbers bilinear = halfway(JointLaw::patton,
                                          [](JointDef& j)
                                          {
                                              j.cohesion = 0.0;
                                              j.friction_angle_deg = 25.0;
                                          });
    EXPECT_NEAR(bilinear[Patton::cohesion], 0.5e6, 1e-6);
    EXPECT_NEAR(bilinear[Patton::change_stress],
                bilinear[Patton::cohesion] / (bilinear[Patton::friction] - bilinear[Patton::residual_friction]), 1e-6);
    const JointNumbers yielding = halfway(JointLaw::continuously_yielding, [](JointDef& j) { j.friction_angle_deg = 10.0; });
    EXPECT_NEAR(yielding[ContinuouslyYielding::friction_angle], radians(20.0), 1e-15);
    EXPECT_NEAR(yielding[ContinuouslyYielding::friction], std::tan(radians(20.0)), 1e-15);
}

/// The same where a table says how much of the change is made: 0.2 of it after 4000 cycles, all after 10 000.
TEST(StageStrengths, FollowATable)
{
    for (const TableColumn by : {TableColumn::cycle, TableColumn::time})
    {
        const double slope = std::tan(20.0 * std::acos(-1.0) / 180.0);
        CaseDef scene = scenes::block_on_ground();
        scene.gravity = 9.81 * Vec2(std::sin(std::atan(slope)), -std::cos(std::atan(slope)));
        scene.contact.method = Method::force;
        scene.joints[0].friction_angle_deg = 45.0;
        scene.time.step = 1e-4;
        scene = with_change(scene, [](JointDef& j) { j.friction_angle_deg = 0.0; });
        const double unit = by == TableColumn::time ? *scene.time.step : 1.0;
        scene.stages[0].cycles = 20'000;
        scene.stages[1].set_table = {{0.0, 0.0}, {4'000 * unit, 0.2}, {10'000 * unit, 1.0}};
        scene.stages[1].set_table_by = by;
        scene.stages[1].cycles = 20'000;
        CaseRun run(scene);
        run.advance(20'000);
        run.simulation.begin_stage(1);
        EXPECT_EQ(steady_from(run.model(), run.state()), 30'001);
        run.advance(4'000);
        EXPECT_NEAR(run.model().joints.laws[0].friction_coefficient, 0.8, 1e-3);
        EXPECT_LT(run.velocity("block").norm(), 1e-6);
        std::int64_t slips_at = 0;
        while (slips_at == 0 && run.state().cycle < 30'000)
        {
            run.advance(10);
            if (run.velocity("block").norm() > 1e-3)
                slips_at = run.state().cycle - 20'000;
        }
        EXPECT_NEAR(static_cast<double>(slips_at), 4'000 + (1.0 - slope - 0.2) / 0.8 * 6'000, 400.0);
        EXPECT_LT(ledger_residual(run), 1e-6);
        run.advance(30'001 - run.state().cycle);
        EXPECT_EQ(run.model().joints.laws[0].friction_coefficient, 0.0);
    }
}

/// Written to a file in the middle, and on several threads.
TEST(StageStrengths, GiveTheSameBitsAfterARestartAndOnThreads)
{
    CaseDef scene = scenes::joints(8.0, 8.0, 1.0, 6.0);
    scene.domain.fixed = {"bottom", "left"};
    scene = with_change(
        scene,
        [](JointDef& j)
        {
            j.normal_stiffness *= 2.0;
            j.friction_angle_deg = 12.0;
        },
        0.5 * scene.materials[0].density);
    scene.stages.push_back({.name = "weaker", .cycles = 1500, .set_cycles = 1000, .joints = scene.stages[1].joints});
    scene.stages.back().joints[0].friction_angle_deg = 5.0;
    scene.stages.push_back({.name = "weakest",
                            .cycles = 1500,
                            .set_table = {{100.0, 0.0}, {400.0, 0.5}, {1300.0, 1.0}},
                            .joints = scene.stages[2].joints});
    scene.stages.back().joints[0].friction_angle_deg = 3.0;
    for (StageDef& stage : scene.stages)
        stage.cycles = 1500;
    const auto simulate = [&](std::int64_t save_at, int threads)
    {
        hdem::Setup setup = build_model(scene);
        Simulation simulation(std::move(setup.model), std::move(setup.state), threads);
        class Stop : public Keeper
        {
          public:
            explicit Stop(std::int64_t at) : at_(at) {}
            [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override { return now < at_ ? at_ : never; }
            [[nodiscard]] bool keep(const Simulation& s) override { return s.state().cycle != at_; }

          private:
            std::int64_t at_;
        } stop(save_at);
        run_stages(simulation, {}, &stop);
        if (simulation.state().cycle < 6000)
        {
            hdem::Setup again = build_model(scene);
            EXPECT_EQ(model_hash(again.model), model_hash(simulation.model()));
            Simulation rest(std::move(again.model), simulation.state(), threads);
            run_stages(rest, {});
            EXPECT_LT(std::abs(relative_residual(rest.state().ledger, stored_energy(rest.model(), rest.state()))), 1e-4);
            return state_hash(rest.model(), rest.state());
        }
        return state_hash(simulation.model(), simulation.state());
    };
    const std::uint64_t unbroken = simulate(-1, 1);
    for (const std::int64_t save_at : {700, 1500, 1777, 3000, 3333, 3990, 4321, 4777, 5111})
        EXPECT_EQ(simulate(save_at, 1), unbroken) << save_at;
    EXPECT_EQ(simulate(-1, 2), unbroken);
    EXPECT_EQ(simulate(4777, 3), unbroken);
}
}  // namespace
}  // namespace hdem
