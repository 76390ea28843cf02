#include "core/joint/user_law.h"
#include "verification/scenes/sample_joints.h"
#include "verification/unit/core/joint/law_point.h"

namespace hdem
{
namespace
{
JointNumbers numbers(double way = 1e-3, double stiffness = 1e10)
{
    return UserLaw::numbers({.function = scenes::weakening_law, .parameters = {way}, .shear_stiffness = 1e9},
                            Linear::numbers(stiffness));
}

TEST(UserLaw, GivesTheStressesOfItsFunction)
{
    LawPoint<UserLaw, Linear> p(numbers(), 1e6);
    p.go(0.5e-3, 100, 1e6);
    EXPECT_NEAR(p.now.shear, 0.5e6, 1e-6);
    p.go(5e-3, 20000, 1e6);
    EXPECT_NEAR(p.now.shear, 1e6 * (0.5 + 0.3 / (1.0 + p.memory.slip / 1e-3)), 10.0);
    EXPECT_NEAR(p.memory.slip + p.now.shear / 1e9, 5e-3, 1e-9);
    EXPECT_DOUBLE_EQ(p.now.energy, 1e12 / (2.0 * 1e10));
    EXPECT_DOUBLE_EQ(UserLaw::peak_strength(numbers(), 2e6), 1.6e6);
}

TEST(UserLaw, ReducedByFourHasAQuarterOfItsStrength)
{
    JointNumbers n = numbers();
    UserLaw::weaken(n, 4.0);
    EXPECT_DOUBLE_EQ(UserLaw::peak_strength(n, 2e6), 0.4e6);
    LawPoint<UserLaw, Linear> p(n, 1e6);
    p.go(0.1e-3, 10, 1e6);
    EXPECT_NEAR(p.now.shear, 0.1e6, 1e-6);  // the spring is as it was
    p.go(5e-3, 20000, 1e6);
    EXPECT_NEAR(p.now.shear, 0.25e6 * (0.5 + 0.3 / (1.0 + p.memory.slip / 1e-3)), 10.0);
}

TEST(UserLaw, EnergyBalancesOverTenCycles)
{
    expect_energy_balance<UserLaw, Linear>(numbers(), 1e6, 5e9, 2000);
}

TEST(UserLaw, OfFourLanesAreThoseOfOne)
{
    expect_same_bits<UserLaw, Linear>({numbers(), numbers(), numbers(), numbers()}, 1e-4);
    const JointNumbers one = numbers();
    expect_same_bits<UserLaw, Linear>({one, one, one, one}, 1e-4);
}

/// Lanes of other laws have no number.
TEST(UserLaw, IsNotAskedForOthers)
{
    BasicJointNumbers<Pack> n{};
    for (int i = 0; i < joint_numbers; ++i)
        n[i] = Pack(0.0);
    const JointNumbers mine = numbers();
    for (int i = 0; i < joint_numbers; ++i)
        n[i].v[2] = mine[i];
    BasicJointMemory<Pack> memory{};
    const BasicJointStress<Pack> now = UserLaw::react<Linear>(n, {Pack(1e-4), Pack(0.0), Pack(0.0), Pack(1e6)}, memory);
    EXPECT_EQ(now.normal.v[0], 0.0);
    EXPECT_EQ(now.normal.v[2], 1e6);
}
}  // namespace
}  // namespace hdem
