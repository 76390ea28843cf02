#pragma once
/// Stress that the rock carries before the first cycle, locked into its joints without moving a block.

#include "core/model/model.h"
#include "core/state/state.h"

#include <string>
#include <vector>

namespace hdem
{
/// sigma(y) of [insitu] at a height, tension positive [Pa].
///
///   sigma = stress + gradient (y - reference)
///   sigma_yy = rho g (y - surface),  sigma_xx = ratio sigma_yy - ratio_offset,  0 above the surface (a millimetre above it is the surface still)
///
/// @param y  in the model's local coordinates [m]
[[nodiscard]] StressDef stress_at(const InsituField& field, double y);

/// The field of a case. rho is the density of the domain's material (of the first block where there is no domain).
[[nodiscard]] InsituField make_field(const InsituDef& def, double density, const Vec2& gravity, const Vec2& origin);

/// How far the field is from equilibrium with gravity: |d sigma_xy/dy + rho g_x, d sigma_yy/dy + rho g_y| over rho g; without gravity over the gradient itself [-].
[[nodiscard]] double field_unbalance(const InsituField& field, double density, const Vec2& gravity);

/// Give a contact whose edges lie on each other the forces of the field. Blocks stay where they are.
///
///   F_1 = L (2 t_1 + t_2) / 6,  F_2 = L (t_1 + 2 t_2) / 6,  t = sigma n at the two ends of a joint of length L
///   p = F_N / (K_N l) - u
///
///   p preload, by which the spring is pressed beyond the overlap u [m]   l the point's share of L [m]
///
/// These two forces have the resultant and the moment of a traction that is linear along the joint, so each block is in equilibrium where the field is. Half of
/// the length times the traction at each end would have three times the moment of the gradient.
/// A joint takes no tension: such forces are 0, and summarise_insitu reports them. A joint above its strength slips in the first cycle.
/// @see verification/unit/core/stress/insitu_stress_test.cpp
void lock_in_stress(const Model& model, State& state, Index contact);

/// Joints of one set under the stress they begin with.
struct StressedSet
{
    std::string name;           ///< of the joint set, or what else the edges are
    Index joints = 0;           ///< contacts
    double length = 0.0;        ///< [m]
    double most_used = 0.0;     ///< greatest share of the shear strength in use [-]
    Index above = 0;            ///< contacts that bear more shear than their strength, or tension
    double length_above = 0.0;  ///< [m]
};

struct InsituSummary
{
    double
        unbalance = 0.0;  ///< worst net force on a free block, with its moment over its radius, over the sum of what acts on it [-]
    Index worst = no_index;  ///< that block
    double field = 0.0;      ///< field_unbalance [-]
    std::vector<StressedSet> sets;
};

/// @pre the stress is locked in, and no cycle has run
[[nodiscard]] InsituSummary summarise_insitu(const Model& model, const State& state);
}  // namespace hdem
