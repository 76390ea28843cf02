#pragma once
/// Hard scenes: great ratios of mass and stiffness, slivers, needles, throws and falls.

#include "verification/checks/robust_blocks.h"

namespace hdem::verification
{
/// Each family: scenes that are always the same, and `seeds` random positions of each of the others.
[[nodiscard]] std::vector<Scene> mass_scenes(int seeds);
[[nodiscard]] std::vector<Scene> stiffness_scenes(int seeds);
[[nodiscard]] std::vector<Scene> sliver_scenes(int seeds);
[[nodiscard]] std::vector<Scene> needle_scenes(int seeds);
[[nodiscard]] std::vector<Scene> throw_scenes(int seeds);
[[nodiscard]] std::vector<Scene> fall_scenes(int seeds);
}  // namespace hdem::verification
