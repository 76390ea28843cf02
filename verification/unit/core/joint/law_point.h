#pragma once
/// What the tests of all laws expect.

#include "verification/scenes/law_point.h"

#include <gtest/gtest.h>

namespace hdem
{
/// Ten cycles of +-5 mm under constant stress, then behind a spring: what is put in is stored, turned into heat or freed.
template <typename Law, typename Curve>
void expect_energy_balance(const JointNumbers& n, double normal, double spring, int steps)
{
    for (const double stiffness : {0.0, spring})
    {
        const ReversalEnergy energy = ten_reversals<Law, Curve>(n, normal, stiffness, steps);
        EXPECT_GT(energy.heat, 0.0);
        EXPECT_GE(energy.least_heat, -1e-6 * energy.heat);
        EXPECT_NEAR(energy.unexplained(), 0.0, 1e-6 * energy.greatest_work) << "spring " << stiffness;
    }
}

/// Four lanes have the bits of each point alone.
template <typename Law, typename Curve>
void expect_same_bits(const std::array<JointNumbers, lanes>& numbers, double closure)
{
    EXPECT_EQ((first_difference_of_lanes<Law, Curve>(numbers, closure)), -1);
}

/// An open point carries nothing and remembers what it remembered.
template <typename Law, typename Curve>
void expect_open_point_rests(const JointNumbers& n, double normal)
{
    LawPoint<Law, Curve> p(n, normal);
    p.go(1e-3, 1000, normal);
    const JointMemory before = p.memory;
    EXPECT_NE(before.slip, 0.0);
    p.step(1e-4, -1e-2);
    EXPECT_EQ(p.now.normal, 0.0);
    EXPECT_EQ(p.now.shear, 0.0);
    EXPECT_EQ(p.now.strength, 0.0);
    EXPECT_EQ(p.now.slid, 0.0);
    EXPECT_EQ(p.now.heat, 0.0);
    EXPECT_EQ(p.memory.slip, before.slip);
    EXPECT_EQ(p.memory.state, before.state);
    EXPECT_EQ(p.memory.turn, before.turn);
    EXPECT_EQ(p.memory.opening, before.opening);
}
}  // namespace hdem
