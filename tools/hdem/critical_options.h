#pragma once
/// What `hdem critical` is asked for.

#include "parallel/critical_search.h"
#include "tools/hdem/options.h"

#include <string>

namespace hdem
{
/// A number of the case and its range.
struct Vary
{
    std::string key;
    double low = 0.0, high = 0.0;
};

/// Ends the command with a message on what it was asked for: throws InputError.
[[noreturn]] void refuse(const std::string& text);

/// "KEY=LOW:HIGH". Throws InputError.
[[nodiscard]] Vary parse_vary(const std::string& text);
/// "displacement:BLOCK>0.1", "rotation:*>5", "detached>0". Throws InputError.
[[nodiscard]] FailureCondition parse_condition(const std::string& text);
}  // namespace hdem
