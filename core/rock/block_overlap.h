#pragma once
/// Which blocks lie in each other.

#include "core/rock/rock_mass.h"

#include <vector>

namespace hdem
{
struct BlockOverlap
{
    std::size_t a = 0;  ///< a < b
    std::size_t b = 0;
    double area = 0.0;  ///< [m2]
};

/// All pairs with b >= first_b whose common area exceeds `share` of the smaller block's area, in order of b, then a. By a tree of the
/// parts' boxes.
std::vector<BlockOverlap> find_overlaps(const std::vector<RockBlock>& blocks, std::size_t first_b, double share);
}  // namespace hdem
