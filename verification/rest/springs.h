#pragma once
/// The springs of a scene as its shapes have them: how large a step they bear, how far they give way.

#include "verification/rest/scene.h"
#include "verification/rest/touching.h"

namespace hdem::verification::rest
{
/// The blocks at the start.
[[nodiscard]] std::vector<Body> bodies_of(const Scene& scene);
[[nodiscard]] std::vector<TouchingPoint> touching_at_start(const Scene& scene, const std::vector<Body>& bodies);

/// 2 / omega_max of the springs between blocks that touch at the start (two points a face, each with half of its length), or of a block alone on its stiffest face,
/// whichever is less [s].
[[nodiscard]] double stable_limit(const Scene& scene);
/// The same where blocks land on others: besides what touches at the start, so many landings of one block on its stiffest face at once [s].
[[nodiscard]] double stable_limit(const Scene& scene, double landings);

/// Greatest way of a rim under the weights, with all these springs closed and shear springs of a thousandth of their stiffness: about as far as blocks sink that slip until only
/// their normals carry [m].
/// @pre normals alone hold the blocks
[[nodiscard]] double elastic_settle(const Scene& scene);
}  // namespace hdem::verification::rest
