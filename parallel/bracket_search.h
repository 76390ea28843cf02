#pragma once
/// Search for the number between what stands and what fails, two trials at once.

#include <functional>
#include <optional>
#include <stop_token>

namespace hdem
{
/// What was found. Without `stands` all fail down to the least, without `fails` all stand up to the most.
struct Bracket
{
    std::optional<double> stands, fails;
    [[nodiscard]] bool is_closed() const { return stands && fails; }
    [[nodiscard]] double middle() const { return 0.5 * (*stands + *fails); }
};

/// Where it is looked for.
struct BracketRule
{
    double low = 0.0, high = 0.0;   ///< to begin with
    double tolerance = 0.0;         ///< width of the last bracket
    std::optional<double> guess{};  ///< where it probably is: looked at first
    double least = 0.0;             ///< nothing below is looked at
    double most = 0.0;              ///< nothing above
    Bracket known{};                ///< both ends, where they are known: nothing outside is looked at
};

/// Does the model stand at x? Called from two threads at once. When asked to stop, its answer is not used.
using StandsAt = std::function<bool(double x, int threads, const std::stop_token& stop)>;
/// Called after each pair with those of the two whose answers count, in ascending order.
using AfterPair = std::function<void(const Bracket&)>;

/// Each round looks at two numbers in the bracket, at once where there are two threads. That the greater one fails as well where the lower one
/// does is taken for granted: its answer is not waited for. So the same numbers count on any number of threads.
///
/// 1. half a tolerance below and above the guess
/// 2. beyond that: the given low, and its middle with what is known to fail; half of that, and so on; or upwards, by doubling
/// 3. thirds of the bracket, until it is as narrow as the tolerance
/// @see verification/unit/parallel/bracket_search_test.cpp
[[nodiscard]] Bracket search_bracket(const BracketRule& rule, int threads, const StandsAt& stands, const AfterPair& after = {});
}  // namespace hdem
