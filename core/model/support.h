#pragma once
/// Bolts with names resolved to blocks. Constant during a run: what has happened to them is in core/state/support_state.h. All forces and stiffnesses are those of one
/// metre of thickness: divided by the bolt's spacing out of plane.

#include "core/model/case_def.h"

#include <limits>
#include <string>
#include <vector>

namespace hdem
{
/// Where a bolt pulls two blocks towards each other. Both points belong to the material of their block.
struct BoltLink
{
    Index first = no_index;             ///< the block on the side of the head
    Index second = no_index;            ///< the block on the side of the end
    Vec2 first_arm = {0.0, 0.0};        ///< from the centroid, in the block's frame [m]
    Vec2 second_arm = {0.0, 0.0};       ///< [m]
    double axial_stiffness = 0.0;       ///< upper bound, for the time step [N/m]
    double transverse_stiffness = 0.0;  ///< [N/m]
};

/// A piece of a grouted bolt between two nodes; half of its bond acts at each of them.
struct BoltSegment
{
    Index part = 0;       ///< number of the block that it lies in along the bolt: so many links are before it
    double length = 0.0;  ///< [m]
    bool is_bonded = true;
};

struct Bolt
{
    static constexpr double none = std::numeric_limits<double>::infinity();

    std::string name;
    BoltKind kind = BoltKind::anchored;
    Index stage = 0;                    ///< it is installed as this stage begins
    double spacing = 1.0;               ///< out of plane; one bolt bears so many times what stands here [m]
    Vec2 axis = {1.0, 0.0};             ///< from the head to the end, as drawn [-]
    std::vector<BoltLink> links;        ///< anchored: one; else one for each joint that it crosses, from the head on
    std::vector<Index> blocks;          ///< grouted: that it runs through, from the head on
    double stiffness = 0.0;             ///< anchored, local: axial [N/m]
    double shear_stiffness = 0.0;       ///< local [N/m]
    double pretension = 0.0;            ///< [N]
    double yield = none;                ///< axial force [N]
    double shear_strength = none;       ///< [N]
    double rupture = none;              ///< strain [-]
    double length = 0.0;                ///< that stretches: anchored free length, else active length at a joint [m]
    std::vector<BoltSegment> segments;  ///< of a grouted bolt, from the head on
    double section_stiffness = 0.0;     ///< E A [N]
    double bond_stiffness = 0.0;        ///< [N/m/m]
    double bond_strength = 0.0;         ///< [N/m]
    bool plate = false;
    Index history = 0;  ///< position of its numbers in SupportState::history
    Index history_size = 0;
};

/// One end of a link, for what is asked block by block.
struct BoltEnd
{
    Index block = no_index;
    Index bolt = no_index;
    Index link = 0;
    bool is_first = true;
};

struct Support
{
    std::vector<Bolt> bolts;    ///< in the order of the case
    std::vector<BoltEnd> ends;  ///< ascending by block, then by bolt and link
    Index history_size = 0;

    [[nodiscard]] bool empty() const { return bolts.empty(); }
};

/// Renew `ends`, after links were made or blocks renumbered.
void list_ends(Support& support);

/// Positions in `ends` of those of a block.
[[nodiscard]] IndexRange ends_of(const Support& support, Index block);
}  // namespace hdem
