#include "verification/unit/case_run.h"

#include <numbers>

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;

CaseDef lone_block(double step)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "block", rectangle({0, 0}, {1, 1}));
    scene.time.step = step;
    return scene;
}

TEST(FreeFall, IsThatOfSemiImplicitEulerAndOfFirstOrder)
{
    std::vector<double> errors;
    for (const int n : {100, 200, 400})
    {
        CaseRun run(lone_block(1.0 / n));
        run.advance(n);
        EXPECT_NEAR(run.velocity("block").y(), -9.81, 1e-12) << "round-off of n additions";
        EXPECT_NEAR(run.displacement("block").y(), -0.5 * 9.81 * (1.0 + 1.0 / n), 1e-12) << "g dt^2 n (n + 1) / 2";
        errors.push_back(std::abs(run.displacement("block").y() + 0.5 * 9.81));
    }
    EXPECT_NEAR(errors[0] / errors[1], 2.0, 1e-6);
    EXPECT_NEAR(errors[1] / errors[2], 2.0, 1e-6);
}

TEST(FreeFall, IsNotDamped)
{
    CaseDef scene = lone_block(1e-3);
    scene.damping = {.preset = DampingPreset::paper, .local = 0.8, .global_damping_ratio = 0.1, .average_frequency = 100.0};
    scene.blocks[0].velocity = {2.0, 0.0};
    scene.blocks[0].angular_velocity = 1.0;
    CaseRun run(scene);
    run.advance(1000);
    EXPECT_NEAR(run.velocity("block").x(), 2.0, 1e-13);
    EXPECT_NEAR(run.velocity("block").y(), -9.81, 1e-12);
    EXPECT_NEAR(run.motion("block").w, 1.0, 1e-13);
}

TEST(Rotation, StaysAUnitVectorForAMillionSteps)
{
    CaseDef scene = lone_block(1e-4);
    scene.gravity = {0.0, 0.0};
    scene.blocks[0].angular_velocity = 10.0;
    CaseRun run(scene);
    run.advance(1'000'000);
    const BlockMotion& m = run.motion("block");
    // Each step rounds by up to 2e-16; at a constant speed always the same way.
    EXPECT_NEAR(m.c * m.c + m.s * m.s, 1.0, 1e-9);
    EXPECT_NEAR(m.angle, 1000.0, 1e-7);  // a million roundings of 1000 rad
    // The vector lags behind by (w dt)^3 / 12 a step: 8.3e-5 rad in all.
    EXPECT_NEAR(std::remainder(std::atan2(m.s, m.c) - m.angle, 2.0 * std::numbers::pi), -1e6 * 1e-9 / 12.0, 1e-7);
}

TEST(Moment, TurnsABlockByItsMomentOfInertia)
{
    CaseDef scene = lone_block(1e-3);
    scene.gravity = {0.0, 0.0};
    scene.loads = {{.blocks = {"block"}, .moment = 900.0}};
    CaseRun run(scene);
    run.advance(1000);
    EXPECT_NEAR(run.motion("block").w, 900.0 / (2700.0 / 6.0), 1e-12);
}

// ---- oscillator: a block that only moves up and down on its springs -----------------------------------------------------

CaseRun oscillator(double step, double speed)
{
    CaseDef scene = scenes::block_on_ground();
    scene.blocks[1].fix_x = scene.blocks[1].fix_rotation = true;
    scene.contact.method = Method::force;
    scene.damping.preset = DampingPreset::dynamic;
    scene.time.step = step;
    scene.blocks[1].velocity = {0.0, speed};
    return CaseRun(scene, [](const Model& model, State& state)
                   { state.blocks.motion[model.find_block("block")].y -= 2700.0 * 9.81 / 7e9; });
}

constexpr double speed = 1e-3;  // the amplitude, 0.6 um, is below the static deflection of 3.8 um: the contact stays closed
const double omega = std::sqrt(7e9 / 2700.0);

