#pragma once
/// GeoJSON (RFC 7946) as traces or blocks. Coordinates are taken as metres in the plane of the model.
///
/// Traces: LineString, MultiLineString. Blocks: Polygon, MultiPolygon without holes; properties name, material and fixed (true, or text as in
/// a file of WKT). Features of other kinds are refused, a third coordinate is left out.

#include "io/polygons.h"
#include "io/traces.h"

namespace hdem
{
[[nodiscard]] bool is_geojson(const std::string& file_name);

TraceFile read_geojson_traces(const std::string& text, const std::string& file_name);

/// Blocks without a name are called "block1", "block2", ... counted on from `first_number`.
PolygonFile read_geojson_blocks(const std::string& text, const std::string& file_name, std::size_t first_number = 0);
}  // namespace hdem
