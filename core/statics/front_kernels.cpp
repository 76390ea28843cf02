// Compiled for several kinds of processors: core/kernels.h.
#include "core/kernels_here.h"
#include "core/statics/front.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
inline namespace HDEM_LANES
{
namespace
{
/// Row panels of one update that stay in the first-level cache: 12 times 3 kB.
constexpr Index panels_in_cache = 12;

/// Four rows of one column.
double* column(double* panel, Index j)
{
    return panel + static_cast<std::ptrdiff_t>(j) * lanes;
}
const double* column(const double* panel, Index j)
{
    return panel + static_cast<std::ptrdiff_t>(j) * lanes;
}

enum class Into
{
    change,
    set
};

/// c <- c - a b^T  (or c <- -a b^T)  for `rows` panels of a, which lie `stride` doubles apart, and `columns` rows of one panel b, over `depth` columns of both.
/// The sum is formed first: the order of its terms does not depend on how many panels go together.
template <int rows, int columns, Into into>
void subtract_product(const double* a, std::size_t stride, const double* b, Index depth, double* const* c)
{
    Pack sum[rows][columns];
    for (auto& row : sum)
        for (Pack& s : row)
            s = Pack(0.0);
    for (int r = 0; r < rows; ++r)
    {
        __builtin_prefetch(c[r], 1);
        __builtin_prefetch(c[r] + 8, 1);
    }
    for (Index k = 0; k < depth; ++k)
    {
        Pack left[rows];
        for (int r = 0; r < rows; ++r)
            left[r] = Pack::load(column(a + r * stride, k));
        for (int j = 0; j < columns; ++j)
        {
            const Pack right(column(b, k)[j]);
            for (int r = 0; r < rows; ++r)
                sum[r][j] += left[r] * right;
        }
    }
    for (int r = 0; r < rows; ++r)
        for (int j = 0; j < columns; ++j)
            (into == Into::set ? -sum[r][j] : Pack::load(column(c[r], j)) - sum[r][j]).store(column(c[r], j));
}

template <int rows, Into into>
void subtract_product(const double* a, std::size_t stride, const double* b, Index depth, Index columns, double* const* c)
{
    switch (columns)
    {
    case 1:
        return subtract_product<rows, 1, into>(a, stride, b, depth, c);
    case 2:
        return subtract_product<rows, 2, into>(a, stride, b, depth, c);
    case 3:
        return subtract_product<rows, 3, into>(a, stride, b, depth, c);
    default:
        return subtract_product<rows, 4, into>(a, stride, b, depth, c);
    }
}

/// x <- x L^-T  for four columns at most of `rows` panels, L the lower triangle of `diagonal`.
template <int rows>
void solve_triangle(const double* diagonal, Index columns, double* const* x)
{
    for (Index j = 0; j < columns; ++j)
        for (int r = 0; r < rows; ++r)
        {
            Pack value = Pack::load(column(x[r], j));
            for (Index i = 0; i < j; ++i)
                value = value - Pack::load(column(x[r], i)) * Pack(column(diagonal, i)[j]);
            (value * Pack(column(diagonal, j)[j])).store(column(x[r], j));
        }
}

/// Cholesky factor of a tile of four columns at most, reciprocals on its diagonal. Returns the column that failed, or no_index.
Index factor_tile(Index columns, const double* smallest, double* tile)
{
    for (Index j = 0; j < columns; ++j)
    {
        Pack value = Pack::load(column(tile, j));
        for (Index i = 0; i < j; ++i)
            value = value - Pack::load(column(tile, i)) * Pack(column(tile, i)[j]);
        const double pivot = value.v[j];
        if (!(pivot > smallest[j]) || !std::isfinite(pivot))
            return j;
        const double reciprocal = 1.0 / std::sqrt(pivot);
        value = value * Pack(reciprocal);
        value.v[j] = reciprocal;
        value.store(column(tile, j));
    }
    return no_index;
}

/// Columns [4 g, 4 g + 4) of `rows` panels of a strip, from its columns before.
template <int rows>
void solve_group(const Strip& strip, Index g, const double* diagonal_panel, double* panel)
{
    const std::size_t stride = static_cast<std::size_t>(strip.width) * lanes;
    const Index columns = std::min<Index>(lanes, strip.width - g * lanes);
    double* c[rows];
    for (int r = 0; r < rows; ++r)
        c[r] = column(panel + r * stride, g * lanes);
    if (g > 0)
        subtract_product<rows, Into::change>(panel, stride, diagonal_panel, g * lanes, columns, c);
    solve_triangle<rows>(column(diagonal_panel, g * lanes), columns, c);
}

template <int rows>
void solve_rows(const Strip& strip, Index p, double* factor)
{
    for (Index g = 0; g * lanes < strip.width; ++g)
        solve_group<rows>(strip, g, factor + strip.panel(strip.first_panel + g), factor + strip.panel(p));
}

/// Where the product of `q`'s rows with those of a panel goes: four columns of a later strip or of C.
struct Target
{
    double* first;           ///< of row panel `from`
    std::size_t stride = 0;  ///< from panel to panel; in C it grows by 16 with each
    std::size_t growth = 0;
    Index columns = lanes;
};

Target find_target(const FrontShape& shape, Index q, Index from, double* factor, double* contribution)
{
    if (q >= shape.own_panels())
    {
        const auto before = static_cast<std::size_t>(from - shape.own_panels());
        return {column(contribution + shape.contribution_panel(from), (q - shape.own_panels()) * lanes),
                (before + 1) * lanes * lanes, static_cast<std::size_t>(lanes * lanes), lanes};
    }
    const Strip strip = shape.strip(q * lanes / strip_columns);
    const Index first = q * lanes - strip.first;
    return {column(factor + strip.panel(from), first), static_cast<std::size_t>(strip.width) * lanes, 0,
            std::min<Index>(lanes, strip.width - first)};
}

/// Rows [p, end) times the rows of panel q.
template <Into into>
void update_group(const Strip& strip, Index q, Index p, Index end, const double* factor, Target target)
{
    const std::size_t stride = static_cast<std::size_t>(strip.width) * lanes;
    const double* right = factor + strip.panel(q);
    double* c[3];
    const auto take = [&](int rows)
    {
        for (int r = 0; r < rows; ++r)
        {
            c[r] = target.first;
            target.first += target.stride;
            target.stride += target.growth;
        }
    };
    for (; p + 3 <= end; p += 3)
    {
        take(3);
        subtract_product<3, into>(factor + strip.panel(p), stride, right, strip.width, target.columns, c);
    }
    if (p + 2 == end)
    {
        take(2);
        subtract_product<2, into>(factor + strip.panel(p), stride, right, strip.width, target.columns, c);
    }
    else if (p < end)
    {
        take(1);
        subtract_product<1, into>(factor + strip.panel(p), stride, right, strip.width, target.columns, c);
    }
}
}  // namespace

Index eliminate_diagonal(const Strip& strip, const double* smallest, double* factor)
{
    const Index groups = (strip.width + lanes - 1) / lanes;
    for (Index g = 0; g < groups; ++g)
    {
        const Index columns = std::min<Index>(lanes, strip.width - g * lanes);
        double* panel = factor + strip.panel(strip.first_panel + g);
        double* tile = column(panel, g * lanes);
        if (g > 0)
            subtract_product<1, Into::change>(panel, 0, panel, g * lanes, columns, &tile);
        const Index failed = factor_tile(columns, smallest + strip.first + g * lanes, tile);
        if (failed != no_index)
            return strip.first + g * lanes + failed;
        Index p = g + 1;
        for (; p + 2 <= groups; p += 2)
            solve_group<2>(strip, g, panel, factor + strip.panel(strip.first_panel + p));
        if (p < groups)
            solve_group<1>(strip, g, panel, factor + strip.panel(strip.first_panel + p));
    }
    return no_index;
}

void eliminate_panels(const Strip& strip, IndexRange panels, double* factor)
{
    Index p = panels.begin;
    for (; p + 3 <= panels.end; p += 3)
        solve_rows<3>(strip, p, factor);
    for (; p < panels.end; ++p)
        solve_rows<1>(strip, p, factor);
}

void subtract_strip(const FrontShape& shape, Index s, IndexRange panels, double* factor, double* contribution)
{
    const Strip strip = shape.strip(s);
    const Index first = strip.end_panel();
    for (Index begin = panels.begin; begin < panels.end; begin += panels_in_cache)
    {
        const Index end = std::min(begin + panels_in_cache, panels.end);
        for (Index q = first; q < end; ++q)
        {
            const Index p = std::max(begin, q);
            const Target target = find_target(shape, q, p, factor, contribution);
            if (s == 0 && q >= shape.own_panels())
                update_group<Into::set>(strip, q, p, end, factor, target);
            else
                update_group<Into::change>(strip, q, p, end, factor, target);
        }
    }
}
}  // namespace HDEM_LANES
}  // namespace hdem
