/// Blocks that a static search leaves out: those that have come away, and those that keep the others from coming to rest.

#include "parallel/static_search.h"

#include <algorithm>

namespace hdem
{
namespace
{
constexpr double frozen_share = 0.2;  // of the worst block's imbalance: blocks farther out, which swing to and fro, are left out
constexpr double most_frozen = 2e-3;  // if they are no more of all blocks
constexpr double away = 1e-2;         // of the middle size of a block
}  // namespace

bool StaticSearch::too_many_held() const
{
    Index free = 0, held = 0;
    for (Index b = 0; b < model_.blocks(); ++b)
    {
        free += state_.blocks.is_free(b) ? 1 : 0;
        held += is_held_[b] == come_away ? 1 : 0;
    }
    return static_cast<double>(held) > rule_.most_loose * static_cast<double>(free);
}

bool StaticSearch::let_stand_again()
{
    const auto held = std::ranges::count(is_held_, static_cast<std::uint8_t>(come_away));
    std::ranges::replace(is_held_, std::uint8_t{come_away}, std::uint8_t{not_held});
    return held > 0;
}

/// False when too many have come away.
bool StaticSearch::hold_loose()
{
    const std::vector<Index> loose = find_loose(state_, whole_.unknowns, is_held_, tangents_, moved_,
                                                std::max(away * block_size_, far_));
    if (loose.empty())
        return true;
    for (const Index b : loose)
        is_held_[b] = come_away;
    if (too_many_held())
        return false;
    number();
    find_imbalance(whole_, false, false);
    return true;
}

/// Leave out the blocks that are farthest out of balance, for the rest of the search, if they are few.
bool StaticSearch::freeze_worst()
{
    std::vector<Index> worst;
    for (std::size_t u = 0; u < whole_.unknowns.block.size(); ++u)
        if (unbalanced(model_, whole_.unknowns.block[u], &whole_.net[3 * u]) > frozen_share * whole_.imbalance.worst)
            worst.push_back(whole_.unknowns.block[u]);
    if (static_cast<double>(worst.size()) > most_frozen * static_cast<double>(whole_.unknowns.block.size()))
        return false;
    for (const Index b : worst)
        is_held_[b] = frozen;
    number();
    find_imbalance(whole_, false, false);
    return true;
}
}  // namespace hdem
