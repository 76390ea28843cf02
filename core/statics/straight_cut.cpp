#include "core/statics/straight_cut.h"

#include "core/geometry/unit_direction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
constexpr int directions = 8;
constexpr double least_share = 0.4;

double projection(const Vec2& direction, const Vec2& place)
{
    return direction.x() * place.x() + direction.y() * place.y();
}
}  // namespace

StraightCutSearch::StraightCutSearch(const BlockGraph& graph, const std::vector<Vec2>& places)
    : graph_(&graph),
      places_(&places),
      slice_(static_cast<std::size_t>(graph.blocks()))
{
}

/// Count for lines between the slices from `first` to `last`.
void StraightCutSearch::count_borders(std::span<const Index> blocks, const std::vector<CutSide>& side, Index first, Index last)
{
    for (std::vector<Index>& border : border_)
        border.assign(count_.size() + 1, 0);
    // Blocks farther away than this hardly touch any across these lines.
    const Index margin = std::max<Index>(4, (last - first) / 4);
    for (const Index block : blocks)
    {
        const Index own = slice_[block];
        if (own < first - margin || own > last + margin)
            continue;
        Index low = own, high = own;
        for (const Index next : graph_->of(block))
            if (side[next] != CutSide::outside)
            {
                low = std::min(low, slice_[next]);
                high = std::max(high, slice_[next]);
            }
        ++border_[0][own];
        --border_[0][high];
        ++border_[1][low];
        --border_[1][own];
    }
}

bool StraightCutSearch::find_in_direction(std::span<const Index> blocks, const std::vector<CutSide>& side, StraightCut& line)
{
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Index block : blocks)
    {
        const double p = projection(line.direction, (*places_)[block]);
        low = std::min(low, p);
        high = std::max(high, p);
    }
    if (!(high > low))
        return false;
    const auto slices = static_cast<Index>(count_.size());
    const double per_metre = slices / (high - low);
    std::fill(count_.begin(), count_.end(), 0);
    for (const Index block : blocks)
    {
        const auto slice = static_cast<Index>((projection(line.direction, (*places_)[block]) - low) * per_metre);
        slice_[block] = std::min(slice, slices - 1);
        ++count_[slice_[block]];
    }

    const auto all = static_cast<Index>(blocks.size());
    const auto least = static_cast<Index>(std::ceil(least_share * all));
    Index first = 0, left = count_[0];  // the line behind slice `first`
    while (left < least)
        left += count_[++first];
    Index last = first;
    for (Index sum = left; last + 1 < slices && sum + count_[last + 1] <= all - least; ++last)
        sum += count_[last + 1];
    if (left > all - least)
        return false;
    count_borders(blocks, side, first, last);

    line.cost = std::numeric_limits<double>::infinity();
    std::array<Index, 2> border{};
    for (Index s = 0; s <= last; ++s)
    {
        border[0] += border_[0][s];
        border[1] += border_[1][s];
        if (s < first)
            continue;
        if (s > first)
            left += count_[s];
        const double cost = cost_of(std::min(border[0], border[1]), left, all - left);
        if (cost < line.cost)
        {
            line.cost = cost;
            line.offset = low + (s + 1) / per_metre;
        }
    }
    return true;
}

std::vector<StraightCut> StraightCutSearch::find(std::span<const Index> blocks, const std::vector<CutSide>& side)
{
    std::vector<StraightCut> lines;
    count_.resize(static_cast<std::size_t>(std::clamp(4.0 * std::sqrt(static_cast<double>(blocks.size())), 64.0, 1024.0)));
    for (int i = 0; i < directions; ++i)
    {
        StraightCut line{unit_direction(i * 180.0 / directions)};
        if (find_in_direction(blocks, side, line))
            lines.push_back(line);
    }
    std::stable_sort(lines.begin(), lines.end(), [](const StraightCut& a, const StraightCut& b) { return a.cost < b.cost; });
    return lines;
}
}  // namespace hdem
