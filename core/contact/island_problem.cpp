#include "core/contact/island_problem.h"

#include "core/joint/coulomb_slip.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// The greater one; NaN if one of them is NaN: impulses that are NaN must not count as solved.
double greater(double a, double b)
{
    return a > b || std::isnan(a) ? a : b;
}
}  // namespace

double law_error(const ImpulsePoint& point, const PointVelocity& velocity)
{
    double error = 0.0;
    if (point.mass_normal > 0.0)
    {
        const double next = std::max(point.impulse_normal + point.mass_normal * (velocity.m - point.target), 0.0);
        error = std::abs(next - point.impulse_normal) / point.mass_normal;
    }
    const double next = slip_limited(point.impulse_shear - point.mass_shear * velocity.t, shear_limit(point, point.impulse_normal));
    return greater(error, std::abs(next - point.impulse_shear) / point.mass_shear);
}

double IslandProblem::error() const
{
    double worst = 0.0;
    for (const ImpulsePoint& p : points)
        worst = greater(worst, law_error(p, velocity_at(p)));
    return worst;
}

double IslandProblem::greatest_impulse() const
{
    double greatest = 0.0;
    for (const ImpulsePoint& p : points)
        greatest = std::max(greatest, p.impulse_normal);
    return greatest;
}

void IslandProblem::set_impulses(const std::vector<double>& normal, const std::vector<double>& shear)
{
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        ImpulsePoint& p = points[i];
        const Kick kick(p, shear[i] - p.impulse_shear, p.impulse_normal - normal[i]);
        Block& ref = blocks[p.ref];
        Block& inc = blocks[p.inc];
        change_velocity(ref.inertia, -kick.x, -kick.y, -kick.w_ref, ref.velocity.x, ref.velocity.y, ref.velocity.w);
        change_velocity(inc.inertia, kick.x, kick.y, kick.w_inc, inc.velocity.x, inc.velocity.y, inc.velocity.w);
        p.impulse_normal = normal[i];
        p.impulse_shear = shear[i];
    }
}
}  // namespace hdem
