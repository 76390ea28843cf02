#include "core/motion/time_step.h"

#include "core/detection/contact_tracking.h"
#include "core/detection/edge_touch.h"
#include "core/motion/rest.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

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

namespace
{
/// One spring as a block feels it, in coordinates in which its mass matrix is the unit matrix: K L of the point, row of its stretch.
struct SpringRow
{
    Vec3 row;
    double other;  ///< r M^-1 r^T of the block on the other side [1/kg]
};

Vec3 square_root(const BlockInertia& inertia)
{
    return Vec3(inertia.inverse_mass_x, inertia.inverse_mass_y, inertia.inverse_inertia).cwiseSqrt();
}

void add_spring(double stiffness, const SpringRow& spring, Eigen::Matrix3d& sum)
{
    const double own = spring.row.squaredNorm();
    sum += stiffness * (1.0 + spring.other / own) * spring.row * spring.row.transpose();
}

/// Springs of one contact, as one of its blocks feels them.
void add_contact(const Model& model, const Contacts& contacts, Index i, Index block, const Blocks& blocks, Eigen::Matrix3d& sum)
{
    const Index ref = contacts.ref[i];
    const Index inc = contacts.inc[i];
    const EdgePair edges = contacts.edges(i);
    const EdgeTouch touch = touch_edges(edges, view_edges(edges, blocks.motion[ref], blocks.motion[inc]), blocks.motion[ref],
                                        blocks.motion[inc]);
    if (touch.length <= 0.0)
        return;
    const auto mobile = [&](Index b) { return blocks.is_free(b) ? square_root(model.full_inertia[b]) : Vec3(Vec3::Zero()); };
    const Vec3 by_ref = mobile(ref), by_inc = mobile(inc);
    const CoulombSlip& joint = model.joints.laws[contacts.law[i]];
    const double length = point_length(touch.length, contacts.length_floor(i));
    for (const TouchPoint& p : touch.point)
    {
        if (p.overlap < -skin_width(model))
            continue;
        const Vec3 normal_ref = by_ref.cwiseProduct(Vec3(-touch.ey, touch.ex, p.ref_t));
        const Vec3 normal_inc = by_inc.cwiseProduct(Vec3(-touch.ey, touch.ex, p.inc_t));
        const Vec3 shear_ref = by_ref.cwiseProduct(Vec3(touch.ex, touch.ey, -p.ref_m));
        const Vec3 shear_inc = by_inc.cwiseProduct(Vec3(touch.ex, touch.ey, -p.inc_m));
        const bool is_ref = block == ref;
        add_spring(joint.normal_stiffness * length,
                   {is_ref ? normal_ref : normal_inc, (is_ref ? normal_inc : normal_ref).squaredNorm()}, sum);
        add_spring(joint.shear_stiffness * length, {is_ref ? shear_ref : shear_inc, (is_ref ? shear_inc : shear_ref).squaredNorm()},
                   sum);
    }
}
}  // namespace

double stable_step(IndexRange range, StepOf which, const Model& model, const BlockContacts& list, const Contacts& contacts,
                   const Blocks& blocks)
{
    double greatest = 0.0;
    for (Index b = range.begin; b < range.end; ++b)
    {
        if (!blocks.is_free(b) || list.begin[b] == list.begin[b + 1] ||
            (which == StepOf::moving && !is_beside_moving(b, list, contacts, blocks)))
            continue;
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (Index e = list.begin[b]; e < list.begin[b + 1]; ++e)
            add_contact(model, contacts, list.entry[e] / 2, b, blocks, sum);
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
        solver.computeDirect(sum, Eigen::EigenvaluesOnly);
        greatest = std::max(greatest, solver.eigenvalues()[2]);
    }
    return greatest > 0.0 ? 2.0 / std::sqrt(greatest) : std::numeric_limits<double>::infinity();
}

double critical_time_step(const Model& model, const Blocks& blocks, const Contacts& contacts, int iterations)
{
    const auto n = static_cast<std::size_t>(blocks.size());
    std::vector<Vec3> u(n), force(n);
    // A start with a share in every mode: one of a pattern has none in the stiffest of two blocks that face each other.
    std::mt19937 random;
    const auto share = [&] { return static_cast<double>(random()) / 0x1p31 - 1.0; };
    for (std::size_t i = 0; i < n; ++i)
        for (int d = 0; d < 3; ++d)
            u[i][d] = d < 2 ? share() : share() / model.radius[i];
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
