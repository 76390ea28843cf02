#pragma once
/// A case with everything in it turned: the answer must turn with it.

#include "verification/checks/case_run.h"

#include <string>
#include <utility>
#include <vector>

namespace hdem::verification
{
/// Each method with the model as drawn and turned by 23 degrees: {name, angle [deg]}.
[[nodiscard]] std::vector<std::pair<const char*, double>> methods_and_angles();

/// (x, y) turned by `angle` about the origin [rad].
[[nodiscard]] Vec2 turned(const Vec2& p, double angle);

/// `case_file` under `overrides`, turned by `angle` about the origin [rad], as overrides: domain, joint sets, excavations, blocks, in-situ stress,
/// water, bolts, linings, velocities, loads and gravity. Sides need nothing: their stresses are normal and along them.
///
/// Blocks of a file, rectangular domains, moving walls and a stress with a gradient stay as they are.
/// @pre loads prescribe both components of a velocity or none
[[nodiscard]] Overrides turned_case(const std::string& case_file, const Overrides& overrides, double angle);
}  // namespace hdem::verification
