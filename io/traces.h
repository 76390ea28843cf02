#pragma once
/// Files of joint traces, and what they cut a domain into.
///
///   # comment
///   LINESTRING(0 2, 8 5.5)
///   LINESTRING(3 0, 4 3, 6 9)
///
/// One WKT line a row; a file whose name ends in .csv has rows of name,x,y instead. Coordinates are in metres.

#include "core/check.h"
#include "core/model/trace_cells.h"

#include <iosfwd>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hdem
{
struct TraceFile
{
    std::vector<Polygon> traces;    ///< points of each, at least two
    std::vector<Problem> problems;  ///< located: their texts begin with file:line
};

TraceFile read_traces(std::istream& in, const std::string& file_name);

/// Points of one WKT text, or what is wrong with it. Only LINESTRING is taken.
std::variant<Polygon, std::string> parse_wkt_line(std::string_view text);

/// The cells that traces of finite length cut a domain into. Stretches that end inside a cell or only join two rings of traces part
/// nothing: they are dropped and counted. A cell around a ring of traces that meets no other trace has a hole, and comes in triangles. A
/// trace is lengthened by `snap` at both ends first, what is too long then goes uncounted. Throws InputError when the library cannot cut.
/// @param domain simple
/// @param lines faults and outlines of regions; they are cut as they are. Of those the length that is dropped is found
/// @see verification/unit/io/traces_test.cpp
TraceCells cut_into_cells(const Polygon& domain, const std::vector<Polygon>& traces, double snap,
                          const std::vector<SourceLine>& lines = {});
}  // namespace hdem
