#pragma once
/// Waits of threads for each other: a short spin, in which nearly all of them end, then sleep. A thread that sleeps leaves its processor to whoever wants it.

#include <atomic>
#include <chrono>
#include <cstdint>

namespace hdem
{
/// Waits shorter than this are spun away [s]. Waking a thread takes a tenth to a half of this time; if another thread gets the processor, its time slice
/// is a hundred times as long.
inline constexpr double longest_spin = 50e-6;

/// Leaves the processor's shared units to others for a moment.
inline void pause_briefly()
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("isb");
#endif
}

/// A number that only grows, and threads that wait until it has grown.
///
/// No call is missed. A waiting thread counts itself as asleep, then looks at the number. A calling thread changes the number, then looks for sleepers. These four
/// operations are sequentially consistent, so one of the two threads sees the other. And the kernel puts no thread to sleep whose number has changed. What
/// the caller wrote before call() is seen after wait().
class alignas(64) Signal
{
  public:
    [[nodiscard]] std::uint32_t number() const { return number_.load(std::memory_order_acquire); }

    /// Wait until the number is not `seen` any more.
    void wait(std::uint32_t seen)
    {
        if (spin(seen))
            return;
        sleepers_.fetch_add(1);
        while (number_.load() == seen)
            number_.wait(seen);
        sleepers_.fetch_sub(1, std::memory_order_relaxed);
    }

    void call()
    {
        number_.fetch_add(1);
        if (sleepers_.load() > 0)
            number_.notify_all();
    }

  private:
    [[nodiscard]] bool spin(std::uint32_t seen) const
    {
        if (looks_changed(seen))
            return true;
        const auto begin = std::chrono::steady_clock::now();
        while (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < longest_spin)
            if (looks_changed(seen))
                return true;
        return false;
    }

    /// Half a microsecond of looking at it, so that the clock is read seldom.
    [[nodiscard]] bool looks_changed(std::uint32_t seen) const
    {
        constexpr int looks = 32;
        for (int i = 0; i < looks; ++i)
        {
            if (number() != seen)
                return true;
            pause_briefly();
        }
        return false;
    }

    std::atomic<std::uint32_t> number_ = 0;
    std::atomic<std::uint32_t> sleepers_ = 0;
};

/// All threads of a team pass it together: what any of them wrote before is seen by all after.
class alignas(64) Barrier
{
  public:
    /// @param threads  that come
    /// @param last     done by whoever comes last, before anybody passes
    template <typename Last>
    void pass(int threads, const Last& last)
    {
        const std::uint32_t round = passed_.number();
        if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 < threads)  // the last one sees what all others wrote
        {
            passed_.wait(round);
            return;
        }
        arrived_.store(0, std::memory_order_relaxed);  // nobody comes for the next round before the call
        last();
        passed_.call();
    }
    void pass(int threads)
    {
        pass(threads, [] {});
    }

  private:
    std::atomic<int> arrived_ = 0;
    Signal passed_;
};
}  // namespace hdem
