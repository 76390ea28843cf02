#pragma once
/// The ground of a domain: rows of x,y with x ascending.

#include "core/check.h"
#include "core/types.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace hdem
{
struct ProfileFile
{
    Polygon points;                 ///< from the left to the right [m]
    std::vector<Problem> problems;  ///< located: their texts begin with file:line
};

ProfileFile read_profile(std::istream& in, const std::string& file_name);

/// What lies between a profile and a level, anticlockwise: edge 0 is the lower side, edge 1 the right one, the last one the left one.
/// @pre the level is below all points
[[nodiscard]] Polygon domain_below(const Polygon& profile, double bottom);
}  // namespace hdem
