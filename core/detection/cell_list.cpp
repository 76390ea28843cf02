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

    const auto n = static_cast<Index>(boxes.size());
    level_.assign(boxes.size(), -1);
    next_.assign(boxes.size(), no_index);
    used_levels_.clear();
    std::size_t slots = 16;
    while (slots < 2 * boxes.size())
        slots *= 2;
    head_.assign(slots, no_index);
    // Backwards, so that each slot's chain ascends.
    for (Index i = n - 1; i >= 0; --i)
    {
        if (is_empty(boxes[i]))
            continue;
        int level = 0;
        std::frexp(extent(boxes[i]) / smallest_cell_ * 0.999999, &level);
        level_[i] = std::clamp(level, 0, 60);
        while (std::ldexp(smallest_cell_, level_[i]) < extent(boxes[i]))
            ++level_[i];
        const std::size_t s = slot(cell_of(i, level_[i]));
        next_[i] = head_[s];
        head_[s] = i;
        if (std::find(used_levels_.begin(), used_levels_.end(), level_[i]) == used_levels_.end())
            used_levels_.push_back(level_[i]);
    }
    std::sort(used_levels_.begin(), used_levels_.end());
}

CellList::Cell CellList::cell_of(Index box, int level) const
{
    const double side = std::ldexp(smallest_cell_, level);
    const Vec2 centre = 0.5 * ((*boxes_)[box].low + (*boxes_)[box].high);
    // Blocks flying away for ever must not overflow the cell numbers; beyond the limit they share cells, which is only slow.
    constexpr double limit = 4.0e18;
    return {static_cast<std::int64_t>(std::clamp(std::floor(centre.x() / side), -limit, limit)),
            static_cast<std::int64_t>(std::clamp(std::floor(centre.y() / side), -limit, limit)), level};
}

std::size_t CellList::slot(const Cell& cell) const
{
    const std::uint64_t key = mixed(static_cast<std::uint64_t>(cell.x) + mixed(static_cast<std::uint64_t>(cell.y) * 64u + static_cast<std::uint64_t>(cell.level)));
    return key & (head_.size() - 1);
}

void CellList::visit(const Cell& cell, Index box, std::vector<std::uint64_t>& pairs) const
{
    for (Index other = head_[slot(cell)]; other != no_index; other = next_[other])
    {
        if (level_[other] != cell.level || (cell.level == level_[box] && other <= box) || !(*boxes_)[box].meets((*boxes_)[other]))
            continue;
        const Cell home = cell_of(other, cell.level);  // several cells may share a slot
        if (home.x == cell.x && home.y == cell.y)
            pairs.push_back(pair_key(std::min(box, other), std::max(box, other)));
    }
}

void CellList::find_pairs(IndexRange range, std::vector<std::uint64_t>& pairs) const
{
    for (Index i = range.begin; i < range.end; ++i)
    {
        if (level_[i] < 0)
            continue;
        for (const int level : used_levels_)
        {
            if (level < level_[i])
                continue;
            const Cell home = cell_of(i, level);
            for (std::int64_t dy = -1; dy <= 1; ++dy)
                for (std::int64_t dx = -1; dx <= 1; ++dx)
                    visit({home.x + dx, home.y + dy, level}, i, pairs);
        }
    }
}
}  // namespace hdem
