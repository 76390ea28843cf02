#pragma once
/// Scenes of the benchmarks, by name.

#include "verification/scenes/scenes.h"

#include <array>
#include <string>

namespace hdem::perf
{
/// The first three scenes are used for tuning. The others are not used while something is changed, and must be about as fast. `rough_wall` is the wall with
/// joints of Barton and Bandis: at least half as fast.
inline constexpr std::array<const char*, 3> named_scenes{"wall", "voronoi", "joints"};
inline constexpr std::array<const char*, 4> other_scenes{"hexagons", "long_bricks", "dips", "rough_wall"};

/// `scene`: one of these, of about `blocks` blocks. Throws std::invalid_argument for another name.
[[nodiscard]] CaseDef make_scene(const std::string& scene, Index blocks, Method method);
}  // namespace hdem::perf
