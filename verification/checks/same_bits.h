#pragma once
/// A problem again on several threads, and broken off and gone on with: the state must be the same to the last bit.

#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"

#include <span>
#include <string>

namespace hdem::verification
{
/// Adds a row for each method, with the model as drawn and turned by 23 degrees: how many of three runs end otherwise than the run on one thread. They are
/// those on 2 and on 3 threads, and one on 2 threads that goes on from a checkpoint written half way. State hash, what is told of the stages and all terms
/// of the energy ledger are compared.
///
/// A model with fewer than 512 contacts runs its cycles on one thread, however many are asked for, one with fewer than 768 on two.
/// @return  contacts at the end, of the run that has the fewest
std::int64_t require_same_bits(Report& report, const std::string& case_file, const Overrides& overrides = {},
                               std::span<const char* const> methods = all_methods);
}  // namespace hdem::verification
