#pragma once
/// Blocks: what changes from cycle to cycle. One entry per block, in the model's order.

#include "core/simd.h"
#include "core/types.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace hdem
{
/// Pose at the cycle's start and velocity half a step before it. One cache line a block: a contact reads two of them, where
/// seven separate arrays would cost it fourteen.
template <typename R>
struct alignas(64) BasicMotion
{
    R x = 0.0;  ///< centroid [m]
    R y = 0.0;
    R c = 1.0;  ///< cosine and sine of the rotation since the start [-]
    R s = 0.0;
    R vx = 0.0;  ///< [m/s]
    R vy = 0.0;
    R w = 0.0;      ///< angular velocity, anticlockwise [rad/s]
    R angle = 0.0;  ///< rotation since the start, not wrapped [rad]
};
using BlockMotion = BasicMotion<double>;

/// Which kinds of contact points act on a block: bits of BlockForce::contacts.
enum ContactBits : std::uint32_t
{
    contact_force = 1,   ///< at least one in the force regime
    contact_impulse = 2  ///< at least one in the impulse regime
};

/// Sum of what acts on a block in this cycle.
struct alignas(64) BlockForce
{
    double x = 0.0;  ///< [N]
    double y = 0.0;
    double moment = 0.0;         ///< about the centroid [N m]
    double reserve = 0.0;        ///< shear strength not in use at all its force points [N]
    std::uint32_t contacts = 0;  ///< ContactBits
    float mobilised = -1.0F;     ///< greatest share of a joint's shear strength in use at its force points; -1: no force point [-]
    float t_x = 1.0F;            ///< direction of that joint [-]
    float t_y = 0.0F;
    double joint_load = std::numeric_limits<double>::infinity();  ///< squared, of that joint: scratch while it is looked for [N2]
    double least_load = 0.0;                                      ///< squared: joints that bear less do not count; scratch [N2]
};

/// Inverse mass and inertia, zero where the motion is prescribed.
template <typename R>
struct alignas(32) alignas(R) BasicInertia
{
    R inverse_mass_x = 0.0;  ///< [1/kg]
    R inverse_mass_y = 0.0;
    R inverse_inertia = 0.0;  ///< [1/(kg m2)]
    R unused = 0.0;
};
using BlockInertia = BasicInertia<double>;

[[nodiscard]] inline bool can_move(const BlockInertia& i)
{
    return i.inverse_mass_x > 0.0 || i.inverse_mass_y > 0.0 || i.inverse_inertia > 0.0;
}

/// The two steps that meet at the poses of now [s]. A force at these poses acts for half of each.
struct Steps
{
    double last = 0.0;  ///< over which the blocks have moved here
    double next = 0.0;  ///< over which they move on

    [[nodiscard]] double kick() const { return 0.5 * (last + next); }
};

/// Blocks::rest counts up to `stopped`; the cycle after, in which the contacts have been evaluated at rest, the block is left out.
inline constexpr std::uint8_t stopped = 8;
inline constexpr std::uint8_t left_out = 9;

struct Blocks
{
    std::vector<BlockMotion> motion;
    std::vector<BlockForce> force;
    std::vector<BlockInertia> inertia;
    std::vector<double> stable_step;       ///< last value found, see core/motion/step_control.h [s]
    std::vector<double> bearing_force;     ///< normal forces on its sides, summed (core/detection/bearing_force.h) [N]
    std::vector<double> margin;            ///< a block may move so far before contacts must be found anew [m]
    std::vector<std::uint8_t> rest;        ///< checks in a row that found the block quiet, see core/motion/rest.h
    std::vector<std::uint8_t> present;     ///< 0 once excavated
    std::vector<Vec2> reference_position;  ///< displacements are counted from here [m]
    std::vector<double> reference_angle;   ///< [rad]
    Steps step;

    [[nodiscard]] Index size() const { return static_cast<Index>(motion.size()); }
    [[nodiscard]] bool is_free(Index block) const { return present[block] != 0 && can_move(inertia[block]); }
    [[nodiscard]] Vec2 velocity(Index block) const { return {motion[block].vx, motion[block].vy}; }
    [[nodiscard]] Vec2 displacement(Index block) const
    {
        return Vec2(motion[block].x, motion[block].y) - reference_position[block];
    }
    /// Does the block take part in a cycle? Blocks that are left out do not, nor do fixed blocks that do not move.
    [[nodiscard]] bool takes_part(Index block) const
    {
        const BlockMotion& m = motion[block];
        return is_free(block) ? rest[block] < left_out : m.vx != 0.0 || m.vy != 0.0 || m.w != 0.0;
    }
    /// Has a free block moved farther than this since its stage began?
    [[nodiscard]] bool is_loose(Index block, double distance) const
    {
        return is_free(block) && displacement(block).squaredNorm() > distance * distance;
    }
};
}  // namespace hdem
