#include "verification/unit/core/boundary/sides.h"

namespace hdem
{
namespace
{
using namespace test;

/// The force of a [[load]] at a point has a moment about the centroid, whose arm turns with the block.
TEST(Load, ActsAtItsPoint)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "block", scenes::rectangle({0.0, 0.0}, {1.0, 1.0}));
    scene.gravity = {0.0, 0.0};
    scene.damping.preset = DampingPreset::dynamic;
    scene.loads = {{.blocks = {"block"}, .force = {0.0, 100.0}, .point = Vec2(1.0, 0.5)}};
    scene.time.step = 1e-3;
    CaseRun run(scene);
    run.advance(1);
    const double inertia = run.model().inertia[0];
    EXPECT_NEAR(run.motion("block").w, 50.0 / inertia * 1e-3, 1e-12);
    run.advance(6000);
    // Turned by 90 degrees and more the arm has changed its sign: a pendulum about the force's direction, energy 50 N m (sin a).
    const BlockMotion& m = run.motion("block");
    const double lift = 100.0 * (m.y + m.s * 0.5 + 0.0 - run.state().blocks.reference_position[0].y());
    const double kinetic = kinetic_energy(run.model(), run.state().blocks, 0);
    EXPECT_GT(std::abs(m.angle), 0.1);
    EXPECT_NEAR(kinetic, lift, 2e-3 * lift) << "work of the force along the way of its point";
    EXPECT_LT(ledger_residual(run), 1e-12);
}
}  // namespace
}  // namespace hdem
