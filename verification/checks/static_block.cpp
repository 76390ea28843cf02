/// Static condition test, [Lee2025] sect. 4.1: Table 2, Figs. 3 to 5.

#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr const char* case_file = "paper_static/static.toml";
constexpr std::int64_t loaded_from = 5000;  ///< cycle
const double weight = 2700.0 * 9.81;
const double strength = weight / std::numbers::sqrt3 + 1e4;
constexpr double shear_stiffness = 5e8;  ///< [N/m], contact length 1 m
constexpr double converged_below = 5e-6;

/// When a force converges to its exact value, counted from `begin`.
struct Convergence
{
    std::int64_t first = -1;      ///< first cycle at which the relative error is below the limit
    double error = 1.0;           ///< relative, there
    std::int64_t last_above = 0;  ///< last cycle at which it is not
};

/// force[c] is what acted in cycle c (the first cycle is 1).
Convergence find_convergence(const std::vector<double>& force, double exact, std::int64_t begin, std::int64_t end)
{
    Convergence found;
    for (std::int64_t c = begin + 1; c <= end; ++c)
    {
        const double error = std::abs(std::abs(force[c]) - exact) / exact;
        if (error < converged_below && found.first < 0)
        {
            found.first = c - begin;
            found.error = error;
        }
        if (error >= converged_below)
            found.last_above = c - begin;
    }
    return found;
}

struct Forces
{
    Convergence normal;
    Convergence shear;
};

/// A panel of Fig. 3 or 4: the force of each cycle, or with the impulse-based method the impulse F dt, as the paper draws it.
struct ForcePlot
{
    const char* method;
    const char* component;  ///< "normal", "shear"
    double exact;           ///< [N]
    std::int64_t begin;     ///< cycle from which convergence counts
    double paper_cycle;     ///< Table 2
};

Panel force_panel(const CaseRun& run, const ForcePlot& plot)
{
    const bool impulse = std::string(plot.method) == "impulse";
    const double factor = impulse ? run.step() : 1e-3;
    std::vector<double> force = run.column(fmt::format("contact.{}_force", plot.component));
    const Convergence found = find_convergence(force, plot.exact, plot.begin, plot.begin + 1000);
    for (double& f : force)
        f = factor * std::abs(f);
    const double exact = factor * plot.exact;
    const auto begin = static_cast<double>(plot.begin);
    const double shown = impulse ? 30.0 : 600.0;
    const auto first = static_cast<std::size_t>(plot.begin);  // the cycle before: nothing has acted yet
    Panel panel{.title = plot.method,
                .x_label = "cycle",
                .y_label = fmt::format("{} {}", plot.component, impulse ? "impulse [N s]" : "force [kN]")};
    panel.series = {sampled("hdem", force, first, first + static_cast<std::size_t>(shown) + 1),
                    level("exact", Origin::exact, exact, begin, begin + shown),
                    point("first within 5e-6, hdem", Origin::ours, begin + static_cast<double>(found.first), exact),
                    point("the same, Table 2", Origin::paper, begin + plot.paper_cycle, exact)};
    return panel;
}

struct ForceFigures
{
    Figure normal{.id = "fig3",
                  .title = "Normal force of the block at rest",
                  .source = "Fig. 3; exact: weight 26 487 N, impulse 1.32435 N s a cycle",
                  .columns = 3};
    Figure shear{.id = "fig4",
                 .title = "Shear force of the pushed block",
                 .source = "Fig. 4; exact: strength 25 292.3 N, impulse 1.2646 N s a cycle",
                 .note = "The push of 25 380 N, which exceeds the strength, begins at cycle 5000.",
                 .columns = 3};
};

Forces run_method(Report& report, const std::string& method, const std::string& scale, ForceFigures* figures = nullptr,
                  const std::array<double, 2>& paper_cycles = {})
{
    const CaseRun run(report, case_file, {set("contact.method", method), set("contact.threshold_scale", scale)});
    if (figures != nullptr)
    {
        figures->normal.panels.push_back(force_panel(run, {method.c_str(), "normal", weight, 0, paper_cycles[0]}));
        figures->shear.panels.push_back(force_panel(run, {method.c_str(), "shear", strength, loaded_from, paper_cycles[1]}));
    }
    return {.normal = find_convergence(run.column("contact.normal_force"), weight, 0, loaded_from),
            .shear = find_convergence(run.column("contact.shear_force"), strength, loaded_from, run.state().cycle)};
}

void show_convergence(Report& report, const std::string& name, const Convergence& found)
{
    report.require({name + ", relative error there [-]", "Table 2", converged_below, found.error}, at_most());
    report.inform(name + ", below 5e-6 for good after [cycle]", "-", static_cast<double>(found.last_above));
}

