#include "verification/checks/report.h"

#include "verification/checks/case_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem::verification
{
namespace
{
bool is_met(const Quantity& q, const Bar& bar)
{
    const double off = std::abs(q.measured - q.reference);
    switch (bar.kind)  // each comparison is false for a value that is not a number
    {
    case Bar::Kind::relative:
        return off <= bar.tolerance * std::abs(q.reference);
    case Bar::Kind::absolute:
        return off <= bar.tolerance;
    case Bar::Kind::at_most:
        return q.measured <= q.reference;
    case Bar::Kind::at_least:
        return q.measured >= q.reference;
    }
    return false;
}
}  // namespace

double Row::deviation() const
{
    const double off = quantity.measured - quantity.reference;
    const bool plain = quantity.reference == 0.0 || (bar && bar->kind == Bar::Kind::absolute);
    return plain ? off : off / std::abs(quantity.reference);
}

std::string Row::deviation_text() const
{
    if (std::isnan(quantity.reference))
        return "";
    const bool plain = quantity.reference == 0.0 || (bar && bar->kind == Bar::Kind::absolute);
    return plain ? fmt::format("{:+.3g}", deviation()) : fmt::format("{:+.3g} %", 100.0 * deviation());
}

std::string Row::bar_text() const
{
    if (!bar)
        return "none";
    switch (bar->kind)
    {
    case Bar::Kind::relative:
        return fmt::format("± {:.3g} %", 100.0 * bar->tolerance);
    case Bar::Kind::absolute:
        return fmt::format("± {:.3g}", bar->tolerance);
    case Bar::Kind::at_most:
        return "at most";
    case Bar::Kind::at_least:
        return "at least";
    }
    return "";
}

void Report::require(Quantity quantity, Bar bar)
{
    const Verdict verdict = is_met(quantity, bar) ? Verdict::pass : Verdict::miss;
    rows_.push_back({.quantity = std::move(quantity), .bar = bar, .verdict = verdict});
}

void Report::inform(Quantity quantity)
{
    rows_.push_back({.quantity = std::move(quantity)});
}

void Report::inform(const std::string& name, const std::string& source, double measured)
{
    inform({.name = name, .source = source, .reference = std::numeric_limits<double>::quiet_NaN(), .measured = measured});
}

void Report::add_figure(Figure figure)
{
    for (Panel& panel : figure.panels)
        for (Series& series : panel.series)
            thin(series, most_points);
    figures_.push_back(std::move(figure));
}

void Report::add_run(const CaseRun& run)
{
    Ledger& ledger = run.had_impulses() ? with_impulses_ : without_impulses_;
    ++ledger.runs;
    ledger.worst = std::max(ledger.worst, run.worst_residual());
    commands_.push_back(run.command());
}

void Report::close()
{
    const auto add = [this](const Ledger& ledger, const char* kind, double limit)
    {
        if (ledger.runs > 0)
            require({.name = fmt::format("energy ledger, worst residual of {} run{} {} impulses [-]", ledger.runs,
                                         ledger.runs == 1 ? "" : "s", kind),
                     .source = "energy balance",
                     .reference = limit,
                     .measured = ledger.worst},
                    at_most());
    };
    add(without_impulses_, "without", 1e-6);
    add(with_impulses_, "with", 1e-4);
}

bool Report::has_missed() const
{
    return std::ranges::any_of(rows_, [](const Row& row) { return row.verdict == Verdict::miss; });
}
}  // namespace hdem::verification
