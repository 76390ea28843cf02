#include "core/contact/impact_energy.h"
#include "verification/scenes/scenes.h"
#include "verification/unit/case_run.h"
#include "verification/unit/core/contact/island_problems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace hdem
{
namespace
{
Blocks blocks_of(const IslandProblem& problem)
{
    Blocks blocks;
    for (const IslandProblem::Block& block : problem.blocks)
    {
        BlockMotion motion;
        motion.vx = block.velocity.x;
        motion.vy = block.velocity.y;
        motion.w = block.velocity.w;
        blocks.motion.push_back(motion);
        blocks.inertia.push_back(block.inertia);
    }
    return blocks;
}

double kinetic_energy_of(const Blocks& blocks)
{
    double sum = 0.0;
    for (std::size_t i = 1; i < blocks.motion.size(); ++i)  // the first one is the ground
    {
        const BlockMotion& v = blocks.motion[i];
        const BlockInertia& inertia = blocks.inertia[i];
        sum += 0.5 * ((v.vx * v.vx + v.vy * v.vy) / inertia.inverse_mass_x + v.w * v.w / inertia.inverse_inertia);
    }
    return sum;
}

/// With the ground at rest, the energy that impulses take is what the blocks lose.
TEST(ImpactEnergy, IsWhatTheBlocksLose)
{
    for (std::uint32_t seed = 1; seed <= 20; ++seed)
    {
        IslandProblem problem = random_island(seed);
        const double before = kinetic_energy_of(blocks_of(problem));
        for (std::size_t i = 0; i < problem.points.size(); ++i)
            problem.set_impulses(problem.points[i], 0.01 * static_cast<double>(i + 1), 0.002 * static_cast<double>(i % 3) - 0.001);
        std::vector<ImpulsePoint*> points;
        for (ImpulsePoint& p : problem.points)
        {
            p.impulse_normal += 0.3;  // as counted from a pull
            p.pull = 0.3;
            points.push_back(&p);
        }
        const Blocks blocks = blocks_of(problem);
        EXPECT_NEAR(energy_taken(points, blocks), before - kinetic_energy_of(blocks), 1e-9 * before) << seed;
    }
}

/// Greatest rise of the energy, over the kinetic energy at the start.
double gain(const CaseDef& scene, int cycles)
{
    test::CaseRun run(scene);
    const Blocks& blocks = run.state().blocks;
    double kinetic = 0.0;
    for (Index i = 0; i < blocks.size(); ++i)
        kinetic += blocks.is_free(i) ? kinetic_energy(run.model(), blocks, i) : 0.0;
    double least = std::numeric_limits<double>::max(), rise = 0.0;
    for (int cycle = 0; cycle < cycles; ++cycle)
    {
        run.advance();
        const double energy = test::mechanical_energy(run.model(), run.state());
        rise = std::max(rise, energy - least);
        least = std::min(least, energy);
    }
    return rise / kinetic;
}

/// A slab that spins and slides as it hits the ground: restitution point by point gives up to a fifth of its energy.
TEST(ImpactEnergy, IsNotGivenToASpinningSlab)
{
    for (const Method method : {Method::impulse, Method::hybrid})
        for (const double restitution : {1.0, 0.8})
            for (const auto& [angle, speed, spin] :
                 std::vector<std::array<double, 3>>{{34.1, 1.08, -5.99}, {40.6, -0.98, 5.83}, {19.2, -0.56, -2.1}})
            {
                CaseDef scene = scenes::empty_scene();
                scenes::add_block(scene, "slab", scenes::rectangle({-1.0, -0.3}, {1.0, 0.3}));
                scene = scenes::moved(scenes::turned(scene, angle), {0.0, 1.1});
                scene.gravity = {0.0, -9.81};
                scenes::add_fixed_block(scene, "ground", scenes::rectangle({-40, -1}, {40, 0}));
                scene.blocks[0].velocity = {speed, -4.0};
                scene.blocks[0].angular_velocity = spin;
                scene.joints[0].friction_angle_deg = 35.0;
                scene.contact.method = method;
                scene.contact.restitution = restitution;
                scene.damping.preset = DampingPreset::dynamic;
                EXPECT_LE(gain(scene, 30'000), 1e-3) << restitution << ", " << angle;
            }
}
}  // namespace
}  // namespace hdem
