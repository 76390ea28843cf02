#pragma once
/// Joint rows of four contacts.

#include "core/contact/contact_lanes.h"
#include "core/joint/all_laws.h"
#include "core/joint/joint_row.h"
#include "core/state/contacts.h"

#include <vector>

namespace hdem
{
/// Neighbours mostly have the same rows: what was loaded last is kept.
class RowLanes
{
  public:
    explicit RowLanes(const std::vector<JointRow>& rows) : rows_(rows) {}

    void load(const Index* law)
    {
        if (!std::equal(law, law + lanes, last_.begin()))
            reload(law);
    }

    std::array<JointKind, lanes> kind{};
    std::array<CurveKind, lanes> curve{};
    Mask has_memory{};        ///< the others are plain
    Mask is_linear{};         ///< of these: with a linear normal spring
    Mask is_bonded{};         ///< JointRow::is_bonded
    Mask is_rough{};          ///< dilates, or is of a law of which impulses know no more than its basic friction
    bool any = false;         ///< one of the four has a memory
    bool is_uniform = false;  ///< all have, and the same law and curve
    Pack reach = 0.0, torn_reach = 0.0;
    BasicJointNumbers<Pack> numbers;

  private:
    void reload(const Index* law);

    const std::vector<JointRow>& rows_;
    std::array<Index, lanes> last_{no_index, no_index, no_index, no_index};
};

/// Gap across which the points still bear [m].
[[nodiscard]] inline Pack reach_of(const RowLanes& rows, const MemoryLanes::Point& memory)
{
    return load_lane(memory.opening) + select(load_lane(memory.broken) < Pack(0.5), rows.reach, rows.torn_reach);
}

/// Points that slipped in the last cycle.
[[nodiscard]] inline Mask did_slip(const std::uint8_t* regime)
{
    return mask_of(WordLanes(load_bytes(regime) == byte_ones * static_cast<std::uint32_t>(Regime::slip)));
}

/// By which slip of this cycle may open a joint at most that has slipped, and opened, before: the law must be asked whether it still touches [m].
[[nodiscard]] inline Pack climb_of(const MemoryLanes::Point& memory, Mask slipped, Pack slide)
{
    return select(slipped & (load_lane(memory.opening) > Pack(0.0)), abs(slide), 0.0);
}

/// Points that no impulse may take from their springs: bonds until they break, and closures that are no straight line.
[[nodiscard]] inline Mask keep_springs(const RowLanes& rows, const MemoryLanes::Point& memory)
{
    return rows.has_memory & ((!rows.is_linear) | (rows.is_bonded & (load_lane(memory.broken) < Pack(0.5))));
}

inline void RowLanes::reload(const Index* law)
{
    std::copy(law, law + lanes, last_.begin());
    any = false;
    for (int i = 0; i < lanes; ++i)
    {
        const JointRow& row = rows_[law[i]];
        kind[i] = row.kind;
        curve[i] = row.curve;
        has_memory.v[i] = row.has_memory() ? -1 : 0;
        is_linear.v[i] = row.curve == CurveKind::linear ? -1 : 0;
        is_bonded.v[i] = row.is_bonded ? -1 : 0;
        const bool dilates = row.kind != kind_of<CoulombResidual>() || row.numbers[CoulombResidual::dilation] > 0.0;
        is_rough.v[i] = row.has_memory() && dilates ? -1 : 0;
        any = any || row.has_memory();
        is_uniform = (i == 0 || is_uniform) && row.has_memory() && kind[i] == kind[0] && curve[i] == curve[0];
        reach.v[i] = row.reach;
        torn_reach.v[i] = row.torn_reach;
        for (int k = 0; k < joint_numbers; ++k)
            numbers[k].v[i] = row.numbers[k];
    }
}
}  // namespace hdem
