#pragma once
/// Linings in stages that look for rest.

#include "core/support/liner_forces.h"

namespace hdem
{
/// As press_liners, and a node that slows down has the local damping of blocks:
///
///   m dv = -damping |F| v / |v|   where F v < 0                                  F the net force on it
///
/// One that swings comes to rest within some swings, whatever their period; one that falls is not held. Implicit Euler alone takes thousands of cycles for a soft or a wide lining.
void press_liners(const Model& model, State& state, LinerSolvers& solvers, double damping, std::vector<BlockPush>& pushes);
}  // namespace hdem
