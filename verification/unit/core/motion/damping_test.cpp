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
             {0, 0.0, paper, 0.0, 0.0},
             {0, 0.0, automatic, 0.0, 0.0},
             {contact_force, 0.0, paper, 0.8, 0.0},
             {contact_force, 0.0, automatic, 0.8, 0.0},
             {contact_force, 0.25F, automatic, 0.8, 0.0},
             {contact_force, 0.25F, paper, 0.8, 0.0},
             {contact_force, 0.0, dynamic, 0.0, 0.0},
             {contact_force, 1.0F, paper, 0.8, 0.0},
             {contact_force, 1.0F, automatic, 0.8, 0.0},
             {contact_force, 1.0F, dynamic, 0.0, 0.0},
             {contact_impulse, 0.0, paper, 0.0, 10.0},
             {contact_impulse, 0.0, automatic, 0.0, 10.0},
             {contact_impulse, 0.0, dynamic, 0.0, 10.0},
             {contact_impulse | contact_force, 0.5F, paper, 0.0, 10.0},
             {contact_impulse | contact_force, 1.0F, automatic, 0.0, 10.0},
         })
    {
        const BlockDamping damping = conditional_damping(Acting{.mobilised = row.mobilised,
                                                                .springs = (row.contacts & contact_force) != 0,
                                                                .impulses = (row.contacts & contact_impulse) != 0},
                                                         row.preset, def);
        EXPECT_DOUBLE_EQ(damping.local, row.local) << "contacts " << row.contacts << ", preset " << static_cast<int>(row.preset);
        EXPECT_DOUBLE_EQ(damping.global, row.global) << "contacts " << row.contacts << ", preset " << static_cast<int>(row.preset);
    }
}

TEST(ConditionalDamping, LeavesTurningAloneAsAJointIsMobilised)
{
    const DampingDef def{.local = 0.8};
    EXPECT_NEAR(conditional_damping(Acting{.mobilised = 0.25, .springs = true}, DampingPreset::automatic, def).local_rotation, 0.6,
                1e-15);
    EXPECT_EQ(conditional_damping(Acting{.mobilised = 1.0, .springs = true}, DampingPreset::automatic, def).local_rotation, 0.0);
    EXPECT_EQ(conditional_damping(Acting{.mobilised = 1.0, .springs = true}, DampingPreset::paper, def).local_rotation, 0.8);
}

/// A block that slides along (0.6, 0.8) at the limit moves freely along the joint, and is damped across it.
TEST(LocalDamping, AlongAJointIsLimitedByItsReserve)
{
    const BlockInertia inertia{.inverse_mass_x = 1.0, .inverse_mass_y = 1.0, .inverse_inertia = 1.0};
    const BlockDamping damping{.local = 0.8, .along_joint = true};
    const double t_x = 0.6, t_y = 0.8;
    const auto damped = [&](double reserve)
    {
        const Acting force{.x = 10.0 * t_x - 5.0 * t_y, .y = 10.0 * t_y + 5.0 * t_x, .reserve = reserve, .t_x = t_x, .t_y = t_y};
        // 2 m/s along, 1 m/s across
        const DampedForce<double> f = damp_translation(force, inertia, 2.0 * t_x - 1.0 * t_y, 2.0 * t_y + 1.0 * t_x, damping);
        return Vec2(t_x * f.x + t_y * f.y, t_x * f.y - t_y * f.x);
    };
    EXPECT_NEAR(damped(0.0).x(), 10.0, 1e-12);
    EXPECT_NEAR(damped(3.0).x(), 7.0, 1e-12);
    EXPECT_NEAR(damped(100.0).x(), 2.0, 1e-12);
    for (const double reserve : {0.0, 3.0, 100.0})
        EXPECT_NEAR(damped(reserve).y(), 1.0, 1e-12);
}

/// What can move along one axis only is damped along it.
TEST(LocalDamping, LeavesAFixedComponentAlone)
{
    const BlockInertia inertia{.inverse_mass_y = 1.0};
    const Acting force{.x = 7.0, .y = 10.0, .reserve = 3.0, .t_x = 0.6, .t_y = 0.8};
    EXPECT_DOUBLE_EQ(damp_translation(force, inertia, 0.0, 1.0, {.local = 0.8, .along_joint = true}).y, 7.0);
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
