#pragma once
/// Cutting excavation outlines into the blocks.

#include "core/rock/block_cutter.h"

#include <vector>

namespace hdem
{
/// The outline as a closed polygon, anticlockwise. Arcs have their vertices on the circle, so the area of n straight edges over a
/// half circle of radius r is n/2 r² sin(π/n), less than that of the circle.
/// @pre the sizes are positive, height > width/2 for a horseshoe
Polygon outline_polygon(const ExcavationDef& excavation);

/// Convex parts on both sides of an outline.
struct Separated
{
    std::vector<CutPolygon> inside;
    std::vector<CutPolygon> outside;
};

/// Cut the parts of one block along an outline, convex or concave. Only edges of the outline that run through a part cut it, each
/// along its whole line: pieces on the same side keep internal edges between them, edges between the sides come from the
/// outline. A vertex of the outline inside a part becomes a vertex of the pieces, bit for bit.
Separated separate(std::vector<CutPolygon> parts, const Polygon& outline, Chords& chords, double tolerance);

/// Cut outline `number` into every block that lies in no earlier excavation. Each connected piece becomes a block; what lies inside
/// belongs to the excavation. Parts of the outline outside the domain have no effect: an outline may open to the surface.
///
/// InsideOutline::one_block: the pieces inside give way to a single block, the area inside the outline and the domain but in no
/// earlier excavation.
///
/// Returns the number of separate areas the single block would consist of (an error unless 1); for InsideOutline::jointed the
/// number of blocks inside (0: the outline misses the domain or lies in earlier excavations).
std::size_t cut_outline(CutMass& mass, const std::vector<Polygon>& outlines, std::size_t number, InsideOutline inside);
}  // namespace hdem
