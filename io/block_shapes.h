#pragma once
/// Generated blocks as files for other programs: GeoJSON (RFC 7946) and WKT. Coordinates are metres in the plane of the model.

#include "core/rock/rock_mass.h"

#include <span>
#include <string>
#include <vector>

namespace hdem
{
/// What a mapped rock mass is written as.
struct BlockShape
{
    BlockDef block;                  ///< its polygon: the outer ring, anticlockwise
    std::vector<Polygon> holes;      ///< rings around other blocks
    std::string excavation;          ///< that it lies in, or ""
    std::vector<std::string> edges;  ///< what each edge of the outer ring was cut by: the name of a set, "domain", ...
    std::vector<std::vector<std::string>> hole_edges;  ///< the same of each hole
    double area = 0.0;                                 ///< [m2]
};

/// All blocks but walls, in their order.
[[nodiscard]] std::vector<BlockShape> block_shapes(const CaseDef& def, const RockMass& rock);

/// One feature a block, with properties name, material, fixed, area, excavation and edges; hole_edges where there are holes.
[[nodiscard]] std::string to_geojson(std::span<const BlockShape> blocks);

/// As write_polygon; above each block a comment with what its edges were cut by.
[[nodiscard]] std::string to_wkt(std::span<const BlockShape> blocks);
}  // namespace hdem
