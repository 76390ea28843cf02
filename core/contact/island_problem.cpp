#include "core/contact/island_problem.h"

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
        error = std::abs(next_normal(point, velocity) - point.impulse_normal) / point.mass_normal;
    return greater(error, std::abs(next_shear(point, velocity) - point.impulse_shear) / point.mass_shear);
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

double IslandProblem::heaviest() const
{
    double mass = 0.0;
    for (const Block& block : blocks)
        for (const double inverse : {block.inertia.inverse_mass_x, block.inertia.inverse_mass_y})
            mass = inverse > 0.0 ? std::max(mass, 1.0 / inverse) : mass;
    return mass;
}

double IslandProblem::stopping_impulse() const
{
    return std::max(heaviest() * error(), greatest_impulse());
}

void IslandProblem::set_impulses(ImpulsePoint& point, double normal, double shear)
{
    const Kick kick(point, shear - point.impulse_shear, point.impulse_normal - normal);
    Block& ref = blocks[point.ref];
    Block& inc = blocks[point.inc];
    change_velocity(ref.inertia, -kick.x, -kick.y, -kick.w_ref, ref.velocity.x, ref.velocity.y, ref.velocity.w);
    change_velocity(inc.inertia, kick.x, kick.y, kick.w_inc, inc.velocity.x, inc.velocity.y, inc.velocity.w);
    point.impulse_normal = normal;
    point.impulse_shear = shear;
}

void IslandProblem::set_impulses(const std::vector<double>& normal, const std::vector<double>& shear)
{
    for (std::size_t i = 0; i < points.size(); ++i)
        set_impulses(points[i], normal[i], shear[i]);
}
}  // namespace hdem