void check_table2(Report& report)
{
    const auto cycle = [](const Convergence& c) { return static_cast<double>(c.first); };
    ForceFigures figures;
    const Forces force = run_method(report, "force", "model", &figures, {397.0, 161.0});
    report.require({"F_N force, first below 5e-6 [cycle]", "Table 2", 397.0, cycle(force.normal)}, relative(0.05));
    show_convergence(report, "F_N force", force.normal);
    report.require({"F_S force, first below 5e-6 [cycle after loading]", "Table 2", 161.0, cycle(force.shear)}, relative(0.05));
    show_convergence(report, "F_S force", force.shear);

    const Forces impulse = run_method(report, "impulse", "model", &figures, {16.0, 3.0});
    report.require({"F_N impulse, first below 5e-6 [cycle]", "Table 2", 16.0, cycle(impulse.normal)}, at_most());
    show_convergence(report, "F_N impulse", impulse.normal);
    report.require({"F_S impulse, first below 5e-6 [cycle after loading]", "Table 2", 3.0, cycle(impulse.shear)}, at_most());
    show_convergence(report, "F_S impulse", impulse.shear);

    // C_scale by Eq. (28): the whole model over a block.
    const Forces hybrid = run_method(report, "hybrid", "model", &figures, {396.0, 161.0});
    report.require({"F_N hybrid, first below 5e-6 [cycle]", "Table 2", 397.0, cycle(hybrid.normal)}, relative(0.05));
    report.require({"F_N hybrid against force [cycle]", "Table 2", cycle(force.normal), cycle(hybrid.normal)}, absolute(2.0));
    show_convergence(report, "F_N hybrid", hybrid.normal);
    report.require({"F_S hybrid, first below 5e-6 [cycle after loading]", "Table 2", 161.0, cycle(hybrid.shear)}, relative(0.05));
    report.require({"F_S hybrid against force [cycle]", "Table 2", cycle(force.shear), cycle(hybrid.shear)}, absolute(2.0));
    show_convergence(report, "F_S hybrid", hybrid.shear);

    // With C_scale = 1 a block at rest on springs that have stored nothing is at the threshold at once.
    const Forces at_one = run_method(report, "hybrid", "1");
    report.inform({"F_N hybrid, C_scale = 1: first below 5e-6 [cycle]", "Table 2", 397.0, cycle(at_one.normal)});
    report.inform({"F_S hybrid, C_scale = 1: first below 5e-6 [cycle after loading]", "Table 2", 161.0, cycle(at_one.shear)});
    report.add_figure(std::move(figures.normal));
    report.add_figure(std::move(figures.shear));
}

/// Where the elastic line meets the plateau. A cycle's force is found at the poses of its start, so force c belongs to displacement c - 1.
double displacement_at_strength(const CaseRun& run)
{
    const std::vector<double>& force = run.column("contact.shear_force");
    const std::vector<double>& way = run.column("contact.shear_displacement");
    for (std::size_t c = loaded_from + 2; c + 1 < force.size(); ++c)
        if (std::abs(force[c + 1]) >= strength * (1.0 - 1e-3) && std::abs(force[c + 1] - force[c + 2]) < 1e-4 * strength)
        {
            const double slope = (force[c] - force[c - 1]) / (way[c - 1] - way[c - 2]);
            return way[c - 1] + (strength - std::abs(force[c])) / std::abs(slope);
        }
    return std::nan("");
}

Panel displacement_panel(const CaseRun& run, const std::string& method)
{
    const std::vector<double>& force = run.column("contact.shear_force");
    const std::vector<double>& way = run.column("contact.shear_displacement");
    constexpr double shown = 0.15;  // [mm]
    Series ours{.name = "hdem"};
    for (std::size_t c = loaded_from + 1; c < force.size() && 1e3 * way[c - 1] < shown; ++c)
    {
        ours.x.push_back(1e3 * way[c - 1]);
        ours.y.push_back(1e-3 * std::abs(force[c]));
    }
    const double slips_at = method == "impulse" ? 0.0 : 1e3 * strength / shear_stiffness;
    Panel panel{.title = method, .x_label = "shear displacement [mm]", .y_label = "shear force [kN]"};
    panel.series = {
        ours,
        {.name = "exact", .origin = Origin::exact, .x = {0.0, slips_at, shown}, .y = {0.0, 1e-3 * strength, 1e-3 * strength}}};
    if (method != "impulse")
        panel.series.push_back(point("onset of slip, Fig. 5", Origin::paper, 5.06e-2, 25.2923));
    return panel;
}

void check_fig5(Report& report)
{
    Figure figure{.id = "fig5",
                  .title = "Shear force against shear displacement",
                  .source = "Fig. 5; exact: K_S u up to the strength 25 292.3 N, at 5.06e-2 mm; impulses: rigid",
                  .columns = 3};
    for (const char* method : {"force", "hybrid"})
    {
        const CaseRun run(report, case_file,
                          {set("contact.method", std::string(method)), set("contact.threshold_scale", std::string("model"))});
        report.require({fmt::format("plateau of the shear force, {} [N]", method), "Fig. 5", 25292.3,
                        std::abs(run.column("contact.shear_force").back())},
                       relative(1e-3));
        report.require({fmt::format("shear displacement where it begins, {} [mm]", method), "Fig. 5", 5.06e-2,
                        1e3 * displacement_at_strength(run)},
                       relative(1e-3));
        figure.panels.push_back(displacement_panel(run, method));
    }
    const CaseRun run(report, case_file, {set("contact.method", std::string("impulse"))});
    report.require(
        {"plateau of the shear force, impulse [N]", "Fig. 5", 25292.3, std::abs(run.column("contact.shear_force").back())},
        relative(1e-3));
    report.inform("shear displacement in the cycle that reaches it, impulse [mm]", "Fig. 5b: no elastic phase",
                  1e3 * run.column("contact.shear_displacement")[loaded_from + 1]);
    figure.panels.insert(figure.panels.begin() + 1, displacement_panel(run, "impulse"));
    report.add_figure(std::move(figure));
}
}  // namespace

std::vector<Check> static_block_checks()
{
    return {{"paper.table2", "convergence of contact forces on a block at rest, then pushed", check_table2},
            {"paper.fig5", "shear force against shear displacement", check_fig5}};
}
}  // namespace hdem::verification
