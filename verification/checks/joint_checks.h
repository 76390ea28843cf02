#pragma once
/// Checks of joint.* that stand in files of their own.

#include "verification/checks/report.h"

namespace hdem::verification
{
// Slow direct shear: joint_slow.cpp
void check_normal_stiffness(Report& report);
void check_scale(Report& report);
void check_plesha(Report& report);
void check_saeb(Report& report);

// Laws by themselves: joint_laws.cpp
void check_joint_laws(Report& report);

// All laws in the cycle: joint_cycles.cpp
void check_contacts(Report& report);
void check_fall(Report& report);
void check_bits(Report& report);
}  // namespace hdem::verification
