#include "verification/checks/case_run.h"

#include "core/history_sampler.h"
#include "core/observer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hdem::verification
{
namespace
{
/// Samples the histories of the case into columns.
class Histories final : public Observer
{
  public:
    Histories(const Model& model, std::map<std::string, std::vector<double>>& columns)
    {
        for (const HistoryDef& def : model.histories)
        {
            History& history = histories_.emplace_back(History{HistorySampler(model, def), {}, {}});
            for (const Column& column : history.sampler.columns())
                history.target.push_back(&columns[history.sampler.name() + '.' + column.name]);
            history.values.resize(history.target.size());
        }
    }
    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override
    {
        std::int64_t next = never;
        for (const History& history : histories_)
            next = std::min(next, history.sampler.next_after(now));
        return next;
    }
    void observe(const Model& model, const State& state) override
    {
        for (History& history : histories_)
        {
            if (!history.sampler.is_due(state.cycle))
                continue;
            history.sampler.sample(model, state, history.values);
            for (std::size_t i = 0; i < history.values.size(); ++i)
                history.target[i]->push_back(history.values[i]);
        }
    }

  private:
    struct History
    {
        HistorySampler sampler;
        std::vector<std::vector<double>*> target;
        std::vector<double> values;
    };
    std::vector<History> histories_;
};

class EnergyWatch final : public Observer
{
  public:
    EnergyWatch(std::vector<LedgerSample>& samples, std::int64_t every) : samples_(samples), every_(every) {}
    /// Greatest residual as a share of the greatest term of the whole run: a block at rest has no energy to compare with.
    [[nodiscard]] double worst() const { return residual_ > 0.0 ? residual_ / greatest_ : 0.0; }
    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override { return next_multiple(now, every_); }
    void observe(const Model& model, const State& state) override
    {
        if (state.cycle == 0)
            return;
        samples_.push_back({.time = state.time, .sums = state.ledger, .stored = stored_energy(model, state)});
        add(state.ledger, samples_.back().stored);
    }

  private:
    void add(const EnergyLedger& ledger, const StoredEnergy& stored)
    {
        const double off = std::abs(residual(ledger, stored));
        residual_ = std::max(residual_, off);
        if (off > 0.0)
            greatest_ = std::max(greatest_, off / std::abs(relative_residual(ledger, stored)));
    }
    std::vector<LedgerSample>& samples_;
    double residual_ = 0.0;  ///< [J]
    double greatest_ = 0.0;  ///< [J]
    std::int64_t every_;
};

class Watching final : public Observer
{
  public:
    Watching(const CaseRun::Watch& watch, std::int64_t every) : watch_(watch), every_(every) {}
    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override { return next_multiple(now, every_); }
    void observe(const Model& model, const State& state) override { watch_(model, state); }

  private:
    const CaseRun::Watch& watch_;
    std::int64_t every_;
};

std::string command_line(const std::string& case_file, const Overrides& overrides)
{
    std::string text = "hdem run verification/cases/" + case_file;
    for (const Override& o : overrides)
        text += " --set '" + o.key + '=' + o.value + '\'';
    return text;
}

std::string vector_text(const Vec2& v)
{
    return fmt::format("[{:.17g}, {:.17g}]", v.x(), v.y());
}
}  // namespace

std::filesystem::path& case_folder()
{
    static std::filesystem::path folder;
    return folder;
}

Override set(const std::string& key, double value)
{
    return {key, fmt::format("{:.17g}", value)};
}

Override set(const std::string& key, const Vec2& value)
{
    return {key, vector_text(value)};
}

Override set(const std::string& key, const Polygon& value)
{
    std::string text;
    for (const Vec2& v : value)
        text += (text.empty() ? "[" : ", ") + vector_text(v);
    return {key, text + ']'};
}

Override set(const std::string& key, const std::string& word)
{
    return {key, word};
}

Overrides operator+(Overrides first, const Overrides& second)
{
    first.insert(first.end(), second.begin(), second.end());
    return first;
}

CaseRun::CaseRun(const std::string& case_file, const Overrides& overrides)
    : loaded_(load_case(case_folder() / case_file, overrides)),
      simulation_(loaded_.setup.model, loaded_.setup.state),
      command_(command_line(case_file, overrides))
{
    if (const std::vector<Problem> problems = simulation_.find_problems(); !problems.empty())
        throw InputError(loaded_.file.source.located(problems));
}

CaseRun::CaseRun(Report& report, const std::string& case_file, const Overrides& overrides, const Watch& watch)
    : CaseRun(case_file, overrides)
{
    run(watch);
    report.add_run(*this);
}

void CaseRun::run(const Watch& watch, std::int64_t watch_every)
{
    Histories histories(model(), columns_);
    EnergyWatch energies(ledger_, std::min<std::int64_t>(model().output.row_every, 100));
    Watching watching(watch, watch_every);
    std::vector<Observer*> observers{&histories, &energies};
    if (watch)
        observers.push_back(&watching);
    stages_ = run_stages(simulation_, observers);
    worst_residual_ = energies.worst();
}

Index CaseRun::block(const std::string& name) const
{
    return model().find_block(name);
}

const std::vector<double>& CaseRun::column(const std::string& name) const
{
    const auto at = columns_.find(name);
    if (at == columns_.end())
        throw RunError(fmt::format("{}: no history \"{}\". Add it to the case file.", command_, name));
    return at->second;
}

bool CaseRun::had_impulses() const
{
    const EnergyLedger& ledger = state().ledger;
    return ledger.impulse_loss != 0.0 || ledger.position_correction != 0.0;
}
}  // namespace hdem::verification
