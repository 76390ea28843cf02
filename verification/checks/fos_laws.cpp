/// Strength reduction of all joint laws, on a slab on a slope of 30 degrees.

#include "verification/checks/checks.h"
#include "verification/checks/fos_answer.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr double degree = std::numbers::pi / 180.0;

double tan_deg(double degrees)
{
    return std::tan(degrees * degree);
}

Overrides law(const std::string& keys)
{
    return {{"joint.default", "{normal_stiffness = 1e10, shear_stiffness = 1e9, " + keys + "}"}};
}

/// With the numbers of check_laws [Pa].
double saeb_amadei_peak(double sigma)
{
    const double x = sigma / 5e7, whole = std::pow(1.0 - x, 1.5);
    const double roughness = std::atan(std::pow(1.0 - x, 4.0) * tan_deg(10.0));
    return sigma * std::tan(30.0 * degree + roughness) * whole + (1.0 - whole) * (5e6 + sigma * tan_deg(40.0));
}
}  // namespace

void check_laws(Report& report)
{
    const double sigma = 2700.0 * 9.81 * std::cos(std::numbers::pi / 6.0), slope = tan_deg(30.0);
    const double i = 8.0 * std::log10(50e6 / sigma);
    const struct
    {
        const char* name;
        Overrides overrides;
        double factor, bar;
    } laws[] = {{"coulomb", {}, tan_deg(40.0) / slope, 0.01},
                {"patton",
                 law("law = \"patton\", friction_angle_deg = 30.0, asperity_angle_deg = 10.0, residual_friction_angle_deg = 33.0, "
                     "cohesion = 1e6"),
                 tan_deg(40.0) / slope, 0.01},
                {"plesha", law("law = \"plesha\", friction_angle_deg = 30.0, asperity_angle_deg = 10.0, wear = 1e-7"),
                 tan_deg(40.0) / slope, 0.01},
                {"slip_weakening",
                 law("law = \"slip_weakening\", friction_angle_deg = 40.0, residual_friction_angle_deg = 25.0, wear_length = 0.1"),
                 tan_deg(40.0) / slope, 0.01},
                {"saeb_amadei",
                 law("law = \"saeb_amadei\", friction_angle_deg = 30.0, asperity_angle_deg = 10.0, transition_stress = 5e7, "
                     "rock_cohesion = 5e6, rock_friction_angle_deg = 40.0, greatest_closure = 3e-4"),
                 saeb_amadei_peak(sigma) / sigma / slope, 0.01},
                {"barton_bandis",
                 law("law = \"barton_bandis\", jrc = 8.0, jcs = 5e7, residual_friction_angle_deg = 28.0, length = 0.1"),
                 tan_deg(28.0 + i) / slope, 0.01}};
    for (const auto& l : laws)
    {
        const FosAnswer a = find_factor("slab.toml", l.overrides);
        report.require({fmt::format("{}: F", l.name), "peak strength / tan 30°", l.factor, a.value()}, relative(l.bar));
    }
    const FosAnswer yielding = find_factor("slab.toml", law("law = \"continuously_yielding\", friction_angle_deg = 32.0, "
                                                            "mobilised_angle_deg = 42.0, wear_length = 1e-2"));
    report.require({"continuously_yielding: F", "tan φ / tan 30°", tan_deg(32.0) / slope, yielding.value()}, at_least());
    report.require({"continuously_yielding: F", "tan φ_m0 / tan 30°", tan_deg(42.0) / slope, yielding.value()}, at_most());
    const FosAnswer brittle = find_factor("slab.toml", law("friction_angle_deg = 35.0, cohesion = 5e3, residual_cohesion = 0.0"));
    const double weak = tan_deg(35.0) / slope, strong = weak + 5e3 / (2700.0 * 9.81 * 0.5);
    report.require({"coulomb that loses its cohesion: F", "with residual strength alone", weak - 0.01, brittle.value()},
                   at_least());
    report.require({"coulomb that loses its cohesion: F, peak strength throughout", "(c + σ tan φ)/τ", strong, brittle.peak()},
                   relative(0.01));
    report.require({"coulomb that loses its cohesion: F", "below that of its peak", strong, brittle.value()}, at_most());
}
}  // namespace hdem::verification
