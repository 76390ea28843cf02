#include "core/state/block_sorting.h"

#include "core/geometry/space_curve.h"
#include "core/model/block_order.h"
#include "core/state/fields.h"
#include "core/state/renumber.h"

#include <algorithm>
#include <cstdlib>

namespace hdem
{
namespace
{
constexpr Index least_blocks = 5000;
constexpr Index far_apart = 1000;

/// Where parts and vertices of the old order are in the new one.
struct Moved
{
    std::vector<Index> block, part, vertex;

    Moved(const Model& old, const Shapes& now, const std::vector<Index>& from)
        : block(from.size()),
          part(old.shapes.part_block.size()),
          vertex(old.shapes.vertex.size())
    {
        for (std::size_t i = 0; i < from.size(); ++i)
            block[from[i]] = static_cast<Index>(i);
        for (Index p = 0; p < old.shapes.parts(); ++p)
        {
            const Index owner = old.shapes.part_block[p];
            part[p] = now.part_begin[block[owner]] + p - old.shapes.part_begin[owner];
            for (Index v = old.shapes.vertex_begin[p]; v < old.shapes.vertex_begin[p + 1]; ++v)
                vertex[v] = now.vertex_begin[part[p]] + v - old.shapes.vertex_begin[p];
        }
    }

    void apply(Contact& contact) const
    {
        contact.part_a = part[contact.part_a];
        contact.part_b = part[contact.part_b];
        if (contact.part_a > contact.part_b)
        {
            std::swap(contact.part_a, contact.part_b);
            contact.swapped = !contact.swapped;
        }
        contact.ref = block[contact.ref];
        contact.inc = block[contact.inc];
        contact.ref_edge = vertex[contact.ref_edge];
        contact.inc_edge = vertex[contact.inc_edge];
    }
};

void move_contacts(const Moved& moved, Contacts& contacts)
{
    std::vector<Contact> list;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        list.push_back(contacts.get(i));
        moved.apply(list.back());
    }
    std::sort(list.begin(), list.end(),
              [](const Contact& a, const Contact& b) { return a.part_a != b.part_a ? a.part_a < b.part_a : a.part_b < b.part_b; });
    for (Index i = 0; i < contacts.size(); ++i)
        contacts.put(i, list[i]);
}
}  // namespace

bool is_order_decayed(const Model& model, const State& state)
{
    if (model.blocks() < least_blocks)
        return false;
    std::int64_t all = 0, far = 0;
    for (Index i = 0; i < state.contacts.size(); ++i)
    {
        const Index a = state.contacts.ref[i];
        const Index b = state.contacts.inc[i];
        if (!state.blocks.is_free(a) || !state.blocks.is_free(b))
            continue;
        ++all;
        far += std::abs(a - b) > far_apart ? 1 : 0;
    }
    return 4 * far > all;
}

void sort_blocks(Model& model, State& state)
{
    std::vector<Vec2> places;  // in the users' order
    for (const Index slot : model.slot_of_user)
        places.emplace_back(state.blocks.motion[slot].x, state.blocks.motion[slot].y);
    const std::vector<Index> user_number = curve_order(places, bounding_box(places));
    std::vector<Index> from;
    for (const Index user : user_number)
        from.push_back(model.slot_of_user[user]);

    Model sorted = model;
    reorder_blocks(user_number, sorted);
    const Moved moved(model, sorted.shapes, from);
    sorted.stages.swap(model.stages);  // where they are: a run keeps pointers to them
    model = std::move(sorted);

    fields::for_each(fields::block_arrays, state.blocks, [&](auto& array) { permute(from, array); });
    permute(from, state.rebuilt_at);
    if (!state.water.empty())
        permute(from, state.water);
    for (Index& block : state.next_to_excavation)
        block = moved.block[block];
    std::sort(state.next_to_excavation.begin(), state.next_to_excavation.end());
    renumber(moved.block, state.released);
    renumber(moved.block, state.moving);
    renumber(moved.block, state.creeping);
    move_contacts(moved, state.contacts);
    state.contacts_outdated = true;
}
}  // namespace hdem
