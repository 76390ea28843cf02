#pragma once
/// The factor of safety: the greatest number by which the strength of joints can be divided before rock fails.

#include "parallel/bracket_search.h"
#include "parallel/strength_trial.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
/// Searches of one case.
enum class FactorSearch
{
    as_given,  ///< with residual strength where slip or breaking takes some
    peak,      ///< residual strength is that of the peak
    stiffer    ///< joints FactorOfSafetyDef::check_stiffness times as stiff
};
/// "as_given", "peak", "stiffer"
[[nodiscard]] const char* name_of(FactorSearch search);

struct FactorTrial
{
    FactorSearch search = FactorSearch::as_given;
    Trial trial;
};

/// Keeps trials beyond the end of the program, so that a search which was cut short goes on. Called from two threads.
class TrialStore
{
  public:
    TrialStore() = default;
    TrialStore(const TrialStore&) = delete;
    TrialStore& operator=(const TrialStore&) = delete;
    virtual ~TrialStore() = default;
    [[nodiscard]] virtual std::optional<Trial> find(FactorSearch search, double factor) = 0;
    virtual void add(FactorSearch search, const Trial& trial) = 0;
};

struct FactorSetting
{
    FactorOfSafetyDef def;
    std::optional<double> bound;  ///< F by limit analysis, from above
    ThreadRule threads = 1;       ///< of all trials at once
    TrialStore* store = nullptr;
    /// A trial that counts has ended.
    std::function<void(const FactorTrial&)> show = {};
    std::stop_token stop = {};  ///< asked to stop, the search throws SearchStopped
};

/// Thrown where the search was asked to stop; trials that had ended are in the store.
struct SearchStopped
{
};

/// Nothing below and above these factors is looked at.
inline constexpr double least_factor = 1.0 / 128.0, greatest_factor = 64.0;

struct SafetyFactor
{
    Bracket as_given;
    std::optional<Bracket> peak;      ///< where slip or breaking takes strength
    std::optional<Bracket> stiffer;   ///< where it was looked at
    std::vector<FactorTrial> trials;  ///< those that count, in the order of the search
    std::optional<Moment> failure;    ///< where the first failing trial has ended, if it was run by this call
    /// The failing trial with the least factor, or null.
    [[nodiscard]] const Trial* first_failure() const;
    [[nodiscard]] const Trial* last_stable() const;
};

/// @param reference  elastic_state of the case's last state
[[nodiscard]] SafetyFactor find_safety_factor(const Moment& reference, const FactorSetting& setting);

/// Rule of the trials of a search at F.
[[nodiscard]] TrialRule trial_rule(const Model& model, const FactorOfSafetyDef& def, FactorSearch search, double factor);

[[nodiscard]] bool weakens_bolts(const FactorOfSafetyDef& def);

/// Per [joint.NAME]: is it weakened? Empty: all.
[[nodiscard]] std::vector<std::uint8_t> weakened_joints(const JointTable& table, const FactorOfSafetyDef& def);
}  // namespace hdem
