#include "core/motion/time_step.h"

#include "core/detection/contact_tracking.h"
#include "core/geometry/convex_part.h"
#include "core/motion/contact_springs.h"
#include "core/motion/stiffest_part.h"
#include "core/support/bolt_springs.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace hdem
{
double paper_time_step(double smallest_mass, double greatest_stiffness, double fraction)
{
    return fraction * 2.0 * std::sqrt(smallest_mass / (2.0 * greatest_stiffness));
}

namespace
{
/// Longest side of a block's outline [m].
double longest_side(const Shapes& shapes, Index block)
{
    double longest = 0.0;
    for (Index e = shapes.vertex_begin[shapes.part_begin[block]]; e < shapes.vertex_begin[shapes.part_begin[block + 1]]; ++e)
        if (shapes.edge_source[e] != edge_internal)
            longest = std::max(longest, shapes.edge_length[e]);
    return longest;
}
}  // namespace

double default_time_step(const Model& model, const Blocks& blocks, double greatest_stiffness, double fraction)
{
    double least = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < model.blocks(); ++i)
        if (blocks.is_free(i))
            least = std::min(least, model.mass[i] / std::max(1.0, 0.25 * longest_side(model.shapes, i)));
    return paper_time_step(least, greatest_stiffness, fraction);
}

namespace
{
Vec3 inverse_masses(const BlockInertia& inertia)
{
    return {inertia.inverse_mass_x, inertia.inverse_mass_y, inertia.inverse_inertia};
}

/// Springs of one contact, as one of its blocks feels them, in coordinates in which its mass matrix is the unit matrix.
void add_contact(const Model& model, const Contacts& contacts, Index i, Index block, const Blocks& blocks, Eigen::Matrix3d& sum)
{
    const auto mobile = [&](Index b)
    { return blocks.is_free(b) ? Vec3(inverse_masses(model.full_inertia[b]).cwiseSqrt()) : Vec3(Vec3::Zero()); };
    const Vec3 by_ref = mobile(contacts.ref[i]), by_inc = mobile(contacts.inc[i]);
    const bool is_ref = block == contacts.ref[i];
    const auto add_spring = [&](const ContactSpring& spring)
    {
        const Vec3 ref = by_ref.cwiseProduct(spring.ref), inc = by_inc.cwiseProduct(spring.inc);
        const Vec3& row = is_ref ? ref : inc;
        const double other = (is_ref ? inc : ref).squaredNorm();
        sum += spring.stiffness * (1.0 + other / row.squaredNorm()) * row * row.transpose();
    };
    for_springs(model, blocks, contacts, i,
                [&](const EdgeTouch& touch, int k, const ContactSpring& normal, const ContactSpring& shear)
                {
                    if (touch.length <= 0.0 || touch.point[k].overlap < -skin_width(model))
                        return;
                    add_spring(normal);
                    add_spring(shear);
                });
}
}  // namespace

double stable_step(IndexRange range, const Model& model, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks)
{
    double greatest = 0.0;
    for (Index b = range.begin; b < range.end; ++b)
    {
        const bool is_supported = is_held(model.support, b);
        if (!blocks.is_free(b) || (list.begin[b] == list.begin[b + 1] && !is_supported))
            continue;
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        for (Index e = list.begin[b]; e < list.begin[b + 1]; ++e)
            add_contact(model, contacts, list.entry[e] / 2, b, blocks, sum);
        if (is_supported)
        {
            const auto mobile = [&](Index i)
            { return blocks.is_free(i) ? inverse_masses(model.full_inertia[i]) : Vec3(Vec3::Zero()); };
            add_bolt_rows(model, blocks, b, mobile(b), mobile, sum);
        }
        if (sum.norm() <= greatest)  // no eigenvalue is above it
            continue;
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
        solver.computeDirect(sum, Eigen::EigenvaluesOnly);
        greatest = std::max(greatest, solver.eigenvalues()[2]);
    }
    return greatest > 0.0 ? 2.0 / std::sqrt(greatest) : std::numeric_limits<double>::infinity();
}

