#pragma once
/// What all joint laws share: parameters, memory, input and output of a cycle. All per area of joint.
///
/// A law is a struct with
///
///   enum Number        positions of its numbers, after those of the normal spring (normal_closure.h)
///   numbers(input, n)  fills them from the user's values; n holds the normal spring's already
///   react<Curve>       one cycle at one point; Curve is Linear, Hyperbolic or PowerLaw
///   peak_strength      greatest shear stress under a normal stress, from where the joint is drawn
///   damage_of          how far it has lost its roughness or its bond: 0 as drawn, 1 nothing left
///   drawn_state        only where `state` begins with a shear stress: its first value
///
/// and stands in the list of core/joint/all_laws.h.
///
/// Signs: compression is positive. tau acts on the incident block along t, so the shear displacement that raises tau is -slide.
///
/// What every law keeps:
///
///   sigma = N(closure + w)                    N: the normal spring's curve, in total form
///   tau   = last_shear + K_S (-slide - slid)
///   mean tau (-slide) + mean sigma d(closure) = change of (energy + tau^2 / 2 K_S) + heat + freed
///
/// Means are of the values before and after the cycle. The last line is exact where N is linear, and of second order in the step elsewhere.

#include "core/joint/functions.h"
#include "core/types.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace hdem
{
inline constexpr int joint_numbers = 20;
inline constexpr double no_limit = 1e30;  ///< a length or a stress that is never reached; finite, so that no lane gets a NaN

/// Numbers of a joint, SI units, angles in radians; each law names its positions.
template <typename R>
struct BasicJointNumbers
{
    std::array<R, joint_numbers> n;

    [[nodiscard]] const R& operator[](int i) const { return n[static_cast<std::size_t>(i)]; }
    [[nodiscard]] R& operator[](int i) { return n[static_cast<std::size_t>(i)]; }
};
using JointNumbers = BasicJointNumbers<double>;

/// What a point of a joint remembers. All zero: as drawn. A contact that was not drawn begins with broken = 1.
template <typename R>
struct BasicJointMemory
{
    R slip = 0.0;     ///< u_p, plastic slip, signed as tau [m]
    R state = 0.0;    ///< variable of the law
    R turn = 0.0;     ///< second variable of the law
    R opening = 0.0;  ///< w of laws whose dilation depends on the path [m]
    R broken = 0.0;   ///< 0 intact, 1 broken; coulomb only
};
using JointMemory = BasicJointMemory<double>;

/// What happens to a point in a cycle.
template <typename R>
struct BasicJointStep
{
    R closure;      ///< overlap minus rest overlap plus preload, without the law's dilation [m]
    R slide;        ///< way of the incident block along t [m]
    R last_shear;   ///< tau after the last cycle [Pa]
    R last_normal;  ///< sigma after the last cycle [Pa]
};
using JointStep = BasicJointStep<double>;

/// What a law gives for a point in a cycle.
template <typename R>
struct BasicJointStress
{
    R normal;            ///< sigma; below 0 only where the joint bears tension [Pa]
    R shear;             ///< tau [Pa]
    R strength;          ///< greatest |tau| under the present sigma, of the state after this cycle [Pa]
    R slid;              ///< plastic slip of this cycle, change of u_p: signed as tau, so that shear * slid >= 0 [m]
    R opening;           ///< dilation w [m]
    R energy;            ///< stored normal to the joint [J/m^2]
    R heat;              ///< work of slip against friction and dilation in this cycle [J/m^2]
    R freed;             ///< energy that the joint lost by breaking, opening or a change of K_S in this cycle [J/m^2]
    R normal_stiffness;  ///< d sigma / d closure [Pa/m]
    R shear_compliance;  ///< 1 / K_S, elastic; 0 where there is no shear spring [m/Pa]
};
using JointStress = BasicJointStress<double>;

/// A stretch of slip in which strength and dilation change in proportion to slip.
template <typename R>
struct BasicSlipPiece
{
    R length;     ///< >= 0 [m]
    R stiffness;  ///< what a metre of slip takes off the excess: K_S + K_N mu dw/du_p [Pa/m]
};

/// How much of each piece is slipped until the excess of shear stress over strength is gone.
///
/// A piece whose stiffness is not positive is passed at once: there the strength falls faster than the spring unloads.
/// @param most    slip at which the shear stress is 0, |tau| / K_S; there is none beyond
/// @param pieces  in the order of slip; the last one is endless and has a positive stiffness
template <typename R, std::size_t n>
[[nodiscard]] inline std::array<R, n> slip_along(R excess, R most, const std::array<BasicSlipPiece<R>, n>& pieces)
{
    std::array<R, n> way;
    const R zero = 0.0;
    excess = max(excess, zero);
    for (std::size_t k = 0; k < n; ++k)
    {
        const auto holds = pieces[k].stiffness > zero;
        const R needed = select(holds, excess / select(holds, pieces[k].stiffness, R(1.0)), R(no_limit));
        const R reach = select(excess > zero, needed, zero);
        const R length = min(pieces[k].length, most);
        const auto ends = reach <= length;
        way[k] = select(ends, reach, length);
        most = max(most - way[k], zero);
        excess = select(ends, zero, excess - pieces[k].stiffness * way[k]);
    }
    return way;
}

/// 1 / x, 0 where x is 0.
template <typename R>
[[nodiscard]] inline R compliance_of(R stiffness)
{
    return select(stiffness > R(0.0), R(1.0) / max(stiffness, R(1e-200)), R(0.0));
}

/// 1 or -1.
template <typename R>
[[nodiscard]] inline R direction_of(R x)
{
    return select(x < R(0.0), R(-1.0), R(1.0));
}

/// numerator / max(denominator, tiny): 0 / 0 is 0.
template <typename R>
[[nodiscard]] inline R safe_ratio(R numerator, R denominator)
{
    return numerator / max(denominator, R(1e-200));
}

/// tau^2 / (2 K_S) [J/m^2]
template <typename R>
[[nodiscard]] inline R shear_energy(R shear, R compliance)
{
    return R(0.5) * shear * shear * compliance;
}

/// Heat of a cycle: mean tau * slid - mean sigma * dw.
template <typename R>
[[nodiscard]] inline R slip_heat(const BasicJointStep<R>& step, const BasicJointStress<R>& now, R last_opening)
{
    return R(0.5) * ((step.last_shear + now.shear) * now.slid - (step.last_normal + now.normal) * (now.opening - last_opening));
}

/// Where a joint is open it carries nothing, its slip stays, and the shear spring's energy is freed.
template <typename R, typename M>
inline void empty_where_open(M open, const BasicJointStep<R>& step, R last_opening, BasicJointStress<R>& now)
{
    if (!any(open))
        return;
    const R zero = 0.0;
    const R released = R(0.5) * step.last_shear * (step.last_shear * now.shear_compliance - step.slide);
    now.freed = select(open, select(step.last_shear == zero, zero, released), now.freed);
    now.opening = select(open, last_opening, now.opening);
    for (R* value : {&now.normal, &now.shear, &now.strength, &now.slid, &now.energy, &now.heat, &now.normal_stiffness})
        *value = select(open, zero, *value);
}
}  // namespace hdem
