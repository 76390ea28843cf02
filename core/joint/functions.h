#pragma once
/// Logarithm, exponential, tangent and power for `double` and for packs.
///
/// One algorithm for both, from + - * / and integer operations alone: a lane gives the same bits as a double, and no result depends on the
/// libm of the machine. The series are those of Taylor, the tangent's fraction is Lambert's. Relative error about 5e-16.
/// @see verification/unit/core/joint/functions_test.cpp

#include "core/simd.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace hdem
{
using BitLanes = std::uint64_t __attribute__((vector_size(32)));

inline std::uint64_t bits_of(double x)
{
    return std::bit_cast<std::uint64_t>(x);
}
inline BitLanes bits_of(Pack x)
{
    return std::bit_cast<BitLanes>(x.v);
}
template <typename R, typename Bits>
[[nodiscard]] inline R from_bits(Bits bits)
{
    if constexpr (std::is_same_v<R, double>)
        return std::bit_cast<double>(bits);
    else
        return R(std::bit_cast<typename R::V>(bits));
}

/// |x|. The sign of 0 is the same in a lane and in a double, unlike with abs of simd.h.
template <typename R>
[[nodiscard]] inline R magnitude(R x)
{
    return select(x < R(0.0), -x, x);
}

/// c[from] + c[from + 1] x + ... of `count` coefficients; powers[k] is x^(2^k). In halves that do not wait for each other (Estrin's scheme).
template <std::size_t from, std::size_t count, typename R, std::size_t n>
[[nodiscard, gnu::always_inline]] inline R polynomial_part(const std::array<R, 4>& powers, const std::array<double, n>& c)
{
    if constexpr (count == 1)
        return c[from];
    else
    {
        constexpr std::size_t half = std::bit_ceil(count) / 2;
        return polynomial_part<from, half>(powers, c) +
               powers[std::countr_zero(half)] * polynomial_part<from + half, count - half>(powers, c);
    }
}

/// c[0] + c[1] x + c[2] x^2 + ...
template <typename R, std::size_t n>
[[nodiscard]] inline R polynomial(R x, const std::array<double, n>& c)
{
    static_assert(n <= 16);
    std::array<R, 4> powers;
    powers[0] = x;
    for (std::size_t k = 1; k < 4; ++k)
        powers[k] = powers[k - 1] * powers[k - 1];
    return polynomial_part<0, n>(powers, c);
}

// ln 2 in two parts; the first ends in zeros, so that its product with a power of two below 2048 is exact.
inline constexpr double ln2_high = 0x1.62e42fee00000p-1;
inline constexpr double ln2_low = 0x1.a39ef35793c76p-33;

/// (2 atanh(s) - 2 s) / s = 2 (s^2 / 3 + s^4 / 5 + ...), for |s| <= 0.18. ln((1 + s) / (1 - s)) = 2 atanh(s).
template <typename R>
[[nodiscard]] inline R atanh_rest(R s)
{
    constexpr std::array<double, 10> c{2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11,
                                       2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21};
    const R square = s * s;
    return square * polynomial(square, c);
}

/// Natural logarithm. x = 2^k m with m from sqrt(1/2) to sqrt(2).
/// @pre x is 0 or a normal positive number. At 0 the answer is about -709, so that an unused lane gives no NaN.
template <typename R>
[[nodiscard]] inline R log(R x)
{
    constexpr std::uint64_t root_half = 0x3FE6A09E667F3BCDu, bias = std::uint64_t{1024} << 52, two52 = 0x4330000000000000u;
    const auto bits = bits_of(x);
    const auto shifted = (bits - root_half + bias) >> 52;  // k + 1024
    const R k = from_bits<R>(shifted | two52) - R(0x1p52 + 1024.0);
    const R m = from_bits<R>(bits - (shifted << 52) + bias);
    const R f = m - R(1.0);
    const R s = f / (R(2.0) + f);
    return k * R(ln2_high) + (R(2.0) * s + (s * atanh_rest(s) + k * R(ln2_low)));
}

/// e^x; x is cut to +-708. x = n ln 2 + r with |r| <= ln 2 / 2.
template <typename R>
[[nodiscard]] inline R exp(R x)
{
    constexpr std::array<double, 12> c{1.0 / 2,       1.0 / 6,        1.0 / 24,          1.0 / 120,
                                       1.0 / 720,     1.0 / 5040,     1.0 / 40320,       1.0 / 362880,
                                       1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600.0, 1.0 / 6227020800.0};
    constexpr double rounder = 0x1.8p52;  // added to a small number it leaves the nearest integer in the last bits
    constexpr double log2_e = 1.4426950408889634;
    const R cut = min(max(x, R(-708.0)), R(708.0));
    const R stored = cut * R(log2_e) + R(rounder);
    const R n = stored - R(rounder);
    const R r = (cut - n * R(ln2_high)) - n * R(ln2_low);
    const R rest = r * r * polynomial(r, c);
    const R scale = from_bits<R>((bits_of(stored) - std::bit_cast<std::uint64_t>(rounder) + 1023u) << 52);
    return scale * (R(1.0) + (r + rest));
}

/// tan x, |x| < pi / 2: the ninth convergent of Lambert's continued fraction x / (1 - x^2 / (3 - x^2 / (5 - ...))), 1e-18 off at pi / 4.
template <typename R>
[[nodiscard]] inline R tan(R x)
{
    constexpr std::array<double, 4> more{11486475.0, -810810.0, 12870.0, -44.0};  // of (numerator / y - denominator) / y^2
    constexpr std::array<double, 5> under{34459425.0, -16216200.0, 945945.0, -13860.0, 45.0};
    constexpr double quarter = 0.78539816339744831, half_high = 1.5707963267948966, half_low = 6.123233995736766e-17;
    const R size = magnitude(x);
    const auto steep = size > R(quarter);
    const R y = select(steep, (R(half_high) - size) + R(half_low), size);
    const R square = y * y;
    const R c = polynomial(square, under);
    const R s = y * (c + square * polynomial(square, more));
    const R t = select(steep, c, s) / select(steep, s, c);
    return select(x < R(0.0), -t, t);
}

/// x^y for x > 0; the relative error grows with |y ln x|, 1e-16 times that. At x = 0 a tiny number for y > 1, no NaN.
template <typename R>
[[nodiscard]] inline R power(R x, R y)
{
    return exp(y * log(x));
}
}  // namespace hdem
