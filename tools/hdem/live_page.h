#pragma once
/// hdem run --live: a script beside the run that keeps the page of hdem view up to date.

#include <sys/types.h>

#include <filesystem>

namespace hdem
{
/// Lives as long as the run. The script looks for new frames by itself; it ends with a last page when the pipe to it is closed, which happens
/// however the run ends. It has no part in the run: its failures are told by itself and change nothing.
class LivePage
{
  public:
    /// Throws InputError when this hdem has no page.
    static void check();

    explicit LivePage(const std::filesystem::path& folder);
    /// Waits for the last page, half a minute at most.
    ~LivePage();
    LivePage(const LivePage&) = delete;
    LivePage& operator=(const LivePage&) = delete;

  private:
    int pipe_ = -1;     ///< end on which nothing is ever written
    pid_t child_ = -1;  ///< -1: could not be started
};
}  // namespace hdem
