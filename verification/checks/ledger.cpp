/// The energy ledger against closed forms: A18.

#include "verification/checks/checks.h"
#include "verification/checks/ledger_figure.h"
#include "verification/checks/variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace hdem::verification
{
namespace
{
using Run = std::unique_ptr<CaseRun>;

/// First sample not before time `t`.
const LedgerSample& sample_at(const CaseRun& run, double t)
{
    const auto at = std::ranges::lower_bound(run.ledger(), t, {}, &LedgerSample::time);
    return at == run.ledger().end() ? run.ledger().back() : *at;
}

/// Down the incline of the case file, 30 degrees and a friction angle of 20, from a loaded joint. Each metre, gravity gives
/// m g sin beta and friction takes m g cos beta tan phi; the rest is kinetic.
void check_incline(Report& report)
{
    constexpr double beta_deg = 30.0;
    constexpr double phi_deg = 20.0;
    const double given = density * g * std::sin(radians(beta_deg));
    const double taken = density * g * std::cos(radians(beta_deg)) * std::tan(radians(phi_deg));
    std::array<Run, 3> runs;
    std::vector<LedgerRun> drawn;
    for (std::size_t i = 0; i < runs.size(); ++i)
    {
        const std::string method = all_methods[i];
        runs[i] = std::make_unique<CaseRun>(
            report, "sliding/incline.toml",
            Overrides{set("contact.method", method), set("stage[1].damping", std::string("dynamic"))});
        drawn.push_back({method, *runs[i]});
        const double way = runs[i]->column("block.displacement_x").back();
        const EnergyLedger& sums = runs[i]->state().ledger;
        report.require({fmt::format("incline, {}: work of gravity [J]", method), "m g sin β s", given * way, sums.gravity_work},
                       relative(1e-4));
        report.require({fmt::format("incline, {}: spent by friction [J]", method), "m g cos β tan φ s", taken * way,
                        sums.friction + sums.impulse_loss},
                       relative(1e-3));
        report.require({fmt::format("incline, {}: kinetic at the end [J]", method), "m g (sin β − cos β tan φ) s",
                        (given - taken) * way, runs[i]->ledger().back().stored.kinetic},
                       relative(1e-3));
    }
    report.add_figure(ledger_figure("ledger_incline", "Energy ledger of the block on an incline (A1)", drawn));
}

/// The first impact with restitution 0.5 takes three quarters of the energy; in the end all of it is spent.
void check_bounce(Report& report)
{
    constexpr double between_impacts = 0.7;  ///< [s]
    constexpr double restitution = 0.5;
    const double energy = density * g;
    std::array<Run, 3> runs;
    std::vector<LedgerRun> drawn;
    for (std::size_t i = 0; i < runs.size(); ++i)
    {
        const std::string method = all_methods[i];
        runs[i] = std::make_unique<CaseRun>(report, "paper_dynamic/dynamic.toml", Overrides{set("contact.method", method)});
        drawn.push_back({method, *runs[i]});
        const EnergyLedger& sums = sample_at(*runs[i], between_impacts).sums;
        const Quantity first{fmt::format("bounce, {}: spent in the first impact [J]", method), "(1 − e²) m g h",
                             (1.0 - restitution * restitution) * energy,
                             sums.impulse_loss + sums.local_damping + sums.global_damping};
        method == "force" ? report.inform(first) : report.require(first, relative(1e-3));
    }
    report.add_figure(ledger_figure("ledger_bounce", "Energy ledger of the bouncing block (A5)", drawn));
}

void check_a18(Report& report)
{
    check_incline(report);
    check_bounce(report);
}
}  // namespace

std::vector<Check> ledger_checks()
{
    return {{"closed_form.A18", "energy ledger: work of gravity, friction, impacts", check_a18}};
}
}  // namespace hdem::verification
