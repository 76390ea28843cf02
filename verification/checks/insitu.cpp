/// Stress in the ground: rock stays where it is drawn, and what a hole does to it.

#include "core/contact/contact_report.h"
#include "core/stress/insitu_stress.h"
#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"
#include "verification/checks/insitu_checks.h"
#include "verification/checks/turned_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
double greatest_displacement(const CaseRun& run)
{
    double greatest = 0.0;
    for (Index b = 0; b < run.model().blocks(); ++b)
        greatest = std::max(greatest, run.state().blocks.displacement(b).norm());
    return greatest;
}

/// Greatest relative error of the stress on the joints of one dip, as drawn.
double worst_stress(const CaseRun& run, double dip_deg, double normal, double shear)
{
    double worst = 0.0;
    for (Index i = 0; i < run.state().contacts.size(); ++i)
    {
        const ContactReport joint = report_contact(run.state(), i);
        const Vec2 along = joint.shear_axis();
        const double off = std::remainder(std::atan2(along.y(), along.x()) * 180.0 / std::numbers::pi - dip_deg, 180.0);
        if (!is_closed_contact(run.state(), i) || std::abs(off) > 1e-6 || joint.length < 0.1)
            continue;
        worst = std::max({worst, std::abs(joint.normal_force / joint.length / normal - 1.0),
                          std::abs(std::abs(joint.shear_force) / joint.length - std::abs(shear)) / normal});
    }
    return worst;
}

void check_stand(Report& report, const std::string& name, const Overrides& overrides)
{
    for (const char* method : all_methods)
    {
        const Overrides all = overrides + Overrides{set("contact.method", std::string(method))};
        const CaseRun drawn("insitu/rock.toml", all);
        report.require({fmt::format("{}, {}: worst unbalanced share", name, method), "divergence theorem", 1e-12,
                        summarise_insitu(drawn.model(), drawn.state()).unbalance},
                       at_most());
        const CaseRun run(report, "insitu/rock.toml", all);
        report.require(
            {fmt::format("{}, {}: moved in 1000 cycles [m]", name, method), "equilibrium", 1e-12, greatest_displacement(run)},
            at_most());
    }
}

void check_uniform(Report& report)
{
    const CaseRun drawn("insitu/rock.toml", {});
    constexpr std::array<std::array<double, 3>, 3> joints{
        {{25.0, 6.301863e6, 1.791854e6}, {60.0, 8.116025e6, 0.799038e6}, {-55.0, 6.073338e6, -1.751559e6}}};
    for (const auto& [dip, normal, shear] : joints)
        report.require({fmt::format("dip {:g}°: worst error of σ_n, τ", dip), "t = σ n, seven digits", 2e-7,
                        worst_stress(drawn, dip, normal, shear)},
                       at_most());
    const Overrides pressed{{"domain.fixed_edges", "[]"},
                            {"domain.hold", "mean"},
                            {"boundary", R"([{edges = [0, 1, 2, 3], kind = "stress", stress = "insitu"}])"}};
    for (const double angle : {0.0, 23.0})
    {
        check_stand(report, fmt::format("turned {:g}°", angle), turned_case("insitu/rock.toml", {}, radians(angle)));
        check_stand(report, fmt::format("turned {:g}°, pressed and held on average", angle),
                    turned_case("insitu/rock.toml", pressed, radians(angle)));
    }
}

void check_ground(Report& report)
{
    check_stand(report, "ground at 0, K0 1.5",
                {{"insitu", "{surface = 0.0, ratio = 1.5}"}, set("gravity.vector", Vec2(0.0, -9.81))});
}

/// What a joint of the hole bears.
struct HoleJoint
{
    Vec2 place;      ///< its middle
    double dip_deg;  ///< 0 or 90
    double normal;   ///< [MPa]
    const char* what;
};

double normal_at(const CaseRun& run, const Vec2& place, double dip)
{
    for (Index i = 0; i < run.state().contacts.size(); ++i)
    {
        const ContactReport joint = report_contact(run.state(), i);
        const Vec2 middle = 0.5 * (joint.point[0] + joint.point[1]) + run.model().origin;
        const double off = std::remainder(std::atan2(joint.shear_axis().y(), joint.shear_axis().x()) - dip, std::numbers::pi);
        if ((middle - place).norm() < 0.05 && std::abs(off) < 0.01 && joint.length > 0.5)
            return joint.normal_force / joint.bearing_length;
    }
    return std::nan("");
}

Vec2 displacement_at(const CaseRun& run, const Vec2& place)
{
    for (Index b = 0; b < run.model().blocks(); ++b)
        if ((Vec2(run.state().blocks.motion[b].x, run.state().blocks.motion[b].y) + run.model().origin - place).norm() < 0.1)
            return run.state().blocks.displacement(b);
    return {std::nan(""), std::nan("")};
}

void check_hole(Report& report, const Overrides& overrides, const std::vector<HoleJoint>& joints, const Vec2& crown_and_springline)
{
    for (const double degrees : {0.0, 23.0})
    {
        const double angle = radians(degrees);
        const CaseRun run(report, "insitu/hole.toml", turned_case("insitu/hole.toml", overrides, angle));
        const std::string turn = fmt::format("turned {:g}°: ", degrees);
        for (const HoleJoint& joint : joints)
            report.require({turn + joint.what, "rigid blocks, linear", joint.normal,
                            1e-6 * normal_at(run, turned(joint.place, angle), radians(joint.dip_deg) + angle)},
                           relative(0.01));
        report.require({turn + "crown moves [mm]", "rigid blocks, linear", crown_and_springline.x(),
                        1e3 * turned(displacement_at(run, turned({0.0, 5.0}, angle)), -angle).y()},
                       relative(0.01));
        if (crown_and_springline.y() != 0.0)
            report.require({turn + "springline moves [mm]", "rigid blocks, linear", crown_and_springline.y(),
                            1e3 * turned(displacement_at(run, turned({5.0, 0.0}, angle)), -angle).x()},
                           relative(0.01));
    }
}

