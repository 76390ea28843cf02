#pragma once
/// Impulses of an island, found all at once.

#include "core/contact/island_problem.h"

namespace hdem
{
/// The problem with impulses that bring its error() to `goal` [m/s] or below; if that fails, with the best that were met.
///
/// By solve_by_newton, from the impulses of now. The few islands that it does not solve are left to InteriorPoint. The limit of friction follows the normal
/// impulses, so its path may end on the way, too (rare, core/tried.md). Then the problem is solved step by step, with the limits of the step before: each of
/// these problems is convex (Haslinger's fixed point).
[[nodiscard]] IslandProblem solve_all_at_once(const IslandProblem& problem, double goal);
}  // namespace hdem
