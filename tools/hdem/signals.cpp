#include "tools/hdem/signals.h"

#include <unistd.h>

#include <atomic>
#include <csignal>

namespace hdem
{
namespace
{
// Any thread may be the one that handles a signal: a process that was stopped hands it to whichever wakes first.
std::atomic<int> interrupted_by = 0;
std::atomic<bool> checkpoint_wanted = false;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free, "a handler may not wait for a lock");

extern "C" void note_interrupt(int signal)
{
    const int before = interrupted_by.exchange(signal);
    if (before != 0 && before != SIGHUP && before != SIGXCPU)
        ::_exit(128 + signal);
}

/// The terminal or the connection is gone, or the processor time that was granted is over. A hangup often comes together with a SIGTERM, and
/// SIGXCPU comes again each second: they do not hurry the program.
extern "C" void note_without_haste(int signal)
{
    int before = 0;
    interrupted_by.compare_exchange_strong(before, signal);
}

extern "C" void note_checkpoint_request(int)
{
    checkpoint_wanted = true;
}

void handle(int signal, void (*handler)(int))
{
    struct sigaction action = {};
    action.sa_handler = handler;
    action.sa_flags = SA_RESTART;  // files are written to their end
    ::sigaction(signal, &action, nullptr);
}
}  // namespace

void catch_interrupts()
{
    handle(SIGINT, note_interrupt);
    handle(SIGTERM, note_interrupt);
    handle(SIGXCPU, note_without_haste);  // ulimit -S -t, or a batch system
    struct sigaction before = {};
    if (::sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)  // nohup: go on
        handle(SIGHUP, note_without_haste);
}

void catch_checkpoint_requests()
{
    handle(SIGUSR1, note_checkpoint_request);
}

int interrupt()
{
    return interrupted_by;
}

const char* interrupt_name()
{
    const int signal = interrupted_by;
    return signal == SIGTERM ? "SIGTERM" : signal == SIGHUP ? "SIGHUP" : signal == SIGXCPU ? "SIGXCPU" : "SIGINT";
}

bool checkpoint_requested()
{
    return checkpoint_wanted.exchange(false);
}
}  // namespace hdem
