#pragma once
/// The families of rest.* scenes. Scene `number` of a family is always the same.

#include "verification/rest/scene.h"

namespace hdem::verification::rest
{
[[nodiscard]] Scene incline_scene(int number);
[[nodiscard]] Scene tiles_scene(int number);
[[nodiscard]] Scene stack_scene(int number);
[[nodiscard]] Scene notch_scene(int number);
[[nodiscard]] Scene wedge_scene(int number);
[[nodiscard]] Scene arch_scene(int number);
[[nodiscard]] Scene drop_scene(int number);
[[nodiscard]] Scene heap_scene(int number);
[[nodiscard]] Scene concave_scene(int number);
[[nodiscard]] Scene rubble_scene(int number);

/// Case files of scenes that once came to a wrong rest: by three methods, turned by 0 to 350 degrees.
[[nodiscard]] Scene known_scene(int number);
extern const int known_scenes;  ///< how many

/// Copies of a scene of another family beside each other.
[[nodiscard]] Scene threads_scene(int number);
}  // namespace hdem::verification::rest
