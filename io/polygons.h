#pragma once
/// Files of blocks: one WKT polygon a line, for models that come from mapping or from other programs.
///
///   # comment
///   POLYGON((0 0, 1 0, 1 1, 0 1, 0 0))
///   POLYGON((1 0, 2 0, 2 1, 1 1, 1 0)); bench; weathered_rock; fixed
///
/// After the polygon may follow, each behind a semicolon and each possibly empty: name, material, and "fixed" or a list of
/// x, y, rotation. Coordinates are in metres.
///
/// A file whose name ends in .csv has a row a vertex instead: name,x,y and, from a block's first row, material,fixed.

#include "core/check.h"
#include "core/model/rock_def.h"

#include <iosfwd>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace hdem
{
struct PolygonFile
{
    struct Line
    {
        BlockDef block;
        int line = 0;  ///< in the file, 1 = first
    };
    std::vector<Line> blocks;
    std::vector<Problem> problems;  ///< located: their texts begin with file:line
};

/// Blocks without a name are called "block1", "block2", ... counted on from `first_number`, the blocks the case has already.
/// @param file_name for messages
PolygonFile read_polygons(std::istream& in, const std::string& file_name, std::size_t first_number = 0);

/// What is fixed: "fixed" (all), or some of x, y, rotation; words with spaces or commas between them. False for other words.
bool read_fixed(std::string_view text, BlockDef& block);

/// Polygon of one WKT text without its closing vertex, or what is wrong with it. Only POLYGON with one ring is taken.
std::variant<Polygon, std::string> parse_wkt(std::string_view text);

/// "POLYGON((...))", closed; reading it gives the same doubles.
/// @param holes  rings inside of it. parse_wkt refuses them.
std::string to_wkt(const Polygon& polygon, std::span<const Polygon> holes = {});
/// A line with name, material and what is fixed, as read_polygons reads it. Velocities are not written.
void write_polygon(std::ostream& out, const BlockDef& block, std::span<const Polygon> holes = {});
/// The same of each block.
void write_polygons(std::ostream& out, std::span<const BlockDef> blocks);
}  // namespace hdem
