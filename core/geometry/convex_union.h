#pragma once
/// Unions of convex polygons: which edges face each other, and which parts hang together by internal edges.

#include "core/geometry/convex_split.h"

#include <map>
#include <vector>

namespace hdem
{
/// Length along which edges of two parts face each other: edges on one chord, overlapping by more than `tolerance` [m].
double shared_length(const CutPolygon& a, const CutPolygon& b, const Chords& chords, double tolerance);

/// The same by the source of a's edges, added to `lengths`.
void add_shared_lengths(const CutPolygon& a, const CutPolygon& b, const Chords& chords, double tolerance,
                        std::map<std::int32_t, double>& lengths);

/// Give both sides of every shared length the given source. Edges that are shared in part are split there.
void set_shared_source(CutPolygon& a, CutPolygon& b, std::int32_t source, const Chords& chords, double tolerance);

/// For each part the number of the connected group it belongs to, by shared internal edges; groups are numbered in order of their
/// first part.
std::vector<std::size_t> connected_groups(const std::vector<CutPolygon>& parts, const Chords& chords, double tolerance);

/// Total area of the parts [m2].
double total_area(const std::vector<CutPolygon>& parts);
}  // namespace hdem
