#include "core/detection/cell_list.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
double extent(const Box& box)
{
    return std::max(box.high.x() - box.low.x(), box.high.y() - box.low.y());
}

std::uint64_t mixed(std::uint64_t z)
{
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

std::uint64_t row_key(std::int64_t y, int level)
{
    return mixed(static_cast<std::uint64_t>(y) * 64u + static_cast<std::uint64_t>(level));
}
}  // namespace

void CellList::build(const std::vector<Box>& boxes)
{
    boxes_ = &boxes;
    smallest_cell_ = std::numeric_limits<double>::infinity();
    for (const Box& box : boxes)
        if (!is_empty(box) && extent(box) > 0.0)
            smallest_cell_ = std::min(smallest_cell_, extent(box));
    if (!std::isfinite(smallest_cell_))
        smallest_cell_ = 1.0;

    home_.assign(boxes.size(), {0, 0, -1});
    next_.assign(boxes.size(), no_index);
    used_levels_.clear();
    std::size_t slots = 16;
    while (slots < 2 * boxes.size())
        slots *= 2;
    head_.assign(slots, no_index);
    // Backwards, so that each slot's chain ascends.
    for (Index i = static_cast<Index>(boxes.size()) - 1; i >= 0; --i)
    {
        if (is_empty(boxes[i]))
            continue;
        const Cell home = cell_of(boxes[i]);
        home_[i] = home;
        const std::size_t s = slot(home.x, row_key(home.y, home.level));
        next_[i] = head_[s];
        head_[s] = i;
        if (std::find(used_levels_.begin(), used_levels_.end(), home.level) == used_levels_.end())
            used_levels_.push_back(home.level);
    }
    std::sort(used_levels_.begin(), used_levels_.end());
}

CellList::Cell CellList::cell_of(const Box& box) const
{
    int level = 0;
    std::frexp(extent(box) / smallest_cell_ * 0.999999, &level);
    level = std::clamp(level, 0, 60);
    while (std::ldexp(smallest_cell_, level) < extent(box))
        ++level;
    const double side = std::ldexp(smallest_cell_, level);
    const Vec2 centre = 0.5 * (box.low + box.high);
    // Blocks flying away for ever must not overflow the cell numbers; beyond the limit they share cells, which is only slow.
    constexpr double limit = 4.0e18;
    return {static_cast<std::int64_t>(std::clamp(std::floor(centre.x() / side), -limit, limit)),
            static_cast<std::int64_t>(std::clamp(std::floor(centre.y() / side), -limit, limit)), level};
}

std::size_t CellList::slot(std::int64_t x, std::uint64_t row) const
{
    return mixed(static_cast<std::uint64_t>(x) + row) & (head_.size() - 1);
}

void CellList::visit(std::size_t slot, const Cell& cell, Index box, std::vector<std::uint64_t>& pairs) const
{
    for (Index other = head_[slot]; other != no_index; other = next_[other])
    {
        const Cell& home = home_[other];  // several cells may share a slot
        if (home.level != cell.level || home.x != cell.x || home.y != cell.y || (cell.level == home_[box].level && other <= box))
            continue;
        if ((*boxes_)[box].meets((*boxes_)[other]))
            pairs.push_back(pair_key(std::min(box, other), std::max(box, other)));
    }
}

void CellList::find_pairs(IndexRange range, std::vector<std::uint64_t>& pairs) const
{
    for (Index i = range.begin; i < range.end; ++i)
    {
        const Cell home = home_[i];
        if (home.level < 0)
            continue;
        for (const int level : used_levels_)
        {
            if (level < home.level)
                continue;
            // Cells double from level to level.
            const int up = level - home.level;
            for (std::int64_t y = (home.y >> up) - 1; y <= (home.y >> up) + 1; ++y)
            {
                const std::uint64_t row = row_key(y, level);
                for (std::int64_t x = (home.x >> up) - 1; x <= (home.x >> up) + 1; ++x)
                    visit(slot(x, row), {x, y, level}, i, pairs);
            }
        }
    }
}
}  // namespace hdem
