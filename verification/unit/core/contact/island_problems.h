#pragma once
/// Islands for tests of their solution.

#include "core/contact/island_problem.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace hdem
{
inline constexpr double fall = 9.81e-5;  // velocity that weight gives in a cycle [m/s]

/// Blocks that cannot turn, as masses on a vertical line; the first one is the ground.
inline IslandProblem column(const std::vector<double>& masses, double friction = 0.0)
{
    IslandProblem problem;
    problem.blocks.push_back({});
    for (const double mass : masses)
        problem.blocks.push_back({{.inverse_mass_x = 1.0 / mass, .inverse_mass_y = 1.0 / mass}, {0.0, -fall, 0.0}});
    for (std::size_t i = 0; i < masses.size(); ++i)
    {
        ImpulsePoint p;
        p.ref = static_cast<Index>(i);
        p.inc = static_cast<Index>(i + 1);
        p.t_x = -1.0;  // m points down, into the lower block
        p.friction = friction;
        const double inverse = 1.0 / masses[i] + (i > 0 ? 1.0 / masses[i - 1] : 0.0);
        p.mass_normal = p.mass_shear = 1.0 / inverse;
        problem.points.push_back(p);
    }
    return problem;
}

/// Points anywhere on blocks that turn, with any masses from 1 to 1e6, friction, speeds and directions.
inline IslandProblem random_island(std::uint32_t seed)
{
    std::mt19937 bits(seed);
    const auto between = [&](double low, double high) { return low + (high - low) * static_cast<double>(bits()) / 4294967296.0; };
    IslandProblem problem;
    problem.blocks.push_back({});
    const int blocks = 2 + static_cast<int>(between(0.0, 8.0));
    for (int i = 0; i < blocks; ++i)
    {
        const double mass = std::pow(10.0, between(-3.0, 3.0));
        problem.blocks.push_back(
            {{1.0 / mass, 1.0 / mass, 6.0 / mass, 0.0}, {between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 1.0)}});
    }
    for (int i = 1; i <= 3 * blocks; ++i)
    {
        ImpulsePoint p;
        p.inc = 1 + (i - 1) % blocks;
        p.ref = std::min(p.inc - 1, static_cast<Index>(between(0.0, p.inc)));
        const double angle = between(0.0, 6.28);
        p.t_x = std::cos(angle);
        p.t_y = std::sin(angle);
        p.ref_t = between(-0.5, 0.5);
        p.ref_m = between(-0.5, 0.0);
        p.inc_t = between(-0.5, 0.5);
        p.inc_m = between(0.0, 0.5);
        p.friction = between(0.0, 0.6);
        const BlockInertia& ref = problem.blocks[p.ref].inertia;
        const BlockInertia& inc = problem.blocks[p.inc].inertia;
        const double along = ref.inverse_mass_x + inc.inverse_mass_x;
        p.mass_normal = 1.0 / (along + ref.inverse_inertia * p.ref_t * p.ref_t + inc.inverse_inertia * p.inc_t * p.inc_t);
        p.mass_shear = 1.0 / (along + ref.inverse_inertia * p.ref_m * p.ref_m + inc.inverse_inertia * p.inc_m * p.inc_m);
        problem.points.push_back(p);
    }
    return problem;
}
}  // namespace hdem
