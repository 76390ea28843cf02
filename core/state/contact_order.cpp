#include "core/state/contact_order.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace hdem
{
namespace
{
/// Contacts of the same law and normal curve are computed together. All plain joints are one law.
std::pair<JointKind, CurveKind> law_of(const JointRow& row)
{
    return {row.kind, row.has_memory() ? row.curve : CurveKind::linear};
}
}  // namespace

void group_by_law(const JointTable& joints, Contacts& contacts)
{
    if (!contacts.has_memory)
        return;
    const auto law = [&](const Contact& contact) { return law_of(joints.rows[static_cast<std::size_t>(contact.law)]); };
    std::vector<Contact> stretch;
    for (Index begin = 0; begin < contacts.size(); begin += contacts_a_stretch)
    {
        const Index end = std::min(contacts.size(), begin + contacts_a_stretch);
        stretch.clear();
        for (Index i = begin; i < end; ++i)
            stretch.push_back(contacts.get(i));
        if (std::ranges::is_sorted(stretch, {}, law))
            continue;
        std::ranges::stable_sort(stretch, {}, law);
        for (Index i = begin; i < end; ++i)
            contacts.put(i, stretch[static_cast<std::size_t>(i - begin)]);
    }
}

std::vector<Index> order_by_parts(const Contacts& contacts)
{
    std::vector<Index> order(static_cast<std::size_t>(contacts.size()));
    std::iota(order.begin(), order.end(), Index{0});
    const auto parts = [&](Index i) { return std::pair(contacts.part_a[i], contacts.part_b[i]); };
    if (!std::ranges::is_sorted(order, {}, parts))
        std::ranges::sort(order, {}, parts);
    return order;
}
}  // namespace hdem
