/// Strength reduction of all joint laws, on a slab on a slope of 30 degrees.

#include "verification/checks/checks.h"
#include "verification/checks/fos_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

/// The slab on a Barton-Bandis joint as one mass on its slope. A joint bears its peak only once it has slipped by delta_p, and a trial sets the slab free where its own
/// stage has left it, at 0.4 delta_p. So it comes to the peak with a speed, and behind the peak strength falls: below the peak's factor it may run on.
///
///   d(v^2/2)/dx = f - alpha(v) |f|,  f = (D - S(x) / F) / m
///
/// x is the way from the unstressed joint, alpha the local damping of slow blocks: 0.8 up to 20 mm/s, 0 from 40 mm/s on.
class RoughSlab
{
  public:
    /// Greatest F with which it comes to rest.
    [[nodiscard]] double factor() const
    {
        const double begin = rests_at(0.0, 1.0);
        double low = 1.0, high = tan_deg(friction + roughness) / tan_deg(30.0);
        for (int k = 0; k < 20; ++k)
        {
            const double middle = 0.5 * (low + high);
            (rests_at(begin, middle) < beyond ? low : high) = middle;
        }
        return low;
    }

  private:
    static constexpr double friction = 28.0, beyond = 10.0;
    const double stress = 2700.0 * 9.81 * std::cos(30.0 * degree), driving = 2700.0 * 9.81 * 0.5;  ///< [Pa]
    const double roughness = 8.0 * std::log10(50e6 / stress);                                      ///< [deg]
    const double peak = 0.1 / 500.0 * std::pow(8.0 / 0.1, 0.33);                                   ///< delta_p [m]

    /// Barton, Bandis & Bakhtar (1985): share of the roughness that acts at x = delta / delta_p.
    static double mobilised(double x)
    {
        constexpr std::array<std::array<double, 2>, 6> points{
            {{0.3, 0.0}, {0.6, 0.75}, {1.0, 1.0}, {2.0, 0.85}, {4.0, 0.7}, {10.0, 0.5}}};
        for (std::size_t k = 1; k < points.size(); ++k)
            if (x < points[k][0])
                return std::lerp(points[k - 1][1], points[k][1],
                                 std::max(x - points[k - 1][0], 0.0) / (points[k][0] - points[k - 1][0]));
        return points.back()[1];
    }
    [[nodiscard]] double strength(double x) const
    {
        return stress * tan_deg(friction * std::min(x / 0.3, 1.0) + mobilised(x) * roughness);
    }
    /// Where it stops that is set free at rest at x; `beyond`: it does not. In delta_p.
    [[nodiscard]] double rests_at(double x, double factor) const
    {
        constexpr double step = 1e-4;
        double energy = 0.0;  ///< v^2/2
        for (; x < beyond; x += step)
        {
            const double force = (driving - strength(x) / factor) / 2700.0;
            if (energy <= 0.0 && force <= 0.0)
                return x;
            const double slow = std::max(std::min(2.0 - std::sqrt(2.0 * energy) / 0.02, 1.0), 0.0);
            energy = std::max(energy + (force - 0.8 * slow * std::abs(force)) * step * peak, 0.0);
        }
        return beyond;
    }
};

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
                {"saeb_amadei",
                 law("law = \"saeb_amadei\", friction_angle_deg = 30.0, asperity_angle_deg = 10.0, transition_stress = 5e7, "
                     "rock_cohesion = 5e6, rock_friction_angle_deg = 40.0, greatest_closure = 3e-4"),
                 saeb_amadei_peak(sigma) / sigma / slope, 0.01}};
    for (const auto& l : laws)
    {
        const FosAnswer a = find_factor("slab.toml", l.overrides);
        report.require({fmt::format("{}: F", l.name), "peak strength / tan 30°", l.factor, a.value()}, relative(l.bar));
    }
    const FosAnswer barton = find_factor("slab.toml", law("law = \"barton_bandis\", jrc = 8.0, jcs = 5e7, "
                                                          "residual_friction_angle_deg = 28.0, length = 0.1"));
    report.require({"barton_bandis: F", "peak strength / tan 30°", tan_deg(28.0 + i) / slope, barton.value()}, at_most());
    report.require({"barton_bandis: F", "energy of a slab that is set free before its peak", RoughSlab().factor(), barton.value()},
                   relative(0.02));
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
