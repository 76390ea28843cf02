#pragma once
/// Scratch of a cycle, reused: nothing here outlives one, and nothing here is allocated after the first cycles.

#include "core/huge_pages.h"
#include "core/simd.h"
#include "core/state/triple.h"
#include "core/types.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace hdem
{
/// Load of one contact on one of its blocks in this cycle.
struct alignas(32) BlockLoad
{
    double x = 0.0;  ///< [N]
    double y = 0.0;
    double moment = 0.0;   ///< about the block's centroid [N m]
    double reserve = 0.0;  ///< shear strength not in use at the contact's force points [N]
};

/// How far a contact's shear strength is used, for the damping of its blocks.
struct alignas(16) JointUse
{
    std::uint32_t contacts = 0;  ///< ContactBits
    float mobilised = -1.0F;     ///< share in use at its force points; -1: none [-]
    float t_x = 1.0F;            ///< direction along the edge [-]
    float t_y = 0.0F;
};

/// Loads of contacts that follow each other.
struct ContactLoads
{
    LargeVector<BlockLoad> load;  ///< two a contact: on the block of part_a, on that of part_b
    std::vector<JointUse> use;    ///< one a contact
    Index first = 0;              ///< the contact with which they begin

    void resize(std::size_t contacts)
    {
        load.resize(2 * contacts);
        use.resize(contacts);
    }
};

/// Sums over ranges of contacts in one cycle. Energies are summed lane by lane: contacts that give nothing change no bit of the sums,
/// so it does not matter which contacts at rest take part.
struct ContactTally
{
    LaneSums friction;   ///< EnergyLedger::friction [J]
    LaneSums changes;    ///< EnergyLedger::contact_changes [J]
    Index closed = 0;    ///< closed points
    Index impulses = 0;  ///< of these, in the impulse regime
    Index stale = 0;     ///< contacts whose features are to be searched anew
    Index deep = 0;      ///< contacts with an overlap above contact.overlap_limit
    LaneSums dilation;   ///< EnergyLedger::dilation [J]
    LaneSums broken;     ///< EnergyLedger::bond_breaking [J]
    /// Some contact was not only pressed by springs since the last cycle: it may have a rest overlap now.
    bool unrested = false;
    /// By how much any incident vertex may still move before features are stale, of contacts whose views were checked [m].
    float slack = std::numeric_limits<float>::infinity();
};

/// Which contacts a block has: `entry` holds 2 contact + side (0: the block of part_a, 1: of part_b) from begin[block] to begin[block + 1], ascending.
struct BlockContacts
{
    std::vector<Index> begin;
    std::vector<Index> entry;
};

/// One contact point in the impulse regime during one cycle.
struct ImpulsePoint
{
    Index contact = no_index;
    Index ref = no_index;
    Index inc = no_index;
    int end = 0;                      ///< which of the contact's two points
    double t_x = 1.0, t_y = 0.0;      ///< axis along the reference edge [-]; m is it turned left
    double ref_t = 0.0, ref_m = 0.0;  ///< point seen from the centroid of ref, in these axes [m]
    double inc_t = 0.0, inc_m = 0.0;
    double mass_normal = 0.0;  ///< collision masses, Eq. (16) [kg]
    double mass_shear = 0.0;
    double coupling = 0.0;          ///< with the other point of its contact, kept by the first of the two [1/kg]
    double approach = 0.0;          ///< approach velocity before this cycle; negative: the blocks part [m/s]
    double target = 0.0;            ///< approach velocity that the impulse must leave [m/s]
    double weight_velocity = 0.0;   ///< what weight adds to the approach velocity in a cycle [m/s]
    double load_velocity = 0.0;     ///< what this cycle's forces add to the approach velocity, at least weight_velocity [m/s]
    double restitution = 0.0;       ///< R of Eq. (15) [-]
    double overlap = 0.0;           ///< [m]
    double pressed = 0.0;           ///< with the preload [m]
    double stiffness = 0.0;         ///< K_N L of the point, for the spring that follows [N/m]
    double spring_force = 0.0;      ///< with which its spring would have begun before this cycle [N]
    double friction = 0.0;          ///< tan phi [-]
    double cohesive_impulse = 0.0;  ///< c L dt, less tan(phi) times `pull` while the impulses are counted from it [N s]
    double pull = 0.0;              ///< T L dt, the greatest pull that the joint bears [N s]
    double excess_overlap = 0.0;    ///< to be corrected; negative: what the correction of others may press together [m]
    double impulse_normal = 0.0;    ///< J + pull >= 0 from collect_impulse_points on, J from count_from_zero on [N s]
    double impulse_shear = 0.0;     ///< [N s]
    double correction = 0.0;        ///< pseudo impulse of the position correction [N s]
};

/// A loaded block before the step: its velocities, and the moment of the load about its centroid.
struct LoadedBlock
{
    double vx = 0.0, vy = 0.0, w = 0.0;  ///< [m/s], [rad/s]
    double moment = 0.0;                 ///< [N m]
};

/// Force of a bolt or liner on a block in one cycle, and the block's velocities before the step.
struct BlockPush
{
    Index block = no_index;
    Triple force;          ///< [N], moment about the centroid [N m]
    Triple velocity;       ///< [m/s], [rad/s]
    double reserve = 0.0;  ///< strength of the bolt not in use [N]
    bool damps = false;    ///< it is a damping force, which takes energy, and no force of the bolt
};

struct Workspace
{
    ContactLoads loads;
    BlockContacts block_contacts;
    std::vector<Triple> pseudo;    ///< pseudo velocities of the position correction, per block, zero between cycles
    std::vector<Triple> constant;  ///< forces and moments of tractions on sides in the running stage, per block; empty without
    std::vector<Index> held;       ///< blocks at pressed sides that are held together in the running stage
    std::vector<Triple> external;  ///< `constant` with the forces of the case's loads; empty without either
    std::vector<LoadedBlock> loaded;
    std::vector<BlockPush> bolted;  ///< forces of bolts in this cycle, with the velocities before the step
    std::vector<Triple> released;   ///< velocities of blocks on which excavated blocks still act, before the step
};
}  // namespace hdem
