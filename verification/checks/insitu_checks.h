#pragma once
/// Checks of insitu.* that stand in files of their own.

#include "verification/checks/report.h"

namespace hdem::verification
{
void check_two_sets(Report& report);
void check_squares(Report& report);
void check_bond(Report& report);
void check_roof_wedge(Report& report);
}  // namespace hdem::verification
