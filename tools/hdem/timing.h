#pragma once
/// The closing table of where the time went.

#include "core/observer.h"
#include "io/summary.h"
#include "parallel/stages.h"

#include <span>
#include <string>
#include <vector>

namespace hdem
{
/// An observer whose time counts as output.
class TimedObserver : public Observer
{
  public:
    TimedObserver(Observer& inner, double& seconds) : inner_(inner), seconds_(seconds) {}

    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override { return inner_.next_cycle(now); }
    void begin_stage(const Model& model, const State& state) override
    {
        const ScopedTime time(seconds_);
        inner_.begin_stage(model, state);
    }
    void observe(const Model& model, const State& state) override
    {
        const ScopedTime time(seconds_);
        inner_.observe(model, state);
    }
    void end_stage(const Model& model, const State& state) override
    {
        const ScopedTime time(seconds_);
        inner_.end_stage(model, state);
    }

  private:
    Observer& inner_;
    double& seconds_;
};

/// A keeper whose time counts as output: checkpoints.
class TimedKeeper : public Keeper
{
  public:
    TimedKeeper(Keeper& inner, double& seconds) : inner_(inner), seconds_(seconds) {}

    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override { return inner_.next_cycle(now); }
    [[nodiscard]] bool keep(const Simulation& simulation) override
    {
        const ScopedTime time(seconds_);
        return inner_.keep(simulation);
    }
    [[nodiscard]] bool is_to_stop() override { return inner_.is_to_stop(); }
    void follow_statics(int iterations, double ratio) override { inner_.follow_statics(iterations, ratio); }

  private:
    Keeper& inner_;
    double& seconds_;
};

/// Rows of the table: the stages of a cycle, unused, in which cycles ran without the thread, output, and other, which is the rest of `seconds`: the means
/// add up to it.
[[nodiscard]] std::vector<StageTiming> summarise_times(std::span<const StageTimes> threads, double output, double seconds);

/// Which numbers of threads cycles ran on.
[[nodiscard]] ThreadSummary summarise_threads(const ThreadChoice& choice);

[[nodiscard]] std::string thread_line(const ThreadSummary& use);

[[nodiscard]] std::vector<std::string> timing_table(std::span<const StageTiming> timing);
}  // namespace hdem
