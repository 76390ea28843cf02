#include "core/motion/damping.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace hdem
{
namespace
{
/// What the table of [Lee2025] sect. 3.3 says, row by row.
TEST(ConditionalDamping, FollowsTheContactsAndThePreset)
{
    const DampingDef def{.local = 0.8, .global_damping_ratio = 0.05, .average_frequency = 100.0};
    struct Row
    {
        std::uint32_t contacts;
        float mobilised;
        DampingPreset preset;
        double local, global;
    };
    const auto paper = DampingPreset::paper, dynamic = DampingPreset::dynamic, automatic = DampingPreset::automatic;
    for (const Row& row : std::initializer_list<Row>{
             {0, 0.0F, paper, 0.0, 0.0},
             {0, 0.0F, automatic, 0.0, 0.0},
             {contact_force, 0.0F, paper, 0.8, 0.0},
             {contact_force, 0.0F, automatic, 0.8, 0.0},
             {contact_force, 0.25F, automatic, 0.6, 0.0},
             {contact_force, 0.25F, paper, 0.8, 0.0},
             {contact_force, 0.0F, dynamic, 0.0, 0.0},
             {contact_force, 1.0F, paper, 0.8, 0.0},
             {contact_force, 1.0F, automatic, 0.0, 0.0},
             {contact_force, 1.0F, dynamic, 0.0, 0.0},
             {contact_impulse, 0.0F, paper, 0.0, 10.0},
             {contact_impulse, 0.0F, automatic, 0.0, 10.0},
             {contact_impulse, 0.0F, dynamic, 0.0, 10.0},
             {contact_impulse | contact_force, 0.5F, paper, 0.0, 10.0},
             {contact_impulse | contact_force, 1.0F, automatic, 0.0, 10.0},
         })
    {
        const BlockDamping damping = conditional_damping({.contacts = row.contacts, .mobilised = row.mobilised}, row.preset, def);
        EXPECT_DOUBLE_EQ(damping.local, row.local) << "contacts " << row.contacts << ", preset " << static_cast<int>(row.preset);
        EXPECT_DOUBLE_EQ(damping.global, row.global) << "contacts " << row.contacts << ", preset " << static_cast<int>(row.preset);
    }
}

RC_GTEST_PROP(LocalDamping, TakesPowerAndLeavesABlockAtRestAlone, (int f, int v))
{
    const double force = f, velocity = v;
    const double damped = locally_damped(force, velocity, 0.8);
    RC_ASSERT((damped - force) * velocity <= 0.0);
    RC_ASSERT(std::abs(damped - force) <= 0.8 * std::abs(force) * (1.0 + 1e-15));
    RC_ASSERT(v != 0 || damped == force);
    RC_ASSERT(f != 0 || damped == 0.0);
}

TEST(LocalDamping, SlowsAndStrengthensByItsShare)
{
    EXPECT_DOUBLE_EQ(locally_damped(10.0, 1.0, 0.8), 2.0) << "speeding up";
    EXPECT_DOUBLE_EQ(locally_damped(10.0, -1.0, 0.8), 18.0) << "braking";
    EXPECT_DOUBLE_EQ(locally_damped(-10.0, 1.0, 0.8), -18.0);
}
}  // namespace
}  // namespace hdem
