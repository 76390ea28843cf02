/// Tunnel excavation, [Lee2025] sect. 4.4: Table 6.

#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"

#include <fmt/format.h>

#include <cmath>
#include <future>
#include <limits>
#include <memory>

namespace hdem::verification
{
namespace
{
constexpr const char* case_file = "paper_tunnel/tunnel.toml";

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Column of Table 6.
struct PaperResult
{
    double cycles = nothing;             ///< after the excavation
    double kinetic_energy = nothing;     ///< mean over the blocks next to the excavation [J]
    double mean_displacement = nothing;  ///< of these [mm]
    double max_displacement = nothing;   ///< [mm]
};

struct Pairing
{
    const char* name;
    const char* method;
    double restitution;
    PaperResult paper;
};

double mean_kinetic_energy_near(const CaseRun& run)
{
    const std::vector<Index>& near = run.state().next_to_excavation;
    double sum = 0.0;
    for (const Index i : near)
        sum += kinetic_energy(run.model(), run.state().blocks.motion[i], i);
    return near.empty() ? 0.0 : sum / static_cast<double>(near.size());
}

void show(Report& report, const Pairing& pairing, const CaseRun& run)
{
    const std::string name = pairing.name;
    const StageResult& excavated = run.stages().back();
    const DisplacementReport moved = report_displacements(run.model(), run.state());
    report.require({name + ": converges (1 = yes)", "sect. 4.4", 1.0, excavated.converged ? 1.0 : 0.0}, at_least());
    report.inform({name + ": cycles after the excavation", "Table 6", pairing.paper.cycles, static_cast<double>(excavated.cycles)});
    report.inform({name + ": mean kinetic energy of blocks next to it [J]", "Table 6", pairing.paper.kinetic_energy,
                   mean_kinetic_energy_near(run)});
    report.inform(
        {name + ": mean displacement of blocks next to it [mm]", "Table 6", pairing.paper.mean_displacement, 1e3 * moved.mean});
    report.inform(
        {name + ": greatest displacement of these [mm]", "Table 6", pairing.paper.max_displacement, 1e3 * moved.greatest});
    report.inform({name + ": detached blocks", "Fig. 11", 6.0, static_cast<double>(moved.detached.size())});
}

void check_table6(Report& report)
{
    constexpr std::array<Pairing, 3> pairings{Pairing{"force", "force", 0.1, {94502.0, 1.96e-8, 0.64, 1.14}},
                                              Pairing{"hybrid", "hybrid", 0.1, {32709.0, 4.88e-9, 0.70, 1.15}},
                                              Pairing{"hybrid, R = 1/3 as α = 0.8 acts", "hybrid", 1.0 / 3.0, {}}};
    std::vector<std::future<std::unique_ptr<CaseRun>>> running;
    for (const Pairing& pairing : pairings)
        running.push_back(std::async(std::launch::async,
                                     [&pairing]
                                     {
                                         auto run = std::make_unique<CaseRun>(
                                             case_file, Overrides{set("contact.method", std::string(pairing.method)),
                                                                  set("contact.restitution", pairing.restitution)});
                                         run->run();
                                         return run;
                                     }));
    std::vector<std::unique_ptr<CaseRun>> runs;
    for (std::size_t i = 0; i < pairings.size(); ++i)
    {
        runs.push_back(running[i].get());
        report.add_run(*runs[i]);
        show(report, pairings[i], *runs[i]);
    }
    const auto saved = [&](std::size_t i)
    {
        return 100.0 *
               (1.0 - static_cast<double>(runs[i]->stages().back().cycles) / static_cast<double>(runs[0]->stages().back().cycles));
    };
    report.inform({"cycles saved by the hybrid method, the paper's pairing α = 0.8, R = 0.1 [%]", "Table 6", 65.4, saved(1)});
    report.inform("cycles saved by the hybrid method at equal loss in impacts [%]", "-", saved(2));
    const auto means = [&](std::size_t i) { return report_displacements(runs[i]->model(), runs[i]->state()); };
    report.inform({"difference of the mean displacements, hybrid against force [mm]", "Table 6", 0.06,
                   1e3 * std::abs(means(1).mean - means(0).mean)});
    report.inform(
        {"difference of the greatest displacements [mm]", "Table 6", 0.01, 1e3 * std::abs(means(1).greatest - means(0).greatest)});
}
}  // namespace

std::vector<Check> tunnel_checks()
{
    return {{"paper.table6", "tunnel: convergence after the excavation (about a minute)", check_table6, Check::Length::is_long}};
}
}  // namespace hdem::verification
