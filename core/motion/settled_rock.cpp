#include "core/motion/settled_rock.h"

#include "core/contact/contact_report.h"

#include <boost/pending/disjoint_sets.hpp>

namespace hdem
{
std::vector<std::uint8_t> settled_rock(const Model& model, const State& state, double distance)
{
    const Blocks& blocks = state.blocks;
    const auto count = static_cast<std::size_t>(blocks.size());
    const auto moved = [&](Index i) { return Vec2(Vec2(blocks.motion[i].x, blocks.motion[i].y) - model.start[i]); };
    std::vector<Index> rank(count), parent(count);
    boost::disjoint_sets chains(rank.data(), parent.data());
    for (Index i = 0; i < blocks.size(); ++i)
        chains.make_set(i);
    const Contacts& contacts = state.contacts;
    for (Index i = 0; i < contacts.size(); ++i)
        if (is_closed_contact(state, i) && (moved(contacts.ref[i]) - moved(contacts.inc[i])).norm() <= distance)
            chains.union_set(contacts.ref[i], contacts.inc[i]);
    std::vector<std::uint8_t> stays(count, 0), settled(count, 0);
    for (Index i = 0; i < blocks.size(); ++i)
        if (blocks.present[i] != 0 && moved(i).norm() <= distance)
            stays[chains.find_set(i)] = 1;
    for (Index i = 0; i < blocks.size(); ++i)
        settled[i] = stays[chains.find_set(i)];
    return settled;
}
}  // namespace hdem
