#include "core/detection/contact_tracking.h"

#include "core/detection/manifold.h"
#include "core/energy_ledger.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
/// find_features, with the energy it takes from or gives to the springs booked.
double search(const Model& model, const Blocks& blocks, Contact& contact, EnergyLedger& ledger)
{
    const double before = held_energy(model, contact);
    const double distance = find_features(model, blocks, contact);
    ledger.contact_changes += before - held_energy(model, contact);
    return distance;
}
}  // namespace

double skin_width(const Model& model)
{
    return model.contact.skin * model.mean_size;
}

double way_a_cycle(Index block, const Model& model, const Blocks& blocks)
{
    const BlockMotion& m = blocks.motion[block];
    return (std::sqrt(m.vx * m.vx + m.vy * m.vy) + std::abs(m.w) * model.radius[block]) * blocks.step.next;
}

void set_margins(const Model& model, Blocks& blocks)
{
    constexpr double cycles = 64.0;
    constexpr double most = 8.0;
    const double least = 0.5 * skin_width(model);
    for (Index b = 0; b < blocks.size(); ++b)
    {
        const double way = way_a_cycle(b, model, blocks);
        blocks.margin[b] = way * cycles > least ? std::min(way * cycles, most * least)
                                                : least;  // least where `way` is not a number
    }
}

namespace
{
/// A block that has left the model is held there (Simulation::hold_lost_blocks). What falls after it would hit it at great speed.
bool is_held_far_outside(Index block, const Model& model, const Blocks& blocks)
{
    const BlockMotion& m = blocks.motion[block];
    return !blocks.is_free(block) && !model.is_wall(block) && model.is_far_outside({m.x, m.y});
}
}  // namespace

void compute_boxes(IndexRange parts, const Model& model, const Blocks& blocks, std::vector<Box>& boxes)
{
    const Shapes& shapes = model.shapes;
    for (Index part = parts.begin; part < parts.end; ++part)
    {
        const Index block = shapes.part_block[part];
        boxes[part] = empty_box;
        if (blocks.present[block] == 0 || is_held_far_outside(block, model, blocks))
            continue;
        const BlockMotion& m = blocks.motion[block];
        Vec2 lower(m.x, m.y), upper(m.x, m.y);
        for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
        {
            const Vec2& p = shapes.vertex[v];
            const Vec2 world(m.x + m.c * p.x() - m.s * p.y(), m.y + m.s * p.x() + m.c * p.y());
            lower = v == shapes.vertex_begin[part] ? world : Vec2(lower.cwiseMin(world));
            upper = v == shapes.vertex_begin[part] ? world : Vec2(upper.cwiseMax(world));
        }
        const Vec2 margin(blocks.margin[block], blocks.margin[block]);
        boxes[part] = {lower - margin, upper + margin};
    }
}

double margin_used(IndexRange range, const Model& model, const Blocks& blocks, const std::vector<BlockMotion>& rebuilt_at)
{
    double greatest = 0.0;
    for (Index i = range.begin; i < range.end; ++i)
    {
        const BlockMotion& now = blocks.motion[i];
        const BlockMotion& then = rebuilt_at[i];
        const double turned = std::abs(now.angle - then.angle) * model.radius[i];
        const double dx = now.x - then.x, dy = now.y - then.y;
        const double moved = std::sqrt(dx * dx + dy * dy);
        const double used = (moved + turned) / blocks.margin[i];
        if (blocks.present[i] != 0 && !(used <= greatest))
            greatest = std::isfinite(used) ? used : std::numeric_limits<double>::infinity();
    }
    return greatest;
}

void track_contacts(IndexRange pairs_range, const std::vector<std::uint64_t>& pairs, const Model& model, const Blocks& blocks,
                    const Contacts& old, const std::vector<Index>& old_order, std::vector<Contact>& out, EnergyLedger& ledger)
{
    const Shapes& shapes = model.shapes;
    const auto key_of = [&](Index i) { return pair_key(old.part_a[old_order[i]], old.part_b[old_order[i]]); };
    Index at = 0;  // in old_order; found by bisection once, then walked
    if (pairs_range.size() > 0)
    {
        Index low = 0, high = old.size();
        while (low < high)
        {
            const Index middle = low + (high - low) / 2;
            if (key_of(middle) < pairs[pairs_range.begin])
                low = middle + 1;
            else
                high = middle;
        }
        at = low;
    }
    for (Index p = pairs_range.begin; p < pairs_range.end; ++p)
    {
        const std::uint64_t key = pairs[p];
        const Index part_a = first_of(key);
        const Index part_b = second_of(key);
        const Index block_a = shapes.part_block[part_a];
        const Index block_b = shapes.part_block[part_b];
        if (block_a == block_b || !(blocks.is_free(block_a) || blocks.is_free(block_b)))
            continue;
        while (at < old.size() && key_of(at) < key)
            ++at;
        Contact contact;
        const bool known = at < old.size() && key_of(at) == key;
        if (known)
            contact = old.get(old_order[at]);
        if (known && !blocks.takes_part(block_a) && !blocks.takes_part(block_b))
        {
            out.push_back(contact);  // neither has moved
            continue;
        }
        contact.part_a = part_a;
        contact.part_b = part_b;
        if (search(model, blocks, contact, ledger) <= blocks.margin[block_a] + blocks.margin[block_b])
            out.push_back(contact);
        else
            ledger.contact_changes += held_energy(model, contact);
    }
}

Index refresh_features(IndexRange range, const Model& model, const Blocks& blocks, Contacts& contacts, EnergyLedger& ledger)
{
    Index searched = 0;
    for (Index i = range.begin; i < range.end; ++i)
    {
        if (contacts.stale[i] == 0)
            continue;
        Contact contact = contacts.get(i);
        search(model, blocks, contact, ledger);
        contacts.put(i, contact);
        ++searched;
    }
    return searched;
}
}  // namespace hdem
