#pragma once
/// Damping of linings in stages that seek rest.

#include "core/support/liner_forces.h"

namespace hdem
{
/// As press_liners, but a node that slows down has the local damping of blocks:
///
///   m dv = -damping |F| v / |v|   where F v < 0                                  F the net force on it
///
/// A node that swings comes to rest within some swings, whatever their period; a node that falls is not held. Implicit Euler alone takes thousands of
/// cycles for a soft or a wide lining.
///
/// Blocks that touch others by impulses have no local damping. The swing of one on a lining that carries it is damped by
///
///   -2 zeta sqrt(m v p),   p = -df/dt > 0,   zeta = damping / pi          f the force of the lining on it along its velocity
///
/// and likewise its rotation. On a spring p = k v, and this is the share zeta of the critical damping. Where f does not change, as when the block slides
/// along the lining, it is zero.
void press_liners(const Model& model, State& state, LinerSolvers& solvers, double damping, std::vector<BlockPush>& pushes);
}  // namespace hdem
