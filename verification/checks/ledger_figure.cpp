#include "verification/checks/ledger_figure.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

namespace hdem::verification
{
namespace
{
struct Term
{
    std::string name;
    std::function<double(const LedgerSample&)> value;
};

/// Energy that came in is positive, and so is what is stored or spent.
const std::vector<Term>& all_terms()
{
    static const std::vector<Term> terms = []
    {
        std::vector<Term> all{
            {"kinetic", [](const LedgerSample& s) { return s.stored.kinetic; }},
            {"in springs", [](const LedgerSample& s) { return s.stored.elastic_normal + s.stored.elastic_shear; }}};
        for (const LedgerTerm& term : ledger_terms)
        {
            if (term.side == LedgerSide::aside)
                continue;
            std::string name = term.name;
            std::ranges::replace(name, '_', ' ');
            all.push_back({name, [value = term.value](const LedgerSample& s) { return s.sums.*value; }});
        }
        return all;
    }();
    return terms;
}

double greatest_of(const Term& term, const std::vector<LedgerSample>& samples)
{
    double greatest = 0.0;
    for (const LedgerSample& sample : samples)
        greatest = std::max(greatest, std::abs(term.value(sample)));
    return greatest;
}

double greatest_of_all(const std::vector<LedgerSample>& samples)
{
    double greatest = 0.0;
    for (const Term& term : all_terms())
        greatest = std::max(greatest, greatest_of(term, samples));
    return greatest;
}

Panel terms_panel(const LedgerRun& run)
{
    const std::vector<LedgerSample>& samples = run.run.ledger();
    const double greatest = greatest_of_all(samples);
    const double unit = greatest >= 1e6 ? 1e6 : (greatest >= 1e3 ? 1e3 : 1.0);
    Panel panel{.title = run.name,
                .x_label = "time [s]",
                .y_label = unit == 1e6 ? "energy [MJ]" : (unit == 1e3 ? "energy [kJ]" : "energy [J]")};
    for (const Term& term : all_terms())
    {
        if (greatest_of(term, samples) < 1e-3 * greatest)
            continue;
        Series series{.name = term.name};
        for (const LedgerSample& sample : samples)
        {
            series.x.push_back(sample.time);
            series.y.push_back(term.value(sample) / unit);
        }
        panel.series.push_back(series);
    }
    return panel;
}

Series residual_series(const LedgerRun& run)
{
    const double greatest = greatest_of_all(run.run.ledger());
    Series series{.name = run.name};
    for (const LedgerSample& sample : run.run.ledger())
        if (const double off = std::abs(residual(sample.sums, sample.stored)); off > 0.0)  // a logarithm knows no zero
        {
            series.x.push_back(sample.time);
            series.y.push_back(off / greatest);
        }
    return series;
}
}  // namespace

Figure ledger_figure(const std::string& id, const std::string& title, const std::vector<LedgerRun>& runs)
{
    Figure figure{
        .id = id,
        .title = title,
        .source = "Energy balance: what came in less what is stored or spent",
        .note = "Terms below a thousandth of the greatest are left out. Residual: share of the greatest term of that run.",
        .columns = 2};
    Panel residuals{.title = "residual", .x_label = "time [s]", .y_label = "|residual| / greatest term [-]", .log_y = true};
    double end = 0.0;
    bool impulses = false;
    for (const LedgerRun& run : runs)
    {
        figure.panels.push_back(terms_panel(run));
        residuals.series.push_back(residual_series(run));
        end = std::max(end, run.run.state().time);
        impulses = impulses || run.run.had_impulses();
    }
    residuals.series.push_back(level("bar", Origin::exact, 1e-6, 0.0, end));
    if (impulses)
        residuals.series.push_back(level("bar with impulses", Origin::exact, 1e-4, 0.0, end));
    figure.panels.push_back(residuals);
    return figure;
}
}  // namespace hdem::verification
