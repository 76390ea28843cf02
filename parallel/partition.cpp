#include "parallel/partition.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace hdem
{
namespace
{
template <typename Part>
void cut(Index size, Index a_part, std::vector<Part>& parts)
{
    parts.resize(static_cast<std::size_t>((size + a_part - 1) / a_part));
    for (Index i = 0; i < static_cast<Index>(parts.size()); ++i)
    {
        parts[i].range = {i * a_part, std::min(size, (i + 1) * a_part)};
        parts[i].active = {parts[i].range};
    }
}

/// Give each part the least colour that no earlier part has on one of its movable blocks. If a block has 64 colours already, its further parts get colours
/// of their own.
void find_colours(const State& state, Partition& partition)
{
    const Contacts& contacts = state.contacts;
    std::vector<std::uint64_t> taken(static_cast<std::size_t>(state.blocks.size()), 0);
    std::vector<Index> single;
    partition.colours.clear();
    for (Index part = 0; part < static_cast<Index>(partition.contacts.size()); ++part)
    {
        const IndexRange range = partition.contacts[part].range;
        const auto for_movable = [&](const auto& visit)
        {
            for (Index i = range.begin; i < range.end; ++i)
                for (const Index block : {contacts.ref[i], contacts.inc[i]})
                    if (state.blocks.is_free(block))
                        visit(taken[block]);
        };
        std::uint64_t all = 0;
        for_movable([&](std::uint64_t colours) { all |= colours; });
        const int colour = std::countr_one(all);
        if (colour >= 64)
        {
            single.push_back(part);
            continue;
        }
        for_movable([&](std::uint64_t& colours) { colours |= std::uint64_t{1} << colour; });
        if (colour >= static_cast<int>(partition.colours.size()))
            partition.colours.resize(static_cast<std::size_t>(colour) + 1);
        partition.colours[colour].push_back(part);
    }
    for (const Index part : single)
        partition.colours.push_back({part});
}
}  // namespace

void ContactPart::forget()
{
    rests = true;
    seen_until = -1.0;
}

void ContactPart::remember(double gone)
{
    // The view was rounded to floats then and will be when it is looked at next.
    const double slack = tally.slack - 0x1p-21 * farthest_view;
    seen_until = tally.stale == 0 && slack > 0.0 ? gone + (1.0 - 1e-6) * slack / view_way : -1.0;
}

namespace
{
/// How far a vertex of `inc` may be from the start of an edge of `ref`, and how far it may move as seen from there while neither uses up more than its margin [m].
/// Pairs are at most both margins apart when they are found, and come no farther apart than twice that before they are found anew.
struct ViewBounds
{
    double distance, way;

    ViewBounds(Index ref, Index inc, const Model& model, const Blocks& blocks)
    {
        const double margin = blocks.margin[ref], other_margin = blocks.margin[inc];
        const double arm = model.radius[ref] + 2.0 * model.radius[inc] + 2.0 * (margin + other_margin);
        distance = model.radius[ref] + arm;
        // A block that turns by margin / radius moves what is at the arm by more than its margin.
        way = other_margin + margin * std::max(arm / model.radius[ref], 1.0);
    }
};
}  // namespace

void look_at_blocks(const Model& model, const State& state, Partition& partition)
{
    std::vector<Index>& all = partition.blocks_of_contacts;
    all.clear();
    for (ContactPart& part : partition.contacts)
    {
        const auto first = static_cast<std::ptrdiff_t>(all.size());
        part.farthest_view = part.view_way = 0.0;
        for (Index i = part.range.begin; i < part.range.end; ++i)
        {
            const Index ref = state.contacts.ref[i], inc = state.contacts.inc[i];
            all.insert(all.end(), {ref, inc});
            // Both ways: which block has the reference edge may change.
            for (const ViewBounds& of : {ViewBounds(ref, inc, model, state.blocks), ViewBounds(inc, ref, model, state.blocks)})
            {
                part.farthest_view = std::max(part.farthest_view, of.distance);
                part.view_way = std::max(part.view_way, of.way);
            }
        }
        std::sort(all.begin() + first, all.end());
        all.erase(std::unique(all.begin() + first, all.end()), all.end());
        part.blocks = {static_cast<Index>(first), static_cast<Index>(all.size())};
    }
}

void make_partition(const State& state, bool with_colours, Partition& partition)
{
    cut(state.contacts.size(), largest_part, partition.contacts);
    cut(state.blocks.size(), blocks_a_part, partition.blocks);
    partition.colours.clear();
    if (with_colours)
        find_colours(state, partition);
}
}  // namespace hdem
