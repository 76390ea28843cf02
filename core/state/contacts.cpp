#include "core/state/contacts.h"

#include <limits>

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

EdgePair Contacts::edges(Index i) const
{
    const ContactLanes& l = lane[i / lanes];
    const Index k = i % lanes;
    return {l.tx[k], l.ty[k], l.start_t[k], l.start_m[k], l.length[k], l.p0x[k], l.p0y[k], l.p1x[k], l.p1y[k]};
}

JointMemory Contacts::memory(int end, Index i) const
{
    if (!has_memory)
        return {};
    const MemoryLanes::Point& m = memory_lane[i / lanes].point[end];
    const Index at = i % lanes;
    return {m.slip[at], m.state[at], m.turn[at], m.opening[at], m.broken[at]};
}

Contact Contacts::get(Index i) const
{
    const ContactLanes& l = lane[i / lanes];
    const Index at = i % lanes;
    Contact contact{.part_a = part_a[i],
                    .part_b = part_b[i],
                    .ref = ref[i],
                    .inc = inc[i],
                    .ref_edge = ref_edge[i],
                    .inc_edge = inc_edge[i],
                    .law = law[i],
                    .swapped = swapped[i] != 0,
                    .moved_limit = l.moved_limit[at],
                    .seen = {l.seen[0][at], l.seen[1][at], l.seen[2][at], l.seen[3][at]},
                    .length_floor = l.length_floor[at],
                    .last_length = l.last_length[at],
                    .edges = edges(i),
                    .point = {}};
    for (int k = 0; k < 2; ++k)
    {
        PointHistory& point = contact.point[k];
        point.normal_force = l.normal_force[k][at];
        point.shear_force = l.shear_force[k][at];
        point.rest_overlap = l.rest_overlap[k][at];
        point.regime = static_cast<Regime>(regime[k][i]);
        point.overlap = l.overlap[k][at];
        point.tilt_force = l.tilt_force[k][at];
        point.preload = preload(k, i);
        if (!has_memory)
            continue;
        point.memory = memory(k, i);
        point.energy = memory_lane[i / lanes].point[k].energy[at];
        point.stiffness = memory_lane[i / lanes].point[k].stiffness[at];
    }
    return contact;
}

void Contacts::put(Index i, const Contact& contact)
{
    ContactLanes& l = lane[i / lanes];
    const Index at = i % lanes;
    part_a[i] = contact.part_a;
    part_b[i] = contact.part_b;
    ref[i] = contact.ref;
    inc[i] = contact.inc;
    ref_edge[i] = contact.ref_edge;
    inc_edge[i] = contact.inc_edge;
    law[i] = contact.law;
    stale[i] = 0;
    swapped[i] = contact.swapped ? 1 : 0;
    l.moved_limit[at] = contact.moved_limit;
    for (int k = 0; k < 4; ++k)
        l.seen[k][at] = contact.seen[k];
    l.length_floor[at] = contact.length_floor;
    l.last_length[at] = contact.last_length;
    const EdgePair& e = contact.edges;
    l.tx[at] = e.tx;
    l.ty[at] = e.ty;
    l.start_t[at] = e.start_t;
    l.start_m[at] = e.start_m;
    l.length[at] = e.length;
    l.p0x[at] = e.p0x;
    l.p0y[at] = e.p0y;
    l.p1x[at] = e.p1x;
    l.p1y[at] = e.p1y;
    for (int k = 0; k < 2; ++k)
    {
        l.normal_force[k][at] = contact.point[k].normal_force;
        l.shear_force[k][at] = contact.point[k].shear_force;
        l.overlap[k][at] = contact.point[k].overlap;
        l.rest_overlap[k][at] = contact.point[k].rest_overlap;
        l.tilt_force[k][at] = contact.point[k].tilt_force;
        regime[k][i] = static_cast<std::uint8_t>(contact.point[k].regime);
        if (has_preload)
            preload_lane[i / lanes].preload[k][at] = contact.point[k].preload;
        if (!has_memory)
            continue;
        MemoryLanes::Point& m = memory_lane[i / lanes].point[k];
        const JointMemory& from = contact.point[k].memory;
        m.slip[at] = from.slip;
        m.state[at] = from.state;
        m.turn[at] = from.turn;
        m.opening[at] = from.opening;
        m.broken[at] = from.broken;
        m.energy[at] = contact.point[k].energy;
        m.stiffness[at] = contact.point[k].stiffness;
    }
}
}  // namespace hdem
