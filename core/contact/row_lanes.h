#pragma once
/// Joint rows of the contacts of a pack.

#include "core/contact/contact_lanes.h"
#include "core/joint/all_laws.h"
#include "core/joint/joint_row.h"
#include "core/state/contacts.h"

#include <cstring>
#include <vector>

namespace hdem
{
/// Joint rows of a pack. Neighbours mostly have the same rows, so the last ones are kept.
template <typename P>
class BasicRowLanes
{
  public:
    using M = MaskOf<P>;
    static constexpr int width = P::width;

    explicit BasicRowLanes(const std::vector<JointRow>& rows) : rows_(rows) { last_.fill(no_index); }

    void load(const Index* law)
    {
        if (std::memcmp(law, last_.data(), sizeof last_) != 0)
            reload(law);
    }

    std::array<JointKind, width> kind{};
    std::array<CurveKind, width> curve{};
    M has_memory{};           ///< the others are plain
    M is_linear{};            ///< of these: with a linear normal spring
    M is_bonded{};            ///< JointRow::is_bonded
    M is_rough{};             ///< dilates, or has a law of which impulses use the basic friction only
    bool any = false;         ///< one of them has a memory
    bool is_uniform = false;  ///< all have, and the same law and curve
    P reach = 0.0, torn_reach = 0.0;
    BasicJointNumbers<P> numbers;

  private:
    void reload(const Index* law);

    const std::vector<JointRow>& rows_;
    std::array<Index, width> last_;
};
using RowLanes = BasicRowLanes<Pack>;

/// Gap across which the points still bear [m].
template <typename P>
[[nodiscard, gnu::always_inline]] inline P reach_of(const BasicRowLanes<P>& rows, const MemoryLanes& memory, int k)
{
    const MemoryLanes::Point& m = memory.point[k];
    return load_lane<P>(memory, m.opening) + select(load_lane<P>(memory, m.broken) < P(0.5), rows.reach, rows.torn_reach);
}

/// Points that slipped in the last cycle.
[[nodiscard]] inline Mask did_slip(const std::uint8_t* regime, Mask)
{
    return mask_of(WordLanes(load_bytes(regime) == byte_ones * static_cast<std::uint32_t>(Regime::slip)));
}

/// Greatest opening by this cycle's slip of a joint that slipped and opened before [m]. Within it only the law can tell whether the point still touches.
template <typename P>
[[nodiscard, gnu::always_inline]] inline P climb_of(const MemoryLanes& memory, int k, MaskOf<P> slipped, P slide)
{
    return select(slipped & (load_lane<P>(memory, memory.point[k].opening) > P(0.0)), abs(slide), 0.0);
}

/// Points that stay with springs at any speed: bonds that are not broken, and joints whose closure is not linear.
template <typename P>
[[nodiscard, gnu::always_inline]] inline MaskOf<P> keep_springs(const BasicRowLanes<P>& rows, const MemoryLanes& memory, int k)
{
    const MaskOf<P> is_whole = load_lane<P>(memory, memory.point[k].broken) < P(0.5);
    return rows.has_memory & ((!rows.is_linear) | (rows.is_bonded & is_whole));
}

template <typename P>
[[gnu::noinline]] void BasicRowLanes<P>::reload(const Index* law)
{
    std::memcpy(last_.data(), law, sizeof last_);
    any = false;
    has_memory = is_linear = is_bonded = is_rough = M{};
    for (int i = 0; i < width; ++i)
    {
        const JointRow& row = rows_[law[i]];
        kind[i] = row.kind;
        curve[i] = row.curve;
        const bool dilates = row.kind != kind_of<CoulombResidual>() || row.numbers[CoulombResidual::dilation] > 0.0;
        if (row.has_memory())
            has_memory.set(i);
        if (row.curve == CurveKind::linear)
            is_linear.set(i);
        if (row.is_bonded)
            is_bonded.set(i);
        if (row.has_memory() && dilates)
            is_rough.set(i);
        any = any || row.has_memory();
        is_uniform = (i == 0 || is_uniform) && row.has_memory() && kind[i] == kind[0] && curve[i] == curve[0];
        reach.v[i] = row.reach;
        torn_reach.v[i] = row.torn_reach;
        for (int k = 0; k < joint_numbers; ++k)
            numbers[k].v[i] = row.numbers[k];
    }
}
}  // namespace hdem
