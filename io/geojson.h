#pragma once
/// GeoJSON (RFC 7946) as traces or blocks, and blocks as GeoJSON. Coordinates are taken as metres in the plane of the model.
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

/// What a mapped rock mass is written as.
struct BlockShape
{
    BlockDef block;                  ///< its polygon: the outer ring, anticlockwise
    std::vector<Polygon> holes;      ///< rings around other blocks
    std::string excavation;          ///< that it lies in, or ""
    std::vector<std::string> edges;  ///< what each edge of the outer ring was cut by: the name of a set, "domain", ...
    double area = 0.0;               ///< [m2]
};

/// One feature a block, with properties name, material, fixed, area, excavation and edges.
[[nodiscard]] std::string to_geojson(std::span<const BlockShape> blocks);

/// As write_polygons; above each block a comment with what its edges were cut by.
[[nodiscard]] std::string to_wkt(std::span<const BlockShape> blocks);
}  // namespace hdem
