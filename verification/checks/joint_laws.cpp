/// Joint laws by themselves: one point, driven step by step, without blocks or cycles. So nothing trembles, and the bars are those of the digits.

#include "core/joint/barton_bandis.h"
#include "core/joint/continuously_yielding.h"
#include "core/joint/coulomb_residual.h"
#include "core/joint/patton.h"
#include "core/joint/plesha.h"
#include "core/joint/saeb_amadei.h"
#include "core/joint/slip_weakening.h"
#include "verification/checks/joint_checks.h"
#include "verification/scenes/law_point.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace hdem::verification
{
namespace
{
constexpr double mega = 1e6, milli = 1e-3;

JointNumbers coulomb_numbers(double dilation = 10.0)
{
    return CoulombResidual::numbers({.shear_stiffness = 1e9,
                                     .friction_angle = 30.0,
                                     .residual_friction = 25.0,
                                     .cohesion = 1e5,
                                     .dilation_angle = dilation,
                                     .dilation_limit = 5e-3},
                                    Linear::numbers(1e10));
}

/// JRC and JCS are those of the joint's length, as J4 has them.
JointNumbers barton_numbers()
{
    JointNumbers n = BartonBandis::numbers(
        {.roughness = 10.0, .wall_strength = 1e8, .residual_friction = 30.0, .length = 1.0, .normal_stress = 1e6},
        Hyperbolic::numbers(1.749286e10, 0.08236e-3));
    n[BartonBandis::roughness] = radians(10.0) / std::log(10.0);
    n[BartonBandis::log_strength] = std::log(1e8);
    n[BartonBandis::peak_displacement] = 1.0 / 500.0 * std::pow(10.0, 0.33);
    n[BartonBandis::shear_stiffness] = BartonBandis::steepest(n, 1e6);
    return BartonBandis::with_inverses(n);
}

JointNumbers patton_numbers()
{
    return Patton::numbers(
        {.shear_stiffness = 1e9, .friction = 30.0, .roughness = 15.0, .residual_friction = 35.0, .cohesion = 1e6},
        Linear::numbers(1e9));
}

JointNumbers yielding_numbers()
{
    return ContinuouslyYielding::numbers(
        {.shear_stiffness = 1e9, .greatest_stiffness = 1e11, .friction = 30.0, .first_friction = 50.0, .roughness = 0.5e-3},
        Linear::numbers(1e10));
}

JointNumbers plesha_numbers(double stiffness)
{
    return Plesha::numbers({.shear_stiffness = stiffness, .friction = 30.0, .roughness = 15.0, .wear = 2e-5}, Linear::numbers(1e9));
}

JointNumbers saeb_numbers(double stiffness)
{
    return SaebAmadei::numbers({.shear_stiffness = stiffness,
                                .rock_strength = 50e6,
                                .friction = 30.0,
                                .roughness = 15.0,
                                .rock_cohesion = 5e6,
                                .rock_friction = 40.0,
                                .residual_slip = 1e-2,
                                .residual_share = 1.0},
                               Hyperbolic::numbers(1e10, 0.3e-3));
}

void check_coulomb_law(Report& report)
{
    LawPoint<CoulombResidual, Linear> p(coulomb_numbers(), mega);
    const double peak = 1e5 + mega * std::tan(radians(30.0));
    p.go(peak / 1e9 * (1.0 - 2e-7), 100, mega);
    report.require({"J1: peak [MPa]", "c + σ tan φ", 0.677350, p.now.shear / mega}, relative(1e-6));
    report.require({"J1: broken just before it", "intact", 0.0, p.memory.broken}, absolute(0.0));
    p.go(peak / 1e9 * (1.0 + 2e-7), 1, mega);
    report.require({"J1: shear stress just after it [MPa]", "σ tan φ_r", 0.466308, p.now.shear / mega}, relative(1e-6));
    p.go(1e-2, 1000, mega);
    report.require({"J1: shear stress at 10 mm [MPa]", "σ tan φ_r", 0.466308, p.now.shear / mega}, relative(1e-6));
    report.require({"J1: opening at 10 mm [mm]", "u_lim tan ψ", 0.881635, p.now.opening / milli}, relative(1e-6));
    LawPoint<CoulombResidual, Linear> flat(coulomb_numbers(0.0), mega);
    flat.go(1e-3, 100, mega);
    report.require({"J1: energy freed by the drop [J/m2]", "(τ_p² − τ_r²) / 2 K_S", 120.680, flat.freed}, relative(5e-6));

    LawPoint<CoulombResidual, Linear> stiff(coulomb_numbers(), mega);
    const double from = stiff.closure;
    stiff.go(3e-3, 1000, mega, 5e9, from);
    report.require({"J2: slip at 3 mm [mm]", "K_e = K_N K / (K_N + K)", 1.988652, stiff.memory.slip / milli}, relative(1e-6));
    report.require({"J2: normal stress at 3 mm [MPa]", "", 2.168843, stiff.now.normal / mega}, relative(1e-6));
    stiff.go(1e-2, 1000, mega, 5e9, from);
    report.require({"J2: shear stress beyond the limit [MPa]", "σ tan φ_r", 1.836685, stiff.now.shear / mega}, relative(1e-6));
}

void check_barton_law(Report& report)
{
    const JointNumbers n = barton_numbers();
    const double peak = n[BartonBandis::peak_displacement];
    report.require({"J4: δ_p [mm]", "L/500 (JRC/L)^0.33", 4.275924, peak / milli}, relative(1e-6));
    LawPoint<BartonBandis, Hyperbolic> p(n, mega);
    constexpr std::array<std::array<double, 2>, 7> table{
        {{0.15, 0.26795}, {0.3, 0.57735}, {0.6, 1.0}, {1.0, 1.19175}, {2.0, 1.07237}, {4.0, 0.96569}, {10.0, 0.83910}}};
    for (const auto& [x, stress] : table)
    {
        p.go(x * peak, 120'000, mega);
        report.require({fmt::format("J4: shear stress at {:g} δ_p [MPa]", x), "σ tan(φ_r + m i)", stress, p.now.shear / mega},
                       relative(1e-4));
        if (x == 1.0 || x == 4.0)
            report.require({fmt::format("J4: opening at {:g} δ_p [mm]", x), "∫ tan(m i / M) du", x == 1.0 ? 0.347492 : 2.207835,
                            p.now.opening / milli},
                           relative(1e-4));
    }
    const JointNumbers scaled = BartonBandis::numbers(
        {.roughness = 10.0, .wall_strength = 1e8, .residual_friction = 30.0, .length = 2.0, .normal_stress = 1e6},
        Hyperbolic::numbers(1e10, 1e-4));
    report.require({"J5: JRC_n", "JRC_0 (L/L_0)^(−0.02 JRC_0)", 5.492803, scaled[BartonBandis::scaled_roughness]}, relative(1e-6));
    report.require(
        {"J5: JCS_n [MPa]", "JCS_0 (L/L_0)^(−0.03 JRC_0)", 40.70905, std::exp(scaled[BartonBandis::log_strength]) / mega},
        relative(1e-6));
    report.require({"J5: δ_p [mm]", "L/500 (JRC_n/L)^0.33", 5.582801, scaled[BartonBandis::peak_displacement] / milli},
                   relative(1e-6));

    const BandisClosure bandis = bandis_closure(10.0, 1e8, 1.2e8, 3);
    report.require({"J6: K_ni [MPa/mm]", "Bandis (1983)", 17.49286, bandis.stiffness / 1e9}, relative(1e-5));
    const double stiffness = 1e9 * (-7.15 + 17.5 + 0.02 * 100.0 / 0.28);
    const double greatest = 1e-3 * (-0.1032 - 0.074 + 1.1350 * std::pow(100.0 / 0.28, -0.2510));
    const JointNumbers closure = Hyperbolic::numbers(bandis.stiffness, bandis.greatest);
    for (const double stress : {1e6, 5e6, 1e7})
    {
        const double v = Hyperbolic::closure_under(closure, stress), x = stress / (stiffness * greatest + stress);
        const std::string under = fmt::format(" under {:g} MPa ", stress / mega);
        report.require({"J6: closure" + under + "[mm]", "σ V_m / (K_ni V_m + σ)", x * greatest / milli, v / milli}, relative(1e-5));
        report.require({"J6: stiffness" + under + "[MPa/mm]", "K_ni (1 + σ / (K_ni V_m))²",
                        stiffness / 1e9 * (1.0 + stress / (stiffness * greatest)) * (1.0 + stress / (stiffness * greatest)),
                        Hyperbolic::at(closure, v).stiffness / 1e9},
                       relative(1e-5));
        report.require({"J6: energy" + under + "[J/m2]", "K_ni V_m² (−x − ln(1 − x)), x = V / V_m",
                        stiffness * greatest * greatest * (-x - std::log1p(-x)), Hyperbolic::at(closure, v).energy},
                       relative(1e-5));
    }
}

void check_slopes(Report& report)
{
    const JointNumbers n = patton_numbers();
    report.require(
        {"J7: σ_T [MPa]", "c_x / (tan(φ + i) − tan φ_r)", 1.0 / (1.0 - std::tan(radians(35.0))), n[Patton::change_stress] / mega},
        relative(1e-9));
    LawPoint<Patton, Linear> low(n, mega), high(n, 5.0 * mega);
    low.go(2e-3, 200, mega);
    high.go(6e-3, 200, 5.0 * mega);
    report.require({"J7: shear stress under 1 MPa [MPa]", "σ tan(φ + i)", 1.0, low.now.shear / mega}, relative(1e-9));
    report.require(
        {"J7: shear stress under 5 MPa [MPa]", "c_x + σ tan φ_r", 1.0 + 5.0 * std::tan(radians(35.0)), high.now.shear / mega},
        relative(1e-9));

    LawPoint<ContinuouslyYielding, Linear> yielding(yielding_numbers(), mega);
    double peak = 0.0, at = 0.0;
    constexpr std::array<std::array<double, 2>, 3> ways{{{1.0, 0.617209}, {5.0, 0.578321}, {20.0, 0.577350}}};
    for (const auto& [to, stress] : ways)
    {
        while (yielding.u < to * milli - 1e-9)
        {
            yielding.go(yielding.u + 1e-6, 1, mega);
            if (yielding.now.shear > peak)
                peak = yielding.now.shear, at = yielding.u;
        }
        report.require(
            {fmt::format("J8: shear stress at {:g} mm [MPa]", to), "Cundall & Hart (1984)", stress, yielding.now.shear / mega},
            relative(1e-3));
    }
    report.require({"J8: peak [MPa]", "Cundall & Hart (1984)", 0.670104, peak / mega}, relative(1e-3));
    report.require({"J8: way to the peak [mm]", "Cundall & Hart (1984)", 1.497, at / milli}, relative(2e-3));

    LawPoint<Plesha, Linear> plesha(plesha_numbers(1e13), mega);
    constexpr std::array<std::array<double, 4>, 3> turns{
        {{10.0, 0.912963, 9538.1, 2.42641}, {1e-6, -0.332360, 12786.6, 0.30011}, {-10.0, -0.832622, 21377.8, 2.18297}}};
    for (const auto& [to, stress, work, opening] : turns)
    {
        plesha.go(to * milli, 20'000, mega);
        const std::string where = fmt::format("J9: at {:.0f} mm, ", to);
        report.require({where + "shear stress [MPa]", "σ tan(φ ± α)", stress, plesha.now.shear / mega}, relative(1e-3));
        report.require({where + "work of slip [J/m2]", "∫ τ du_p", work, plesha.memory.state}, relative(1e-3));
        report.require({where + "opening [mm]", "∫ tan(±α) du_p", opening, plesha.now.opening / milli}, relative(1e-3));
    }

    constexpr std::array<std::array<double, 3>, 4> loads{{{0.5, 0.56397433, 1.24409748},
                                                          {1.0, 1.10731493, 1.16073902},
                                                          {5.0, 4.92271678, 0.69150733},
                                                          {10.0, 9.05829488, 0.31799072}}};
    for (const auto& [normal, stress, opening] : loads)
    {
        LawPoint<SaebAmadei, Hyperbolic> p(saeb_numbers(1e9), normal * mega);
        p.go(5e-3 + stress * mega / 1e9, 20'000, normal * mega);
        report.require(
            {fmt::format("J10: shear stress under {:g} MPa [MPa]", normal), "Saeb & Amadei (1992)", stress, p.now.shear / mega},
            relative(1e-6));
        report.require({fmt::format("J10: opening at 5 mm of slip under {:g} MPa [mm]", normal), "Saeb & Amadei (1992)", opening,
                        -p.closure / milli},
                       relative(1e-6));
    }
}

/// Ten cycles of +-5 mm under constant stress and behind a spring, and four lanes against one.
template <typename Law, typename Curve>
void check_energy_and_lanes(Report& report, const std::string& name, const JointNumbers& n, const JointNumbers& other,
                            double spring, double closure, int steps)
{
    for (const double stiffness : {0.0, spring})
    {
        const ReversalEnergy energy = ten_reversals<Law, Curve>(n, mega, stiffness, steps);
        report.require({fmt::format("{}: energy not explained over ten cycles of ±5 mm, {}", name,
                                    stiffness == 0.0 ? "constant stress" : "behind a spring"),
                        "work = stored + heat + freed", 1e-6, std::abs(energy.unexplained()) / energy.greatest_work},
                       at_most());
    }
    const int differs = first_difference_of_lanes<Law, Curve>({n, other, n, other}, closure);
    report.require({name + ": cycle in which four lanes differ from one (-1: none of 2000)", "the same bits", -1.0, 1.0 * differs},
                   absolute(0.0));
}
}  // namespace

void check_joint_laws(Report& report)
{
    check_coulomb_law(report);
    check_barton_law(report);
    check_slopes(report);
    check_energy_and_lanes<CoulombResidual, Linear>(report, "coulomb", coulomb_numbers(), coulomb_numbers(0.0), 5e9, 2e-4, 2000);
    check_energy_and_lanes<BartonBandis, Hyperbolic>(report, "barton_bandis", barton_numbers(), barton_numbers(), 5e9, 0.6e-4,
                                                     20'000);
    check_energy_and_lanes<Patton, Linear>(report, "patton", patton_numbers(), patton_numbers(), 5e8, 2.5e-3, 2000);
    check_energy_and_lanes<ContinuouslyYielding, Linear>(report, "continuously_yielding", yielding_numbers(), yielding_numbers(),
                                                         5e9, 2e-4, 5000);
    check_energy_and_lanes<Plesha, Linear>(report, "plesha", plesha_numbers(1e9), plesha_numbers(3e9), 5e8, 1e-3, 5000);
    const JointNumbers weakening = SlipWeakening::numbers(
        {.shear_stiffness = 5e9, .friction = 35.0, .residual_friction = 25.0, .weakening_length = 2e-2}, Linear::numbers(1e10));
    check_energy_and_lanes<SlipWeakening, Linear>(report, "slip_weakening", weakening, weakening, 5e8, 2.5e-4, 2000);
    check_energy_and_lanes<SaebAmadei, Hyperbolic>(report, "saeb_amadei", saeb_numbers(1e10), saeb_numbers(3e10), 1e9, 2e-4,
                                                   20'000);
}
}  // namespace hdem::verification
