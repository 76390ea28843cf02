/// Orders of accuracy: what halving the time step does.

#include "verification/checks/bounce.h"
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
}
}  // namespace

std::vector<Check> order_checks()
{
    return {{"orders", "what halving the time step does to the errors", check_orders}};
}
}  // namespace hdem::verification
