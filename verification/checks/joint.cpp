/// Joint laws in the cycle: direct shear, and a block that hangs.

#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"
#include "verification/checks/joint_checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem::verification
{
namespace
{
constexpr double pressure = 1e6;  ///< of the box [Pa]

Overrides with_joint(const std::string& keys)
{
    return {{"joint.default", "{" + keys + "}"}};
}

const std::string barton = "law = \"barton_bandis\", normal_stiffness = 1e11, shear_stiffness = 1e9, jrc = 10.0, jcs = 1e8, "
                           "residual_friction_angle_deg = "
                           "30.0, length = 0.1, normal_stress = 2e6";
const std::string patton = "law = \"patton\", normal_stiffness = 1e10, shear_stiffness = 5e9, friction_angle_deg = 30.0, "
                           "asperity_angle_deg = 15.0, "
                           "residual_friction_angle_deg = 35.0, cohesion = 1e6";
const std::string yielding = "law = \"continuously_yielding\", normal_stiffness = 1e10, shear_stiffness = 1e9, friction_angle_deg "
                             "= 30.0, mobilised_angle_deg = "
                             "50.0, wear_length = 5e-4";

const std::string
    weakening = "law = \"slip_weakening\", normal_stiffness = 1e10, shear_stiffness = 5e9, friction_angle_deg = 35.0, "
                "residual_friction_angle_deg = 25.0, wear_length = 6e-3";

/// Mean over a stretch of way, in which the block trembles.
double mean_over(const CaseRun& run, const std::string& column, double from, double to)
{
    const std::vector<double>& way = run.column("block.displacement_x");
    const std::vector<double>& values = run.column(column);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < way.size(); ++i)
        if (way[i] >= from && way[i] <= to)
        {
            sum += std::abs(values[i]);
            ++count;
        }
    return count > 0.0 ? sum / count : std::nan("");
}

double stress_ratio(const CaseRun& run, double from, double to)
{
    return mean_over(run, "joint.shear_force", from, to) / mean_over(run, "joint.normal_force", from, to);
}

/// Opening since the block rested under its pressure [m].
double opening(const CaseRun& run, double from, double to, double stiffness)
{
    const std::vector<double>& way = run.column("block.displacement_x");
    const std::vector<double>& up = run.column("block.displacement_y");
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < way.size(); ++i)
        if (way[i] >= from && way[i] <= to)
        {
            sum += up[i];
            ++count;
        }
    return sum / count + pressure / stiffness;
}

void check_coulomb(Report& report)
{
    const CaseRun run(report, "joint/box.toml", {});
    const std::vector<double>& shear = run.column("joint.shear_force");
    double peak = 0.0;
    for (const double s : shear)
        peak = std::max(peak, std::abs(s));
    report.require({"peak shear stress [MPa]", "c + σ tan φ", 0.677350, 1e-6 * peak}, relative(2e-3));
    report.require({"shear over normal stress at 8 to 10 mm", "tan φ_r", 0.466308, stress_ratio(run, 8e-3, 10e-3)}, relative(1e-4));
    report.require({"opening at 8 to 10 mm [mm]", "u_lim tan ψ", 0.881635, 1e3 * opening(run, 8e-3, 10e-3, 1e10)}, relative(1e-3));
}

void check_barton(Report& report)
{
    const CaseRun run(report, "joint/box.toml", with_joint(barton));
    // L = L_0: JRC and JCS are as given, and δ_p = L/500 (JRC/L)^0.33.
    const double peak = 0.1 / 500.0 * std::pow(10.0 / 0.1, 0.33);
    constexpr std::array<std::array<double, 2>, 5> table{
        {{0.3, 0.57735}, {0.6, 1.0}, {1.0, 1.19175}, {2.0, 1.07237}, {4.0, 0.96569}}};
    for (const auto& [x, ratio] : table)
        report.require({fmt::format("shear over normal stress at {:g} δ_p", x), "σ tan(φ_r + m i)", ratio,
                        stress_ratio(run, 0.98 * x * peak, 1.02 * x * peak)},
                       relative(0.01));
}

void check_closure(Report& report)
{
    constexpr std::array<std::array<double, 2>, 3> table{{{1.0, 0.033744}, {5.0, 0.063935}, {10.0, 0.071986}}};
    for (const auto& [stress, closure] : table)
    {
        const CaseRun run(report, "joint/closure.toml", {set("load[0].force", Vec2(0.0, -1e6 * stress))});
        report.require({fmt::format("closure under {:g} MPa [mm]", stress), "σ V_m / (K_ni V_m + σ)", closure,
                        -1e3 * run.state().blocks.displacement(run.block("block")).y()},
                       relative(2e-4));
    }
}

