#include "core/geometry/unit_direction.h"

#include <cmath>

namespace hdem
{
namespace
{
/// Σ (-1)^k x^(2k+first) / (2k+first)!, first = 1: sin, 0: cos. Ten terms leave 1e-20 at 45°.
double alternating_series(double x, int first)
{
    double sum = 1.0;
    for (int k = 9; k >= 1; --k)
    {
        const int n = 2 * k + first;
        sum = 1.0 - sum * (x * x / (n * (n - 1)));
    }
    return first == 1 ? x * sum : sum;
}
}  // namespace

Vec2 unit_direction(double degrees)
{
    const double within = std::remainder(degrees, 360.0);
    const double quarter = std::round(within / 90.0);  // exact, and odd: mirrored angles stay mirrored
    const double x = radians(within - 90.0 * quarter);
    const Vec2 d = {alternating_series(x, 0), alternating_series(x, 1)};
    switch (static_cast<int>(quarter))
    {
    case 0:
        return d;
    case 1:
        return turned_left(d);
    case -1:
        return -turned_left(d);
    default:
        return -d;
    }
}
}  // namespace hdem
