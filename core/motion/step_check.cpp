#include "core/motion/step_check.h"

#include "core/contact/block_forces.h"
#include "core/motion/contact_springs.h"
#include "core/support/bolt_springs.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// Upper bound on the acceleration of a block's rim by a unit force [1/kg].
double mobility_bound(const Model& model, Index block, const Vec3& inverse_mass)
{
    return inverse_mass[0] + inverse_mass[1] + model.radius[block] * model.radius[block] * inverse_mass[2];
}

/// Greatest length of a contact of two blocks [m].
double length_bound(const Model& model, const Contacts& contacts, Index i)
{
    return std::max(2.0 * std::min(model.radius[contacts.ref[i]], model.radius[contacts.inc[i]]), contacts.length_floor(i));
}

/// Upper bound on omega_max^2 of the springs of a contact `length` long, wherever on its blocks [1/s2].
double frequency_squared_bound(const Model& model, const Blocks& blocks, const Contacts& contacts, Index i, double length)
{
    const CoulombSlip& joint = model.joints.laws[contacts.law[i]];
    double mobility = 0.0;
    for (const Index b : {contacts.ref[i], contacts.inc[i]})
        mobility += mobility_bound(model, b, inverse_masses(blocks, b));
    const double normal = std::max(present_stiffness(model, contacts, i, 0), present_stiffness(model, contacts, i, 1));
    return std::max(normal, joint.shear_stiffness) * length * mobility;
}

bool acts(const Contacts& contacts, Index i)
{
    return is_spring(contacts.regime[0][i]) || is_spring(contacts.regime[1][i]);
}

bool is_stable(double step, double frequency_squared)
{
    return step * step * frequency_squared <= 4.0;
}

/// Can it be seen, block by block and without their poses, that the springs that act are stable?
bool is_clearly_stable(double step, const Model& model, const Blocks& blocks, const Contacts& contacts)
{
    std::vector<double> sum(static_cast<std::size_t>(blocks.size()), 0.0);
    for (Index i = 0; i < contacts.size(); ++i)
    {
        if (!acts(contacts, i))
            continue;
        const double both = 2.0 * contacts.lane[i / lanes].last_length[i % lanes];
        const double bound = frequency_squared_bound(model, blocks, contacts, i, both);
        sum[contacts.ref[i]] += bound;
        sum[contacts.inc[i]] += bound;
    }
    for (const Bolt& bolt : model.support.bolts)
        for (const BoltLink& link : bolt.links)
        {
            const double mobile = mobility_bound(model, link.first, inverse_masses(blocks, link.first)) +
                                  mobility_bound(model, link.second, inverse_masses(blocks, link.second));
            sum[link.first] += (link.axial_stiffness + link.transverse_stiffness) * mobile;
            sum[link.second] += (link.axial_stiffness + link.transverse_stiffness) * mobile;
        }
    for (const LinerTie& tie : model.support.ties)
    {
        const Liner& liner = model.support.liners[tie.liner];
        sum[tie.block] += 0.5 * liner.segments[tie.segment].length * (liner.normal_stiffness + liner.shear_stiffness) *
                          mobility_bound(model, tie.block, inverse_masses(blocks, tie.block));
    }
    double greatest = 0.0;
    for (Index b = 0; b < blocks.size(); ++b)
        greatest = std::max(greatest, blocks.is_free(b) ? sum[b] : 0.0);
    return is_stable(step, greatest);
}
}  // namespace

void find_stiff_contacts(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                         std::vector<StiffContact>& stiff)
{
    stiff.clear();
    for (Index i = range.begin; i < range.end; ++i)
    {
        const double length = length_bound(model, contacts, i);
        if (!is_stable(model.time_step, frequency_squared_bound(model, blocks, contacts, i, length)))
            stiff.push_back({i, acts(contacts, i)});
    }
}

double greatest_answer(IndexRange range, const Model& model, const Contacts& contacts)
{
    double stiffness = 0.0, greatest = 0.0;
    for (const CoulombSlip& joint : model.joints.laws)
        stiffness = std::max(stiffness, joint.normal_stiffness);
    for (Index i = range.begin; i < range.end; ++i)
    {
        double mobility = 0.0;
        for (const Index b : {contacts.ref[i], contacts.inc[i]})
        {
            const BlockInertia& inertia = model.full_inertia[b];
            mobility += mobility_bound(model, b, Vec3(inertia.inverse_mass_x, 0.0, inertia.inverse_inertia));
        }
        greatest = std::max(greatest, 0.5 * length_bound(model, contacts, i) * mobility);
    }
    return stiffness * greatest;
}

Index find_unstable(const Model& model, const Blocks& blocks, const Contacts& contacts, std::vector<StiffContact>& stiff)
{
    Index first = no_index;
    for (StiffContact& s : stiff)
    {
        const bool acted = s.acts;
        s.acts = acts(contacts, s.contact);
        if (first == no_index && s.acts && !acted && blocks.step.next > contact_limit(model, blocks, contacts, s.contact))
            first = s.contact;
    }
    return first;
}

double contact_limit(const Model& model, const Blocks& blocks, const Contacts& contacts, Index contact)
{
    // Rows of the springs, in coordinates in which stiffnesses and masses are 1: S S^T has the eigenvalues of M^-1 K.
    Eigen::Matrix<double, 4, 6> rows = Eigen::Matrix<double, 4, 6>::Zero();
    const Vec3 ref = inverse_masses(blocks, contacts.ref[contact]).cwiseSqrt();
    const Vec3 inc = inverse_masses(blocks, contacts.inc[contact]).cwiseSqrt();
    const auto set_row = [&](int row, const ContactSpring& spring)
    {
        rows.row(row) << ref.cwiseProduct(spring.ref).transpose(), inc.cwiseProduct(spring.inc).transpose();
        rows.row(row) *= std::sqrt(spring.stiffness);
    };
    for_springs(model, blocks, contacts, contact,
                [&](const EdgeTouch&, int k, const ContactSpring& normal, const ContactSpring& shear)
                {
                    if (is_spring(contacts.regime[k][contact]))
                        set_row(2 * k, normal);
                    if (contacts.regime[k][contact] == static_cast<std::uint8_t>(Regime::stick))
                        set_row(2 * k + 1, shear);
                });
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(rows * rows.transpose(), Eigen::EigenvaluesOnly);
    const double greatest = solver.eigenvalues()[3];
    return greatest > 0.0 ? 2.0 / std::sqrt(greatest) : std::numeric_limits<double>::infinity();
}

StableLimit exceeded_limit(double step, const Model& model, const Blocks& blocks, const Contacts& contacts)
{
    if (is_clearly_stable(step, model, blocks, contacts))
        return {};
    BlockContacts list;
    list_block_contacts(contacts, blocks.size(), list);
    if (step <= stable_step({0, blocks.size()}, model, list, contacts, blocks))
        return {};
    const StableLimit limit = stable_limit(model, blocks, contacts, Springs::acting);
    return step > limit.step ? limit : StableLimit{};
}
}  // namespace hdem
