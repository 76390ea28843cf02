#pragma once
/// A stop token that follows the signals.

#include "tools/hdem/signals.h"

#include <chrono>
#include <stop_token>
#include <thread>

namespace hdem
{
/// Asks a search to stop when a signal has come.
class SignalWatch
{
  public:
    [[nodiscard]] std::stop_token token() const { return source_.get_token(); }

  private:
    std::stop_source source_;
    std::jthread thread_{[this](const std::stop_token& end)
                         {
                             while (!end.stop_requested() && interrupt() == 0)
                                 std::this_thread::sleep_for(std::chrono::milliseconds(50));
                             if (interrupt() != 0)
                                 source_.request_stop();
                         }};
};
}  // namespace hdem
