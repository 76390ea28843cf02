#pragma once
/// Where the time of a run goes: seconds of each thread in each stage of the cycle.

#include <array>
#include <chrono>
#include <cstdint>
#include <numeric>

namespace hdem
{
enum class CycleStage : std::uint8_t
{
    broad,    ///< contacts found anew, blocks sorted
    narrow,   ///< facing edges searched
    force,    ///< contacts evaluated
    impulse,  ///< impulses swept, and waiting for colours
    update,   ///< forces summed, velocities and positions changed, loads
    wait,     ///< for other threads at the ends of stages
    count
};

/// Times of one thread.
struct StageTimes
{
    std::array<double, static_cast<std::size_t>(CycleStage::count)> seconds{};

    [[nodiscard]] double& of(CycleStage stage) { return seconds[static_cast<std::size_t>(stage)]; }
    [[nodiscard]] double of(CycleStage stage) const { return seconds[static_cast<std::size_t>(stage)]; }
    [[nodiscard]] double total() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }
};

/// What one thread has measured; on a cache line of its own. All of its time in cycles and in searches for contacts is known, and that of the
/// searches by itself; of the other stages only samples, which say how they share the rest.
struct alignas(64) StageSamples
{
    StageTimes sampled;  ///< broad: all of it
    double all = 0.0;    ///< [s]

    /// Without searches for contacts.
    [[nodiscard]] double in_cycles() const { return all - sampled.of(CycleStage::broad); }

    /// Adds up to `all`, as soon as a cycle has been sampled.
    [[nodiscard]] StageTimes shared_out() const
    {
        StageTimes times = sampled;
        const double searches = times.of(CycleStage::broad);
        const double samples = times.total() - searches;
        for (double& seconds : times.seconds)
            seconds *= samples > 0.0 ? (all - searches) / samples : 0.0;
        times.of(CycleStage::broad) = searches;
        return times;
    }
};

/// Adds the time it lives to a sum.
class ScopedTime
{
  public:
    explicit ScopedTime(double& seconds) : seconds_(seconds) {}
    ~ScopedTime() { seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }
    ScopedTime(const ScopedTime&) = delete;
    ScopedTime& operator=(const ScopedTime&) = delete;

  private:
    double& seconds_;
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Adds the time since the last lap to a stage. Does nothing, and does not look at the clock, without a weight.
class StageClock
{
  public:
    /// @param weight cycles that the one timed stands for; 0: none
    StageClock(StageTimes& times, double weight) : times_(times), weight_(weight) { skip(); }

    /// Leave out the time since the last lap: it is measured elsewhere.
    void skip()
    {
        if (weight_ > 0.0)
            last_ = std::chrono::steady_clock::now();
    }

    void lap(CycleStage stage)
    {
        if (weight_ == 0.0)
            return;
        const auto now = std::chrono::steady_clock::now();
        times_.of(stage) += weight_ * std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

  private:
    StageTimes& times_;
    double weight_;
    std::chrono::steady_clock::time_point last_;
};
}  // namespace hdem
