#pragma once
/// Where the time of a run goes: seconds of each thread in each stage of the cycle.

#include <array>
#include <chrono>
#include <cstdint>

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

/// Of one thread; on a cache line of its own.
struct alignas(64) StageTimes
{
    std::array<double, static_cast<std::size_t>(CycleStage::count)> seconds{};
};

/// Adds the time since the last lap to a stage. Does nothing, and does not look at the clock, without a weight.
class StageClock
{
  public:
    /// @param weight cycles that the one timed stands for; 0: none
    StageClock(StageTimes& times, double weight) : times_(times), weight_(weight) { skip(); }

    /// What was done since the last lap is timed by others.
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
        times_.seconds[static_cast<std::size_t>(stage)] += weight_ * std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

  private:
    StageTimes& times_;
    double weight_;
    std::chrono::steady_clock::time_point last_;
};
}  // namespace hdem