void check_patton(Report& report)
{
    const CaseRun run(report, "joint/box.toml", with_joint(patton));
    report.require({"shear over normal stress at 1 to 3 mm", "tan(φ + i)", 1.0, stress_ratio(run, 1e-3, 3e-3)}, relative(5e-3));
}

void check_yielding(Report& report)
{
    const CaseRun run(report, "joint/box.toml", with_joint(yielding));
    report.require({"shear over normal stress at 5 mm", "Cundall & Hart", 0.578321, stress_ratio(run, 4.9e-3, 5.1e-3)},
                   relative(5e-3));
}

void check_weakening(Report& report)
{
    const CaseRun run(report, "joint/box.toml", with_joint(weakening));
    const auto friction = [](double slip)
    {
        const double residual = std::tan(radians(25.0)), lost = std::tan(radians(35.0)) - residual;
        return residual + lost * std::max(1.0 - slip / 6e-3, 0.0);
    };
    for (const double way : {1e-3, 3e-3, 5e-3, 8e-3})
    {
        double slip = way;  // the elastic part of the way is that of the strength
        for (int k = 0; k < 50; ++k)
            slip = way - friction(slip) * pressure / 5e9;
        report.require({fmt::format("shear over normal stress at {:g} mm", 1e3 * way), "tan φ_r + (tan φ − tan φ_r)(1 − P/D)",
                        friction(slip), stress_ratio(run, 0.98 * way, 1.02 * way)},
                       relative(2e-3));
    }
}

double fallen(Report& report, const std::string& method, double tension, double residual, double pull)
{
    const CaseRun run(report, "joint/hung.toml",
                      {set("contact.method", method), set("joint.default.tension", tension),
                       set("joint.default.residual_tension", residual), set("load[0].force", Vec2(0.0, -pull))});
    return run.state().blocks.displacement(run.block("block")).norm();
}

void check_hung(Report& report)
{
    for (const std::string method : {"force", "hybrid", "impulse"})
    {
        const auto moved = [&](const std::string& what) { return fmt::format("{}: {}: moved [m]", method, what); };
        const auto way = [&](double tension, double residual, double pull)
        { return fallen(report, method, tension, residual, pull); };
        report.require({moved("T 50 kPa, weight 26.487 kPa"), "holds", 1e-9, way(50e3, 0.0, 0.0)}, at_most());
        report.require({moved("T 26.9 kPa"), "holds", 1e-9, way(26.9e3, 0.0, 0.0)}, at_most());
        report.require({moved("T 26 kPa"), "falls", 0.5, way(26e3, 0.0, 0.0)}, at_least());
        report.require({moved("T 50 kPa, T_r 20 kPa, after a pull of 30 kN"), "falls", 0.5, way(50e3, 20e3, 30e3)}, at_least());
        report.require({moved("T 50 kPa, T_r 30 kPa, after a pull of 30 kN"), "held by T_r", 0.1, way(50e3, 30e3, 30e3)},
                       at_most());
    }
}
}  // namespace

std::vector<Check> joint_checks()
{
    return {
        {"joint.J1", "Coulomb with residual values and dilation in direct shear", check_coulomb},
        {"joint.J2", "The same in rock that gives way: constant normal stiffness", check_normal_stiffness},
        {"joint.J3", "Tension: a block hung from a roof", check_hung},
        {"joint.J4", "Barton-Bandis in direct shear", check_barton},
        {"joint.J5", "Barton-Bandis: scaled roughness, wall strength and peak displacement", check_scale},
        {"joint.J6", "Closure by Bandis under a load", check_closure},
        {"joint.J7", "Patton in direct shear", check_patton},
        {"joint.J8", "Continuously yielding in direct shear", check_yielding},
        {"joint.J9", "Plesha in direct shear there and back", check_plesha},
        {"joint.J10", "Saeb-Amadei in direct shear: strength and opening", check_saeb},
        {"joint.weakening", "Slip weakening in direct shear", check_weakening},
        {"joint.laws", "Each law by itself: J1 to J10, ten cycles of ±5 mm, four lanes against one", check_joint_laws},
        {"joint.contacts", "Each law on 1, 2 and 16 contacts, and its energy over ten cycles of ±5 mm", check_contacts},
        {"joint.fall", "A slab with cohesion that falls on rock of the same joint does not stick", check_fall},
        {"joint.bits", "Each law on 1, 2, 3 and 8 threads and after a restart: the same bits", check_bits, Check::Length::is_long}};
}
}  // namespace hdem::verification
