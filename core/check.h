#pragma once
/// Contracts. User data is checked always and reported as a list of problems (InputError); what the code itself
/// guarantees is checked in debug builds only (HDEM_EXPECT).

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace hdem
{
/// One thing that is wrong with what the user gave.
/// Grammar of the text: object: field = value unit (why it is wrong). What to do.
struct Problem
{
    enum class Severity
    {
        error,
        warning
    };

    Severity severity = Severity::error;
    /// Key of the case file the problem belongs to, e.g. "joint_set[1].spacing"; the reader turns it into file:line:col.
    std::string key;
    std::string text;
};

/// Thrown with all problems found, never only the first.
class InputError : public std::runtime_error
{
  public:
    explicit InputError(std::vector<Problem> problems)
        : std::runtime_error(problems.empty() ? "bad input" : problems.front().text),
          problems_(std::move(problems))
    {
    }

    explicit InputError(Problem problem) : InputError(std::vector<Problem>{std::move(problem)}) {}

    [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }

  private:
    std::vector<Problem> problems_;
};

/// Thrown when a run cannot go on: a non-finite value, an overlap above its limit, a file that cannot be written.
class RunError : public std::runtime_error
{
  public:
    using std::runtime_error::runtime_error;
};
}  // namespace hdem

#ifdef HDEM_CHECKS
#include <cassert>
#define HDEM_EXPECT(condition) assert(condition)
#else
#define HDEM_EXPECT(condition) static_cast<void>(0)
#endif
