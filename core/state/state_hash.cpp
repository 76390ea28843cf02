#include "core/state/state_hash.h"

#include "core/state/fields.h"
#include "core/state/hash_stream.h"

#include <algorithm>
#include <array>

namespace hdem
{
namespace
{
/// Number of each part when blocks are counted in the user's order.
std::vector<Index> user_part_numbers(const Model& model)
{
    const Shapes& shapes = model.shapes;
    std::vector<Index> number(shapes.part_block.size());
    Index count = 0;
    for (const Index block : model.slot_of_user)
        for (Index part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part)
            number[part] = count++;
    return number;
}

struct HashedContact
{
    std::int64_t low, high, sense;  ///< parts by user number; sense: the reference edge is on `low`
    std::array<double, 6> history;  ///< forces, rest overlaps
    std::array<std::int64_t, 2> regime;
};

struct HashedPreload
{
    std::int64_t low, high;
    std::array<double, 2> preload;
};

struct HashedMemory
{
    std::int64_t low, high;
    std::array<double, 10> memory;
};

std::array<double, 10> memory_of(const Contact& contact)
{
    std::array<double, 10> numbers{};
    auto at = numbers.begin();
    for (const PointHistory& point : contact.point)
        fields::for_each(fields::memory, point.memory, [&](double number) { *at++ = number + 0.0; });
    return numbers;
}

template <typename Rows>
void add_sorted(Rows& rows, HashStream& hash)
{
    std::sort(rows.begin(), rows.end(),
              [](const auto& p, const auto& q) { return p.low != q.low ? p.low < q.low : p.high < q.high; });
    hash.add_bytes(rows.data(), rows.size() * sizeof(rows.front()));
}

/// The numbers of a list of core/state/fields.h.
template <typename List, typename Record>
void add_list(const List& list, const Record& record, HashStream& hash)
{
    fields::for_each(list, record, [&](const auto& number) { hash.add(static_cast<double>(number)); });
}

void add_support(const SupportState& support, HashStream& hash)
{
    for (const BoltRecord& b : support.bolts)
        hash.add({static_cast<double>(b.status), b.force, b.shear_force, b.greatest_force});
    for (const LinerRecord& l : support.liners)
        hash.add({static_cast<double>(l.installed), static_cast<double>(l.since), l.spent});
    for (const double value : support.history)
        hash.add(value);
}

/// Points that are closed, then preloads and memories of all.
void add_contacts(const Model& model, const Contacts& contacts, HashStream& hash)
{
    const std::vector<Index> number = user_part_numbers(model);
    std::vector<HashedContact> closed;
    std::vector<HashedPreload> preloads;
    std::vector<HashedMemory> memories;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const Contact c = contacts.get(i);
        const PointHistory &p = c.point[0], &q = c.point[1];
        const Index a = number[c.part_a], b = number[c.part_b];
        const bool ref_is_a = model.shapes.part_block[c.part_a] == c.ref;
        const std::int64_t low = std::min(a, b), high = std::max(a, b);
        if (p.regime != Regime::open || q.regime != Regime::open)
            closed.push_back({low,
                              high,
                              (ref_is_a ? a : b) == low,
                              {p.normal_force + 0.0, q.normal_force + 0.0, p.shear_force + 0.0, q.shear_force + 0.0,
                               p.rest_overlap + 0.0, q.rest_overlap + 0.0},
                              {static_cast<std::int64_t>(p.regime), static_cast<std::int64_t>(q.regime)}});
        if (contacts.has_preload)
            preloads.push_back({low, high, {p.preload + 0.0, q.preload + 0.0}});
        if (contacts.has_memory)
            memories.push_back({low, high, memory_of(c)});
    }
    add_sorted(closed, hash);
    add_sorted(preloads, hash);
    add_sorted(memories, hash);
}
}  // namespace

std::uint64_t state_hash(const Model& model, const State& state)
{
    HashStream hash;
    for (const Index i : model.slot_of_user)
        add_list(fields::motion, state.blocks.motion[i], hash);
    for (const Index i : state.water.empty() ? std::vector<Index>{} : model.slot_of_user)
        add_list(fields::triple, state.water[i], hash);
    add_support(state.support, hash);
    add_contacts(model, state.contacts, hash);
    return hash.digest();
}
}  // namespace hdem
