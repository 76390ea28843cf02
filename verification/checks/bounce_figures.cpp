#include "verification/checks/bounce_figures.h"

#include <cmath>

namespace hdem::verification
{
namespace
{
constexpr double g = 9.81;
constexpr double mass = 2700.0;
constexpr double drop = 1.0;         ///< [m]
constexpr double restitution = 0.5;  ///< [-]
constexpr double duration = 1.5;     ///< [s]
constexpr double half_block = 0.5;   ///< [m]

/// The exact bounce as paths, each flight with both of its ends, so that an impact is a vertical line.
struct ExactBounce
{
    std::vector<double> time, velocity, height;
};

ExactBounce exact_bounce()
{
    ExactBounce path;
    double impact = std::sqrt(2.0 * drop / g);
    double speed = g * impact;
    double begin = -impact;  // the fall is the second half of a flight
    double from = 0.0;
    while (speed > 1e-3)
    {
        constexpr int pieces = 40;
        for (int i = 0; i <= pieces; ++i)
        {
            const double t = from + (impact - from) * i / pieces;
            path.time.push_back(t);
            path.velocity.push_back(speed - g * (t - begin));
            path.height.push_back(speed * (t - begin) - 0.5 * g * (t - begin) * (t - begin));
        }
        begin = from = impact;
        speed *= restitution;
        impact += 2.0 * speed / g;
    }
    path.time.insert(path.time.end(), {impact, duration});
    path.velocity.insert(path.velocity.end(), {0.0, 0.0});
    path.height.insert(path.height.end(), {0.0, 0.0});
    return path;
}

Series exact(const std::string& name, const std::vector<double>& x, std::vector<double> y)
{
    return {.name = name, .origin = Origin::exact, .x = x, .y = std::move(y)};
}

/// Energies at the half step, at which velocities are known; the height there is the mean of both ends of the step.
struct Energies
{
    std::vector<double> kinetic, potential, total;
    void add(double velocity, double height)
    {
        kinetic.push_back(0.5e-3 * mass * velocity * velocity);
        potential.push_back(1e-3 * mass * g * height);
        total.push_back(kinetic.back() + potential.back());
    }
};

Panel energy_panel(const CaseRun& run, const std::string& method, const ExactBounce& path)
{
    const std::vector<double>& velocity = run.column("block.velocity_y");
    const std::vector<double>& y = run.column("block.position_y");
    Energies ours;
    std::vector<double> time;
    for (std::size_t c = 1; c < velocity.size(); ++c)
    {
        time.push_back((static_cast<double>(c) - 0.5) * run.step());
        ours.add(velocity[c], 0.5 * (y[c - 1] + y[c]) - half_block);
    }
    Energies theirs;
    for (std::size_t i = 0; i < path.time.size(); ++i)
        theirs.add(path.velocity[i], path.height[i]);
    Panel panel{.title = method, .x_label = "time [s]", .y_label = "energy [kJ]"};
    panel.series = {{.name = "kinetic", .x = time, .y = ours.kinetic},
                    {.name = "potential", .x = time, .y = ours.potential},
                    {.name = "sum", .x = time, .y = ours.total},
                    exact("exact", path.time, theirs.kinetic),
                    exact("", path.time, theirs.potential),
                    exact("", path.time, theirs.total)};
    return panel;
}
}  // namespace

Series velocity_series(const std::string& name, const CaseRun& run)
{
    Series series = sampled(name, run.column("block.velocity_y"), 1, run.column("block.velocity_y").size(), run.step());
    for (double& t : series.x)
        t -= 0.5 * run.step();
    return series;
}

void BounceFigures::add_histories(const CaseRun& run, const std::string& method)
{
    const ExactBounce path = exact_bounce();
    Panel velocity{.title = method, .x_label = "time [s]", .y_label = "velocity [m/s]"};
    velocity.series = {velocity_series("hdem", run), exact("exact", path.time, path.velocity)};
    velocity_.push_back(velocity);

    Panel height{.title = method, .x_label = "time [s]", .y_label = "height of the lower face [m]"};
    height.series = {sampled("hdem", run.column("block.position_y"), 0, run.column("block.position_y").size(), run.step()),
                     exact("exact", path.time, path.height)};
    for (double& y : height.series[0].y)
        y -= half_block;
    height_.push_back(height);
    energy_.push_back(energy_panel(run, method, path));
}

void BounceFigures::add_steps(const std::string& method, const std::vector<Series>& velocities, const Series& errors,
                              const Series& paper_errors)
{
    const ExactBounce path = exact_bounce();
    Panel panel{.title = method, .x_label = "time [s]", .y_label = "velocity [m/s]"};
    panel.series = velocities;
    panel.series.push_back(exact("exact", path.time, path.velocity));
    steps_.push_back(panel);
    errors_.push_back({.title = method,
                       .x_label = "time step [s]",
                       .y_label = "mean error [m/s]",
                       .log_x = true,
                       .log_y = true,
                       .series = {errors, paper_errors},
                       .marks = {}});
}

void BounceFigures::add_to(Report& report) const
{
    Figure histories{.id = "fig7",
                     .title = "Bouncing block: velocity, height, energy",
                     .source = "Fig. 7; exact: free flight, speed halved at each impact",
                     .note = "Step 5e-5 s. Energy stored in contact springs during an impact is not part of the sum.",
                     .columns = 3};
    for (const std::vector<Panel>* row : {&velocity_, &height_, &energy_})
        histories.panels.insert(histories.panels.end(), row->begin(), row->end());
    report.add_figure(std::move(histories));

    Figure steps{.id = "fig8",
                 .title = "Bouncing block at four time steps",
                 .source = "Fig. 8 (velocity) and Table 4 (mean error, Eq. 34)",
                 .columns = 3};
    steps.panels = steps_;
    steps.panels.insert(steps.panels.end(), errors_.begin(), errors_.end());
    report.add_figure(std::move(steps));
}
}  // namespace hdem::verification
