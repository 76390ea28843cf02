#pragma once
/// Checks of support.* that stand in files of their own.

#include "verification/checks/report.h"

namespace hdem::verification
{
void check_goodman_bray(Report& report);
void check_tunnel(Report& report);
}  // namespace hdem::verification
