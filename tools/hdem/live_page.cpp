#include "tools/hdem/live_page.h"

#include "core/check.h"
#include "tools/hdem/console.h"
#include "tools/hdem/script.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace hdem
{
namespace
{
constexpr std::chrono::seconds longest_wait(30);

/// In a process group of its own, so that Ctrl-C is for the run only. The script's input is the pipe. Returns an error number.
int start(const std::array<const char*, 5>& words, int input, pid_t& child)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int error = ::posix_spawn(&child, words.front(), &actions, &attributes, const_cast<char* const*>(words.data()), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}
}  // namespace

void LivePage::check()
{
    const std::string file = (shared_folder() / "view" / "viewer.html").string();
    if (::access(file.c_str(), R_OK) != 0)
        throw InputError(Problem{
            .text = "--live: " + file +
                    " (the viewer is not part of this hdem). It is bundled when hdem is built where Node.js and npm are: run "
                    "tools/setup and build hdem again, or leave out --live."});
}

LivePage::LivePage(const std::filesystem::path& folder)
{
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    {
        complain("error: hdem run --live: {}. The run goes on without its page.\n", std::strerror(errno));
        return;
    }
    pipe_ = ends[1];
    const std::string script = (shared_folder() / "run_view.py").string();
    const std::string run = folder.string();
    const int error = start({python, script.c_str(), run.c_str(), "--follow", nullptr}, ends[0], child_);
    ::close(ends[0]);
    if (error == 0)
        return;
    child_ = -1;
    complain("error: hdem run --live: {} cannot be run ({}). The run goes on without its page.\n", python, std::strerror(error));
}

LivePage::~LivePage()
{
    if (pipe_ >= 0)
        ::close(pipe_);
    const auto end = std::chrono::steady_clock::now() + longest_wait;
    while (child_ > 0 && ::waitpid(child_, nullptr, WNOHANG) == 0 && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
}
}  // namespace hdem
