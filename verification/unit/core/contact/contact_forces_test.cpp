#include "core/contact/contact_forces.h"
#include "verification/unit/case_run.h"

#include <cmath>

namespace hdem
{
namespace
{
using test::CaseRun;

constexpr double mass = 2700.0;
constexpr double weight = mass * 9.81;
constexpr double step = 5e-5;
constexpr std::int64_t settled = 8000;  // cycles

/// A unit block at rest on its springs, then pushed to `speed` within one cycle. The ground weighs twice as much, and its centre does not lie
/// below that of the block.
CaseDef pushed_block(double speed, bool fixed_mass_counts)
{
    CaseDef scene = scenes::block_on_ground();
    scene.blocks[0].polygon = scenes::rectangle({-0.5, -1.0}, {1.5, 0.0});
    scene.blocks[1].fix_rotation = true;
    scene.time.step = step;
    scene.contact.method = Method::force;
    scene.contact.threshold_scale = 1.0;
    scene.contact.fixed_mass_counts = fixed_mass_counts;
    scene.stages = {{.name = "settle", .cycles = settled},
                    {.name = "push", .cycles = 2, .method = Method::hybrid, .damping = DampingPreset::dynamic}};
    LoadDef push{.blocks = {"block"}, .acceleration = {speed / step, 0.0}};
    push.interval.from_cycle = settled;
    push.interval.until_cycle = settled + 1;
    scene.loads.push_back(push);
    return scene;
}

Index impulse_points(double speed, bool fixed_mass_counts)
{
    CaseRun run(pushed_block(speed, fixed_mass_counts));
    run.advance(settled);
    run.simulation.begin_stage(1);
    run.advance(1);
    EXPECT_NEAR(run.velocity("block").x(), speed, 1e-6 * speed);
    EXPECT_EQ(run.simulation.count_contacts().points[static_cast<int>(Regime::impulse)], 0);
    run.advance(1);
    return run.simulation.count_contacts().points[static_cast<int>(Regime::impulse)];
}

/// u_th = dt g + sqrt(K u^2 / m_c) with K u = W; m_c = m against an immovable ground, 1/m_c = 1/m + 1/(2 m) where its mass counts. A fixed block
/// does not turn in either case.
TEST(ThresholdVelocity, CountsTheMassOfAFixedBlockWhereTheCaseSaysSo)
{
    for (const bool counts : {false, true})
    {
        const double inverse_mass = counts ? 1.5 / mass : 1.0 / mass;
        const double threshold = step * 9.81 + weight * std::sqrt(inverse_mass / 7e9);
        EXPECT_EQ(impulse_points(0.999 * threshold, counts), 0) << counts;
        EXPECT_EQ(impulse_points(1.001 * threshold, counts), 2) << counts;
    }
}
}  // namespace
}  // namespace hdem
