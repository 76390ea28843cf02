#include "core/motion/damping.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;

/// What works against the mean of the velocities before and after it takes energy.
RC_GTEST_PROP(LocalDamping, GivesNoEnergyToFastMotions, (int f, int v))
{
    const double force = f, velocity = v, inverse_mass = 0.5, dt = 0.1;
    const double left = stopped_by_damping(force, velocity, inverse_mass, dt, 0.8, std::abs(velocity), 1e-9);
    const double after = velocity + left * inverse_mass * dt;
    const double size = std::abs(velocity) + std::abs(force);
    RC_ASSERT((left - force) * (velocity + after) <= 1e-14 * size * size);
}

/// A bar at 3 m/s whose springs throw it back at 1 m/s: stopped if that is slow, left alone if it is fast.
TEST(LocalDamping, OfAMotionThatTurnsRoundDependsOnItsSpeed)
{
    const BlockInertia inertia{.inverse_mass_x = 1.0, .inverse_mass_y = 1.0, .inverse_inertia = 1.0};
    struct Row
    {
        double turning, force, moment;  // what is left of 4 N, and of 4 N m
    };
    for (const auto& [turning, force, moment] : {Row{5.0, 3.0, 1.5}, Row{2.0, 3.5, 2.5}, Row{1.0, 4.0, 3.5}})
    {
        const BlockDamping damping{
            .local = 0.8, .local_across = 0.8, .local_rotation = 0.8, .form = LocalDamping::along_joint, .turning = turning};
        EXPECT_NEAR(damp_translation(Acting{.x = 4.0, .reserve = 9.0}, inertia, -3.0, 0.0, 1.0, damping).x, force, 1e-14)
            << "along, " << turning;
        EXPECT_NEAR(damp_translation(Acting{.y = 4.0}, inertia, 0.0, -3.0, 1.0, damping).y, force, 1e-14) << "across, " << turning;
        EXPECT_NEAR(damp_rotation(Acting{.moment = 4.0}, inertia, -1.5, 2.0, 1.0, damping), moment, 1e-14) << turning;
    }
}

/// Greatest energy that local damping gives in one cycle to a block of 2 m x 1 m that falls 1 m onto a corner [J].
double given_by_damping(bool until_converged, double lean, double step)
{
    const double c = std::cos(lean), s = std::sin(lean);
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "ground", rectangle({-9, -1}, {9, 0}));
    scenes::add_block(scene, "block", {{0, 1}, {2 * c, 1 + 2 * s}, {2 * c - s, 1 + 2 * s + c}, {-s, 1 + c}});
    scene.contact.method = Method::force;
    scene.time.step = step;
    scene.stages = {{.name = "fall", .cycles = 4000}};
    if (until_converged)
        scene.stages = {{.name = "fall", .until_converged = true, .max_cycles = 4000}};
    CaseRun run(scene);
    double most = 0.0;
    for (int i = 0; i < 4000; ++i)
    {
        const double before = run.state().ledger.local_damping;
        run.advance();
        most = std::max(most, before - run.state().ledger.local_damping);
    }
    EXPECT_GT(run.state().ledger.local_damping, 4e4) << "of the 53 kJ of its fall";
    return most;
}

TEST(LocalDamping, GivesNoEnergyToABlockThatIsThrownBack)
{
    const double slow = 0.5 * 5400.0 * 0.08 *
                        0.08;  // J, of what counts as slow; damping that stopped every motion gave up to 2900 J
    for (const bool until_converged : {true, false})
        for (const double lean : {0.1, 0.2, 0.35, 0.6})
            for (const double step : {2e-4, 4e-4})
                EXPECT_LT(given_by_damping(until_converged, lean, step), slow) << until_converged << ", " << lean << ", " << step;
}
}  // namespace
}  // namespace hdem