namespace
{
/// K u of the contacts.
void add_stiffness(const Model& model, const Blocks& blocks, const Contacts& contacts, const std::vector<Index>& some,
                   Springs which, const std::vector<Vec3>& u, std::vector<Vec3>& force)
{
    for (const Index i : some)
    {
        const Index ref = contacts.ref[i], inc = contacts.inc[i];
        for_acting_springs(model, blocks, contacts, which, i,
                           [&](const ContactSpring& spring)
                           {
                               const double f = spring.stiffness * (spring.inc.dot(u[inc]) - spring.ref.dot(u[ref]));
                               force[inc] += f * spring.inc;
                               force[ref] -= f * spring.ref;
                           });
    }
}

/// The same of bolts and liners.
void add_bolt_stiffness(const Model& model, const Blocks& blocks, const std::vector<Vec3>& u, std::vector<Vec3>& force)
{
    for (const Bolt& bolt : model.support.bolts)
        for (const BoltLink& link : bolt.links)
            for_link_springs(bolt, link, blocks,
                             [&](const LinkSpring& spring)
                             {
                                 const double f = spring.stiffness *
                                                  (spring.first.dot(u[link.first]) + spring.second.dot(u[link.second]));
                                 force[link.first] += f * spring.first;
                                 force[link.second] += f * spring.second;
                             });
    for (Index b = 0; b < (model.support.ties.empty() ? 0 : model.blocks()); ++b)
        for_tie_springs(model, blocks, b, [&](double stiffness, const Vec3& row) { force[b] += stiffness * row.dot(u[b]) * row; });
}

/// Energy of a motion of one block, twice; what is prescribed has none.
double energy_of(const Vec3& u, const Vec3& inverse_mass)
{
    double sum = 0.0;
    for (int d = 0; d < 3; ++d)
        sum += inverse_mass[d] > 0.0 ? u[d] * u[d] / inverse_mass[d] : 0.0;
    return sum;
}
}  // namespace

StableLimit stable_limit(const Model& model, const Blocks& blocks, const Contacts& contacts, Springs which, int iterations)
{
    const Part part = stiffest_part(model, blocks, contacts, which);
    std::vector<Vec3> u(static_cast<std::size_t>(blocks.size()), Vec3::Zero()), force(u.size());
    // A start with a share in every mode: one of a pattern has none in the stiffest of two blocks that face each other.
    std::mt19937 random;
    const auto share = [&] { return static_cast<double>(random()) / 0x1p31 - 1.0; };
    for (const Index i : part.blocks)
        for (int d = 0; d < 3; ++d)
            u[i][d] = d < 2 ? share() : share() / model.radius[i];
    StableLimit limit;
    for (int k = 0; k < iterations; ++k)
    {
        for (const Index i : part.blocks)
            force[i] = Vec3::Zero();
        add_stiffness(model, blocks, contacts, part.contacts, which, u, force);
        add_bolt_stiffness(model, blocks, u, force);
        double uu = 0.0, vv = 0.0, most = 0.0;  // in the norm of the masses, which the iteration makes symmetric
        for (const Index i : part.blocks)
        {
            const Vec3 inverse = inverse_masses(blocks, i);
            uu += energy_of(u[i], inverse);
            u[i] = inverse.cwiseProduct(force[i]);
            const double energy = energy_of(u[i], inverse);
            vv += energy;
            if (energy > most)
            {
                most = energy;
                limit.block = i;
            }
        }
        if (vv == 0.0 || uu == 0.0)
            break;
        limit.step = 2.0 / std::sqrt(std::sqrt(vv / uu));
        const double scale = 1.0 / std::sqrt(vv);
        for (const Index i : part.blocks)
            u[i] *= scale;
    }
    return limit;
}

double critical_time_step(const Model& model, const Blocks& blocks, const Contacts& contacts, int iterations)
{
    return stable_limit(model, blocks, contacts, Springs::closed, iterations).step;
}
}  // namespace hdem
