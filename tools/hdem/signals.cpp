#include "tools/hdem/signals.h"

#include <unistd.h>

#include <csignal>

namespace hdem
{
namespace
{
volatile std::sig_atomic_t interrupted_by = 0;
volatile std::sig_atomic_t checkpoint_wanted = 0;

extern "C" void note_interrupt(int signal)
{
    if (interrupted_by != 0 && interrupted_by != SIGHUP)
        ::_exit(128 + signal);
    interrupted_by = signal;
}

/// The terminal or the connection is gone. A hangup often comes together with a SIGTERM: the two do not hurry the program.
extern "C" void note_hangup(int signal)
{
    if (interrupted_by == 0)
        interrupted_by = signal;
}

extern "C" void note_checkpoint_request(int)
{
    checkpoint_wanted = 1;
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
    struct sigaction before = {};
    if (::sigaction(SIGHUP, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)  // nohup: go on
        handle(SIGHUP, note_hangup);
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
    return interrupted_by == SIGTERM ? "SIGTERM" : interrupted_by == SIGHUP ? "SIGHUP" : "SIGINT";
}

bool checkpoint_requested()
{
    const bool wanted = checkpoint_wanted != 0;
    checkpoint_wanted = 0;
    return wanted;
}
}  // namespace hdem
