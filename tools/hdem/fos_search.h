#pragma once
/// The factor of safety of a run that has come to its end: what `hdem fos` and Python ask for.

#include "core/limit/strength_bound.h"
#include "parallel/reference_state.h"
#include "parallel/safety_factor.h"

#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace hdem
{
/// All that was found.
struct FosOutcome
{
    FactorOfSafetyDef def;
    StrengthBound bound;
    std::optional<double> without_corners{};  ///< the bound where corners bear nothing, where that is much lower
    SafetyFactor factor;
    std::vector<std::string> gave_way{};         ///< names of blocks that did not stand in the last stage
    std::vector<std::string> falls_anyway{};     ///< names of those that fell once more when it was run anew under great strength
    std::vector<std::string> gave_way_before{};  ///< names of blocks that had moved far before the last stage
    std::vector<std::string> warnings{};
};

struct FosQuestion
{
    FactorOfSafetyDef def;
    bool found_rest = true;  ///< the last stage ended at rest, or did not look for it
    /// The moment before the last stage; asked for only where blocks did not stand in that stage.
    std::function<std::optional<Moment>()> before;
    ThreadRule threads = 1;
    TrialStore* store = nullptr;
    /// Bound and blocks that gave way are known; trials begin.
    std::function<void(const FosOutcome&)> begin = {};
    std::function<void(const FactorTrial&)> show = {};
    std::stop_token stop = {};  ///< asked to stop, the search throws SearchStopped
};

struct FosAnswer
{
    FosOutcome outcome;
    Moment reference;  ///< that the trials began from
};

/// @param last  in which the last stage ended
[[nodiscard]] FosAnswer find_factor(const Moment& last, const FosQuestion& question);

/// What moves by itself is never at rest: there is no factor of safety. Throws InputError.
void refuse_driven(const CaseDef& def);
}  // namespace hdem
