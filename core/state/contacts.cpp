#include "core/state/contacts.h"

#include "core/state/fields.h"

#include <limits>
#include <type_traits>

namespace hdem
{
void Contacts::resize(Index n)
{
    size_ = n;
    const auto groups = static_cast<std::size_t>((n + lanes - 1) / lanes);
    const std::size_t size = groups * lanes;
    for (auto* column : {&part_a, &part_b, &ref, &inc, &ref_edge, &inc_edge, &law})
        column->resize(size);
    stale.resize(size);
    swapped.resize(size);
    for (auto& column : regime)
        column.resize(size);
    lane.resize(groups);
    preload_lane.resize(has_preload ? groups : 0);
    memory_lane.resize(has_memory ? groups : 0);
    const Contact none{.ref = 0,
                       .inc = 0,
                       .moved_limit = std::numeric_limits<float>::infinity(),
                       .length_floor = 1.0,
                       .last_length = 1.0,
                       .edges = {},
                       .point = {}};
    for (auto i = static_cast<std::size_t>(n); i < size; ++i)
        put(static_cast<Index>(i), none);
}

void Contacts::reserve(Index n)
{
    const auto groups = static_cast<std::size_t>((n + lanes - 1) / lanes);
    for (auto* column : {&part_a, &part_b, &ref, &inc, &ref_edge, &inc_edge, &law})
        column->reserve(groups * lanes);
    for (auto* column : {&stale, &swapped, &regime[0], &regime[1]})
        column->reserve(groups * lanes);
    lane.reserve(groups);
    preload_lane.reserve(has_preload ? groups : 0);
    memory_lane.reserve(has_memory ? groups : 0);
}

namespace
{
/// Use each number of contact `i` together with its place in the arrays.
template <typename AnyContacts, typename AnyContact, typename Use>
void for_each_number(AnyContacts& contacts, Index i, AnyContact& contact, const Use& use)
{
    const Index at = i % lanes;
    auto& lane = contacts.lane[i / lanes];
    fields::for_each_pair(fields::features, contact, contacts, [&](auto& number, auto& array) { use(number, array[i]); });
    fields::for_each_pair(fields::swapped, contact, contacts, [&](auto& number, auto& array) { use(number, array[i]); });
    const auto use_lane = [&](auto& number, auto& places) { use(number, places[at]); };
    fields::for_each_pair(fields::lengths, contact, lane, use_lane);
    fields::for_each_pair(fields::search, contact, lane, use_lane);
    fields::for_each_pair(fields::edges, contact.edges, lane, use_lane);
    for (int k = 0; k < 2; ++k)
    {
        auto& point = contact.point[k];
        const auto use_point = [&](auto& number, auto& places) { use(number, places[k][at]); };
        fields::for_each_pair(fields::forces, point, lane, use_point);
        fields::for_each_pair(fields::regime, point, contacts, [&](auto& number, auto& arrays) { use(number, arrays[k][i]); });
        if (contacts.has_preload)
            fields::for_each_pair(fields::preload, point, contacts.preload_lane[i / lanes], use_point);
        if (!contacts.has_memory)
            continue;
        auto& memory = contacts.memory_lane[i / lanes].point[k];
        fields::for_each_pair(fields::memory, point.memory, memory, use_lane);
        fields::for_each_pair(fields::springs, point, memory, use_lane);
    }
}

/// to = from, also from a byte to what it stands for.
constexpr auto assign = [](auto& to, const auto& from) { to = static_cast<std::remove_reference_t<decltype(to)>>(from); };
}  // namespace

EdgePair Contacts::edges(Index i) const
{
    EdgePair pair;
    fields::for_each_pair(fields::edges, pair, lane[i / lanes],
                          [&](double& number, const ContactLanes::Lane& places) { number = places[i % lanes]; });
    return pair;
}

JointMemory Contacts::memory(int end, Index i) const
{
    JointMemory memory;
    if (has_memory)
        fields::for_each_pair(fields::memory, memory, memory_lane[i / lanes].point[end],
                              [&](double& number, const ContactLanes::Lane& places) { number = places[i % lanes]; });
    return memory;
}

Contact Contacts::get(Index i) const
{
    Contact contact;
    for_each_number(*this, i, contact, [](auto& number, const auto& place) { assign(number, place); });
    return contact;
}

void Contacts::put(Index i, const Contact& contact)
{
    stale[i] = 0;
    for_each_number(*this, i, contact, [](const auto& number, auto& place) { assign(place, number); });
}
}  // namespace hdem
