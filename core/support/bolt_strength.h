#pragma once
/// What bolts can bear, for limit analysis.

#include "core/model/model.h"
#include "core/state/state.h"

#include <vector>

namespace hdem
{
/// A force of a bolt between two blocks: on the first one along `direction`, on the second one against it, of any size between the two limits.
///
///   anchored   0 <= T <= yield
///   grouted    |T| <= min(yield, bond strength times bonded length on either side); a plate holds whatever the bar does
///   local      |T| <= yield, |Q| <= shear_strength
///
/// Strengths that are not given are infinite. How the tension of a grouted bolt changes from one joint to the next is not limited.
struct BoltStrength
{
    Index first = no_index, second = no_index;
    Vec2 direction = {1.0, 0.0};
    Vec2 first_place = {0.0, 0.0}, second_place = {0.0, 0.0};  ///< where it acts [m]
    double least = 0.0, greatest = 0.0;                        ///< [N]
};

/// Strengths of all bolts that act, where the blocks are now.
/// @see verification/unit/core/limit/strength_bound_test.cpp
[[nodiscard]] std::vector<BoltStrength> bolt_strengths(const Model& model, const State& state);

/// Has the bolt a force that nothing limits?
[[nodiscard]] bool bears_any_force(const Bolt& bolt);
}  // namespace hdem
