#include "parallel/crew.h"

#include <pthread.h>

#include <algorithm>
#ifdef _OPENMP
#include <omp.h>
#endif

namespace hdem
{
namespace
{
/// Is this thread at work in a team? Then it works alone in another one.
thread_local bool is_in_team = false;
#ifdef _OPENMP
thread_local std::unique_ptr<Crew> crew;

/// Called in the child of a fork: the child has the crew's memory but none of its threads, so nothing may wait for them or join them.
void abandon_crew()
{
    static_cast<void>(crew.release());
}

/// As the program or module is loaded: another thread may make its first crew while a process is forked off.
[[maybe_unused]] const int watches_forks = ::pthread_atfork(nullptr, nullptr, abandon_crew);
#endif
}  // namespace

#ifdef _OPENMP
Crew::Crew(int threads) : asked_(threads), calls_(std::make_unique<Signal[]>(static_cast<std::size_t>(threads)))
{
    opener_ = std::thread([this] { open(); });
    opened_.wait(0);
}

void Crew::open()
{
#pragma omp parallel num_threads(asked_)
    {
        if (omp_get_thread_num() == 0)
        {
            threads_ = omp_get_num_threads();
            opened_.call();
            closed_.wait(0);
        }
        else
            serve(omp_get_thread_num());
    }
}

Crew::~Crew()
{
    closes_ = true;
    for (int member = 1; member < threads_; ++member)
        calls_[member].call();
    closed_.call();
    opener_.join();
}

void Crew::serve(int member)
{
    is_in_team = true;
    for (std::uint32_t calls = 0;; ++calls)
    {
        calls_[member].wait(calls);
        if (closes_)
            return;
        work_.run(work_.work, Team(member, team_, &meeting_));
        if (busy_.fetch_sub(1, std::memory_order_acq_rel) == 1)  // the last one hands on what all have written
            done_.call();
    }
}

void Crew::run(int threads, const TeamWork& work) noexcept
{
    const std::uint32_t done = done_.number();
    work_ = work;
    team_ = threads;
    busy_.store(threads - 1, std::memory_order_relaxed);
    is_in_team = true;
    for (int member = 1; member < threads; ++member)
        calls_[member].call();
    work.run(work.work, Team(0, threads, &meeting_));
    is_in_team = false;
    done_.wait(done);
}

void run_in_crew(int threads, const TeamWork& work)
{
    if (is_in_team)
        return work.run(work.work, Team(0, 1));
    if (!crew || crew->asked() < threads)
    {
        crew.reset();
        crew = std::make_unique<Crew>(threads);
    }
    if (const int team = std::min(threads, crew->threads()); team > 1)
        crew->run(team, work);
    else
        work.run(work.work, Team(0, 1));
}

int default_threads()
{
    return omp_get_max_threads();
}
#else
void run_in_crew(int, const TeamWork& work)
{
    work.run(work.work, Team(0, 1));
}

int default_threads()
{
    return 1;
}
#endif
}  // namespace hdem
