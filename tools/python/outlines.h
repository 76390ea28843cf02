#pragma once
/// Blocks as polygons: the parts they are made of, joined.

#include "core/model/model.h"

#include <vector>

namespace hdem
{
/// Outline of a block at its pose, anticlockwise, in the user's coordinates [m]. Of a block with a hole it is the outer one.
[[nodiscard]] Polygon outline_of(const Model& model, Index block, const BlockMotion& at);

/// Convex parts of a block at its pose, likewise.
[[nodiscard]] std::vector<Polygon> parts_of(const Model& model, Index block, const BlockMotion& at);
}  // namespace hdem
