/// Tunnel excavation, [Lee2025] sect. 4.4: Table 6, Figs. 11 to 13.

#include "verification/checks/checks.h"
#include "verification/checks/ledger_figure.h"
#include "verification/checks/tunnel_figures.h"

#include <fmt/format.h>

#include <cmath>
#include <future>
#include <memory>

namespace hdem::verification
{
namespace
{
/// Column of Table 6.
struct PaperResult
{
    double cycles = 0.0;             ///< after the excavation
    double kinetic_energy = 0.0;     ///< mean over the blocks next to the excavation [J]
    double mean_displacement = 0.0;  ///< of these [mm]
    double max_displacement = 0.0;   ///< [mm]
};
constexpr PaperResult paper_force{94502.0, 1.96e-8, 0.64, 1.14};
constexpr PaperResult paper_hybrid{32709.0, 4.88e-9, 0.70, 1.15};

/// Over the blocks next to the excavation that did not detach.
struct NearBlocks
{
    double kinetic_energy = 0.0;  ///< mean, of all next to it [J]
    double at_rest = 0.0;         ///< mean kinetic energy [J]
    Vec2 mean = {0.0, 0.0};       ///< of |u_x|, |u_y| [m]
    Vec2 greatest = {0.0, 0.0};   ///< of these [m]
};

NearBlocks look_at_near_blocks(const CaseRun& run)
{
    const State& state = run.state();
    NearBlocks near;
    int counted = 0;
    for (const Index i : state.next_to_excavation)
    {
        const double energy = kinetic_energy(run.model(), state.blocks, i);
        near.kinetic_energy += energy / static_cast<double>(state.next_to_excavation.size());
        const Vec2 moved = state.blocks.displacement(i).cwiseAbs();
        if (!state.blocks.is_free(i) || moved.norm() > run.model().convergence.detached_distance)
            continue;
        near.at_rest += energy;
        near.mean += moved;
        near.greatest = near.greatest.cwiseMax(moved);
        ++counted;
    }
    near.mean /= counted > 0 ? counted : 1;
    near.at_rest /= counted > 0 ? counted : 1;
    return near;
}

void show(Report& report, const TunnelRun& tunnel, const PaperResult& paper)
{
    const std::string name = tunnel.name + ": ";
    const StageResult& excavated = tunnel.run.stages().back();
    const DisplacementReport moved = report_displacements(tunnel.run.model(), tunnel.run.state());
    const NearBlocks near = look_at_near_blocks(tunnel.run);
    report.require({name + "converges (1 = yes)", "sect. 4.4", 1.0, excavated.at_rest ? 1.0 : 0.0}, at_least());
    report.inform({name + "cycles after the excavation", "Table 6", paper.cycles, static_cast<double>(excavated.cycles)});
    report.inform({name + "mean kinetic energy of blocks next to it [J]", "Table 6", paper.kinetic_energy, near.kinetic_energy});
    report.inform({name + "the same without detached blocks [J]", "Table 6", paper.kinetic_energy, near.at_rest});
    report.inform({name + "mean displacement of blocks next to it [mm]", "Table 6", paper.mean_displacement, 1e3 * moved.mean});
    report.inform({name + "greatest displacement of these [mm]", "Table 6", paper.max_displacement, 1e3 * moved.greatest});
    report.inform(name + "mean |u_x| of these [mm]", "-", 1e3 * near.mean.x());
    report.inform(name + "greatest |u_x| [mm]", "-", 1e3 * near.greatest.x());
    report.inform(name + "mean |u_y| of these [mm]", "-", 1e3 * near.mean.y());
    report.inform(name + "greatest |u_y| [mm]", "-", 1e3 * near.greatest.y());
    report.inform({name + "detached blocks", "Fig. 11", 6.0, static_cast<double>(moved.detached.size())});
    report.inform({name + "kinetic energy that counts as rest [J]", "sect. 4.4", 0.377, tunnel.limit});
}

/// The force-based run knows no restitution: it belongs to both pairings.
void compare(Report& report, const std::string& pairing, const TunnelRun& force, const TunnelRun& hybrid)
{
    const auto cycles = [](const TunnelRun& t) { return static_cast<double>(t.run.stages().back().cycles); };
    const auto moved = [](const TunnelRun& t) { return report_displacements(t.run.model(), t.run.state()); };
    report.inform({"cycles saved by the hybrid method, " + pairing + " [%]", "Table 6", 65.4,
                   100.0 * (1.0 - cycles(hybrid) / cycles(force))});
    report.inform({"difference of the mean displacements, " + pairing + " [mm]", "Table 6", 0.06,
                   1e3 * std::abs(moved(hybrid).mean - moved(force).mean)});
    report.inform({"difference of the greatest displacements, " + pairing + " [mm]", "Table 6", 0.01,
                   1e3 * std::abs(moved(hybrid).greatest - moved(force).greatest)});
}

/// Where the profiles of Fig. 12 have become level.
void compare_stresses(Report& report, const TunnelRun& force, const TunnelRun& hybrid)
{
    constexpr double from = 8.0;
    constexpr double to = 10.0;
    for (const double angle : profile_angles_deg)
        report.inform({fmt::format("contact stress {:g} to {:g} m from the centre at {:g}°, hybrid [kPa]", from, to, angle),
                       "force-based run, compare Fig. 12", 1e-3 * mean_traction(force.run, angle, from, to),
                       1e-3 * mean_traction(hybrid.run, angle, from, to)});
}

void check_table6(Report& report)
{
    const auto start = [](const char* name, const char* method, double restitution)
    { return std::async(std::launch::async, [=] { return std::make_unique<TunnelRun>(name, method, restitution); }); };
    auto force_run = start("force", "force", 0.1);
    auto hybrid_run = start("hybrid, R = 0.1", "hybrid", 0.1);
    auto matched_run = start("hybrid, R = 1/3", "hybrid", 1.0 / 3.0);
    const auto force = force_run.get();
    const auto hybrid = hybrid_run.get();
    const auto matched = matched_run.get();
    for (const TunnelRun* tunnel : {force.get(), hybrid.get(), matched.get()})
    {
        report.add_run(tunnel->run);
        show(report, *tunnel, tunnel == force.get() ? paper_force : paper_hybrid);
    }
    compare(report, "the paper's α = 0.8, R = 0.1", *force, *hybrid);
    compare(report, "equal loss α = 0.8, R = 1/3", *force, *matched);
    compare_stresses(report, *force, *hybrid);
    report.add_figure(displacement_figure(*force, *hybrid));
    report.add_figure(stress_figure(*force, *hybrid));
    report.add_figure(kinetic_figure(*force, *hybrid, *matched));
    report.add_figure(ledger_figure("ledger_tunnel", "Energy ledger of the tunnel",
                                    {{force->name, force->run}, {hybrid->name, hybrid->run}, {matched->name, matched->run}}));
}
}  // namespace

std::vector<Check> tunnel_checks()
{
    return {{"paper.table6", "tunnel: convergence after the excavation (about a minute)", check_table6, Check::Length::is_long}};
}
}  // namespace hdem::verification
