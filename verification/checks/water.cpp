/// Water in the joints and around the rock.

#include "core/contact/contact_report.h"
#include "core/stress/insitu_stress.h"
#include "core/water/pore_pressure.h"
#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"
#include "verification/checks/same_bits.h"
#include "verification/checks/turned_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr std::array<double, 2> angles{0.0, 23.0};  ///< [deg]

double radians_of(double degrees)
{
    return degrees * std::numbers::pi / 180.0;
}

/// A level everywhere is no line that turns: with one the model's origin stays at its height.
void check_block(Report& report)
{
    for (const double angle : angles)
    {
        const CaseRun run("water/block.toml", turned_case("water/block.toml", {}, radians_of(angle)));
        const Triple& on = run.state().water[run.block("block")];
        const Vec2 up = -run.model().gravity.normalized(), force(on.x, on.y);
        const std::string turn = fmt::format("turned {:g}°: ", angle);
        report.require({turn + "net force upwards [kN]", "ρ_w g A", 39.24, 1e-3 * force.dot(up)}, relative(1e-9));
        report.require({turn + "force across [kN]", "0", 1e-9, 1e-3 * std::abs(cross(up, force))}, at_most());
        report.require({turn + "moment [kN m]", "0", 1e-9, 1e-3 * std::abs(on.w)}, at_most());
    }
    const CaseRun run("water/block.toml", {});
    const auto side = [&](const Vec2& from, const Vec2& to)
    {
        const PressureSum p = pressure_along(run.model().water, 0, from - run.model().origin, to - run.model().origin);
        const double second = p.moment / (to - from).norm();
        return std::array<double, 2>{1e-3 * (p.force - second), 1e-3 * second};
    };
    const std::array<double, 2> wall = side({0.0, 2.0}, {0.0, 0.0}), top = side({0.0, 2.0}, {2.0, 2.0}),
                                bottom = side({0.0, 0.0}, {2.0, 0.0});
    report.require({"side, upper end [kN]", "L (2 p_1 + p_2) / 6", 35.97, wall[0]}, relative(1e-9));
    report.require({"side, lower end [kN]", "L (p_1 + 2 p_2) / 6", 42.51, wall[1]}, relative(1e-9));
    report.require({"top [kN]", "p L", 58.86, top[0] + top[1]}, relative(1e-9));
    report.require({"bottom [kN]", "p L", 98.10, bottom[0] + bottom[1]}, relative(1e-9));
    require_same_bits(report, "water/block.toml", {set("stage[0].cycles", 600.0)});
}

/// Effective normal force on the base, shear force, and distance of the resultant from the toe.
struct BaseForces
{
    double normal = 0.0, shear = 0.0, from_toe = 0.0;
};

BaseForces base_forces(const CaseRun& run, const Vec2& toe)
{
    BaseForces sums;
    for (Index i = 0; i < run.state().contacts.size(); ++i)
    {
        const ContactReport base = report_contact(run.state(), i);
        for (int k = 0; k < 2; ++k)
        {
            const double normal = run.state().contacts.normal_force(k, i);
            sums.normal += normal;
            sums.from_toe += normal * (base.point[k] + run.model().origin - toe).norm();
        }
        sums.shear += std::abs(base.shear_force);
    }
    sums.from_toe /= sums.normal;
    return sums;
}

void check_dam(Report& report)
{
    for (const double degrees : angles)
    {
        const double angle = radians_of(degrees);
        for (const char* method : {"force", "hybrid"})
        {
            const CaseRun run(report, "water/dam.toml",
                              turned_case("water/dam.toml", {set("contact.method", std::string(method))}, angle));
            const Vec2 toe(10.0 * std::cos(angle), 10.0 * std::sin(angle));
            const BaseForces base = base_forces(run, toe);
            const std::string turn = fmt::format("turned {:g}°, {}: ", degrees, method);
            report.require({turn + "effective normal force [kN]", "W - U", 2389.5, 1e-3 * base.normal}, relative(5e-3));
            report.require({turn + "N tan φ over the shear force", "factor of safety", 4.08772,
                            base.normal * std::tan(radians_of(40.0)) / base.shear},
                           relative(5e-3));
            report.require({turn + "resultant from the toe [m]", "moments", 3.97363, base.from_toe}, relative(5e-3));
        }
    }
    require_same_bits(report, "water/dam.toml");
}

