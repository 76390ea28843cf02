#pragma once
/// A convex piece of a block, each edge tagged with what it came from.

#include "core/types.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// What a block edge came from. Contacts take their joint from it.
/// >= 0: number of a fault, outline, joint set or trace, see model/edge_sources.h; the rest as named.
enum EdgeSource : std::int32_t
{
    edge_internal = -1,  ///< between two convex parts of one block: never touches anything
    edge_plain = -2,     ///< edge of an explicit block or of the domain
    edge_outline = -3,   ///< cut by an excavation outline
    edge_wall = -4       ///< of a wall behind a side of the domain
};

/// Convex, anticlockwise; edge i runs from vertex i to vertex i+1 and came from source[i].
struct ConvexPart
{
    Polygon vertices;                  ///< [m]
    std::vector<std::int32_t> source;  ///< one per edge, see EdgeSource
};
}  // namespace hdem
