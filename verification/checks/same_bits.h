#pragma once
/// Repeats a problem on several threads, and with a break and a restart: the state must be the same to the last bit.

#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"

#include <array>
#include <span>
#include <string>

namespace hdem::verification
{
/// Which runs a problem is asked for besides the one on one thread, and what its rows are called after; "": its file.
struct OtherRuns
{
    std::span<const int> threads;
    std::string name = {};
    bool turned = true;  ///< by 23 degrees too
};
inline constexpr std::array<int, 2> two_and_three{2, 3};

/// Adds a row for each method, with the model as drawn and turned by 23 degrees: how many of some runs end otherwise than the run on one thread. They are
/// those on 2 and on 3 threads, or on others, and one on 2 threads that goes on from a checkpoint written half way. State hash, results of the stages and
/// all terms of the energy ledger are compared.
///
/// A model with fewer than 512 contacts runs its cycles on one thread, however many are asked for, one with fewer than 768 on two.
/// @return  contacts at the end, of the run that has the fewest
std::int64_t require_same_bits(Report& report, const std::string& case_file, const Overrides& overrides = {},
                               std::span<const char* const> methods = all_methods, const OtherRuns& others = {two_and_three});
}  // namespace hdem::verification
