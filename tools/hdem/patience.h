#pragma once
/// Watches the time while a model is built, when nothing else does: shows a progress line on a terminal, and ends the program when --max-wall is over.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace hdem
{
class Patience
{
  public:
    using Clock = std::chrono::steady_clock;

    struct Settings
    {
        std::string work;                ///< e.g. "reading the case and building its blocks"
        Clock::time_point begin;         ///< of the program
        std::optional<double> max_wall;  ///< a second after this time it ends the program, with exit code 5 [s]
        bool quiet = false;              ///< no progress line
    };

    explicit Patience(Settings settings);
    Patience(const Patience&) = delete;
    Patience& operator=(const Patience&) = delete;
    /// The work is done: ends the watch and removes the line.
    ~Patience();

  private:
    void watch();

    Settings settings_;
    bool shown_ = false;
    bool done_ = false;
    std::mutex mutex_;
    std::condition_variable end_;
    std::thread thread_;
};
}  // namespace hdem
