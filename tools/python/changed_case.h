#pragma once
/// A run goes on with a case whose stages to come have changed.

#include "core/rock/build_model.h"
#include "parallel/strength_trial.h"

namespace hdem
{
/// The state of now with the model of the changed case; the order of blocks is that of now. Throws InputError where the case differs in more than stages
/// that have not begun.
/// @param next  made of the changed case
[[nodiscard]] Moment with_other_stages(const Simulation& now, Setup next);
}  // namespace hdem
