#pragma once
/// Cosine and sine that are the same to the last bit on every platform.

#include "core/types.h"

namespace hdem
{
/// (cos, sin) of an angle in degrees, positive anticlockwise; exact at multiples of 90°, error below 2 ulp elsewhere.
///
/// The angle is brought to [-45°, 45°] (exact operations), the rest are Taylor sums of + and * in a fixed order. The sin and
/// cos of libm differ in the last bit from one platform to another; these need IEEE doubles and -ffp-contract=off only.
Vec2 unit_direction(double degrees);
}  // namespace hdem
