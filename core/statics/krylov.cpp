#include "core/statics/krylov.h"

#include "core/simd.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// A pivot below this share of the greatest one is round-off.
constexpr double least_pivot = 1e-13;
}  // namespace

double dot(IndexRange range, const double* a, const double* b)
{
    Pack four(0.0);
    Index i = range.begin;
    for (; i + lanes <= range.end; i += lanes)
        four += Pack::load(a + i) * Pack::load(b + i);
    double rest = 0.0;
    for (; i < range.end; ++i)
        rest += a[i] * b[i];
    return sum(four) + rest;
}

void add_scaled(IndexRange range, double factor, const double* x, double* y)
{
    for (Index i = range.begin; i < range.end; ++i)
        y[i] += factor * x[i];
}

void HessenbergProblem::begin(double beta)
{
    triangle_.clear();
    rotation_.clear();
    right_.assign(1, beta);
}

double HessenbergProblem::add_column(std::span<const double> column)
{
    std::vector<double> turned(column.begin(), column.end() - 1);
    for (std::size_t i = 0; i < rotation_.size(); ++i)
    {
        const auto [c, s] = rotation_[i];
        const double upper = turned[i], lower = turned[i + 1];
        turned[i] = c * upper + s * lower;
        turned[i + 1] = c * lower - s * upper;
    }
    const double length = std::sqrt(turned.back() * turned.back() +
                                    column.back() * column.back());  // std::hypot has other bits in other libraries
    const Rotation last = length > 0.0 ? Rotation{turned.back() / length, column.back() / length} : Rotation{};
    turned.back() = length;
    rotation_.push_back(last);
    triangle_.push_back(std::move(turned));
    const double before = right_.back();
    right_.back() = last.c * before;
    right_.push_back(-last.s * before);
    return std::abs(right_.back());
}

std::vector<double> HessenbergProblem::solve() const
{
    double greatest = 0.0;
    for (std::size_t j = 0; j < triangle_.size(); ++j)
        greatest = std::max(greatest, triangle_[j][j]);
    std::vector<double> y(right_.begin(), right_.end() - 1);
    for (std::size_t j = triangle_.size(); j-- > 0;)
    {
        const double pivot = triangle_[j][j];
        y[j] = pivot > least_pivot * greatest ? y[j] / pivot : 0.0;
        for (std::size_t i = 0; i < j; ++i)
            y[i] -= triangle_[j][i] * y[j];
    }
    return y;
}
}  // namespace hdem
