#pragma once
/// Bolts and liners with names resolved to blocks. Constant during a run: what has happened to them is in core/state/support_state.h. All forces and
/// stiffnesses are those of one metre of thickness: divided by the bolt's spacing out of plane.

#include "core/model/factor_def.h"
#include "core/model/support_def.h"

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

/// A beam of a liner between two nodes, and the block behind it.
struct LinerSegment
{
    Index node[2] = {0, 0};
    Index block = no_index;   ///< no_index: there is none
    Vec2 arm[2];              ///< its ends from the block's centroid, in the block's frame [m]
    Vec2 along = {1.0, 0.0};  ///< from the first node to the second, as drawn [-]
    double length = 0.0;      ///< [m]
    [[nodiscard]] Vec2 to_rock() const { return {along.y(), -along.x()}; }
};

/// Per metre of thickness of the model.
struct Liner
{
    static constexpr double none = std::numeric_limits<double>::infinity();

    std::string name;
    Index stage = 0;                     ///< it is installed as this stage begins
    std::vector<Vec2> nodes;             ///< as drawn [m]
    std::vector<LinerSegment> segments;  ///< the rock is on their right-hand side
    double mass = 0.0;                   ///< of a metre of it [kg/m]
    double axial_stiffness = 0.0;        ///< E A [N]
    double bending_stiffness = 0.0;      ///< E I [N m2]
    double compressive_strength = none;  ///< [N]
    double tensile_strength = none;      ///< [N]
    double moment_strength = none;       ///< [N m]
    double normal_stiffness = 0.0;       ///< of its tie to the rock [Pa/m]
    double shear_stiffness = 0.0;        ///< [Pa/m]
    double friction = 0.0;               ///< tan phi [-]
    double cohesion = 0.0;               ///< [Pa]
    double bond_strength = 0.0;          ///< tension [Pa]
    FactorTable hardening;               ///< rows: cycles since it was installed, factor of modulus and strengths
    double pressure = 0.0;               ///< between it and the rock [Pa]
    std::int64_t pressure_cycles = 0;    ///< over which it grows
    Index history = 0;                   ///< position of its numbers in SupportState::history
    Index history_size = 0;
};

/// Where a liner holds a block, for lookups by block.
struct LinerTie
{
    Index block = no_index;
    Index liner = no_index;
    Index segment = 0;
    int end = 0;  ///< of the segment
};

/// One end of a link, for lookups by block.
struct BoltEnd
{
    Index block = no_index;
    Index bolt = no_index;
    Index link = 0;
    bool is_first = true;
};

struct Support
{
    std::vector<Bolt> bolts;     ///< in the order of the case
    std::vector<BoltEnd> ends;   ///< ascending by block, then by bolt and link
    std::vector<Liner> liners;   ///< in the order of the case
    std::vector<LinerTie> ties;  ///< ascending by block, then by liner, segment and end
    Index history_size = 0;

    [[nodiscard]] bool empty() const { return bolts.empty() && liners.empty(); }
};

/// Renew `ends` and `ties`, after links were made or blocks renumbered.
void list_ends(Support& support);

/// Does any bolt or liner of the case hold this block?
[[nodiscard]] bool is_held(const Support& support, Index block);

/// Positions in `ties` of those of a block.
[[nodiscard]] IndexRange ties_of(const Support& support, Index block);

/// Positions in `ends` of those of a block.
[[nodiscard]] IndexRange ends_of(const Support& support, Index block);
}  // namespace hdem
