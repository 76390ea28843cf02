#include "core/rock/strength_reduction.h"

#include "core/joint/all_laws.h"

#include <algorithm>
#include <limits>

namespace hdem
{
namespace
{
/// Call `use(law, numbers)` where the joint has a law with a memory.
template <typename Use>
void with_numbers(JointRow& row, const Use& use)
{
    if (row.has_memory())
        with_law(row.kind, [&](auto law) { use(law, row.numbers); });
}

void keep_peak(JointRow& row, const CoulombSlip& slip)
{
    with_numbers(row,
                 [](auto law, JointNumbers& n)
                 {
                     if constexpr (requires { decltype(law)::keep_peak(n); })
                         decltype(law)::keep_peak(n);
                 });
    if (row.kind != kind_of<CoulombResidual>())
        return;
    row.residual_friction = slip.friction_coefficient;
    row.residual_cohesion = slip.cohesion;
    row.torn_reach = row.reach;
}

void weaken(JointRow& row, double factor)
{
    row.tension /= factor;
    row.residual_friction /= factor;
    row.residual_cohesion /= factor;
    with_numbers(row, [&](auto law, JointNumbers& n) { decltype(law)::weaken(n, factor); });
}

/// sigma(V) becomes sigma(V / s), s times as stiff: the same stress at 1/s of the closure.
void stiffen(JointRow& row, double s)
{
    JointNumbers& n = row.numbers;
    n[curve_stiffness] *= s;
    n[curve_cap_stiffness] *= s;
    n[curve_cap] /= s;
    n[curve_cap_energy] /= s;
    if (row.curve == CurveKind::hyperbolic)
        n[curve_scale] /= s;
    if (row.curve == CurveKind::power_law)
        n[curve_scale] *= s;
    with_numbers(row, [&](auto law, JointNumbers& numbers) { decltype(law)::stiffen(numbers, s); });
}

/// Laws of a named joint: its own, and that of blocks that have met since the start.
std::vector<Index> laws_of(const JointTable& table, std::size_t joint)
{
    const auto own = static_cast<Index>(joint);
    const Index met = table.unbonded_of(own);
    return met == own ? std::vector<Index>{own} : std::vector<Index>{own, met};
}

bool is_chosen(const std::vector<std::uint8_t>& joints, std::size_t joint)
{
    return joints.empty() || joints[joint] != 0;
}

bool loses(const JointRow& row)
{
    return row.has_memory() && with_law(row.kind,
                                        [&](auto law)
                                        {
                                            if constexpr (requires { decltype(law)::loses_strength(row.numbers); })
                                                return decltype(law)::loses_strength(row.numbers);
                                            else
                                                return false;
                                        });
}

/// F from which on slip would make energy.
double factor_for_dilation(const JointRow& row)
{
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!row.has_memory())
        return infinity;
    return with_law(row.kind,
                    [&](auto law)
                    {
                        if constexpr (requires { decltype(law)::greatest_factor(row.numbers); })
                            return decltype(law)::greatest_factor(row.numbers);
                        else
                            return infinity;
                    });
}
}  // namespace

StageLaws reduced_laws(const JointTable& table, const StrengthReduction& how)
{
    StageLaws reduced{table.laws, table.rows};
    for (CoulombSlip& law : reduced.laws)
    {
        law.normal_stiffness *= how.stiffness;
        law.shear_stiffness *= how.stiffness;
    }
    for (JointRow& row : reduced.rows)
        if (how.stiffness != 1.0)
            stiffen(row, how.stiffness);
    for (std::size_t joint = 0; joint < table.names.size(); ++joint)
        for (const Index i : laws_of(table, joint))
        {
            if (!reduced.rows.empty() && how.keeps_peak)
                keep_peak(reduced.rows[i], reduced.laws[i]);
            if (!is_chosen(how.joints, joint))
                continue;
            reduced.laws[i].friction_coefficient /= how.factor;
            reduced.laws[i].cohesion /= how.factor;
            if (!reduced.rows.empty())
                weaken(reduced.rows[i], how.factor);
        }
    return reduced;
}

void weaken_bolts(Support& support, double factor)
{
    for (Bolt& bolt : support.bolts)
    {
        bolt.yield /= factor;
        bolt.shear_strength /= factor;
        bolt.bond_strength /= factor;
    }
}

bool loses_strength(const JointTable& table, const std::vector<std::uint8_t>& joints)
{
    for (std::size_t joint = 0; joint < table.rows.size() && joint < table.names.size(); ++joint)
        if (is_chosen(joints, joint) && loses(table.rows[joint]))
            return true;
    return false;
}

double greatest_factor_for_dilation(const JointTable& table, const std::vector<std::uint8_t>& joints)
{
    double greatest = std::numeric_limits<double>::infinity();
    for (std::size_t joint = 0; joint < table.rows.size() && joint < table.names.size(); ++joint)
    {
        if (is_chosen(joints, joint))
            greatest = std::min(greatest, factor_for_dilation(table.rows[joint]));
    }
    return greatest;
}
}  // namespace hdem
