/// Linings.

#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"
#include "verification/checks/same_bits.h"
#include "verification/checks/turned_case.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace hdem::verification
{
namespace
{
CaseRun run_turned(Report& report, const std::string& file, const char* method, double angle)
{
    return CaseRun(report, file, turned_case(file, {set("contact.method", std::string(method))}, angle * std::numbers::pi / 180.0));
}

void check_beam(Report& report)
{
    const double thickness = 0.15, modulus = 25e9, foundation = 2e8, force = 1e5;
    const double bending = modulus * std::pow(thickness, 3) / 12.0, beta = std::pow(foundation / (4.0 * bending), 0.25);
    for (const auto& [method, angle] : methods_and_angles())
    {
        const CaseRun run = run_turned(report, "support/beam.toml", method, angle);
        const std::string turn = fmt::format("{}, turned {:g}°: ", method, angle);
        report.require({turn + "displacement under the force [mm]", "P β / 2 k", 1e3 * force * beta / (2.0 * foundation),
                        1e3 * run.column("beam.liner_displacement").back()},
                       relative(1e-2));
        report.require({turn + "moment under the force [N m]", "P / 4 β", force / (4.0 * beta), run.column("beam.moment").back()},
                       relative(1e-2));
    }
    require_same_bits(report, "support/beam.toml");
}

/// Pressure in each sample at which there are so many hinges for the first time.
double pressure_at(const CaseRun& run, double hinges)
{
    const std::vector<double> count = run.column("beam.hinges");
    const auto first = std::ranges::find_if(count, [&](double n) { return n >= hinges; });
    return first == count.end() ? std::nan("")
                                : 60e3 * 10.0 * static_cast<double>(first - count.begin()) / 30000.0;  // a sample each ten cycles
}

void check_collapse(Report& report)
{
    const double strength = 11250.0, length = 2.0;
    for (const auto& [method, angle] : methods_and_angles())
    {
        const CaseRun run = run_turned(report, "support/fixed_beam.toml", method, angle);
        const std::string turn = fmt::format("{}, turned {:g}°: ", method, angle);
        report.require(
            {turn + "load at the first hinges [N/m]", "12 M_p / L²", 12.0 * strength / (length * length), pressure_at(run, 2.0)},
            relative(2e-2));
        report.require({turn + "load at collapse [N/m]", "16 M_p / L²", 16.0 * strength / (length * length), pressure_at(run, 3.0)},
                       relative(2e-2));
        const CaseRun ring = run_turned(report, "support/ring.toml", method, angle);
        report.require({turn + "thrust of the ring [kN]", "p R", 600.0, 1e-3 * ring.column("ring.thrust").back()}, relative(5e-3));
        report.require(
            {turn + "displacement of the ring [mm]", "p R² / E t", 0.48, 1e3 * ring.column("ring.liner_displacement").back()},
            relative(5e-3));
    }
    require_same_bits(report, "support/fixed_beam.toml", {}, std::array{"force"});  // 30 000 cycles
    require_same_bits(report, "support/ring.toml");
}
}  // namespace

std::vector<Check> liner_checks()
{
    return {{"support.B7", "Beam on an elastic foundation", check_beam},
            {"support.B8", "Collapse of a beam between two walls; ring under a pressure", check_collapse}};
}
}  // namespace hdem::verification
