#pragma once
/// Which edges of two parts face each other.

#include "core/detection/edge_scan.h"
#include "core/state/contacts.h"

namespace hdem
{
/// A reference edge with the edge that faces it.
struct Facing
{
    bool ref_is_a;
    Index ref_edge, inc_edge;
    EdgePair edges;
    double overlap;       ///< greatest where they face each other; -infinity: beside each other [m]
    double length;        ///< over which they lie over each other, up to hollow corners; < 0: beside each other [m]
    double middle;        ///< of that stretch, from the start of the reference edge [m]
    double deepest;       ///< where they overlap most, from there [m]
    double along;         ///< velocity of the other block there along the reference edge [m/s]
    double approach;      ///< and into the block of the reference edge
    double slope;         ///< of the incident edge, d overlap / d t [-]
    bool is_deep_at_end;  ///< of the incident edge: its end reaches deeper than its start
    double full;          ///< of the shorter one along the reference edge: the most that could lie over the other [m]
};

/// The external edge of least overlap, and the one of the other part that faces it.
/// @param kept  an edge that is taken if no other's overlap is less by the margin
/// @pre  both parts have an external edge
[[nodiscard]] Facing choose_facing(const Shapes& shapes, const PartPair& pair, const PairScan& scan, Index kept = no_index);

/// The external edge of least overlap of one part, and the one of the other part that faces it.
/// @pre  that part has one: `scan.on[0 or 1].edge`
[[nodiscard]] Facing facing_on(bool part_a, const Shapes& shapes, const PartPair& pair, const PairScan& scan);
}  // namespace hdem
