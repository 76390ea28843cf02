/// Stiffness and density that a stage changes.

#include "core/stage/properties.h"
#include "verification/scenes/sample_joints.h"
#include "verification/unit/parallel/stage_changes.h"

namespace hdem
{
namespace
{
using test::CaseRun;
using test::ledger_residual;
using test::with_change;

struct Forces
{
    std::vector<double> normal, shear;
};

Forces forces_of(const State& state)
{
    Forces forces;
    for (Index i = 0; i < state.contacts.size(); ++i)
        for (int k = 0; k < 2; ++k)
        {
            forces.normal.push_back(state.contacts.normal_force(k, i));
            forces.shear.push_back(state.contacts.shear_force(k, i));
        }
    return forces;
}

double greatest_difference(const std::vector<double>& a, const std::vector<double>& b)
{
    double most = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = std::max(most, std::abs(a[i] - b[i]));
    return most;
}

double greatest(const std::vector<double>& a)
{
    return std::abs(*std::ranges::max_element(a, {}, [](double x) { return std::abs(x); }));
}

/// A stack at rest under its weight: whatever the stiffness becomes, they stay where they are with the forces they have.
TEST(StageProperties, ANewStiffnessLeavesRestingRockAlone)
{
    for (const double ratio : {0.25, 3.0})
        for (const double angle : {0.0, 23.0})
        {
            const CaseDef stack = scenes::turned(scenes::stack(4), angle);
            CaseDef scene = with_change(stack,
                                        [&](JointDef& j)
                                        {
                                            j.normal_stiffness *= ratio;
                                            j.shear_stiffness *= ratio;
                                        });
            scene.contact.method = Method::force;
            scene.stages[0].cycles = 60'000;
            CaseRun run(scene);
            run.advance(60'000);
            const Forces before = forces_of(run.state());
            const double elastic = stored_energy(run.model(), run.state()).total();
            run.simulation.begin_stage(1);
            EXPECT_NEAR(stored_energy(run.model(), run.state()).total(), elastic / ratio, 1e-3 * elastic / ratio)
                << "the same forces in other springs";
            EXPECT_NEAR(run.state().ledger.property_changes, elastic * (1.0 - 1.0 / ratio), 1e-3 * elastic);
            EXPECT_LT(ledger_residual(run), 1e-6);
            run.advance(1);
            const Forces after = forces_of(run.state());
            ASSERT_EQ(before.normal.size(), after.normal.size());
            EXPECT_LT(greatest_difference(before.normal, after.normal), 1e-6 * greatest(before.normal)) << ratio;
            EXPECT_LT(greatest_difference(before.shear, after.shear), 1e-6 * greatest(before.normal));
            run.advance(4000);
            for (Index b = 0; b < run.model().blocks(); ++b)
                EXPECT_LT(run.state().blocks.displacement(b).norm(), 1e-9);
            EXPECT_LT(ledger_residual(run), 1e-6);
        }
}

/// A block under a load on a spring of the new stiffness: P more presses it by P / K' l in place of P / K l.
TEST(StageProperties, WhatIsAddedLaterIsBorneByTheNewStiffness)
{
    for (const bool has_memory : {false, true})
        for (const double ratio : {0.5, 4.0})
        {
            CaseDef scene = scenes::block_on_ground();
            if (has_memory)
                scene.joints[0].residual_cohesion = 0.0;
            scene.contact.method = Method::force;
            scene = with_change(scene, [&](JointDef& j) { j.normal_stiffness *= ratio; });
            constexpr double more = 50e3;
            scene.loads = {
                {.blocks = {"block"}, .force = {0.0, -more}, .factor = {.ramp_cycles = Vec2(0.0, 2000.0), .since = "changed"}}};
            scene.stages = {scene.stages[0], scene.stages[1]};
            scene.stages[0].cycles = 20'000;
            CaseRun run(scene);
            run.advance(20'000);
            run.simulation.begin_stage(1);
            run.advance(30'000);
            const double stiffness = ratio * scene.joints[0].normal_stiffness * 1.0;
            EXPECT_NEAR(-run.displacement("block").y(), more / stiffness, 2e-3 * more / stiffness) << ratio << has_memory;
            EXPECT_LT(ledger_residual(run), 1e-6);
        }
}

/// The same with the curves of laws that have one: forces stay, and so do laws that only their strength knows.
TEST(StageProperties, CurvesGoOnWhereTheyBearTheSameStress)
{
    CaseDef scene = scenes::block_on_ground();
    JointDef& joint = scene.joints[0];
    joint.residual_cohesion = 0.0;
    joint.greatest_closure = 1e-3;
    joint.normal_stiffness = 1e9;
    scene.contact.method = Method::force;
    scene = with_change(scene,
                        [](JointDef& j)
                        {
                            j.normal_stiffness = 4e9;
                            j.greatest_closure = 0.5e-3;
                            j.shear_stiffness *= 2.0;
                        });
    scene.stages[0].cycles = 30'000;
    CaseRun run(scene);
    run.advance(30'000);
    const Forces before = forces_of(run.state());
    run.simulation.begin_stage(1);
    EXPECT_LT(ledger_residual(run), 1e-6);
    EXPECT_GT(run.state().ledger.property_changes, 0.0) << "a stiffer joint holds less";
    run.advance(1);
    EXPECT_LT(greatest_difference(before.normal, forces_of(run.state()).normal), 1e-6 * greatest(before.normal));
    run.advance(4000);
    EXPECT_LT(run.displacement("block").norm(), 1e-8);
    EXPECT_LT(ledger_residual(run), 1e-6);
}

TEST(StageProperties, ANewDensityKeepsVelocities)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "block", scenes::rectangle({0.0, 0.0}, {1.0, 1.0})).velocity = {2.0, 0.0};
    scene.blocks[0].angular_velocity = 0.5;
    scene.gravity = {0.0, 0.0};
    scene.damping.preset = DampingPreset::dynamic;
    const double density = scene.materials[0].density;
    scene = with_change(
        scene, [](JointDef&) {}, 0.4 * density);
    scene.stages[1].joints.clear();
    scene.loads = {{.blocks = {"block"}, .force = {0.0, 100.0}, .interval = {.from_cycle = 100}}};
    CaseRun run(scene);
    run.advance(100);
    const double mass = run.model().mass[0], inertia = run.model().inertia[0];
    const double kinetic = kinetic_energy(run.model(), run.state().blocks, 0);
    run.simulation.begin_stage(1);
    EXPECT_NEAR(run.model().mass[0], 0.4 * mass, 1e-12 * mass);
    EXPECT_NEAR(run.model().inertia[0], 0.4 * inertia, 1e-12 * inertia);
    EXPECT_EQ(run.velocity("block").x(), 2.0);
    EXPECT_EQ(run.motion("block").w, 0.5);
    EXPECT_NEAR(run.state().ledger.property_changes, 0.6 * kinetic, 1e-12 * kinetic);
    run.advance(500);
    EXPECT_NEAR(run.velocity("block").y(), 100.0 / (0.4 * mass) * 500 * run.model().time_step, 1e-9);
    EXPECT_LT(ledger_residual(run), 1e-12);
}

/// Heavier rock presses harder: the joint below bears the new weight.
TEST(StageProperties, ANewDensityChangesWeight)
{
    CaseDef scene = scenes::block_on_ground();
    scene.contact.method = Method::force;
    scene = with_change(
        scene, [](JointDef&) {}, 2.0 * scene.materials[0].density);
    scene.stages[1].joints.clear();
    CaseRun run(scene);
    run.advance(10'000);
    const double weight = run.forces_between("ground", "block").x();
    run.simulation.begin_stage(1);
    run.advance(20'000);
    EXPECT_NEAR(run.forces_between("ground", "block").x(), 2.0 * weight, 2e-3 * weight);
    EXPECT_LT(ledger_residual(run), 1e-6);
}

/// The step that a case does not give is good for the stiffest joint and the lightest rock of all stages.
TEST(StageProperties, TheStepIsGoodForAllStages)
{
    const CaseDef wall = scenes::wall(4, 3);
    CaseDef same = wall, stiffer, lighter;
    same.time.step.reset();
    stiffer = with_change(same, [](JointDef& j) { j.normal_stiffness *= 16.0; });
    lighter = with_change(
        same, [](JointDef&) {}, 0.25 * wall.materials[0].density);
    const double step = build_model(same).model.time_step;
    EXPECT_NEAR(build_model(stiffer).model.time_step, 0.25 * step, 1e-12);
    EXPECT_NEAR(build_model(lighter).model.time_step, 0.5 * step, 1e-12);
    CaseRun run(stiffer);
    CaseRun plain(same);
    EXPECT_LT(run.simulation.critical_step(), 0.3 * plain.simulation.critical_step()) << "of the stage to come";
}
}  // namespace
}  // namespace hdem
