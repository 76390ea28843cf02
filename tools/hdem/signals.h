#pragma once
/// Signals that reach a run.

namespace hdem
{
/// From now on SIGINT and SIGTERM wait to be asked for; a second one ends the program at once, as without a handler.
void catch_interrupts();
/// From now on SIGUSR1 waits to be asked for.
void catch_checkpoint_requests();

/// SIGINT or SIGTERM once one has come, else 0.
[[nodiscard]] int interrupt();
/// Has SIGUSR1 come since this was asked last?
[[nodiscard]] bool checkpoint_requested();
}  // namespace hdem
