#pragma once
/// Hilbert curve: a number for a point, such that points with near numbers lie near each other.

#include <cstdint>
#include <utility>

namespace hdem
{
/// Position along the Hilbert curve of order 31 through the square [0, 2^31)^2.
[[nodiscard]] inline std::uint64_t hilbert_number(std::uint32_t x, std::uint32_t y)
{
    std::uint64_t number = 0;
    for (std::uint32_t side = 1u << 30; side > 0; side >>= 1)
    {
        const std::uint32_t right = (x & side) != 0 ? 1 : 0;
        const std::uint32_t upper = (y & side) != 0 ? 1 : 0;
        number += static_cast<std::uint64_t>(side) * side * ((3 * right) ^ upper);
        if (upper == 0)
        {
            if (right == 1)
            {
                x = ~x;
                y = ~y;
            }
            std::swap(x, y);
        }
    }
    return number;
}
}  // namespace hdem
