#include "core/contact/island_solution.h"

#include "core/contact/interior_point.h"
#include "core/contact/island_newton.h"

#include <algorithm>
#include <vector>

namespace hdem
{
namespace
{
constexpr int most_rounds = 20;  ///< of Haslinger, in which the error must fall by half

/// Interior points, by themselves and step by step.
IslandProblem solve_by_interior_points(const IslandProblem& problem, double goal)
{
    // A joint that bears more tension than its cohesion allows for has no whole cone of friction.
    const bool has_cones = std::ranges::none_of(problem.points, [](const ImpulsePoint& p) { return p.cohesive_impulse < 0.0; });
    IslandProblem best = has_cones ? InteriorPoint(problem).solve(goal) : problem;
    double least = best.error();
    double milestone = least;
    IslandProblem next = problem;
    const auto has_shear = [](const ImpulsePoint& p) { return p.friction > 0.0; };
    if (std::none_of(problem.points.begin(), problem.points.end(), has_shear))
        return best;
    for (int left = most_rounds; left > 0 && least > goal; --left)
    {
        IslandProblem frozen = next;
        for (ImpulsePoint& p : frozen.points)
        {
            p.cohesive_impulse = shear_limit(p, p.impulse_normal);
            p.friction = 0.0;
        }
        frozen = InteriorPoint(frozen).solve(0.1 * goal);
        std::vector<double> normal, shear;
        for (std::size_t i = 0; i < next.points.size(); ++i)
        {
            normal.push_back(frozen.points[i].impulse_normal);
            const double most = shear_limit(next.points[i], normal[i]);
            shear.push_back(std::clamp(frozen.points[i].impulse_shear, -most, most));
        }
        next.set_impulses(normal, shear);
        const double error = next.error();
        if (!(error < least))
            continue;
        if (error < 0.5 * milestone)
        {
            milestone = error;
            left = most_rounds;
        }
        least = error;
        best = next;
    }
    return best;
}
}  // namespace

IslandProblem solve_all_at_once(const IslandProblem& problem, double goal)
{
    IslandProblem best = solve_by_newton(problem, goal);
    const double error = best.error();
    if (error <= goal)
        return best;
    IslandProblem other = solve_by_interior_points(problem, goal);
    return other.error() < error ? other : best;
}
}  // namespace hdem
