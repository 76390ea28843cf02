#pragma once
/// Signals that reach a run.

namespace hdem
{
/// From now on SIGINT, SIGTERM, SIGHUP and SIGXCPU wait to be asked for; a second SIGINT or SIGTERM ends the program at once, as without a
/// handler. SIGHUP stays ignored where it is (nohup).
void catch_interrupts();
/// From now on SIGUSR1 waits to be asked for.
void catch_checkpoint_requests();

/// One of these once it has come, else 0.
[[nodiscard]] int interrupt();
/// Name of that signal. @pre interrupt() != 0
[[nodiscard]] const char* interrupt_name();
/// Has SIGUSR1 come since this was asked last?
[[nodiscard]] bool checkpoint_requested();
}  // namespace hdem
