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
    if (interrupted_by != 0)
        ::_exit(128 + signal);
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
}

void catch_checkpoint_requests()
{
    handle(SIGUSR1, note_checkpoint_request);
}

int interrupt()
{
    return interrupted_by;
}

bool checkpoint_requested()
{
    const bool wanted = checkpoint_wanted != 0;
    checkpoint_wanted = 0;
    return wanted;
}
}  // namespace hdem
