/// Energy continuity at changes of regime, [Lee2025] sect. 4.3.

#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"
#include "verification/checks/fit.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr const char* case_file = "transition/transition.toml";
constexpr double mass = 2700.0;
constexpr double g = 9.81;
constexpr double push = 9.4;              ///< [m/s2]
constexpr double normal_stiffness = 7e9;  ///< [N/m], contact length 1 m
constexpr double shear_stiffness = 5e8;
constexpr double alpha = 0.8;
constexpr double step = 5e-5;  ///< [s]
constexpr std::int64_t pushed_from = 5000;
constexpr double paper_cycle = 75300.0;

/// Cycle at which the sliding block reaches the threshold velocity.
///
///   u_th = dt g + sqrt((F_N^2 / K_N + F_S^2 / K_S) / m_c)                 [Lee2025] Eqs. (25)-(27), C_scale = 1
///
/// Elastic stage under local damping, u = F/K (1 - cos w t), w^2 = (1 - alpha) K / m, until K u is the strength S; then
/// dv/dt = (1 - alpha) (F - S) / m.
double predicted_cycle(double collision_mass)
{
    const double normal = mass * g;
    const double strength = normal / std::numbers::sqrt3 + 1e4;
    const double driving = mass * push;
    const double threshold = step * g + std::sqrt((normal * normal / normal_stiffness + strength * strength / shear_stiffness) /
                                                  collision_mass);
    const double w = std::sqrt((1.0 - alpha) * shear_stiffness / mass);
    const double phase = std::acos(1.0 - strength / driving);
    const double first_speed = driving / shear_stiffness * w * std::sin(phase);
    const double acceleration = (1.0 - alpha) * (driving - strength) / mass;
    return static_cast<double>(pushed_from) + (phase / w + (threshold - first_speed) / acceleration) / step;
}

/// First cycle after `from` whose contact points are impulse-based, or are not.
std::int64_t find_switch(const CaseRun& run, std::int64_t from, bool to_impulse)
{
    const std::vector<double>& points = run.column("contact.impulse_points");
    for (std::size_t c = static_cast<std::size_t>(from) + 1; c < points.size(); ++c)
        if ((points[c] > 0.0) == to_impulse)
            return static_cast<std::int64_t>(c);
    throw RunError(run.command() + ": the contact does not change its regime");
}

/// Step in the velocity at a switch: straight lines through the `window` cycles before and after it, both taken to the last cycle of the
/// old regime, so that the change of acceleration does not count.
struct Jump
{
    double kinetic = 0.0;  ///< energy before [J]
    double energy = 0.0;   ///< what the jump added [J]
};

Jump find_jump(const CaseRun& run, std::int64_t cycle, std::int64_t window)
{
    const std::vector<double>& v = run.column("block.velocity_x");
    const auto at = static_cast<double>(cycle - 1);
    const double before = fit_line(v, cycle - 1 - window, cycle - 1).at(at);
    const double after = fit_line(v, cycle, cycle + window).at(at);
    return {.kinetic = 0.5 * mass * before * before, .energy = 0.5 * mass * (after * after - before * before)};
}

struct Variant
{
    const char* name;
    const char* fixed_mass_counts;
    double collision_mass;
};

CaseRun run_with_release(Report& report, const Variant& variant, std::int64_t release)
{
    const auto at = [&](std::int64_t later) { return static_cast<double>(release + later); };
    return {report,
            case_file,
            {{"contact.fixed_mass_counts", variant.fixed_mass_counts},
             set("load[0].until_cycle", at(0)),
             set("load[1].from_cycle", at(0)),
             set("load[1].until_cycle", at(50)),
             set("load[2].from_cycle", at(50)),
             set("load[2].until_cycle", at(100)),
             set("load[3].from_cycle", at(100)),
             set("stage[1].cycles", at(6000) - static_cast<double>(pushed_from))}};
}

Panel energy_panel(const CaseRun& run, const char* title, std::int64_t first, std::int64_t last)
{
    Panel panel{.title = title, .x_label = "cycle", .y_label = "kinetic energy [J]"};
    Series energy = sampled("hdem", run.column("block.velocity_x"), static_cast<std::size_t>(first),
                            static_cast<std::size_t>(last));
    for (double& v : energy.y)
        v = 0.5 * mass * v * v;
    panel.series.push_back(energy);
    return panel;
}

