#pragma once
/// Work that several threads share, as one of them sees it.

#include "core/types.h"
#include "parallel/waiting.h"

namespace hdem
{
/// Where the threads of a team meet.
struct Meeting
{
    Barrier barrier;
    alignas(64) std::atomic<Index> dealt = 0;  ///< pieces that Team::deal has given to somebody
};

/// One thread of a team, as it sees itself.
class Team
{
  public:
    /// @param meeting  of all members; null for a team of one
    Team(int member, int threads, Meeting* meeting = nullptr) : member_(member), threads_(threads), meeting_(meeting) {}

    [[nodiscard]] bool is_first() const { return member_ == 0; }
    [[nodiscard]] int member() const { return member_; }
    [[nodiscard]] int threads() const { return threads_; }

    /// This member's share of `count` pieces of work, consecutive ones. Which thread does a piece never changes its result.
    [[nodiscard]] IndexRange share(Index count) const { return share(count, member_); }
    [[nodiscard]] IndexRange share(Index count, int member) const
    {
        const auto cut = [&](int i) { return static_cast<Index>(static_cast<std::int64_t>(count) * i / threads_); };
        return {cut(member), cut(member + 1)};
    }

    /// Wait for the others; what they wrote before is seen after.
    void barrier() const
    {
        if (threads_ > 1)
            meeting_->barrier.pass(threads_);
    }
    /// The same; one of them runs `last` before anybody goes on.
    template <typename Last>
    void barrier(const Last& last) const
    {
        if (threads_ > 1)
            meeting_->barrier.pass(threads_, last);
        else
            last();
    }

    /// Run work(i) for each of `count` pieces, each on whichever member is free; all wait at the end. For pieces that have nothing to do with each other.
    template <typename Work>
    void deal(Index count, const Work& work) const
    {
        if (threads_ == 1)
        {
            for (Index i = 0; i < count; ++i)
                work(i);
            return;
        }
        const auto next = [&] { return meeting_->dealt.fetch_add(1, std::memory_order_relaxed); };
        for (Index i = next(); i < count; i = next())
            work(i);
        meeting_->barrier.pass(threads_, [&] { meeting_->dealt.store(0, std::memory_order_relaxed); });
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
    Meeting* meeting_ = nullptr;
};

/// What a team does; run by each of its members.
struct TeamWork
{
    void (*run)(const void* work, const Team& team);
    const void* work;
};

/// See with_team.
void run_in_crew(int threads, const TeamWork& work);

/// Run `work(team)` on each of `threads` threads, of which the caller is the first, and wait for all. Within a team, or without OpenMP (HDEM_OPENMP off), there
/// is one. OMP_THREAD_LIMIT may allow fewer than are asked for: team.threads() says how many.
template <typename Work>
void with_team(int threads, const Work& work)
{
    if (threads > 1)
        run_in_crew(threads, {.run = [](const void* w, const Team& team) { (*static_cast<const Work*>(w))(team); }, .work = &work});
    else
        work(Team(0, 1));
}

/// Threads that there can be: OMP_NUM_THREADS, else the processors this process may run on.
[[nodiscard]] int default_threads();
}  // namespace hdem
