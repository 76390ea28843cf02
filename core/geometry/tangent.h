#pragma once
/// Tangent that is the same to the last bit on every platform.

namespace hdem
{
/// tan x for 0 <= x < pi / 2, correctly rounded but for one argument in 1e15 or so.
///
/// The tan of libm differs in the last bit from one platform to another, and with glibc from one processor to another. Here sine and cosine are
/// summed with twice the digits of a double, by + and * alone.
double tangent(double x);
}  // namespace hdem
