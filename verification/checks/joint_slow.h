#pragma once
/// Checks of joint laws in slow direct shear.

#include "verification/checks/report.h"

namespace hdem::verification
{
void check_normal_stiffness(Report& report);
void check_scale(Report& report);
void check_plesha(Report& report);
void check_saeb(Report& report);
}  // namespace hdem::verification
