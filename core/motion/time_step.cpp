#include "core/motion/time_step.h"

#include "core/detection/edge_touch.h"

#include <cmath>
#include <limits>

namespace hdem
{
double paper_time_step(double smallest_mass, double greatest_stiffness, double fraction)
{
    return fraction * 2.0 * std::sqrt(smallest_mass / (2.0 * greatest_stiffness));
}

namespace
{
/// Motion or force of a block as (x, y, rotation).
using Vec3 = Eigen::Vector3d;

/// K u of the contacts: each closed point a spring along its normal and one along its edge.
void add_stiffness(const Model& model, const Blocks& blocks, const Contacts& contacts, const std::vector<Vec3>& u,
                   std::vector<Vec3>& force)
{
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const Index ref = contacts.ref[i];
        const Index inc = contacts.inc[i];
        const EdgePair edges = contacts.edges(i);
        const EdgeTouch touch = touch_edges(edges, view_edges(edges, blocks.motion[ref], blocks.motion[inc]), blocks.motion[ref],
                                            blocks.motion[inc]);
        const CoulombSlip& joint = model.joints.laws[contacts.law[i]];
        const double length = point_length(touch.length, contacts.length_floor(i));
        for (const TouchPoint& p : touch.point)
        {
            if (!is_closed(touch.length, p.overlap, contacts.length_floor(i)))
                continue;
            // Rows of the two springs: how fast each stretches by a motion of inc, of ref.
            const Vec3 shear_inc(touch.ex, touch.ey, -p.inc_m);
            const Vec3 shear_ref(touch.ex, touch.ey, -p.ref_m);
            const Vec3 normal_inc(-touch.ey, touch.ex, p.inc_t);
            const Vec3 normal_ref(-touch.ey, touch.ex, p.ref_t);
            const double f_n = joint.normal_stiffness * length * (normal_inc.dot(u[inc]) - normal_ref.dot(u[ref]));
            const double f_s = joint.shear_stiffness * length * (shear_inc.dot(u[inc]) - shear_ref.dot(u[ref]));
            force[inc] += f_n * normal_inc + f_s * shear_inc;
            force[ref] -= f_n * normal_ref + f_s * shear_ref;
        }
    }
}
}  // namespace

double critical_time_step(const Model& model, const Blocks& blocks, const Contacts& contacts, int iterations)
{
    const auto n = static_cast<std::size_t>(blocks.size());
    std::vector<Vec3> u(n), force(n);
    // Any start with a share in every mode; alternating signs favour the stiff ones.
    for (std::size_t i = 0; i < n; ++i)
        u[i] = Vec3(i % 2 == 0 ? 1.0 : -1.0, i % 3 == 0 ? -1.0 : 1.0, (i % 5 < 2 ? 1.0 : -1.0) / model.radius[i]);
    double eigenvalue = 0.0;
    for (int k = 0; k < iterations; ++k)
    {
        std::fill(force.begin(), force.end(), Vec3::Zero());
        add_stiffness(model, blocks, contacts, u, force);
        double uu = 0.0, vv = 0.0;  // in the norm of the masses, which the iteration makes symmetric
        for (std::size_t i = 0; i < n; ++i)
        {
            const BlockInertia& inertia = blocks.inertia[i];
            const Vec3 inverse(inertia.inverse_mass_x, inertia.inverse_mass_y, inertia.inverse_inertia);
            const Vec3 next = inverse.cwiseProduct(force[i]);
            for (int d = 0; d < 3; ++d)
                if (inverse[d] > 0.0)
                {
                    uu += u[i][d] * u[i][d] / inverse[d];
                    vv += next[d] * next[d] / inverse[d];
                }
            u[i] = next;
        }
        if (vv == 0.0 || uu == 0.0)
            break;
        eigenvalue = std::sqrt(vv / uu);
        const double scale = 1.0 / std::sqrt(vv);
        for (Vec3& value : u)
            value *= scale;
    }
    return eigenvalue > 0.0 ? 2.0 / std::sqrt(eigenvalue) : std::numeric_limits<double>::infinity();
}
}  // namespace hdem
