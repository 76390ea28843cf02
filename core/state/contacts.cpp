#include "core/state/contacts.h"

namespace hdem
{
void Contacts::resize(Index n)
{
    const auto size = static_cast<std::size_t>(n);
    for (auto* column : {&part_a, &part_b, &ref, &inc, &ref_edge, &inc_edge, &law})
        column->resize(size);
    for (auto* column : {&length_floor, &last_length, &tx, &ty, &start_t, &start_m, &length, &p0x, &p0y, &p1x, &p1y})
        column->resize(size);
    for (auto* column : {&seen0, &seen1, &seen2, &seen3, &moved_limit})
        column->resize(size);
    stale.resize(size);
    for (int k = 0; k < 2; ++k)
    {
        normal_force[k].resize(size);
        shear_force[k].resize(size);
        overlap[k].resize(size);
        rest_overlap[k].resize(size);
        regime[k].resize(size);
    }
}

Contact Contacts::get(Index i) const
{
    Contact contact{.part_a = part_a[i],
                    .part_b = part_b[i],
                    .ref = ref[i],
                    .inc = inc[i],
                    .ref_edge = ref_edge[i],
                    .inc_edge = inc_edge[i],
                    .law = law[i],
                    .moved_limit = moved_limit[i],
                    .seen = {seen0[i], seen1[i], seen2[i], seen3[i]},
                    .length_floor = length_floor[i],
                    .last_length = last_length[i],
                    .edges = edges(i),
                    .point = {}};
    for (int k = 0; k < 2; ++k)
        contact.point[k] = {normal_force[k][i], shear_force[k][i], rest_overlap[k][i], static_cast<Regime>(regime[k][i]), overlap[k][i]};
    return contact;
}

void Contacts::put(Index i, const Contact& contact)
{
    part_a[i] = contact.part_a;
    part_b[i] = contact.part_b;
    ref[i] = contact.ref;
    inc[i] = contact.inc;
    ref_edge[i] = contact.ref_edge;
    inc_edge[i] = contact.inc_edge;
    law[i] = contact.law;
    moved_limit[i] = contact.moved_limit;
    seen0[i] = contact.seen[0];
    seen1[i] = contact.seen[1];
    seen2[i] = contact.seen[2];
    seen3[i] = contact.seen[3];
    length_floor[i] = contact.length_floor;
    last_length[i] = contact.last_length;
    tx[i] = contact.edges.tx;
    ty[i] = contact.edges.ty;
    start_t[i] = contact.edges.start_t;
    start_m[i] = contact.edges.start_m;
    length[i] = contact.edges.length;
    p0x[i] = contact.edges.p0x;
    p0y[i] = contact.edges.p0y;
    p1x[i] = contact.edges.p1x;
    p1y[i] = contact.edges.p1y;
    stale[i] = 0;
    for (int k = 0; k < 2; ++k)
    {
        normal_force[k][i] = contact.point[k].normal_force;
        shear_force[k][i] = contact.point[k].shear_force;
        overlap[k][i] = contact.point[k].overlap;
        rest_overlap[k][i] = contact.point[k].rest_overlap;
        regime[k][i] = static_cast<std::uint8_t>(contact.point[k].regime);
    }
}
}  // namespace hdem
