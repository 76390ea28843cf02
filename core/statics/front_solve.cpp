// Compiled for several kinds of processors: core/kernels.h.
#include "core/kernels_here.h"
#include "core/statics/front.h"

#include <algorithm>
#include <array>

namespace hdem
{
inline namespace HDEM_LANES
{
namespace
{
/// x <- x - L x_strip  in `rows` panels of the first `columns` columns of a strip.
template <int rows>
void subtract_rows(const double* panel, std::size_t stride, Index columns, const double* from, double* x)
{
    Pack sum[rows];
    for (Pack& s : sum)
        s = Pack(0.0);
    for (Index j = 0; j < columns; ++j)
        for (int r = 0; r < rows; ++r)
            sum[r] += Pack::load(panel + r * stride + static_cast<std::size_t>(j) * lanes) * Pack(from[j]);
    for (int r = 0; r < rows; ++r)
        (Pack::load(x + r * lanes) - sum[r]).store(x + r * lanes);
}

void forward_strip(const Strip& strip, Index panels, const double* factor, double* x)
{
    const std::size_t stride = static_cast<std::size_t>(strip.width) * lanes;
    const double* from = x + strip.first;
    Index p = strip.first_panel;
    for (Index first = 0; first < strip.width; first += lanes, ++p)
    {
        const double* panel = factor + strip.panel(p);
        subtract_rows<1>(panel, stride, first, from, x + p * lanes);
        const double* tile = panel + first * lanes;
        double* own = x + strip.first + first;
        const Index columns = std::min<Index>(lanes, strip.width - first);
        for (Index j = 0; j < columns; ++j)
        {
            own[j] *= tile[j * lanes + j];
            for (Index i = j + 1; i < columns; ++i)
                own[i] -= tile[j * lanes + i] * own[j];
        }
    }
    for (; p + 4 <= panels; p += 4)
        subtract_rows<4>(factor + strip.panel(p), stride, strip.width, from, x + p * lanes);
    for (; p < panels; ++p)
        subtract_rows<1>(factor + strip.panel(p), stride, strip.width, from, x + p * lanes);
}

/// sum <- sum + L^T x  over `rows` row panels, one after the other.
template <int rows>
void add_transposed(const double* panel, std::size_t stride, Index columns, const double* x, Pack* sum)
{
    Pack row[rows];
    for (int r = 0; r < rows; ++r)
        row[r] = Pack::load(x + r * lanes);
    for (Index j = 0; j < columns; ++j)
    {
        Pack s = sum[j];
        for (int r = 0; r < rows; ++r)
            s += Pack::load(panel + r * stride + static_cast<std::size_t>(j) * lanes) * row[r];
        sum[j] = s;
    }
}

void backward_strip(const Strip& strip, Index panels, const double* factor, double* x)
{
    std::array<Pack, strip_columns> sum;
    std::fill_n(sum.begin(), strip.width, Pack(0.0));
    const Index groups = (strip.width + lanes - 1) / lanes;
    const std::size_t stride = static_cast<std::size_t>(strip.width) * lanes;
    Index p = strip.first_panel + groups;
    for (; p + 4 <= panels; p += 4)
        add_transposed<4>(factor + strip.panel(p), stride, strip.width, x + p * lanes, sum.data());
    for (; p < panels; ++p)
        add_transposed<1>(factor + strip.panel(p), stride, strip.width, x + p * lanes, sum.data());
    for (Index g = groups - 1; g >= 0; --g)
    {
        const Index first = g * lanes;
        const double* panel = factor + strip.panel(strip.first_panel + g);
        const double* tile = panel + first * lanes;
        double* own = x + strip.first + first;
        for (Index j = std::min<Index>(lanes, strip.width - first) - 1; j >= 0; --j)
        {
            own[j] -= hdem::sum(sum[first + j]);
            own[j] *= tile[j * lanes + j];
            for (Index i = 0; i < j; ++i)
                own[i] -= tile[i * lanes + j] * own[j];
        }
        add_transposed<1>(panel, stride, first, own, sum.data());
    }
}
}  // namespace

void substitute_forward(const FrontShape& shape, const double* factor, double* x)
{
    for (Index s = 0; s < shape.strips(); ++s)
        forward_strip(shape.strip(s), shape.panels(), factor, x);
}

void substitute_backward(const FrontShape& shape, const double* factor, double* x)
{
    for (Index s = shape.strips() - 1; s >= 0; --s)
        backward_strip(shape.strip(s), shape.panels(), factor, x);
}
}  // namespace HDEM_LANES
}  // namespace hdem
