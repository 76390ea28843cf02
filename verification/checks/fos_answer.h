#pragma once
/// The factor of safety of a case, as `hdem fos` finds it.

#include "core/limit/strength_bound.h"
#include "parallel/safety_factor.h"
#include "verification/checks/case_run.h"

#include <cmath>
#include <string>

namespace hdem::verification
{
struct FosAnswer
{
    SafetyFactor factor;
    StrengthBound bound;
    [[nodiscard]] double value() const { return factor.as_given.is_closed() ? factor.as_given.middle() : std::nan(""); }
    [[nodiscard]] double stiffer() const
    {
        return factor.stiffer && factor.stiffer->is_closed() ? factor.stiffer->middle() : std::nan("");
    }
    [[nodiscard]] double peak() const { return factor.peak && factor.peak->is_closed() ? factor.peak->middle() : std::nan(""); }
};

/// How a search is run, besides its case.
struct FosRun
{
    int threads = 1;
    TrialStore* store = nullptr;
    std::stop_token stop = {};
};

/// `case_file` relative to cases/fos. Throws SearchStopped where it is asked to stop.
[[nodiscard]] FosAnswer find_factor(const std::string& case_file, const Overrides& overrides, const FosRun& run = {});

/// Adds a row: how many of three searches have the trials of `one`, bit for bit. One runs on 2 threads, one on 3 threads, and one is broken off after
/// three trials and continued.
void require_same_trials(Report& report, const std::string& name, const FosAnswer& one, const std::string& case_file,
                         const Overrides& overrides);

/// fos.laws
void check_laws(Report& report);
}  // namespace hdem::verification
