#include "io/run_recorder.h"

#include "core/check.h"
#include "io/energy_rows.h"

#include <algorithm>

namespace hdem
{
namespace
{
/// Above, a copy takes much memory, and a frame is rarely worth more than a few cycles.
constexpr std::size_t most_copied = 20'000;

/// Blocks and stages. To copy 20 000 stages and free them takes some 5 ms, more than a frame of a small model.
bool is_worth_a_copy(const Model& model)
{
    constexpr std::size_t blocks_a_stage = 10;
    return static_cast<std::size_t>(model.blocks()) + blocks_a_stage * model.stages.size() <= most_copied;
}

/// With more stages than this a frame at the end of a stage comes so many cycles after the last one at the earliest: it takes as long as forty.
constexpr std::size_t many_stages = 1000;
constexpr std::int64_t cycles_a_frame = 1000;
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
    if (!frames_.frames().empty())
        last_frame_cycle_ = frames_.frames().back().cycle;
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
    cycles_a_frame_ = model.stages.size() > many_stages ? cycles_a_frame : 0;
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
    energy_table_ = results_.add_table("/energy", energy_columns());
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
        add_energy_row(model, state);
    if (next_multiple(state.cycle - 1, frame_every_) == state.cycle)
        write_frame(model, state);
    if (results_.is_due())
        write_results();
}

void RunRecorder::end_stage(const Model& model, const State& state)
{
    sample_all(model, state);
    if (state.cycle - last_frame_cycle_ >= cycles_a_frame_)
        write_frame(model, state);
    if (results_.is_due_after_stage())
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
    add_energy_row(model, state);
}

void RunRecorder::add_energy_row(const Model& model, const State& state)
{
    sample_energies(model, state, row_);
    results_.add_row(energy_table_, state.cycle, state.time, row_);
}

void RunRecorder::write_frame(const Model& model, const State& state)
{
    await_frame();
    if (!frames_.frames().empty() && frames_.frames().back().cycle == state.cycle)
        return;
    may_write_();
    last_frame_cycle_ = state.cycle;
    if (!is_worth_a_copy(model))
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
    may_write_();
    frames_.write_series();
    results_.write(frames_.frames(), frames_.kinds());
}

void RunRecorder::take_case(const std::string& text, const std::vector<std::string>& overrides)
{
    results_.provenance().case_text = text;
    results_.provenance().overrides = overrides;
}

void RunRecorder::save()
{
    if (!has_tables_)
        begin_tables();
    write_results();
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
