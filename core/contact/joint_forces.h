#pragma once
/// Forces of joints whose law has a memory, at one point of four contacts.

#include "core/contact/contact_lanes.h"
#include "core/joint/joint_row.h"
#include "core/state/contacts.h"

#include <vector>

namespace hdem
{
/// Joint rows of four contacts. Neighbours mostly have the same ones: what was loaded last is kept.
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
    Mask has_memory{};  ///< the others are plain
    Mask is_linear{};   ///< of these: with a linear normal spring
    Mask is_bonded{};   ///< JointRow::is_bonded
    bool any = false;         ///< one of the four has a memory
    bool is_uniform = false;  ///< all have, and the same law and curve
    Pack reach = 0.0, torn_reach = 0.0;
    BasicJointNumbers<Pack> numbers;

  private:
    void reload(const Index* law);

    const std::vector<JointRow>& rows_;
    std::array<Index, lanes> last_{no_index, no_index, no_index, no_index};
};

/// What happens to a point of four contacts in a cycle.
struct JointPoint
{
    Pack length;       ///< the point's share of the contact length [m]
    Pack closure;      ///< overlap with preload, less the rest overlap; without dilation [m]
    Pack slide;        ///< way of inc along t [m]
    Pack start;        ///< shear force before this cycle, at the length of now [N]
    Pack last_normal;  ///< [N]
    Mask spring;       ///< the point obeys its joint law in this cycle
    Mask stays;        ///< and did so in the last one, under a force
    Mask held;         ///< the point obeys the impulse law
};

/// What the law answers; 0 in lanes that are plain or no springs.
struct JointForces
{
    Pack normal = 0.0;    ///< < 0: tension [N]
    Pack shear = 0.0;     ///< [N]
    Pack strength = 0.0;  ///< [N]
    Pack opening = 0.0;   ///< dilation [m]
    Pack friction = 0.0;  ///< heat of this cycle [J]
    Pack lost = 0.0;      ///< by which the energy of the springs has fallen [J]
    Mask bears{};         ///< normal force other than 0
    Mask slips{};
};

/// Ask the laws and let the point remember. The memory of plain lanes stays as it is.
[[nodiscard]] JointForces react_joints(const RowLanes& rows, const JointPoint& point, MemoryLanes::Point& memory);

/// Gap across which the points still bear [m].
[[nodiscard]] inline Pack reach_of(const RowLanes& rows, const MemoryLanes::Point& memory)
{
    return load_lane(memory.opening) + select(load_lane(memory.broken) < Pack(0.5), rows.reach, rows.torn_reach);
}

/// Points that no impulse may take from their springs: bonds until they break, and closures that are no straight line.
[[nodiscard]] inline Mask keep_springs(const RowLanes& rows, const MemoryLanes::Point& memory)
{
    return rows.has_memory & ((!rows.is_linear) | (rows.is_bonded & (load_lane(memory.broken) < Pack(0.5))));
}
}  // namespace hdem
