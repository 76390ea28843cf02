/// Orders of accuracy: what halving the time step does.

#include "verification/checks/bounce.h"
#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"
#include "verification/checks/fit.h"
#include "verification/checks/variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr const char* fall_file = "paper_dynamic/dynamic.toml";

double fall_error(Report& report, const std::string& method, double step)
{
    constexpr double t = 0.4;  // before the impact
    const CaseRun run(report, fall_file,
                      {set("contact.method", method), set("time.step", step), set("stage[0].cycles", std::round(t / step))});
    const std::vector<double>& y = run.column("block.position_y");
    return std::abs(y.back() - y.front() + 0.5 * 9.81 * t * t);
}

double frequency_error(Report& report, const std::string& method, double step)
{
    constexpr std::int64_t settled = 60000;
    const CaseRun run(report, "column/swing.toml",
                      {set("contact.method", method), set("time.step", step), set("domain.height", 2.0),
                       set("history[0].block", std::string("b2"))});
    const std::vector<double>& y = run.column("top.position_y");
    const double exact = std::sqrt(7e9 / 2700.0) / (2.0 * std::numbers::pi);
    return std::abs(1.0 / (mean_period({y.begin() + settled, y.end()}) * step) / exact - 1.0);
}

double bounce_error(Report& report, const std::string& method, double step)
{
    const CaseRun run(report, fall_file,
                      {set("contact.method", method), set("time.step", step), set("stage[0].cycles", std::round(1.5 / step))});
    return velocity_error(run.column("block.velocity_y"), step);
}

/// Slope of log2 error over steps that halve each time.
double order(const std::vector<double>& errors)
{
    std::vector<double> logs;
    for (const double error : errors)
        logs.push_back(-std::log2(error));
    return fit_line(logs, 0, static_cast<std::int64_t>(logs.size())).slope;
}

/// What the force-based method makes of the energy of a block that falls from `height` and bounces undamped, as a share of it.
double energy_error(Report& report, double height, double step)
{
    constexpr double in_flight = 0.8;  // s; after the first bounce of all heights, before the second
    const Polygon block{{0.0, height}, {1.0, height}, {1.0, height + 1.0}, {0.0, height + 1.0}};
    const CaseRun run(report, fall_file,
                      {set("contact.method", std::string("force")), set("damping.preset", std::string("dynamic")),
                       set("time.step", step), set("stage[0].cycles", std::round(in_flight / step) + 1.0),
                       set("block[1].polygon", block)});
    const std::vector<double>& y = run.column("block.position_y");
    const std::vector<double>& v = run.column("block.velocity_y");  // half a step before the position
    const auto energy = [&](std::size_t c)
    {
        const double mean = 0.5 * (v[c] + v[c + 1]);
        return 0.5 * mean * mean + g * (y[c] - 0.5);
    };
    return std::abs(energy(y.size() - 2) / energy(0) - 1.0);
}

/// A spring takes hold, and lets go, up to a cycle late. Either changes the energy by ½ K u (u − v Δt), 0 < u < v Δt: at most an eighth of
/// K (v Δt)², a quarter of (ω Δt)² of the kinetic energy, the one as a loss and the other as a gain. Where in a cycle it happens is chance, so
/// errors lie below a line of second order but need not follow it.
void check_force_bounce(Report& report)
{
    constexpr int heights = 16;
    const double omega_squared = normal_stiffness / density;
    std::vector<double> bounce;
    for (const double step : {2e-4, 1e-4, 5e-5, 2.5e-5})
    {
        double worst = 0.0;
        for (int i = 0; i < heights; ++i)
            worst = std::max(worst, energy_error(report, 1.0 + 0.003 * i, step));
        report.require({fmt::format("force: energy error of an undamped bounce, worst of {}, step {:g} s [-]", heights, step),
                        "(ω Δt)² / 4", omega_squared * step * step / 4.0, worst},
                       at_most());
        bounce.push_back(bounce_error(report, "force", step));
    }
    report.inform("force: order of the velocity in a bounce", "limited by the springs", order(bounce));
    report.inform("force: mean velocity error at the smallest step [m/s]", "time in contact, no step removes it", bounce.back());
}

void check_orders(Report& report)
{
    for (const char* method : all_methods)
    {
        const std::string name = method;
        std::vector<double> fall;
        std::vector<double> bounce;
        for (const double step : {4e-4, 2e-4, 1e-4, 5e-5, 2.5e-5})
        {
            fall.push_back(fall_error(report, name, step));
            if (name != "force")
                bounce.push_back(bounce_error(report, name, step));
        }
        // Velocities start at t = 0 and not half a step earlier: first order, ½ g t Δt.
        report.require({name + ": order of the way in free fall", "semi-implicit Euler", 1.0, order(fall)}, absolute(0.05));
        // An impact is noticed up to a cycle late; how late depends on the step by chance.
        if (!bounce.empty())
            report.require({name + ": order of the velocity in a bounce, at least", "impact within a cycle", 0.9, order(bounce)},
                           at_least());
        if (name != "impulse")
            report.require({name + ": order of the frequency of a spring", "(ω Δt)² / 24", 2.0,
                            order({frequency_error(report, name, 2e-4), frequency_error(report, name, 1e-4),
                                   frequency_error(report, name, 5e-5)})},
                           absolute(0.1));
    }
    check_force_bounce(report);
}
}  // namespace

std::vector<Check> order_checks()
{
    return {{"orders", "what halving the time step does to the errors", check_orders}};
}
}  // namespace hdem::verification
