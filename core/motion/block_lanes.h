#pragma once
/// Four blocks at once: from the arrays to Packs and back.

#include "core/motion/damping.h"
#include "core/state/workspace.h"

#include <algorithm>

namespace hdem
{
/// Run `work(first, count)` for groups of four of `range`; the last may have fewer.
template <typename Work>
void for_groups(IndexRange range, const Work& work)
{
    for (Index i = range.begin; i < range.end; i += lanes)
        work(i, std::min<Index>(lanes, range.end - i));
}

/// Rows of four doubles that begin at from[0], from[stride], ...: columns of them. Rows beyond `count` are zero.
struct Columns
{
    Pack a = 0.0, b = 0.0, c = 0.0, d = 0.0;

    Columns() = default;
    Columns(const double* from, std::ptrdiff_t stride, Index count)
    {
        a = Pack::load(from);
        if (count > 1)
            b = Pack::load(from + stride);
        if (count > 2)
            c = Pack::load(from + 2 * stride);
        if (count > 3)
            d = Pack::load(from + 3 * stride);
        transpose(a, b, c, d);
    }
    void store(double* to, std::ptrdiff_t stride, Index count) const
    {
        Columns rows = *this;
        transpose(rows.a, rows.b, rows.c, rows.d);
        rows.a.store(to);
        if (count > 1)
            rows.b.store(to + stride);
        if (count > 2)
            rows.c.store(to + 2 * stride);
        if (count > 3)
            rows.d.store(to + 3 * stride);
    }
};

template <typename Entry>
inline constexpr std::ptrdiff_t row_stride = sizeof(Entry) / sizeof(double);

[[nodiscard]] inline BasicActing<Pack> load_acting(const BlockForce* force, Index count)
{
    const Columns f(&force->x, row_stride<BlockForce>, count);
    BasicActing<Pack> acting{.x = f.a, .y = f.b, .moment = f.c, .reserve = max(f.d, Pack(0.0))};
    for (Index i = 0; i < count; ++i)
    {
        acting.mobilised.v[i] = force[i].mobilised;
        acting.t_x.v[i] = force[i].t_x;
        acting.t_y.v[i] = force[i].t_y;
        acting.springs.v[i] = (force[i].contacts & contact_force) != 0 ? -1 : 0;
        acting.impulses.v[i] = (force[i].contacts & contact_impulse) != 0 ? -1 : 0;
    }
    return acting;
}

[[nodiscard]] inline BasicInertia<Pack> load_inertia(const BlockInertia* inertia, Index count)
{
    const Columns i(&inertia->inverse_mass_x, row_stride<BlockInertia>, count);
    return {i.a, i.b, i.c, i.d};
}

[[nodiscard]] inline Pack load_some(const double* from, Index count, double otherwise = 0.0)
{
    if (count == lanes)
        return Pack::load(from);
    Pack p = otherwise;
    for (Index i = 0; i < count; ++i)
        p.v[i] = from[i];
    return p;
}
}  // namespace hdem
