#pragma once
/// How many members a plain struct has.

#include <cstddef>
#include <utility>

namespace hdem
{
namespace detail
{
/// Stands for a member of any type.
struct AnyMember
{
    template <typename T>
    operator T() const;
};
}  // namespace detail

/// @pre T is a struct without constructors, base classes and arrays of C
template <typename T, typename... Members>
[[nodiscard]] consteval std::size_t field_count()
{
    if constexpr (requires { T{std::declval<Members>()..., detail::AnyMember{}}; })
        return field_count<T, Members..., detail::AnyMember>();
    else
        return sizeof...(Members);
}
}  // namespace hdem
