#pragma once
/// What makes a run stop: values that are not finite, blocks too deep in each other, a step too great for the springs. Each throws a RunError that names
/// cycle, time, blocks and the setting that may help.

#include "core/model/model.h"
#include "core/state/state.h"

#include <string>

namespace hdem
{
/// The value in a format of printf.
[[nodiscard]] std::string with_digits(const char* format, double value);

/// Greatest preload of a joint [m].
[[nodiscard]] double greatest_preload(const State& state);
/// Joints that a stage has made soft must not be lost while they bear.
void check_preload(const Model& model, const State& state);

void check_finite(const Model& model, const State& state);
/// @see core/motion/step_check.h
void check_step(const Model& model, const State& state);

/// An overlap of the last cycle is above contact.overlap_limit.
[[noreturn]] void refuse_overlap(const Model& model, const State& state);
/// The springs of `contact`, which began to act in the last cycle, swing too fast for the step.
[[noreturn]] void refuse_step(const Model& model, const State& state, Index contact);
}  // namespace hdem