void check_soft_shear(Report& report)
{
    check_hole(report, {},
               {{{0.5, 5.0}, 90.0, 1.81320, "hoop stress at (0.5, 5) [MPa]"},
                {{0.5, 6.0}, 90.0, 1.28120, "hoop stress at (0.5, 6) [MPa]"},
                {{0.5, 7.0}, 90.0, 1.10063, "hoop stress at (0.5, 7) [MPa]"},
                {{5.0, 0.5}, 0.0, 0.86016, "hoop stress at (5, 0.5) [MPa]"},
                {{6.0, 0.5}, 0.0, 0.64171, "hoop stress at (6, 0.5) [MPa]"},
                {{5.5, 0.0}, 90.0, 0.03605, "radial stress at (5.5, 0) [MPa]"}},
               {-0.76215, -1.74083});
}

void check_isotropic(Report& report)
{
    check_hole(report,
               {{"insitu.stress", "[-1e6, -1e6, 0.0]"},
                set("joint.default.normal_stiffness", 1e10),
                set("joint.default.shear_stiffness", 1e10)},
               {{{0.5, 5.0}, 90.0, 1.64329, "hoop stress at (0.5, 5) [MPa]"},
                {{0.5, 6.0}, 90.0, 1.52771, "hoop stress at (0.5, 6) [MPa]"},
                {{0.5, 7.0}, 90.0, 1.38110, "hoop stress at (0.5, 7) [MPa]"}},
               {-0.369245, 0.0});
}

/// The joints of one set that cuts the rock at this dip, under [xx, yy] in Pa.
StressedSet stressed(double dip, double friction, const Vec2& stress)
{
    const CaseRun run(
        "insitu/rock.toml",
        {{"domain.fixed_edges", "[0]"},
         {"insitu", fmt::format("{{stress = [{}, {}, 0.0]}}", stress.x(), stress.y())},
         {"joint_set", fmt::format("[{{name = \"asked\", dip_deg = {}, spacing = 1.0}}]", dip)},
         {"joint.default", fmt::format("{{normal_stiffness = 1e10, shear_stiffness = 1e9, friction_angle_deg = {}}}", friction)}});
    for (const StressedSet& set : summarise_insitu(run.model(), run.state()).sets)
        if (set.name == "asked")
            return set;
    return {};
}

/// How much of their strength joints have in use, and which are above it.
void check_slip_tendency(Report& report)
{
    const Vec2 stress(-15e6, -5e6);
    for (const auto& [dip, used] : {std::pair(15.0, 0.4409270), {30.0, 0.5773503}, {45.0, 0.5}, {60.0, 0.3464102}})
    {
        report.require({fmt::format("dip {:g}°: τ over σ_n", dip), "t = σ n", used,
                        stressed(dip, 30.0, stress).most_used * std::tan(radians(30.0))},
                       relative(2e-7));
        const StressedSet set = stressed(dip, 29.9, stress);
        report.require({fmt::format("dip {:g}°, φ 29.9°: share of the length above its strength", dip), "only 30° slips",
                        dip == 30.0 ? 1.0 : 0.0, set.length_above / set.length},
                       absolute(1e-12));
    }
    // s1 is vertical: the normal of a joint is as far from it as its dip says.
    const double ratio = 4.0, phi = radians(30.0);
    const double spread = std::asin((ratio + 1.0) / (ratio - 1.0) * std::sin(phi));
    const double least = 0.5 * (phi + spread) * 180.0 / std::numbers::pi, most = 120.0 - least;
    for (const auto& [angle, slips] :
         {std::pair(least - 0.01, false), {least + 0.01, true}, {most - 0.01, true}, {most + 0.01, false}})
    {
        const StressedSet set = stressed(angle, 30.0, {-2e6, -8e6});
        report.require({fmt::format("s1/s3 = 4, φ 30°, normal {:.2f}° from s1: share of the length above its strength", angle),
                        "sin(2θ − φ) > (s1 + s3)/(s1 − s3) sin φ", slips ? 1.0 : 0.0, set.length_above / set.length},
                       absolute(1e-12));
    }
}
}  // namespace

std::vector<Check> insitu_checks()
{
    return {{"insitu.I1", "Uniform stress in rock of three joint sets: on the joints, and nothing moves", check_uniform},
            {"insitu.I2", "Stress of the ground with K0 1.5: nothing moves", check_ground},
            {"insitu.I3", "Two sets of joints as a continuum: compliance, strain, stress", check_two_sets},
            {"insitu.I4", "Square blocks as an isotropic continuum", check_squares},
            {"insitu.I5", "Running bond as a continuum: stiffness by moving the outer bricks", check_bond},
            {"insitu.I6", "Hole under unequal stress, soft in shear", check_soft_shear},
            {"insitu.I7", "Hole under equal stress, K_S = K_N", check_isotropic},
            {"insitu.I8", "Wedge in a roof: greatest weight, drop at slip, and fall", check_roof_wedge},
            {"insitu.I9", "Which joints are above their strength: slip tendency", check_slip_tendency}};
}
}  // namespace hdem::verification
