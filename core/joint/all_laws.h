#pragma once
/// The list of all joint laws with a memory, and of all curves of the normal spring.

#include "core/joint/barton_bandis.h"
#include "core/joint/continuously_yielding.h"
#include "core/joint/coulomb_residual.h"
#include "core/joint/joint_row.h"
#include "core/joint/patton.h"
#include "core/joint/plesha.h"
#include "core/joint/saeb_amadei.h"
#include "core/joint/slip_weakening.h"
#include "core/joint/user_law.h"

#include <tuple>
#include <utility>

namespace hdem
{
/// Empty, only to name a type.
template <typename T>
struct Named
{
    using Type = T;
};
template <typename... Types>
using List = std::tuple<Named<Types>...>;

using AllLaws = List<CoulombResidual, BartonBandis, Patton, ContinuouslyYielding, Plesha, SaebAmadei, SlipWeakening, UserLaw>;
using AllCurves = List<Linear, Hyperbolic, PowerLaw>;  ///< in the order of CurveKind

inline constexpr int law_count = std::tuple_size_v<AllLaws>;
inline constexpr int curve_count = std::tuple_size_v<AllCurves>;

/// Position of a law in the list.
template <typename Law, int at = 0>
[[nodiscard]] constexpr JointKind kind_of()
{
    if constexpr (std::is_same_v<typename std::tuple_element_t<at, AllLaws>::Type, Law>)
        return JointKind{at};
    else
        return kind_of<Law, at + 1>();
}

/// Call `use` with an object of the type at a position of a list.
template <typename Types, int at = 0, typename Use>
decltype(auto) with_type(int position, const Use& use)
{
    if constexpr (at + 1 < static_cast<int>(std::tuple_size_v<Types>))
        if (position != at)
            return with_type<Types, at + 1>(position, use);
    return use(typename std::tuple_element_t<at, Types>::Type{});
}

/// @pre the joint has a memory
template <typename Use>
decltype(auto) with_law(JointKind kind, const Use& use)
{
    return with_type<AllLaws>(static_cast<int>(kind), use);
}
template <typename Use>
decltype(auto) with_curve(CurveKind kind, const Use& use)
{
    return with_type<AllCurves>(static_cast<int>(kind), use);
}
}  // namespace hdem
