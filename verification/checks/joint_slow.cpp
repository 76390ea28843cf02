/// Joint laws in the cycle, slowly enough for seven digits: scale, wear, constant normal stiffness.

#include "core/contact/contact_report.h"
#include "verification/checks/case_run.h"
#include "verification/checks/joint_checks.h"
#include "verification/checks/turned_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace hdem::verification
{
namespace
{
/// A leg of the way: three loads that prescribe a velocity, and how far the last two move the base [m].
struct Leg
{
    std::size_t first_load = 0;
    double way = 0.0;  ///< of the base [m]
};

constexpr std::array<double, 3> slow_ways{0.0, 20e-6, 0.05e-6};

/// Velocities of the base that take it along the legs. The case says in which cycles.
Overrides pulled(const CaseDef& def, const std::vector<Leg>& legs)
{
    Overrides overrides;
    for (const Leg& leg : legs)
        for (std::size_t k = 0; k < 3; ++k)
        {
            const Interval& when = def.loads[leg.first_load + k].interval;
            const double time = *def.time.step * static_cast<double>(*when.until_cycle - *when.from_cycle);
            const double slow = std::copysign(k == 0 ? std::abs(leg.way) - slow_ways[1] - slow_ways[2] : slow_ways[k], leg.way);
            overrides.push_back(set(fmt::format("load[{}].velocity_x", leg.first_load + k), -slow / time));
        }
    return overrides;
}

/// What the joint below the block bears, and how far the block has gone along and across it.
struct Joint
{
    double normal = std::nan(""), shear = std::nan("");  ///< stresses [Pa]
    double slip = std::nan(""), opening = std::nan("");  ///< remembered by its first point [m]
    double state = std::nan("");                         ///< of its law
    double along = 0.0, across = 0.0;                    ///< displacement of the block against the base [m]
};

Joint joint_below(const Model& model, const State& state, double angle)
{
    const Index base = model.find_block("base"), block = model.find_block("block");
    const Vec2 way = turned(state.blocks.displacement(block) - state.blocks.displacement(base), -angle);
    Joint joint{.along = way.x(), .across = way.y()};
    for (Index i = 0; i < state.contacts.size(); ++i)
    {
        const ContactReport report = report_contact(state, i);
        if (std::minmax(report.first, report.second) != std::minmax(base, block))
            continue;
        joint.normal = report.normal_force / report.length;
        joint.shear = report.shear_force / report.length;
        joint.slip = report.memory[0].slip;
        joint.opening = report.memory[0].opening;
        joint.state = report.memory[0].state;
    }
    return joint;
}

Joint after(Report& report, const std::string& file, const Overrides& overrides, const std::vector<Leg>& legs, double degrees)
{
    const double angle = radians(degrees);
    const CaseRun drawn(file, overrides);
    const CaseRun run(report, file, turned_case(file, overrides + pulled(drawn.definition(), legs), angle));
    return joint_below(run.model(), run.state(), angle);
}

constexpr double cheek = 0.3;  ///< height of the cheeks of both boxes [m]

/// Of the base, so that the block is displaced by `way` against it while its joint bears `shear`, by which the cheeks give way [m].
double base_way(double way, double shear)
{
    return way + shear / (2.0 * 1e11 * cheek);
}

/// Overrides of the slow box that end it after the first leg.
Overrides one_leg(const std::string& joint, double pressure)
{
    return {{"joint.default", "{" + joint + "}"}, set("load[0].force", Vec2(0.0, -pressure)), {"stage[0].cycles", "276000"}};
}
}  // namespace

void check_normal_stiffness(Report& report)
{
    for (const double degrees : {0.0, 23.0})
    {
        const auto at = [&](double way, double shear) {
            return after(report, "joint/stiff_box.toml", {}, {{0, way + shear / (2.0 * 1e10 * cheek)}}, degrees);
        };
        const std::string turn = fmt::format("turned {:g}°: ", degrees);
        const Joint sliding = at(3e-3, 1.011348e6), beyond = at(10e-3, 1.836685e6);
        report.require({turn + "slip at 3 mm [mm]", "(u − τ/K_S), K_e = K_N K / (K_N + K)", 1.988652, 1e3 * std::abs(sliding.slip)},
                       relative(1e-4));
        report.require({turn + "normal stress at 3 mm [MPa]", "σ_0 + K_e u_p tan ψ", 2.168843, 1e-6 * sliding.normal},
                       relative(1e-4));
        report.require({turn + "shear stress at 3 mm [MPa]", "σ tan φ_r", 1.011348, 1e-6 * std::abs(sliding.shear)},
                       relative(1e-4));
        report.require({turn + "normal stress at 10 mm [MPa]", "σ_0 + K_e u_lim tan ψ", 3.938783, 1e-6 * beyond.normal},
                       relative(1e-4));
        report.require({turn + "shear stress at 10 mm [MPa]", "σ tan φ_r", 1.836685, 1e-6 * std::abs(beyond.shear)},
                       relative(1e-4));
    }
}

void check_scale(Report& report)
{
    const std::string joint = "law = \"barton_bandis\", normal_stiffness = 1e10, shear_stiffness = 1e9, jrc = 10.0, jcs = 1e8, "
                              "residual_friction_angle_deg = 30.0, length = 2.0, normal_stress = 1e7";
    const double peak = 5.582801e-3;
    const auto at = [&](double pressure, double way, double shear) {
        return after(report, "joint/slow_box.toml", one_leg(joint, pressure), {{1, base_way(way, shear)}}, 0.0);
    };
    const auto angle = [](const Joint& j) { return std::atan2(std::abs(j.shear), j.normal); };
    const Joint rises = at(1e6, 5e-3, 0.78866e6);
    const double low = angle(at(1e6, peak, 0.8052201e6)), high = angle(at(5e6, peak, 3.501351e6));
    const double roughness = (low - high) / std::log10(5.0), i = low - radians(30.0);
    const double m = (angle(rises) - radians(30.0)) / i;  // from 0.75 at 0.6 peak to 1 at peak
    report.require({"shear over normal stress at δ_p, 1 MPa", "tan(φ_r + JRC_n log10(JCS_n/σ))", 0.8052201, std::tan(low)},
                   relative(1e-6));
    report.require({"JRC_n by the strength under 1 and 5 MPa", "JRC_0 (L/L_0)^(−0.02 JRC_0)", 5.492803, roughness / radians(1.0)},
                   relative(1e-6));
    report.require({"JCS_n [MPa]", "JCS_0 (L/L_0)^(−0.03 JRC_0)", 40.70905, std::pow(10.0, i / roughness)}, relative(1e-6));
    report.require(
        {"δ_p by the strength at 5 mm [mm]", "L/500 (JRC_n/L)^0.33", 5.582801, 1e3 * rises.along / (0.6 + 0.4 * (m - 0.75) / 0.25)},
        relative(1e-6));
}

void check_plesha(Report& report)
{
    struct Turn
    {
        const char* name;
        double slip, shear, angle, work, opening;  ///< [mm], [MPa], [deg], [J/m2], [mm]
    };
    constexpr std::array<Turn, 3> turns{{{"at 10 mm: ", 10.0, 0.912963, 12.39494, 9538.1, 2.42641},
                                         {"back at 0: ", 1e-4, -0.332360, 11.61524, 12786.6, 0.30011},
                                         {"at -10 mm: ", -10.0, -0.832622, 9.78152, 21377.8, 2.18297}}};
    const std::string file = "joint/slow_box.toml";
    const CaseRun drawn(file, {});
    std::vector<Leg> legs;
    std::vector<Joint> ends;
    double last = 0.0;
    for (const Turn& turn : turns)
    {
        const double to = base_way(1e-3 * turn.slip + 1e6 * turn.shear / 2e10, 1e6 * turn.shear);
        legs.push_back({1 + 3 * legs.size(), to - last});
        last = to;
    }
    CaseRun run(file, pulled(drawn.definition(), legs));
    run.run(
        [&](const Model& model, const State& state)
        {
            if (ends.size() < legs.size() &&
                state.cycle == run.definition().loads[legs[ends.size()].first_load + 2].interval.until_cycle)
                ends.push_back(joint_below(model, state, 0.0));
        },
        1000);
    report.add_run(run);
    for (std::size_t k = 0; k < ends.size(); ++k)
    {
        const Turn& turn = turns[k];
        const Joint& j = ends[k];
        const double angle = 15.0 * std::exp(-2e-5 * j.state);
        report.require({turn.name + std::string("shear stress [MPa]"), "σ tan(φ ± α)", turn.shear, 1e-6 * j.shear}, relative(1e-3));
        report.require({turn.name + std::string("α [deg]"), "α_0 exp(-C W)", turn.angle, angle}, relative(1e-3));
        report.require({turn.name + std::string("work of slip W [J/m2]"), "∫ τ du_p", turn.work, j.state}, relative(1e-3));
        report.require({turn.name + std::string("opening [mm]"), "∫ tan(±α) du_p", turn.opening, 1e3 * (j.across + 1e-4)},
                       relative(1e-3));
    }
}

void check_saeb(Report& report)
{
    struct Load
    {
        double pressure, shear, opening;  ///< [MPa], [MPa], [mm]
    };
    const std::string joint = "law = \"saeb_amadei\", normal_stiffness = 1e10, greatest_closure = 3e-4, shear_stiffness = 5e9, "
                              "friction_angle_deg = 30.0, asperity_angle_deg = 15.0, transition_stress = 5e7, "
                              "normal_stress = 1.2e7, rock_cohesion = 5e6, rock_friction_angle_deg = 40.0";
    for (const double degrees : {0.0, 23.0})
        for (const Load& load : {Load{0.5, 0.56397433, 1.24409748}, Load{1.0, 1.10731493, 1.16073902},
                                 Load{5.0, 4.92271678, 0.69150733}, Load{10.0, 9.05829488, 0.31799072}})
        {
            const double way = base_way(5e-3 + 1e6 * load.shear / 5e9, 1e6 * load.shear);
            const Joint j = after(report, "joint/slow_box.toml", one_leg(joint, 1e6 * load.pressure), {{1, way}}, degrees);
            const std::string name = fmt::format("turned {:g}°, {:g} MPa: ", degrees, load.pressure);
            report.require({name + "shear stress [MPa]", "Saeb & Amadei", load.shear, 1e-6 * std::abs(j.shear)}, relative(1e-6));
            report.require({name + "opening at 5 mm of slip [mm]", "Saeb & Amadei", load.opening, 1e3 * j.across}, relative(1e-6));
        }
}
}  // namespace hdem::verification
