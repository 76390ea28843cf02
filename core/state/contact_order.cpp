#include "core/state/contact_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hdem
{
namespace
{
using LawKind = std::pair<JointKind, CurveKind>;

/// Contacts of the same law and normal curve are computed together. All plain joints are one law.
LawKind law_of(const JointRow& row)
{
    return {row.kind, row.has_memory() ? row.curve : CurveKind::linear};
}
}  // namespace

void put_bearing_first(const std::vector<Contact>& contacts, Index first, Contacts& list)
{
    const auto end = static_cast<Index>(contacts.size());
    for (Index begin = 0, next = 0; begin < end; begin = next)
    {
        next = std::min(end, begin + contacts_a_stretch - (first + begin) % contacts_a_stretch);
        Index place = first + begin;
        for (const bool bears : {true, false})
            for (Index k = begin; k < next; ++k)
                if (contacts[static_cast<std::size_t>(k)].may_bear() == bears)
                    list.put(place++, contacts[static_cast<std::size_t>(k)]);
    }
}

void group_alike(const JointTable& joints, Contacts& contacts)
{
    const auto kind = [&](bool bears, Index law)
    { return std::pair(!bears, contacts.has_memory ? law_of(joints.rows[static_cast<std::size_t>(law)]) : LawKind()); };
    const auto kind_at = [&](Index i) { return kind(contacts.may_bear(i), contacts.law[i]); };
    const auto kind_of_one = [&](const auto& one) { return kind(one.first.may_bear(), one.first.law); };
    std::vector<std::pair<Contact, std::uint8_t>> stretch;  // and whether features are stale
    for (Index begin = 0; begin < contacts.size(); begin += contacts_a_stretch)
    {
        const Index end = std::min(contacts.size(), begin + contacts_a_stretch);
        Index sorted = begin + 1;
        while (sorted < end && !(kind_at(sorted) < kind_at(sorted - 1)))
            ++sorted;
        if (sorted >= end)
            continue;
        stretch.clear();
        for (Index i = begin; i < end; ++i)
            stretch.emplace_back(contacts.get(i), contacts.stale[i]);
        std::ranges::stable_sort(stretch, {}, kind_of_one);
        for (Index i = begin; i < end; ++i)
        {
            const auto& [contact, stale] = stretch[static_cast<std::size_t>(i - begin)];
            contacts.put(i, contact);
            contacts.stale[i] = stale;
        }
    }
}

Index count_misplaced(const Contacts& contacts)
{
    Index misplaced = 0;
    bool is_behind = false;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        is_behind = is_behind && i % contacts_a_stretch != 0;
        if (!contacts.may_bear(i))
            is_behind = true;
        else if (is_behind)
            ++misplaced;
    }
    return misplaced;
}

std::vector<Index> order_by_parts(const Contacts& contacts)
{
    std::vector<Index> order(static_cast<std::size_t>(contacts.size()));
    std::iota(order.begin(), order.end(), Index{0});
    const auto parts = [&](Index i) { return std::pair(contacts.part_a[i], contacts.part_b[i]); };
    for (auto begin = order.begin(); begin != order.end();)
    {
        const auto next = begin + std::min<std::ptrdiff_t>(contacts_a_stretch, order.end() - begin);
        std::ranges::sort(begin, next, {}, parts);
        begin = next;
    }
    if (!std::ranges::is_sorted(order, {}, parts))
        std::ranges::sort(order, {}, parts);
    return order;
}
}  // namespace hdem