void check_slope(Report& report)
{
    const double steepness = std::tan(radians_of(20.0));
    for (const char* water : {"{level = -50.0}", "{level = 50.0}"})
        for (const auto& [how, angle] : methods_and_angles())
        {
            const std::string method = how;
            const double turn = radians_of(angle);
            const auto speed = [&](double factor)
            {
                const double friction = std::atan(steepness * factor) / std::numbers::pi * 180.0;
                const Overrides given{
                    {"water", water}, set("contact.method", method), set("joint.default.friction_angle_deg", friction)};
                const CaseRun run(report, "water/slope.toml", turned_case("water/slope.toml", given, turn));
                return run.state().blocks.velocity(run.block("block")).norm();
            };
            const std::string name = fmt::format("water {}, {}, turned {:g}°: ", water, method, angle);
            report.require({name + "speed with tan φ 0.1 % above tan 20° [m/s]", "holds", 1e-9, speed(1.001)}, at_most());
            report.require({name + "speed with tan φ 0.1 % below [m/s]", "slides", 1e-4, speed(0.999)}, at_least());
        }
    require_same_bits(report, "water/slope.toml", {{"water", "{level = 50.0}"}});
}

void check_effective_stress(Report& report)
{
    // 2.5 MPa everywhere, by light water that stands high.
    const Overrides stressed{{"insitu", "{stress = [-5e6, -10e6, 0.0]}"},
                             set("gravity.vector", Vec2(0.0, -9.81)),
                             {"water", fmt::format("{{level = {}, density = 0.01}}", 2.5e6 / (0.01 * 9.81))},
                             set("joint.default.friction_angle_deg", 30.0)};
    for (const double angle : angles)
    {
        const CaseRun run("insitu/rock.toml", turned_case("insitu/rock.toml", stressed, radians_of(angle)));
        const InsituSummary summary = summarise_insitu(run.model(), run.state());
        const auto set = std::ranges::find(summary.sets, std::string("b"), &StressedSet::name);
        report.require({fmt::format("dip 60°, turned {:g}°: τ over (σ_n - p) tan φ", angle), "6.25, 2.165064, p = 2.5 MPa", 1.0,
                        set->most_used},
                       relative(1e-3));
    }
    require_same_bits(report, "insitu/rock.toml", stressed);
}

void check_ground(Report& report)
{
    for (const char* method : all_methods)
    {
        const CaseRun run(report, "insitu/rock.toml",
                          {{"insitu", "{surface = 0.0, ratio = 1.5}"},
                           set("gravity.vector", Vec2(0.0, -9.81)),
                           {"water", "{table = [[-300.0, -80.0], [-2.0, -96.0], [3.0, -99.0], [300.0, -110.0]]}"},
                           set("contact.method", std::string(method))});
        double greatest = 0.0;
        for (Index b = 0; b < run.model().blocks(); ++b)
            greatest = std::max(greatest, run.state().blocks.displacement(b).norm());
        report.require(
            {fmt::format("{}: moved in 1000 cycles [m]", method), "effective stress and water are in equilibrium", 1e-12, greatest},
            at_most());
    }
}
}  // namespace

std::vector<Check> water_checks()
{
    return {{"water.W1", "Block below the water: forces on its faces, and its uplift", check_block},
            {"water.W3", "Gravity dam with uplift", check_dam},
            {"water.W4", "Block on a slope slides at the same friction, dry or below the water", check_slope},
            {"water.W5", "Effective stress on a joint", check_effective_stress},
            {"water.ground", "A water table that cuts through blocks, in the ground with K0 1.5: nothing moves", check_ground}};
}
}  // namespace hdem::verification
