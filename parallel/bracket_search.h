#pragma once
/// Search for the number at which a model begins to fail, two trials at once.

#include <functional>
#include <optional>
#include <stop_token>

namespace hdem
{
/// What was found. Without `stands`, all numbers down to the least fail; without `fails`, all up to the most stand.
struct Bracket
{
    std::optional<double> stands, fails;
    [[nodiscard]] bool is_closed() const { return stands && fails; }
    [[nodiscard]] double middle() const { return 0.5 * (*stands + *fails); }
};

/// Where the search looks.
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

/// Each round tries two numbers in the bracket, at the same time where there are two threads. If the lower one fails, the greater one is taken to fail too:
/// its answer is not waited for. So the same numbers count on any number of threads.
///
/// 1. half a tolerance below and above the guess
/// 2. beyond that: the given low, and its middle with what is known to fail; half of that, and so on; or upwards, by doubling
/// 3. thirds of the bracket, until it is as narrow as the tolerance
/// @see verification/unit/parallel/bracket_search_test.cpp
[[nodiscard]] Bracket search_bracket(const BracketRule& rule, int threads, const StandsAt& stands, const AfterPair& after = {});
}  // namespace hdem
