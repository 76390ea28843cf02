#include "core/geometry/tangent.h"

namespace hdem
{
namespace
{
/// high + low, |low| at most half the last bit of high.
struct Twofold
{
    double high, low;
};

/// Where |a| >= |b| or a is 0.
Twofold quick_sum(double a, double b)
{
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

Twofold exact_sum(double a, double b)
{
    const double sum = a + b;
    const double of_b = sum - a;
    return {sum, (a - (sum - of_b)) + (b - of_b)};
}

/// Dekker's product: without fused multiply-add, which not every processor has.
Twofold exact_product(double a, double b)
{
    const auto halves = [](double x)
    {
        const double large = 134217729.0 * x;  // 2^27 + 1
        const double high = large - (large - x);
        return Twofold{high, x - high};
    };
    const auto [a_high, a_low] = halves(a);
    const auto [b_high, b_low] = halves(b);
    const double product = a * b;
    return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

Twofold operator*(Twofold a, Twofold b)
{
    const Twofold p = exact_product(a.high, b.high);
    return quick_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}

Twofold operator-(Twofold a, Twofold b)
{
    const Twofold high = exact_sum(a.high, -b.high);
    const Twofold low = exact_sum(a.low, -b.low);
    const Twofold sum = quick_sum(high.high, high.low + low.high);
    return quick_sum(sum.high, sum.low + low.low);
}

Twofold operator/(Twofold a, Twofold b)
{
    const double first = a.high / b.high;
    const Twofold rest = a - b * Twofold{first, 0.0};
    return quick_sum(first, rest.high / b.high);
}

/// Σ (-1)^k x^(2k) / (2k + first)!, first = 1: sin x / x, 0: cos x. Twenty terms leave 1e-36 at a right angle.
Twofold alternating_series(Twofold square, int first)
{
    const Twofold one = {1.0, 0.0};
    Twofold sum = one;
    for (int k = 19; k >= 1; --k)
    {
        const int n = 2 * k + first;
        sum = one - sum * (square / Twofold{static_cast<double>(n * (n - 1)), 0.0});
    }
    return sum;
}
}  // namespace

double tangent(double x)
{
    const Twofold square = exact_product(x, x);
    const Twofold ratio = Twofold{x, 0.0} * alternating_series(square, 1) / alternating_series(square, 0);
    return ratio.high + ratio.low;
}
}  // namespace hdem
