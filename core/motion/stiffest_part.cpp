#include "core/motion/stiffest_part.h"

#include <algorithm>
#include <numeric>

namespace hdem
{
namespace
{
constexpr Index large = 20'000;       ///< blocks from which on a part of them is looked at
constexpr std::size_t stiffest = 64;  ///< blocks in the middle of that part
constexpr int rings = 3;              ///< of neighbours around them

Part whole(const Blocks& blocks, const Contacts& contacts)
{
    Part part;
    part.blocks.resize(static_cast<std::size_t>(blocks.size()));
    part.contacts.resize(static_cast<std::size_t>(contacts.size()));
    std::iota(part.blocks.begin(), part.blocks.end(), 0);
    std::iota(part.contacts.begin(), part.contacts.end(), 0);
    return part;
}

/// Upper bounds of what blocks contribute to omega_max^2, as in stable_step, by the trace.
std::vector<double> bounds_of_blocks(const Model& model, const Blocks& blocks, const Contacts& contacts, Springs which)
{
    std::vector<double> bound(static_cast<std::size_t>(blocks.size()), 0.0);
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const Vec3 ref = inverse_masses(blocks, contacts.ref[i]), inc = inverse_masses(blocks, contacts.inc[i]);
        for_acting_springs(model, blocks, contacts, which, i,
                           [&](const ContactSpring& spring)
                           {
                               const double by_ref = spring.ref.dot(ref.cwiseProduct(spring.ref));
                               const double by_inc = spring.inc.dot(inc.cwiseProduct(spring.inc));
                               bound[contacts.ref[i]] += by_ref > 0.0 ? spring.stiffness * (by_ref + by_inc) : 0.0;
                               bound[contacts.inc[i]] += by_inc > 0.0 ? spring.stiffness * (by_ref + by_inc) : 0.0;
                           });
    }
    return bound;
}
}  // namespace

Part stiffest_part(const Model& model, const Blocks& blocks, const Contacts& contacts, Springs which)
{
    if (blocks.size() < large || !model.support.bolts.empty() || !model.support.ties.empty())
        return whole(blocks, contacts);
    const std::vector<double> bound = bounds_of_blocks(model, blocks, contacts, which);
    std::vector<Index> order(bound.size());
    std::iota(order.begin(), order.end(), 0);
    const auto middle = order.begin() + static_cast<std::ptrdiff_t>(std::min(stiffest, order.size()));
    std::partial_sort(order.begin(), middle, order.end(),
                      [&](Index a, Index b) { return bound[a] != bound[b] ? bound[a] > bound[b] : a < b; });
    std::vector<std::uint8_t> is_in(bound.size(), 0), is_next;
    std::for_each(order.begin(), middle, [&](Index b) { is_in[b] = 1; });
    for (int ring = 0; ring < rings; ++ring)
    {
        is_next = is_in;
        for (Index i = 0; i < contacts.size(); ++i)
            if (is_in[contacts.ref[i]] != is_in[contacts.inc[i]])
                is_next[contacts.ref[i]] = is_next[contacts.inc[i]] = 1;
        is_in.swap(is_next);
    }
    Part part;
    for (Index b = 0; b < blocks.size(); ++b)
        if (is_in[b] != 0)
            part.blocks.push_back(b);
    for (Index i = 0; i < contacts.size(); ++i)
        if (is_in[contacts.ref[i]] != 0 || is_in[contacts.inc[i]] != 0)
            part.contacts.push_back(i);
    return part;
}
}  // namespace hdem
