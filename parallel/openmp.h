#pragma once
/// Threads that stay together for many cycles. Without OpenMP (HDEM_OPENMP off) there is one.

#include "core/types.h"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace hdem
{
/// One thread of a team, as it sees itself.
class Team
{
  public:
    Team(int member, int threads) : member_(member), threads_(threads) {}

    [[nodiscard]] bool is_first() const { return member_ == 0; }
    [[nodiscard]] int member() const { return member_; }
    [[nodiscard]] int threads() const { return threads_; }

    /// This member's share of `count` pieces of work, consecutive ones. Which thread does a piece never changes its result.
    [[nodiscard]] IndexRange share(Index count) const
    {
        const auto cut = [&](int i) { return static_cast<Index>(static_cast<std::int64_t>(count) * i / threads_); };
        return {cut(member_), cut(member_ + 1)};
    }

    /// Wait for the others; what they wrote before is seen after.
    void barrier() const
    {
#ifdef _OPENMP
        if (threads_ > 1)
        {
#pragma omp barrier
        }
#endif
    }

    /// Run work(i) for each of `count` pieces, each on whichever member is free; all wait at the end. For pieces that have nothing to do with each other.
    template <typename Work>
    void deal(Index count, const Work& work) const
    {
#ifdef _OPENMP
        if (threads_ > 1)
        {
#pragma omp for schedule(dynamic)
            for (Index i = 0; i < count; ++i)
                work(i);
            return;
        }
#endif
        for (Index i = 0; i < count; ++i)
            work(i);
    }

    /// Run `work` on the first member while the others wait.
    template <typename Work>
    void alone(const Work& work) const
    {
        barrier();
        if (is_first())
            work();
        barrier();
    }

  private:
    int member_ = 0;
    int threads_ = 1;
};

/// Run `work(team)` on each of `threads` threads.
template <typename Work>
void with_team(int threads, const Work& work)
{
#ifdef _OPENMP
    if (threads > 1)
    {
#pragma omp parallel num_threads(threads)
        work(Team(omp_get_thread_num(), omp_get_num_threads()));
        return;
    }
#endif
    work(Team(0, 1));
}
}  // namespace hdem
