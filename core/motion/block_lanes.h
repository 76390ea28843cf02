#pragma once
/// As many blocks at once as a pack holds: from the arrays to packs and back. Four; eight of them in wide_blocks.h.

#include "core/motion/damping.h"
#include "core/state/workspace.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace hdem
{
inline namespace HDEM_LANES
{
/// Run `work(first, count)` for groups of `range` that fill a pack; the last may have fewer. For full groups `count` is a compile-time constant, so that its tests vanish.
template <typename P, typename Work>
void for_groups(IndexRange range, const Work& work)
{
    Index i = range.begin;
    for (; i + P::width <= range.end; i += P::width)
        work(i, std::integral_constant<Index, P::width>());
    if (i < range.end)
        work(i, range.end - i);
}

/// Columns of rows of four doubles, which begin at from[0], from[stride], ... Rows beyond `count` are zero.
template <typename P>
struct Columns;

template <>
struct Columns<Pack>
{
    Pack a = 0.0, b = 0.0, c = 0.0, d = 0.0;

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

static_assert(offsetof(BlockForce, t_y) == offsetof(BlockForce, contacts) + 12);

template <typename Entry>
inline constexpr std::ptrdiff_t row_stride = sizeof(Entry) / sizeof(double);

/// Columns of the members after `reserve` in BlockForces.
template <typename P>
struct JointColumns;

template <>
struct JointColumns<Pack>
{
    using Words = std::uint32_t __attribute__((vector_size(16)));
    Words mobilised, t_x, t_y, contacts;

    JointColumns(const BlockForce* force, Index count)
    {
        Words row[lanes] = {};
        for (Index i = 0; i < count; ++i)
            std::memcpy(&row[i], &force[i].contacts, sizeof row[i]);
        const Words low_01 = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);
        const Words low_23 = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
        const Words high_01 = __builtin_shufflevector(row[0], row[1], 2, 6, 3, 7);
        const Words high_23 = __builtin_shufflevector(row[2], row[3], 2, 6, 3, 7);
        contacts = __builtin_shufflevector(low_01, low_23, 0, 1, 4, 5);
        mobilised = __builtin_shufflevector(low_01, low_23, 2, 3, 6, 7);
        t_x = __builtin_shufflevector(high_01, high_23, 0, 1, 4, 5);
        t_y = __builtin_shufflevector(high_01, high_23, 2, 3, 6, 7);
    }
    [[nodiscard]] static Pack to_pack(Words floats)
    {
        return Pack(__builtin_convertvector(std::bit_cast<FloatLanes>(floats), Pack::V));
    }
    [[nodiscard]] Mask have(ContactBits bits) const
    {
        return {(__builtin_convertvector(contacts, Mask::V) & std::int64_t{bits}) != 0};
    }
};

template <typename P>
[[nodiscard]] inline BasicActing<P> load_acting(const BlockForce* force, Index count)
{
    using Joint = JointColumns<P>;
    const Columns<P> f(&force->x, row_stride<BlockForce>, count);
    const Joint joint(force, count);
    return {.x = f.a,
            .y = f.b,
            .moment = f.c,
            .reserve = max(f.d, P(0.0)),
            .mobilised = Joint::to_pack(joint.mobilised),
            .t_x = Joint::to_pack(joint.t_x),
            .t_y = Joint::to_pack(joint.t_y),
            .springs = joint.have(contact_force),
            .impulses = joint.have(contact_impulse)};
}

template <typename P>
[[nodiscard]] inline BasicInertia<P> load_inertia(const BlockInertia* inertia, Index count)
{
    const Columns<P> i(&inertia->inverse_mass_x, row_stride<BlockInertia>, count);
    return {i.a, i.b, i.c, i.d};
}

template <typename P>
[[nodiscard]] inline P load_some(const double* from, Index count, double otherwise = 0.0)
{
    if (count == P::width)
        return P::load(from);
    P p = otherwise;
    for (Index i = 0; i < count; ++i)
        p.v[i] = from[i];
    return p;
}
}  // namespace HDEM_LANES
}  // namespace hdem
