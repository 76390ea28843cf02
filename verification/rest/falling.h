#pragma once
/// Blocks in rows above a ground, alone or in a bin, that fall onto each other. Which way each one goes is chance.

#include "verification/rest/scene.h"

#include <functional>
#include <string>
#include <utility>

namespace hdem::verification::rest
{
struct FallingBlocks
{
    std::string family;
    std::string kind;                     ///< words that follow the number and the size in the title
    std::pair<int, int> blocks, columns;  ///< least and greatest number
    std::function<Polygon(const Vec2& centre, double radius, Draw&)> draw_block;  ///< within the radius of its centre
    /// From -wide to wide; between -half and half, where the blocks fall, it may be uneven.
    std::function<Polygon(double wide, double half, double radius, Draw&)> draw_ground;
    double hollow = 0.0;    ///< greatest depth of the ground, times the radius
    double landings = 4.0;  ///< of one block at once, for its stable limit
};

[[nodiscard]] Scene falling_scene(int number, const FallingBlocks& kind);
}  // namespace hdem::verification::rest
