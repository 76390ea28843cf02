#pragma once
/// Observer that writes a run's folder: frames, and results.h5 with histories and energies.

#include "core/observer.h"
#include "io/results_writer.h"

#include <filesystem>
#include <functional>
#include <future>
#include <span>
#include <string>
#include <vector>

namespace hdem
{
/// Frames of small models are written beside the cycles that follow, from a copy of the state; whatever else it writes waits for them.
class RunRecorder : public Observer
{
  public:
    /// A new run in FOLDER; frames of an earlier one are removed. Throws InputError for a history that cannot be sampled.
    RunRecorder(std::filesystem::path folder, const Model& model, Provenance provenance);
    /// Goes on at `restart`, with the axes that were saved with it: frames and rows of the folder up to its cycle stay, younger ones go.
    RunRecorder(std::filesystem::path folder, const Model& model, Provenance provenance, const State& restart,
                std::span<const Vec2> history_axes);

    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override;
    void begin_stage(const Model& model, const State& state) override;
    void observe(const Model& model, const State& state) override;
    void end_stage(const Model& model, const State& state) override;

    /// What is called before anything is written under a name in the folder; it may throw.
    void ask_before_writing(std::function<void()> check) { may_write_ = std::move(check); }
    /// The case of these results has changed in stages to come.
    void take_case(const std::string& text, const std::vector<std::string>& overrides);
    /// Rows that are still in memory go to the disk: what a checkpoint needs beside it.
    void save();
    /// What histories between two blocks remember, one for each history; for a checkpoint.
    [[nodiscard]] std::vector<Vec2> history_axes() const;
    /// A frame of this state, unless the last one shows the same cycle. Throws RunError, also of the frame before.
    void write_frame(const Model& model, const State& state);
    /// Wait until the last frame is on the disk. Throws RunError where it could not be written.
    void await_frame();
    /// Write a frame and rows of this state, and everything that is still in memory. For a run that ends or fails, not for one that is
    /// to go on from a checkpoint: it would not have these rows without the break.
    void finish(const Model& model, const State& state);
    /// A frame of a run that is broken off. It goes when the run goes on.
    void show_interruption(const Model& model, const State& state);

  private:
    void add_tables(const Model& model);
    void begin_tables();
    void sample_all(const Model& model, const State& state);
    void add_energy_row(const Model& model, const State& state);
    void write_results();

    FrameWriter frames_;
    ResultsWriter results_;
    std::int64_t frame_every_ = 0;
    std::int64_t energy_every_ = 0;
    std::int64_t cycles_a_frame_ = 0;  ///< at least, to one at the end of a stage
    std::int64_t last_frame_cycle_ = 0;
    std::vector<HistorySampler> samplers_;
    std::vector<std::size_t> table_of_sampler_;
    std::size_t energy_table_ = 0;
    bool has_tables_ = false;
    std::int64_t take_over_ = -1;  ///< rows up to this cycle come from the file
    std::vector<double> row_;
    std::function<void()> may_write_ = [] {};
    std::future<void> frame_;  ///< on its way to the disk; the last member: it ends before the others go
};
}  // namespace hdem
