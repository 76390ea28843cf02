#pragma once
/// Contacts: pairs of convex parts of two blocks that touch or nearly touch, with the features found for them and the
/// history their two points carry. A contact outlives broad-phase rebuilds as long as its parts stay near each other.
///
/// The block that owns the reference edge is `ref`, the other `inc` (incident). In the reference edge's own frame the
/// first axis t runs along the edge (anticlockwise around its block), the second, m, into its block; so an overlap is a
/// positive m of a point of the incident edge. Forces are given on `inc`: normal along -m, shear along t.

#include "core/huge_pages.h"
#include "core/joint/joint_law.h"
#include "core/simd.h"
#include "core/types.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hdem
{
enum class Regime : std::uint8_t
{
    open = 0,    ///< apart
    stick = 1,   ///< force-based, below the joint's strength
    slip = 2,    ///< force-based, at the joint's strength
    impulse = 3  ///< impulse-based
};

[[nodiscard]] inline bool is_spring(std::uint8_t regime)
{
    return regime == static_cast<std::uint8_t>(Regime::stick) || regime == static_cast<std::uint8_t>(Regime::slip);
}

/// The two edges that face each other, constant while the features hold.
template <typename R>
struct BasicEdgePair
{
    R tx = 1.0;  ///< reference edge's direction in the body frame of ref [-]
    R ty = 0.0;
    R start_t = 0.0;  ///< its first vertex in the edge's own axes, from the centroid of ref [m]
    R start_m = 0.0;
    R length = 0.0;  ///< [m]
    R p0x = 0.0;     ///< incident edge's first vertex in the body frame of inc [m]
    R p0y = 0.0;
    R p1x = 0.0;  ///< its second vertex
    R p1y = 0.0;
};
using EdgePair = BasicEdgePair<double>;

/// What one contact point remembers.
struct PointHistory
{
    double normal_force = 0.0;  ///< of the last cycle, >= 0 [N]; in the impulse regime J / dt, Eq. (29)
    double shear_force = 0.0;   ///< on inc along t [N]
    double rest_overlap = 0.0;  ///< >= 0, overlap at which the normal spring is empty [m]
    Regime regime = Regime::open;
    double overlap = 0.0;     ///< of the last cycle, with the preload [m]
    double tilt_force = 0.0;  ///< of the last cycle, on inc along t (contact/force_law.h) [N]
    double preload =
        0.0;  ///< by which the joint is pressed where the blocks are drawn, in-situ stress over K_N; below 0 where it is pulled [m]
    JointMemory memory;      ///< of a law that has one (core/joint)
    double energy = 0.0;     ///< that its springs held at the last forces; laws with a memory only [J]
    double stiffness = 0.0;  ///< d sigma / d closure at the last forces; laws with a memory only [Pa/m]
};

/// Length of the reference edge of a pair that bears nothing until its features are searched again: nothing lies over it.
inline constexpr double no_length = -1.0;

/// One contact as a value: what moves between arrays when contacts are re-sorted, saved or restarted.
struct Contact
{
    Index part_a = no_index;  ///< part_a < part_b
    Index part_b = no_index;
    Index ref = no_index;  ///< blocks
    Index inc = no_index;
    Index ref_edge = no_index;  ///< positions in Shapes::vertex; no_index: features never searched
    Index inc_edge = no_index;
    Index law = 0;                ///< position in JointTable::laws
    bool swapped = false;         ///< ref is the block of part_b
    float moved_limit = 0.0f;     ///< features are searched anew when an incident vertex moved farther [m]
    std::array<float, 4> seen{};  ///< incident vertices in the edge frame when the features were found [m]
    double length_floor = 0.0;    ///< least contact length [m]
    double last_length = 0.0;     ///< length that each point bore in the last cycle [m]
    EdgePair edges;
    std::array<PointHistory, 2> point;  ///< 0 at the lower t, 1 at the upper

    [[nodiscard]] bool may_bear() const { return edges.length > no_length; }
};

/// What the cycle reads and writes of four contacts that follow each other: one stretch of memory, for one pass of the laws on a Pack.
struct alignas(64) ContactLanes
{
    using Lane = std::array<double, lanes>;
    Lane tx, ty, start_t, start_m, length, p0x, p0y, p1x, p1y;  ///< EdgePair
    Lane length_floor, last_length;
    std::array<Lane, 2> shear_force, overlap, normal_force;  ///< PointHistory
    // From here on only some cycles need more: see PassNeeds, core/contact/contact_forces.h.
    std::array<float, lanes> moved_limit;
    std::array<std::array<float, lanes>, 4> seen;
    alignas(64) std::array<Lane, 2> rest_overlap;  ///< PointHistory
    std::array<Lane, 2> tilt_force;
};

/// Preloads of four contacts.
struct alignas(64) PreloadLanes
{
    std::array<ContactLanes::Lane, 2> preload;
};

/// What joint laws with a memory keep of four contacts.
struct alignas(64) MemoryLanes
{
    struct Point
    {
        ContactLanes::Lane slip, state, turn, opening, broken;  ///< JointMemory
        ContactLanes::Lane energy, stiffness;                   ///< PointHistory
    };
    std::array<Point, 2> point;
};

/// All contacts. Arrays are filled up to a multiple of `lanes` with contacts of block 0 with itself that never touch.
class Contacts
{
  public:
    std::vector<Index> part_a, part_b, ref, inc, ref_edge, inc_edge, law;
    std::vector<std::uint8_t> stale;    ///< features to be searched anew
    std::vector<std::uint8_t> swapped;  ///< ref is the block of part_b, inc that of part_a
    std::array<std::vector<std::uint8_t>, 2> regime;
    LargeVector<ContactLanes> lane;
    std::vector<PreloadLanes> preload_lane;  ///< empty without in-situ stress
    std::vector<MemoryLanes> memory_lane;    ///< empty where all joints are plain
    bool has_preload = false;                ///< set these two while there are no contacts; memory comes with preload
    bool has_memory = false;

    [[nodiscard]] Index size() const { return size_; }
    void resize(Index n);
    void reserve(Index n);
    [[nodiscard]] Contact get(Index i) const;
    void put(Index i, const Contact& contact);
    [[nodiscard]] EdgePair edges(Index i) const;
    [[nodiscard]] bool may_bear(Index i) const { return lane[i / lanes].length[i % lanes] > no_length; }

    [[nodiscard]] double length_floor(Index i) const { return lane[i / lanes].length_floor[i % lanes]; }
    [[nodiscard]] double normal_force(int end, Index i) const { return lane[i / lanes].normal_force[end][i % lanes]; }
    [[nodiscard]] double tilt_force(int end, Index i) const { return lane[i / lanes].tilt_force[end][i % lanes]; }
    [[nodiscard]] double shear_force(int end, Index i) const { return lane[i / lanes].shear_force[end][i % lanes]; }
    [[nodiscard]] double rest_overlap(int end, Index i) const { return lane[i / lanes].rest_overlap[end][i % lanes]; }
    [[nodiscard]] double preload(int end, Index i) const
    {
        return has_preload ? preload_lane[i / lanes].preload[end][i % lanes] : 0.0;
    }
    [[nodiscard]] JointMemory memory(int end, Index i) const;
    [[nodiscard]] double opening(int end, Index i) const
    {
        return has_memory ? memory_lane[i / lanes].point[end].opening[i % lanes] : 0.0;
    }
    /// That the springs of a law with a memory held at the last forces [J].
    [[nodiscard]] double held_energy(Index i) const
    {
        const auto& point = memory_lane[i / lanes].point;
        return point[0].energy[i % lanes] + point[1].energy[i % lanes];
    }
    [[nodiscard]] double& rest_overlap(int end, Index i) { return lane[i / lanes].rest_overlap[end][i % lanes]; }
    [[nodiscard]] double& normal_force(int end, Index i) { return lane[i / lanes].normal_force[end][i % lanes]; }
    [[nodiscard]] double& shear_force(int end, Index i) { return lane[i / lanes].shear_force[end][i % lanes]; }

  private:
    Index size_ = 0;
};
}  // namespace hdem
