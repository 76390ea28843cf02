#pragma once
/// Shapes and element types of HDF5 datasets.

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace hdem
{
/// Extents, slowest first; {} is a scalar.
using Shape = std::vector<std::uint64_t>;

/// In a shape that is asked for: any extent.
inline constexpr std::uint64_t any_extent = UINT64_MAX;

enum class ElementType
{
    float64,
    float32,
    int64,
    uint64,
    int32,
    uint8
};

template <class T>
constexpr ElementType element_type()
{
    if constexpr (std::is_same_v<T, double>)
        return ElementType::float64;
    else if constexpr (std::is_same_v<T, float>)
        return ElementType::float32;
    else if constexpr (std::is_same_v<T, std::int64_t>)
        return ElementType::int64;
    else if constexpr (std::is_same_v<T, std::uint64_t>)
        return ElementType::uint64;
    else if constexpr (std::is_same_v<T, std::int32_t>)
        return ElementType::int32;
    else
    {
        static_assert(std::is_same_v<T, std::uint8_t>);
        return ElementType::uint8;
    }
}
}  // namespace hdem
