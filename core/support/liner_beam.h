#pragma once
/// One beam of a liner.
///
///   N   = E A / L (e - e_p),                          -compressive_strength <= N <= tensile_strength     e its elongation [m]
///   M_1 = E I / L (4 (phi_1 - p_1) + 2 (phi_2 - p_2)),  |M| <= moment_strength                            phi rotations of its ends against the chord
///   M_2 = E I / L (2 (phi_1 - p_1) + 4 (phi_2 - p_2))
///
/// Euler and Bernoulli's beam, small rotations. N and M yield independently: their limits form a rectangle. e_p and p are what has flowed before. They are
/// found such that the energy of the step is least (elastic energy plus strength times flow), so that steps of any size end on the limits.

#include "core/model/support.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem
{
/// How the three deformations of a beam follow from its six displacements: rows of elongation, rotation of its first end, of its second end against the chord.
struct BeamShape
{
    double row[3][6];

    explicit BeamShape(const LinerSegment& s)
    {
        const double c = s.along.x(), n = s.along.y(), l = 1.0 / s.length;
        const double shape[3][6] = {
            {-c, -n, 0.0, c, n, 0.0}, {-n * l, c * l, 1.0, n * l, -c * l, 0.0}, {-n * l, c * l, 0.0, n * l, -c * l, 1.0}};
        std::copy(&shape[0][0], &shape[0][0] + 18, &row[0][0]);
    }
    [[nodiscard]] double of(int which, const double* first, const double* second) const
    {
        double sum = 0.0;
        for (int d = 0; d < 3; ++d)
            sum += row[which][d] * first[d] + row[which][3 + d] * second[d];
        return sum;
    }
};

struct BeamLaw
{
    double axial = 0.0;    ///< E A / L [N/m]
    double bending = 0.0;  ///< E I / L [N m]
    double compressive_strength = 0.0, tensile_strength = 0.0, moment_strength = 0.0;
};

/// Forces and tangents of a beam at a deformation.
struct BeamAnswer
{
    double thrust = 0.0;              ///< N, tension positive [N]
    std::array<double, 2> moment{};   ///< [N m]
    double stretched = 0.0;           ///< elongation that flows in this step [m]
    std::array<double, 2> turned{};   ///< rotations that flow [rad]
    double axial = 0.0;               ///< dN / de [N/m]
    std::array<double, 3> bending{};  ///< dM_1 / dphi_1, dM_1 / dphi_2, dM_2 / dphi_2 [N m]
    double stored = 0.0;              ///< [J]
    double spent = 0.0;               ///< in this step [J]
    unsigned flows = 0;               ///< which of the three are at their strength
};

namespace beam
{
inline constexpr double soft = 1e-8;  // of the elastic stiffness, where the tangent is zero

/// Moments that stay within the strength, and what flows.
inline void bend(const BeamLaw& law, const std::array<double, 2>& phi, BeamAnswer& answer)
{
    const double k = law.bending, limit = law.moment_strength;
    const std::array<double, 2> tried = {k * (4.0 * phi[0] + 2.0 * phi[1]), k * (2.0 * phi[0] + 4.0 * phi[1])};
    std::array<double, 2> m = tried;
    std::array<bool, 2> flows = {false, false};
    // The end that is farther beyond its strength flows first; that gives half of it to the other one.
    const int first = std::abs(tried[0]) >= std::abs(tried[1]) ? 0 : 1, second = 1 - first;
    if (std::abs(tried[first]) > limit)
    {
        flows[first] = true;
        m[first] = std::copysign(limit, tried[first]);
        m[second] = tried[second] - 0.5 * (tried[first] - m[first]);
        if (std::abs(m[second]) > limit)
        {
            flows[second] = true;
            m[second] = std::copysign(limit, m[second]);
        }
    }
    // Inverse of the elastic stiffness: what the moments do not bear has flowed.
    const std::array<double, 2> lost = {tried[0] - m[0], tried[1] - m[1]};
    answer.moment = m;
    answer.turned = {(2.0 * lost[0] - lost[1]) / (6.0 * k), (2.0 * lost[1] - lost[0]) / (6.0 * k)};
    for (int end = 0; end < 2; ++end)
        answer.turned[end] = flows[end] ? answer.turned[end] : 0.0;
    answer.bending = {4.0 * k, 2.0 * k, 4.0 * k};
    if (flows[0] && flows[1])
        answer.bending = {soft * k, 0.0, soft * k};
    else if (flows[first])
        answer.bending = first == 0 ? std::array{soft * k, 0.0, 3.0 * k} : std::array{3.0 * k, 0.0, soft * k};
    answer.stored += (m[0] * m[0] - m[0] * m[1] + m[1] * m[1]) / (6.0 * k);
    for (int end = 0; end < 2; ++end)
        answer.spent += std::abs(answer.turned[end]) > 0.0 ? m[end] * answer.turned[end] : 0.0;
    answer.flows |= (flows[0] ? 2U : 0U) | (flows[1] ? 4U : 0U);
}
}  // namespace beam

/// @param elongation  e - e_p with e_p of the last cycle [m]
/// @param phi         likewise [rad]
[[nodiscard]] inline BeamAnswer answer_of_beam(const BeamLaw& law, double elongation, const std::array<double, 2>& phi)
{
    BeamAnswer answer;
    const double tried = law.axial * elongation;
    answer.thrust = std::clamp(tried, -law.compressive_strength, law.tensile_strength);
    const bool flows = answer.thrust != tried;
    answer.stretched = flows ? (tried - answer.thrust) / law.axial : 0.0;
    answer.axial = flows ? beam::soft * law.axial : law.axial;
    answer.stored = 0.5 * answer.thrust * answer.thrust / law.axial;
    answer.spent = flows ? answer.thrust * answer.stretched : 0.0;
    answer.flows = flows ? 1U : 0U;
    beam::bend(law, phi, answer);
    return answer;
}
}  // namespace hdem
