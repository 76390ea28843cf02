#pragma once
/// What ties one end of a liner's segment to the rock: half of the segment's length l bears.
///
///   N = k_n l g,                 N >= -bond_strength l            g how far the liner is in the rock since it was installed [m]
///   S = k_s l (s - slip),        |S| <= l c + tan(phi) N          s how far it has moved along the rock [m]
///
/// Where N reaches the bond's strength the liner parts from the rock there: from the next cycle on it has no tension and no cohesion. N in the limit of S is that of the
/// last cycle, so that the energy of a cycle has a least value.

#include "core/model/support.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
struct TieAnswer
{
    double normal = 0.0, shear = 0.0;                  ///< on the rock, towards it and along the liner [N]
    double normal_tangent = 0.0, shear_tangent = 0.0;  ///< [N/m]
    double slips = 0.0;                                ///< in this step [m]
    double stored = 0.0, spent = 0.0;                  ///< [J]; spent: in this step
    double energy = 0.0;                               ///< that is to be least [J]
    bool parts = false;                                ///< its bond breaks
    unsigned state = 0;                                ///< which tangents it has
};

/// @param length   of liner that the tie stands for [m]
/// @param parted   has it come off?
/// @param pressed  N of the last cycle [N]
[[nodiscard]] inline TieAnswer answer_of_tie(const Liner& liner, double length, double gap, double along, bool parted,
                                             double pressed)
{
    TieAnswer answer;
    const double normal = liner.normal_stiffness * length, shear = liner.shear_stiffness * length;
    const double least = parted ? 0.0 : -liner.bond_strength * length;
    const double tried = normal * gap;
    answer.normal = std::max(tried, least);
    answer.parts = tried < least;
    answer.normal_tangent = answer.parts ? 0.0 : normal;
    const double limit = (parted ? 0.0 : liner.cohesion * length) + liner.friction * std::max(pressed, 0.0);
    const double tried_shear = shear * along;
    answer.shear = std::clamp(tried_shear, -limit, limit);
    const bool slips = answer.shear != tried_shear;
    answer.slips = slips ? (tried_shear - answer.shear) / shear : 0.0;
    answer.shear_tangent = slips ? 0.0 : shear;
    const double normal_held = 0.5 * answer.normal * answer.normal / normal;
    const double shear_held = shear > 0.0 ? 0.5 * answer.shear * answer.shear / shear : 0.0;
    answer.stored = normal_held + shear_held;
    answer.spent = answer.shear * answer.slips;
    answer.energy = answer.stored + answer.spent + (answer.parts ? least * (gap - least / normal) : 0.0);
    answer.state = (answer.parts ? 1U : 0U) | (slips ? 2U : 0U);
    return answer;
}
}  // namespace hdem
