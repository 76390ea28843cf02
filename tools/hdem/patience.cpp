#include "tools/hdem/patience.h"

#include "tools/hdem/console.h"
#include "tools/hdem/options.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace hdem
{
namespace
{
constexpr std::chrono::seconds first_line_after(2);
constexpr std::chrono::seconds line_every(1);
constexpr std::chrono::duration<double> longest(1e9);
constexpr std::chrono::seconds grace(1);  // a small model is built all the same, and its run saved
constexpr const char* to_line_begin = "\r\033[K";
}  // namespace

Patience::Patience(Settings settings) : settings_(std::move(settings))
{
    const bool shows = !settings_.quiet && ::isatty(STDERR_FILENO) != 0;
    settings_.quiet = !shows;
    if (shows || settings_.max_wall)
        thread_ = std::thread([this] { watch(); });
}

Patience::~Patience()
{
    if (!thread_.joinable())
        return;
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        done_ = true;
    }
    end_.notify_all();
    thread_.join();
    if (shown_)
        std::fputs(to_line_begin, stderr);
}

void Patience::watch()
{
    using Seconds = std::chrono::duration<double>;
    const Seconds most = std::min(Seconds(settings_.max_wall.value_or(longest.count())), longest) + grace;
    const Clock::time_point over = settings_.begin + std::chrono::duration_cast<Clock::duration>(most);
    Clock::time_point line = settings_.quiet ? over : settings_.begin + first_line_after;
    std::unique_lock<std::mutex> lock(mutex_);
    while (!end_.wait_until(lock, std::min(line, over), [&] { return done_; }))
    {
        const Clock::time_point now = Clock::now();
        if (now >= over)
        {
            complain("{}error: --max-wall: the time was over while {}; nothing was run. Give more time, or a smaller model.\n",
                     shown_ ? "\n" : "", settings_.work);
            ::_exit(exit_wall_time);  // the work itself cannot be broken off; a lock that stays behind locks nobody out
        }
        std::fputs(to_line_begin, stderr);
        complain("{}: {:.0f} s", settings_.work, Seconds(now - settings_.begin).count());
        std::fflush(stderr);
        shown_ = true;
        line = now + line_every;
    }
}
}  // namespace hdem
