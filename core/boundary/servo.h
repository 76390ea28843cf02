#pragma once
/// Walls that move until they press with a given stress.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"

namespace hdem
{
/// What a wall presses with, and how stiff its contacts are.
struct WallForce
{
    double normal = 0.0;     ///< sum over its contacts, compression positive [N]
    double stiffness = 0.0;  ///< sum of K_N l over its closed points [N/m]
};

/// From the last forces of the wall's contacts.
[[nodiscard]] WallForce wall_force(Index wall, const Model& model, const Contacts& contacts, const BlockContacts& list);

/// Length of a side on which a wall presses [m]: as drawn, without the parts in front of held blocks. Between a wall and a block that cannot move there is
/// no force, and the rock beside it must not bear its share.
[[nodiscard]] double pressed_length(const Boundary& boundary, const BoundaryWall& wall, const Blocks& blocks);

/// Velocity of a wall along its inward normal:
///
///   v = beta (F_target - F) / (K_wall dt),  |v| <= v_max,  beta = 0.05
///
/// With beta near 1 the wall would swing with the rock. A wall that touches nothing comes nearer with v_max.
/// @see verification/unit/core/boundary/servo_test.cpp
[[nodiscard]] double servo_velocity(const WallForce& force, double target, double max_velocity, double step);

/// Set the velocities of the moving walls of the running stage, before the contacts are evaluated: servo walls, and walls of kind velocity
/// that have a factor. A wall has no mass, so no energy is booked.
void drive_walls(const Model& model, const BlockContacts& list, State& state);

/// Does each servo wall of the running stage press with its present target, within 0.1 % of the full target?
[[nodiscard]] bool servos_press(const Model& model, const State& state);
}  // namespace hdem
