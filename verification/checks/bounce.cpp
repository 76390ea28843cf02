/// Dynamic condition test, [Lee2025] sect. 4.2: Table 4, Figs. 7 and 8.

#include "verification/checks/bounce.h"

#include "verification/checks/bounce_figures.h"
#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hdem::verification
{
double bounce_velocity(double t, double height, double restitution)
{
    constexpr double g = 9.81;
    const double first = std::sqrt(2.0 * height / g);
    if (t < first)
        return -g * t;
    double impact = first;
    double speed = restitution * g * first;
    while (speed > 1e-12)
    {
        const double flight = 2.0 * speed / g;
        if (t < impact + flight)
            return speed - g * (t - impact);
        impact += flight;
        speed *= restitution;
    }
    return 0.0;
}

double velocity_error(const std::vector<double>& velocity, double step)
{
    double sum = 0.0;
    for (std::size_t c = 1; c < velocity.size(); ++c)
        sum += std::abs(velocity[c] - bounce_velocity(static_cast<double>(c) * step, 1.0, 0.5));
    return sum / static_cast<double>(velocity.size() - 1);
}

namespace
{
constexpr const char* case_file = "paper_dynamic/dynamic.toml";
constexpr double duration = 1.5;  ///< [s]

struct PaperColumn
{
    const char* method;
    std::array<double, 4> error;  ///< [m/s]
};
constexpr std::array<double, 4> steps{5e-5, 1e-4, 3e-4, 5e-4};
constexpr std::array<PaperColumn, 3> table4{PaperColumn{"force", {4.52e-2, 4.20e-2, 3.41e-1, 5.94e-1}},
                                            PaperColumn{"impulse", {2.24e-3, 5.30e-3, 1.60e-2, 2.51e-2}},
                                            PaperColumn{"hybrid", {3.41e-3, 7.11e-3, 2.10e-2, 3.34e-2}}};

void check_table4(Report& report)
{
    BounceFigures figures;
    for (const PaperColumn& paper : table4)
    {
        const bool is_force = std::string(paper.method) == "force";
        std::array<double, 4> error{};
        std::vector<Series> velocities;
        for (std::size_t i = 0; i < steps.size(); ++i)
        {
            const CaseRun run(report, case_file,
                              {set("contact.method", std::string(paper.method)), set("time.step", steps[i]),
                               set("stage[0].cycles", std::round(duration / steps[i]))});
            error[i] = velocity_error(run.column("block.velocity_y"), steps[i]);
            velocities.push_back(velocity_series(fmt::format("{:g} s", steps[i]), run));
            if (i == 0)
                figures.add_histories(run, paper.method);
            report.require({fmt::format("mean velocity error, {}, step {:g} s [m/s]", paper.method, steps[i]), "Table 4",
                            paper.error[i], error[i]},
                           is_force ? relative(0.05) : at_most());
        }
        for (std::size_t i = 1; i < steps.size(); ++i)
        {
            const double growth = error[i] / error[0];
            const std::string name = fmt::format("growth of that error from 5e-05 to {:g} s, {} [-]", steps[i], paper.method);
            report.inform({name, "Table 4", paper.error[i] / paper.error[0], growth});
            if (!is_force)
                report.require({name, "first order", steps[i] / steps[0], growth}, at_most());
        }
        const auto over_steps = [](const char* name, Origin origin, const std::array<double, 4>& values)
        {
            return Series{.name = name,
                          .origin = origin,
                          .x = {steps.begin(), steps.end()},
                          .y = {values.begin(), values.end()},
                          .dots = true};
        };
        figures.add_steps(paper.method, velocities, over_steps("hdem, mean error", Origin::ours, error),
                          over_steps("Table 4, mean error", Origin::paper, paper.error));
    }
    figures.add_to(report);
}

/// What the velocities of a run say about the bounce; the velocity after cycle c is that at (c - 1/2) dt.
struct Bounce
{
    double first_impact = 0.0;   ///< [s]
    double impact_speed = 0.0;   ///< [m/s]
    double energy_after = 0.0;   ///< most kinetic energy after the first impact [J]
    double second_impact = 0.0;  ///< [s]
};

Bounce find_bounce(const std::vector<double>& velocity, double step)
{
    Bounce bounce;
    bool was_falling = true;
    for (std::size_t c = 2; c < velocity.size() && bounce.second_impact == 0.0; ++c)
    {
        const bool slows = velocity[c] > velocity[c - 1];
        if (slows && was_falling)
        {
            const double time = step * static_cast<double>(c - 1);
            (bounce.first_impact == 0.0 ? bounce.first_impact : bounce.second_impact) = time;
            bounce.impact_speed = bounce.impact_speed == 0.0 ? -velocity[c - 1] : bounce.impact_speed;
        }
        if (bounce.first_impact > 0.0 && bounce.second_impact == 0.0 && velocity[c] > 0.0)
            bounce.energy_after = std::max(bounce.energy_after, 0.5 * 2700.0 * velocity[c] * velocity[c]);
        was_falling = !slows;
    }
    return bounce;
}

void check_a5(Report& report)
{
    for (const double factor : {1.0, 10.0})
        for (const PaperColumn& paper : table4)
        {
            const double step = factor == 1.0 ? 5e-5 : 1.25e-5;
            const CaseRun run(report, case_file,
                              {set("contact.method", std::string(paper.method)), set("time.step", step),
                               set("stage[0].cycles", std::round(duration / step)),
                               set("joint.default.normal_stiffness", factor * 7e9),
                               set("joint.default.shear_stiffness", factor * 5e8)});
            const std::vector<double>& velocity = run.column("block.velocity_y");
            const Bounce bounce = find_bounce(velocity, step);
            const std::string name = fmt::format("{}{}: ", paper.method, factor == 1.0 ? "" : ", 10 K");
            report.require({name + "mean velocity error [m/s]", "Table 4", paper.error[0], velocity_error(velocity, step)},
                           at_most());
            report.inform({name + "first impact [s]", "√(2 h / g)", 0.451524, bounce.first_impact});
            report.inform({name + "speed then [m/s]", "√(2 g h)", 4.429447, bounce.impact_speed});
            report.inform({name + "energy after it [J]", "e² m g h", 6621.75, bounce.energy_after});
            report.inform({name + "second impact [s]", "(1 + 2 e) √(2 h / g)", 0.903047, bounce.second_impact});
            report.inform({name + "speed after 1.5 s [m/s]", "at rest from 1.354571 s", 0.0, std::abs(velocity.back())});
        }
}
}  // namespace

std::vector<Check> bounce_checks()
{
    return {{"paper.table4", "bouncing block: mean velocity error at four time steps", check_table4},
            {"closed_form.A5", "bounce from 1 m with restitution 0.5", check_a5}};
}
}  // namespace hdem::verification