/// Left the switch to impulses, right the whole way until some cycles after the switch back.
void add_panels(Figure& figure, const CaseRun& run, const Variant& variant, double predicted, std::int64_t up, std::int64_t down)
{
    Panel near = energy_panel(run, variant.name, up - 300, up + 400);
    near.marks = {{"springs to impulses, hdem", Origin::ours, static_cast<double>(up)},
                  {"springs to impulses, Eq. (25)", Origin::exact, predicted}};
    if (variant.collision_mass < mass)
        near.marks.push_back({"springs to impulses, Fig. 9", Origin::paper, paper_cycle});
    Panel both = energy_panel(run, variant.name, up - 500, down + 500);
    both.marks = {{"springs to impulses, hdem", Origin::ours, static_cast<double>(up)},
                  {"impulses to springs, hdem", Origin::ours, static_cast<double>(down)}};
    figure.panels.push_back(near);
    figure.panels.push_back(both);
}

void check_variant(Report& report, const Variant& variant, Figure& figure)
{
    const double predicted = predicted_cycle(variant.collision_mass);
    const std::int64_t late = std::llround(1.05 * predicted);
    const CaseRun pushed = run_with_release(report, variant, late);
    const std::int64_t up = find_switch(pushed, pushed_from, true);
    if (variant.collision_mass < mass)
        report.require(
            {fmt::format("{}: becomes impulse-based [cycle]", variant.name), "sect. 4.3", paper_cycle, static_cast<double>(up)},
            relative(0.03));
    report.require({fmt::format("{}: becomes impulse-based [cycle]", variant.name), "Eq. (25)", predicted, static_cast<double>(up)},
                   relative(0.01));

    const CaseRun run = run_with_release(report, variant, up + 200);
    const std::int64_t down = find_switch(run, up + 200, false);
    add_panels(figure, run, variant, predicted, up, down);
    const Jump first = find_jump(run, up, 50);
    const Jump back = find_jump(run, down, 10);
    report.inform(fmt::format("{}: kinetic energy before the switch [J]", variant.name), "sect. 4.3: 1.41", first.kinetic);
    report.inform({fmt::format("{}: jump of the kinetic energy, size [J]", variant.name), "Fig. 9", 0.038, std::abs(first.energy)});
    report.inform({fmt::format("{}: the same, share of it [%]", variant.name), "Fig. 9", 2.7,
                   100.0 * std::abs(first.energy) / first.kinetic});
    report.require({fmt::format("{}: the same, share of it [%]", variant.name), "no jump", 0.05,
                    100.0 * std::abs(first.energy) / first.kinetic},
                   at_most());
    report.inform(fmt::format("{}: spring energy given up there, ledger's contact changes [J]", variant.name), "-",
                  run.state().ledger.contact_changes);
    report.inform(fmt::format("{}: becomes force-based again [cycle]", variant.name), "-", static_cast<double>(down));
    report.inform(fmt::format("{}: kinetic energy before the way back [J]", variant.name), "-", back.kinetic);
    report.require({fmt::format("{}: jump on the way back, share of the energy then [%]", variant.name), "no jump", 0.05,
                    100.0 * std::abs(back.energy) / back.kinetic},
                   at_most());
}

void check_transition(Report& report)
{
    Figure figure{.id = "fig9",
                  .title = "Kinetic energy of the sliding block at changes of regime",
                  .source = "Fig. 9; Eq. (25): cycle at which the speed reaches the threshold",
                  .note = "The push is reduced from 200 cycles after the switch to impulses on. The paper has a jump of 0.038 J, "
                          "2.7 %, at its switch.",
                  .columns = 2};
    check_variant(report, {"immovable ground", "false", mass}, figure);
    check_variant(report, {"ground's mass counted", "true", 0.5 * mass}, figure);
    report.add_figure(std::move(figure));
}
}  // namespace

std::vector<Check> transition_checks()
{
    return {{"paper.transition", "shear contact from springs to impulses and back: cycle and energy jump", check_transition}};
}
}  // namespace hdem::verification
