#include "io/run_recorder.h"

#include "core/check.h"
#include "core/energy_ledger.h"
#include "core/motion/equilibrium.h"

#include <algorithm>

namespace hdem
{
namespace
{
/// Above, a copy takes much memory, and a frame is rarely worth more than a few cycles.
constexpr Index most_blocks_copied = 20'000;

Equilibrium equilibrium_of(const Model& model, const State& state)
{
    Equilibrium sums;
    add_equilibrium({0, state.blocks.size()}, model, state, ConvergenceBlocks::all, sums);
    return sums;
}

RunRecorder::Quantity points_in(Regime regime)
{
    return [regime](const Model&, const State& state)
    {
        std::int64_t points = 0;
        for (const auto& end : state.contacts.regime)
            points += std::count(end.begin(), end.end(), static_cast<std::uint8_t>(regime));
        return static_cast<double>(points);
    };
}
}  // namespace

RunRecorder::RunRecorder(std::filesystem::path folder, const Model& model, Provenance provenance)
    : frames_(folder, model),
      results_(folder / "results.h5", std::move(provenance))
{
    add_tables(model);
}

RunRecorder::RunRecorder(std::filesystem::path folder, const Model& model, Provenance provenance, const State& restart,
                         std::span<const Vec2> history_axes)
    : frames_(folder, model, restart),
      results_(folder / "results.h5", std::move(provenance)),
      take_over_(restart.cycle)
{
    add_tables(model);
    for (std::size_t i = 0; i < std::min(samplers_.size(), history_axes.size()); ++i)
        samplers_[i].set_axis(history_axes[i]);
}

std::vector<Vec2> RunRecorder::history_axes() const
{
    std::vector<Vec2> axes;
    for (const HistorySampler& sampler : samplers_)
        axes.push_back(sampler.axis());
    return axes;
}

void RunRecorder::add_tables(const Model& model)
{
    frame_every_ = model.output.frame_every;
    energy_every_ = model.output.row_every;
    for (const HistoryDef& def : model.histories)
    {
        samplers_.emplace_back(model, def);
        const std::string path = "/history/" + def.name;
        const bool taken = std::any_of(results_.tables().begin(), results_.tables().end(),
                                       [&](const Table& table) { return table.path == path; });
        if (taken || def.name.empty() || def.name == "." || def.name.find('/') != std::string::npos)
            throw InputError(Problem{.key = "history",
                                     .text = "history: name = \"" + def.name + "\" (" +
                                             (taken ? "used twice" : "cannot name a group of results.h5") +
                                             "). Give each history a name of its own, without /."});
        table_of_sampler_.push_back(results_.add_table(path, samplers_.back().columns()));
    }
    add_energy({"kinetic_energy", "J"}, [](const Model& m, const State& s) { return equilibrium_of(m, s).kinetic_energy; });
    add_energy({"unbalanced_force_ratio", "1"},
               [](const Model& m, const State& s) { return equilibrium_of(m, s).unbalanced_force_ratio(); });
    add_energy({"greatest_speed", "m/s"}, [](const Model& m, const State& s) { return equilibrium_of(m, s).greatest_speed; });
    add_energy({"stick_points", "1"}, points_in(Regime::stick));
    add_energy({"slip_points", "1"}, points_in(Regime::slip));
    add_energy({"impulse_points", "1"}, points_in(Regime::impulse));
    add_ledger();
}

void RunRecorder::add_ledger()
{
    const auto term = [&](const char* name, double EnergyLedger::*field) {
        add_energy({name, "J"}, [field](const Model&, const State& state) { return state.ledger.*field; });
    };
    term("initial", &EnergyLedger::initial);
    term("gravity_work", &EnergyLedger::gravity_work);
    term("load_work", &EnergyLedger::load_work);
    term("position_correction", &EnergyLedger::position_correction);
    term("friction", &EnergyLedger::friction);
    term("local_damping", &EnergyLedger::local_damping);
    term("global_damping", &EnergyLedger::global_damping);
    term("impulse_loss", &EnergyLedger::impulse_loss);
    term("contact_changes", &EnergyLedger::contact_changes);
    term("removed", &EnergyLedger::removed);
    add_energy({"elastic_normal", "J"}, [](const Model& m, const State& s) { return stored_energy(m, s).elastic_normal; });
    add_energy({"elastic_shear", "J"}, [](const Model& m, const State& s) { return stored_energy(m, s).elastic_shear; });
    add_energy({"residual", "J"}, [](const Model& m, const State& s) { return residual(s.ledger, stored_energy(m, s)); });
}

void RunRecorder::add_energy(Column column, Quantity quantity)
{
    energy_columns_.push_back(std::move(column));
    energies_.push_back(std::move(quantity));
}

std::int64_t RunRecorder::next_cycle(std::int64_t now) const
{
    std::int64_t next = std::min(next_multiple(now, energy_every_), next_multiple(now, frame_every_));
    for (const HistorySampler& sampler : samplers_)
        next = std::min(next, sampler.next_after(now));
    return next;
}

void RunRecorder::begin_tables()
{
    energy_table_ = results_.add_table("/energy", energy_columns_);
    has_tables_ = true;
    if (take_over_ < 0)
        return;
    results_.take_over_rows(take_over_);
    write_results();
    frames_.remove_younger_frames();
}

void RunRecorder::begin_stage(const Model&, const State&)
{
    if (!has_tables_)
        begin_tables();
}

void RunRecorder::observe(const Model& model, const State& state)
{
    if (!has_tables_)
    {
        begin_tables();
        sample_all(model, state);
        write_frame(model, state);  // the state before the first cycle
        write_results();
        return;
    }
    for (std::size_t i = 0; i < samplers_.size(); ++i)
    {
        if (!samplers_[i].is_due(state.cycle))
            continue;
        row_.resize(samplers_[i].columns().size());
        samplers_[i].sample(model, state, row_);
        results_.add_row(table_of_sampler_[i], state.cycle, state.time, row_);
    }
    if (next_multiple(state.cycle - 1, energy_every_) == state.cycle)
        sample_energies(model, state);
    if (next_multiple(state.cycle - 1, frame_every_) == state.cycle)
        write_frame(model, state);
    if (results_.is_due())
        write_results();
}

void RunRecorder::end_stage(const Model& model, const State& state)
{
    sample_all(model, state);
    write_frame(model, state);
    write_results();
}

void RunRecorder::sample_all(const Model& model, const State& state)
{
    for (std::size_t i = 0; i < samplers_.size(); ++i)
    {
        row_.resize(samplers_[i].columns().size());
        samplers_[i].sample(model, state, row_);
        results_.add_row(table_of_sampler_[i], state.cycle, state.time, row_);
    }
    sample_energies(model, state);
}

void RunRecorder::sample_energies(const Model& model, const State& state)
{
    row_.clear();
    for (const Quantity& quantity : energies_)
        row_.push_back(quantity(model, state));
    results_.add_row(energy_table_, state.cycle, state.time, row_);
}

void RunRecorder::write_frame(const Model& model, const State& state)
{
    await_frame();
    if (!frames_.frames().empty() && frames_.frames().back().cycle == state.cycle)
        return;
    if (model.blocks() > most_blocks_copied)
        frames_.write(model, state);
    else
        frame_ = std::async(std::launch::async, [this, model, state] { frames_.write(model, state); });
}

void RunRecorder::await_frame()
{
    if (frame_.valid())
        frame_.get();
}

void RunRecorder::write_results()
{
    await_frame();
    frames_.write_series();
    results_.write(frames_.frames(), frames_.has_contacts());
}

void RunRecorder::show_interruption(const Model& model, const State& state)
{
    write_frame(model, state);
    write_results();
}

void RunRecorder::finish(const Model& model, const State& state)
{
    if (!has_tables_)
        observe(model, state);
    sample_all(model, state);
    write_frame(model, state);
    results_.provenance().end = timestamp();
    write_results();
}
}  // namespace hdem
