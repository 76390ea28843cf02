#include "core/statics/front.h"

#include "core/kernels.h"

#include <algorithm>

namespace hdem
{
Strip FrontShape::strip(Index s) const
{
    constexpr Index strip_panels = strip_columns / lanes;
    const auto before = static_cast<std::size_t>(s);
    const std::size_t panels_before = before * static_cast<std::size_t>(panels()) - strip_panels * (before * (before - 1) / 2);
    return {s * strip_columns, std::min(strip_columns, own - s * strip_columns), s * strip_panels,
            panels_before * strip_columns * lanes};
}

std::size_t FrontShape::factor_size() const
{
    if (own == 0)
        return 0;
    const Strip last = strip(strips() - 1);
    return last.panel(panels());
}

Index factor_diagonal(const Strip& strip, const double* smallest, double* factor)
{
    return kernels().eliminate_diagonal(strip, smallest, factor);
}

void solve_panels(const Strip& strip, IndexRange panels, double* factor)
{
    kernels().eliminate_panels(strip, panels, factor);
}

void update_panels(const FrontShape& shape, Index strip, IndexRange panels, double* factor, double* contribution)
{
    kernels().subtract_strip(shape, strip, panels, factor, contribution);
}

Index factor_front(const FrontShape& shape, const double* smallest, double* factor, double* contribution)
{
    for (Index s = 0; s < shape.strips(); ++s)
    {
        const Strip strip = shape.strip(s);
        const Index failed = factor_diagonal(strip, smallest, factor);
        if (failed != no_index)
            return failed;
        const IndexRange below{strip.end_panel(), shape.panels()};
        solve_panels(strip, below, factor);
        update_panels(shape, s, below, factor, contribution);
    }
    return no_index;
}

void solve_forward(const FrontShape& shape, const double* factor, double* x)
{
    kernels().substitute_forward(shape, factor, x);
}

void solve_backward(const FrontShape& shape, const double* factor, double* x)
{
    kernels().substitute_backward(shape, factor, x);
}
}  // namespace hdem
