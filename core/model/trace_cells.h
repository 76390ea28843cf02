#pragma once
/// What faults, outlines of regions and joint traces of finite length cut the domain into, as a geometry library found it.

#include "core/types.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hdem
{
/// A straight stretch of a line.
struct TraceSegment
{
    Vec2 from = {0.0, 0.0};          ///< [m]
    Vec2 to = {0.0, 0.0};            ///< [m]
    std::int32_t source = no_index;  ///< of edges along it, see EdgeSources; no_index: that of all traces
};

/// A fault, or a stretch of a region's outline.
struct SourceLine
{
    std::int32_t source = no_index;
    Polygon points;  ///< [m]
};

/// Random values drawn for one quantity: their count and sum, and the mean of the truncated distribution.
struct DrawnNumber
{
    std::int64_t count = 0;
    double sum = 0.0;
    double expected = 0.0;

    void add(double x)
    {
        ++count;
        sum += x;
    }
    [[nodiscard]] double mean() const { return count > 0 ? sum / static_cast<double>(count) : 0.0; }
};

/// What became of one source of joints: a joint set, the Voronoi cells, the traces of a file.
struct DrawnSet
{
    std::string name;
    std::int64_t joints = 0;  ///< that have a part in the domain
    DrawnNumber dip;          ///< [deg]
    DrawnNumber spacing;      ///< in the section [m]
    DrawnNumber trace;        ///< [m]
    DrawnNumber gap;          ///< [m]
    double length = 0.0;      ///< in the domain and where the set may be [m]
    double skipped = 0.0;     ///< of it left out by persistence [m]
    double refused = 0.0;     ///< of it in blocks of which a cut would have left too small a piece or too short an edge [m]
    double dead_ends = 0.0;   ///< of it that parts nothing, and was dropped [m]
    double welded = 0.0;      ///< of it along slivers that were joined to a neighbour [m]
};

/// What traces of finite length cut the domain into.
struct TraceCells
{
    /// Pieces of each cell, anticlockwise: the cell itself, or convex ones when it has holes. Neighbours, and pieces of one cell, have the
    /// same vertices along their border [m].
    std::vector<std::vector<Polygon>> cells;
    std::vector<TraceSegment> segments;
    std::int64_t traces = 0;
    std::int64_t dead_ends = 0;   ///< stretches of traces dropped, because they part nothing
    double trace_length = 0.0;    ///< of the traces of a file, in the domain [m]
    double trace_dropped = 0.0;   ///< of this the part that was dropped [m]
    std::vector<double> dropped;  ///< the same of faults, outlines and sets: length by source [m]
    std::vector<DrawnSet> sets;   ///< of each joint set, then of the Voronoi cells; empty when none of them was cut here
};
}  // namespace hdem
