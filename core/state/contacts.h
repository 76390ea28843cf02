#pragma once
/// Contacts: pairs of convex parts of two blocks that touch or nearly touch, with the features found for them and the
/// history their two points carry. A contact outlives broad-phase rebuilds as long as its parts stay near each other.
///
/// The block that owns the reference edge is `ref`, the other `inc` (incident). In the reference edge's own frame the
/// first axis t runs along the edge (anticlockwise around its block), the second, m, into its block; so an overlap is a
/// positive m of a point of the incident edge. Forces are given on `inc`: normal along -m, shear along t.

#include "core/types.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hdem
{
enum class Regime : std::uint8_t
{
    open = 0,     ///< apart
    stick = 1,    ///< force-based, below the joint's strength
    slip = 2,     ///< force-based, at the joint's strength
    impulse = 3   ///< impulse-based
};

[[nodiscard]] inline bool is_spring(std::uint8_t regime)
{
    return regime == static_cast<std::uint8_t>(Regime::stick) || regime == static_cast<std::uint8_t>(Regime::slip);
}

/// The two edges that face each other, constant while the features hold.
struct EdgePair
{
    double tx = 1.0;                ///< reference edge's direction in the body frame of ref [-]
    double ty = 0.0;
    double start_t = 0.0;           ///< its first vertex in the edge's own axes, from the centroid of ref [m]
    double start_m = 0.0;
    double length = 0.0;            ///< [m]
    double p0x = 0.0;               ///< incident edge's first vertex in the body frame of inc [m]
    double p0y = 0.0;
    double p1x = 0.0;               ///< its second vertex
    double p1y = 0.0;
};

/// What one contact point remembers.
struct PointHistory
{
    double normal_force = 0.0;      ///< of the last cycle, >= 0 [N]; in the impulse regime J / dt, Eq. (29)
    double shear_force = 0.0;       ///< on inc along t [N]
    double rest_overlap = 0.0;      ///< >= 0, overlap at which the normal spring is empty [m]
    Regime regime = Regime::open;
    double overlap = 0.0;           ///< of the last cycle [m]
};

/// One contact as a value: what moves between arrays when contacts are re-sorted, saved or restarted.
struct Contact
{
    Index part_a = no_index;        ///< part_a < part_b
    Index part_b = no_index;
    Index ref = no_index;           ///< blocks
    Index inc = no_index;
    Index ref_edge = no_index;      ///< positions in Shapes::vertex; no_index: features never searched
    Index inc_edge = no_index;
    Index law = 0;                  ///< position in JointTable::laws
    float moved_limit = 0.0f;       ///< features are searched anew when an incident vertex moved farther [m]
    std::array<float, 4> seen{};    ///< incident vertices in the edge frame when the features were found [m]
    double length_floor = 0.0;      ///< least contact length [m]
    double last_length = 0.0;       ///< length that each point bore in the last cycle [m]
    EdgePair edges;
    std::array<PointHistory, 2> point;  ///< 0 at the lower t, 1 at the upper
};

struct Contacts
{
    std::vector<Index> part_a, part_b, ref, inc, ref_edge, inc_edge, law;
    std::vector<double> length_floor, last_length;
    std::vector<double> tx, ty, start_t, start_m, length, p0x, p0y, p1x, p1y;   ///< EdgePair
    std::vector<float> seen0, seen1, seen2, seen3, moved_limit;
    std::vector<std::uint8_t> stale;                                            ///< features to be searched anew
    std::array<std::vector<double>, 2> normal_force, shear_force, overlap, rest_overlap;   ///< PointHistory
    std::array<std::vector<std::uint8_t>, 2> regime;

    [[nodiscard]] Index size() const { return static_cast<Index>(ref.size()); }
    void resize(Index n);
    [[nodiscard]] Contact get(Index i) const;
    void put(Index i, const Contact& contact);
    [[nodiscard]] EdgePair edges(Index i) const
    {
        return {tx[i], ty[i], start_t[i], start_m[i], length[i], p0x[i], p0y[i], p1x[i], p1y[i]};
    }
};
}  // namespace hdem
