#pragma once
/// What faults, outlines of regions and joint traces of finite length cut the domain into, as a geometry library found it.

#include "core/types.h"

#include <cstdint>
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

/// What traces of finite length cut the domain into.
struct TraceCells
{
    /// Of each cell its pieces, anticlockwise: itself, or triangles when it has a hole. Neighbours, and pieces of one cell, have the
    /// same vertices along their border [m].
    std::vector<std::vector<Polygon>> cells;
    std::vector<TraceSegment> segments;
    std::int64_t traces = 0;
    std::int64_t dead_ends = 0;   ///< stretches of traces dropped, because they part nothing
    std::vector<double> dropped;  ///< the same of faults and outlines: length by source [m]
};
}  // namespace hdem
