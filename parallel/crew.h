#pragma once
/// Threads that stay between one team and the next.

#include "parallel/team.h"

#include <memory>
#include <thread>

namespace hdem
{
/// The threads that work with one calling thread. They live in one OpenMP region from the first team of the caller to its end: OpenMP makes them, counts them and
/// puts them on processors (OMP_NUM_THREADS, OMP_THREAD_LIMIT, OMP_PLACES, OMP_PROC_BIND), but does not let them wait: its own waits
/// spin for milliseconds, unless the user's environment says otherwise.
///
/// The region's first thread, which opens it, only sleeps: its place is the caller's.
class Crew
{
  public:
    /// @param threads  with the caller
    explicit Crew(int threads);
    ~Crew();
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    [[nodiscard]] int threads() const { return threads_; }
    [[nodiscard]] int asked() const { return asked_; }

    /// On the caller and the next threads - 1 of the crew; the others go on sleeping.
    void run(int threads, const TeamWork& work) noexcept;

  private:
    void open();
    void serve(int member);

    int asked_ = 1;
    int threads_ = 1;
    bool closes_ = false;
    TeamWork work_{};
    int team_ = 1;                           ///< threads of the present team
    std::unique_ptr<Signal[]> calls_;        ///< for each member: there is work, or the crew closes
    alignas(64) std::atomic<int> busy_ = 0;  ///< members of the team, without the caller, that are not done
    Signal done_;                            ///< none is busy
    Signal opened_, closed_;
    Meeting meeting_;
    std::thread opener_;
};
}  // namespace hdem
