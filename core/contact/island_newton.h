#pragma once
/// Newton's method for the impulses of an island, from those that sweeps have left.

#include "core/contact/island_problem.h"

namespace hdem
{
/// A step of Newton's method for J' = J, J_S' = J_S (next_normal, next_shear), which are linear in pieces (P. Alart, A. Curnier, Comput. Methods Appl.
/// Mech. Eng. 92, 1991). J' and J_S' of now say which piece holds for a point:
///
///   J + m_cN (v_m - target) < 0  open      J = 0,         J_S as it sticks or slips
///   |J_S'| <= J' tan(phi) + c    sticks    v_m = target,  v_t = 0
///   else                         slips     v_m = target,  J_S = +-(J tan(phi) + c)
///
/// Unknown are the changes of J of points that are not open, and of J_S of those that stick; the blocks' velocities follow from them.
///
/// @param stay  share of its own effect by which each change counts twice [-]. It makes changes small that no velocity asks for: where points carry more
///     than equilibrium does, impulses stay close to those of now. A greater share also tames pieces in which the points jam, and asks for more steps.
[[nodiscard]] IslandProblem newton_step(const IslandProblem& now, double stay);

/// The problem with impulses that bring its error() to `goal` [m/s] or below; if that fails, with the best that were met. A few steps of Newton's method
/// and a few sweeps take turns: one or two steps are enough for 95 % of the islands of heaps. Impulses stay below IslandProblem::impulse_bound().
/// @see verification/unit/core/contact/island_newton_test.cpp, core/tried.md
[[nodiscard]] IslandProblem solve_by_newton(const IslandProblem& problem, double goal);
}  // namespace hdem