TEST(ElasticOscillation, HasThePeriodOfTheSpringAndKeepsItsEnergyForEver)
{
    const double dt = 0.02 / omega;
    CaseRun run = oscillator(dt, speed);
    const double rest = run.position("block").y();
    int crossings = 0;
    double first = 0.0, last = 0.0, late = 0.0;
    double y = 0.0;
    for (int i = 0; i < 100'000; ++i)
    {
        run.advance(1);
        const double now = run.position("block").y() - rest;
        if (y < 0.0 && now >= 0.0)
        {
            last = run.state().time - dt * now / (now - y);
            first = crossings++ == 0 ? last : first;
        }
        y = now;
        if (i > 99'000)
            late = std::max(late, std::abs(y));
    }
    // Semi-implicit Euler: sin(omega' dt / 2) = omega dt / 2, so omega' is greater by (omega dt)^2 / 24, 1.7e-5.
    const double period = (last - first) / (crossings - 1);
    const double exact = 2.0 * std::numbers::pi / (2.0 / dt * std::asin(0.5 * omega * dt));
    EXPECT_NEAR(period, exact, 1e-6 * exact) << "crossings are interpolated linearly";
    EXPECT_NEAR(late, speed / omega, 0.02 * speed / omega) << "half a step of phase between position and velocity: 1 %";
}

TEST(StableStep, IsTwoOverOmegaAndNotLess)
{
    for (const auto& [share, stable] : {std::pair(0.999, true), std::pair(1.001, false)})
    {
        CaseRun run = oscillator(share * 2.0 / omega, 1e-5);
        if (stable)
            run.advance();
        else
            EXPECT_THROW(run.advance(), RunError) << "told once, when the contact begins to act";
        run.advance(stable ? 1999 : 45);  // then it leaves the ground
        // Stable: the amplitude is at most the start's divided by sqrt(1 - share^2), 22 times.
        EXPECT_EQ(std::abs(run.velocity("block").y()) < 25.0 * 1e-5, stable) << share << " of 2/omega";
    }
}

TEST(FixedComponents, KeepTheirVelocityWhateverActs)
{
    CaseDef scene = scenes::block_on_ground();
    scene.blocks[1].fix_x = true;
    scene.blocks[1].velocity = {0.1, 0.0};
    scene.loads = {{.blocks = {"block"}, .force = {1e6, 0.0}}};
    for (const Method method : {Method::force, Method::impulse, Method::hybrid})
    {
        scene.contact.method = method;
        CaseRun run(scene);
        run.advance(500);
        EXPECT_EQ(run.velocity("block").x(), 0.1);
        EXPECT_EQ(run.velocity("ground").norm(), 0.0);
    }
}

TEST(GlobalDamping, SlowsABlockWithImpulseContacts)
{
    CaseDef scene = scenes::block_on_ground();
    scene.contact.method = Method::impulse;
    scene.joints[0].friction_angle_deg = 0.0;
    scene.damping.global_damping_ratio = 0.05;
    scene.damping.average_frequency = 20.0;  // alpha_d = 2 1/s
    scene.blocks[1].velocity = {1.0, 0.0};
    CaseRun run(scene);
    const double dt = run.model().time_step;
    run.advance(static_cast<std::int64_t>(0.1 / dt));
    EXPECT_NEAR(run.velocity("block").x(), std::exp(-2.0 * run.state().time), 1e-3) << "(1 - alpha_d dt)^n, to first order in dt";
}

/// Of a share above 1 the whole velocity is taken, and not turned round: a block that rests would be thrown up.
TEST(GlobalDamping, TakesNoMoreThanTheVelocity)
{
    CaseDef scene = scenes::block_on_ground();
    scene.contact.method = Method::impulse;
    scene.damping.global_damping_ratio = 1.0;
    scene.damping.average_frequency = 1e6;
    CaseRun run(scene);
    run.advance(3000);
    EXPECT_LT(run.displacement("block").norm(), 1e-6);
    EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-9);
}
}  // namespace
}  // namespace hdem
