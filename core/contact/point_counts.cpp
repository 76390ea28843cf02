#include "core/contact/point_counts.h"

#include <algorithm>
#include <span>

namespace hdem
{
std::array<Index, 4> count_points(const Contacts& contacts)
{
    constexpr std::size_t stretch = 255;  // as many as a byte counts: the compiler then adds bytes beside each other
    std::array<Index, 4> counts{};
    for (const std::vector<std::uint8_t>& regime : contacts.regime)
        for (std::size_t begin = 0; begin < regime.size(); begin += stretch)
        {
            const std::span<const std::uint8_t> here(&regime[begin], std::min(stretch, regime.size() - begin));
            for (std::uint8_t one = 1; one < counts.size(); ++one)
            {
                std::uint8_t found = 0;
                for (const std::uint8_t regime_here : here)
                    found = static_cast<std::uint8_t>(found + (regime_here == one ? 1 : 0));
                counts[one] += found;
            }
        }
    return counts;
}
}  // namespace hdem
