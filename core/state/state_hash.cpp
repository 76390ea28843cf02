#include "core/state/state_hash.h"

#include "core/state/hash_stream.h"
#include "core/state/renumber.h"
#include "core/state/state_tables.h"

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <utility>

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

template <typename T>
void add_number(const T& number, HashStream& hash)
{
    if constexpr (std::is_floating_point_v<T>)
        hash.add(static_cast<double>(number));
    else
    {
        const auto whole = static_cast<std::int64_t>(number);  // not every one of them is a double
        hash.add_bytes(&whole, sizeof whole);
    }
}

template <typename List, typename Record>
void add_row(const List& list, const Record& record, HashStream& hash)
{
    fields::for_each(list, record, [&](const auto& number) { add_number(number, hash); });
}

/// What State tells of blocks by their slots.
struct NamedBlocks
{
    std::vector<Index> next_to_excavation;
    std::vector<ReleasedForce> released;
    std::vector<MovingBlock> moving;
    std::vector<CreepingBlock> creeping;
};

NamedBlocks in_user_order(const Model& model, const State& state)
{
    NamedBlocks named{state.next_to_excavation, state.released, state.moving, state.creeping};
    for (Index& block : named.next_to_excavation)
        block = model.user_number[block];
    std::ranges::sort(named.next_to_excavation);
    renumber(model.user_number, named.released);
    renumber(model.user_number, named.moving);
    renumber(model.user_number, named.creeping);
    return named;
}

/// A contact by the user's numbers: of its parts, the lower one first, of its blocks, and of edges within their parts.
Contact in_user_numbers(const Model& model, const std::vector<Index>& part_number, Contact contact)
{
    const Index ref_part = contact.swapped ? contact.part_b : contact.part_a;
    const Index inc_part = contact.swapped ? contact.part_a : contact.part_b;
    const Index ref = part_number[ref_part], inc = part_number[inc_part];
    contact.part_a = std::min(ref, inc);
    contact.part_b = std::max(ref, inc);
    contact.swapped = ref > inc;
    contact.ref = model.user_number[contact.ref];
    contact.inc = model.user_number[contact.inc];
    contact.ref_edge -= model.shapes.vertex_begin[ref_part];
    contact.inc_edge -= model.shapes.vertex_begin[inc_part];
    if (!contact.may_bear())  // overlaps are not kept up to date then, and nothing else is there
        contact.point = {};
    return contact;
}

/// The joint of a contact by what it is: its place in memory depends on how often properties have been set.
void add_joint(const Model& model, Index law, HashStream& hash)
{
    const CoulombSlip& joint = model.joints.laws[static_cast<std::size_t>(law)];
    hash.add({joint.normal_stiffness, joint.shear_stiffness, joint.friction_coefficient, joint.cohesion, joint.restitution});
}

void add_contacts(const Model& model, const Contacts& contacts, HashStream& hash)
{
    const std::vector<Index> part_number = user_part_numbers(model);
    const auto pair_of = [&](Index i)
    {
        const Index a = part_number[contacts.part_a[i]], b = part_number[contacts.part_b[i]];
        return std::pair(std::min(a, b), std::max(a, b));
    };
    std::vector<Index> order(static_cast<std::size_t>(contacts.size()));
    std::iota(order.begin(), order.end(), Index{0});
    std::ranges::sort(order, {}, pair_of);
    for (const Index i : order)
    {
        Contact contact = in_user_numbers(model, part_number, contacts.get(i));
        add_joint(model, std::exchange(contact.law, 0), hash);
        tables::for_each_of_contact(contacts.has_preload, contacts.has_memory,
                                    [&](auto, const char*, const auto& list) { add_row(list, contact, hash); });
        add_number(contacts.stale[i], hash);
    }
}
}  // namespace

std::uint64_t state_hash(const Model& model, const State& state)
{
    HashStream hash;
    const auto all_rows = [&](auto, const char*, const auto& rows, const auto& list)
    {
        for (const auto& row : rows)
            add_row(list, row, hash);
    };
    tables::for_each_of_run(state, [&](const char*, const auto& number) { add_number(number, hash); });
    tables::for_each_of_ends(state, all_rows);
    tables::for_each_of_blocks(state,
                               [&](auto, const char*, const auto& rows, const auto& list)
                               {
                                   for (const Index i : model.slot_of_user)
                                       add_row(list, rows[i], hash);
                               });
    const NamedBlocks named = in_user_order(model, state);
    tables::for_each_of_excavations(named, all_rows);
    tables::for_each_of_groups(named, all_rows);
    tables::for_each_of_support(state.support, all_rows);
    add_contacts(model, state.contacts, hash);
    return hash.digest();
}
}  // namespace hdem
