#pragma once
/// One trial of a strength reduction: does the rock stand with its strength divided by F?

#include "core/rock/strength_reduction.h"
#include "core/stage/failure.h"
#include "parallel/simulation.h"

#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace hdem
{
enum class TrialEnd
{
    stable,
    failed,
    undecided  ///< within the time in which rock that is half a tolerance above its strength would have failed
};
[[nodiscard]] const char* name_of(TrialEnd end);

struct Trial
{
    double factor = 1.0;
    TrialEnd end = TrialEnd::undecided;
    std::string reason;           ///< for the user
    double displacement = 0.0;    ///< of the block that moved farthest by the measure of its limit [m]
    std::vector<Index> failing;   ///< blocks that fail, the user's numbers; the first to fail comes first
    std::vector<Index> let_fall;  ///< blocks below the least size that failed and were taken away
    std::int64_t cycles = 0;
    double time = 0.0;  ///< simulated [s]
};

/// What trials of one search have in common.
struct TrialRule
{
    StrengthReduction reduction;
    FailureRule failure;
    double tolerance = 0.01;  ///< of F
};

/// A state and the model whose order of blocks it has.
struct Moment
{
    Model model;
    State state;
};

/// Stage in which rock under great or reduced strength is brought to rest: the last of the model, but springs, damping and criteria are those of a trial, and
/// nothing is changed at its start. Loads that act at the state's cycle go on for ever, others end.
[[nodiscard]] Model trial_model(const Moment& start, const StrengthReduction& reduction);

/// State of `start` from which a trial with this model begins. Joints whose strength grows with slip at first (Barton-Bandis) have slipped on until they bear under the
/// reduced strength what they bear, to their peak at most. Weakened without that slip, they would at once bear less than before, slip, and reach
/// their peak with a speed: rock would fail below its strength, the more so the less it is damped.
[[nodiscard]] State trial_state(const Model& trial_model, State start);

/// From `start` to the verdict. When asked to stop, the trial is undecided at once.
/// @param end  receives the moment of the verdict, where it is not null
[[nodiscard]] Trial run_trial(const Moment& start, const TrialRule& rule, const ThreadRule& threads,
                              const std::stop_token& stop = {}, std::optional<Moment>* end = nullptr);

/// The state of rest of `start` under strength times great_strength: what each trial begins from. Throws RunError where there is none.
inline constexpr double great_strength = 1e3;
[[nodiscard]] Moment elastic_state(const Moment& start, const ThreadRule& threads);

/// The last stage of the model, run under that strength from the moment before it, with all that it excavates, fixes and frees.
/// @param last  state in which the stage ended under its own strength: the loads that acted there act
[[nodiscard]] Moment elastic_stage(const Moment& before, const State& last, const ThreadRule& threads);

/// The same state with joints `times` as stiff: forces stay, the strain of each spring is divided by it.
[[nodiscard]] Moment stiffened_state(Moment moment, double times);
}  // namespace hdem
