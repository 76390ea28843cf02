#pragma once
/// Cells between traces of finite length as blocks that joint sets and outlines can cut further.

#include "core/rock/block_cutter.h"

namespace hdem
{
/// A block a cell. Every edge on the domain's boundary keeps that edge's chord, every other lies on the chord of its trace, so that
/// neighbours agree on the points of later cuts. Vertices where a cell goes straight on along one trace are left out.
/// @param source of edges along traces
/// @pre domain and pieces of cells are simple and anticlockwise
CutMass traced_mass(const Polygon& domain, const TraceCells& traces, std::int32_t source, double tolerance);
}  // namespace hdem
