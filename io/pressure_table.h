#pragma once
/// Files of water pressures.
///
///   x,y,pressure
///   0.0,0.0,98100
///   10.0,0.0,49050
///
/// Coordinates in metres, pressures in pascals. A first row that is no numbers is a heading; lines that begin with # are skipped.

#include "core/check.h"

#include <array>
#include <iosfwd>
#include <string>
#include <vector>

namespace hdem
{
struct PressureFile
{
    std::vector<std::array<double, 3>> rows;
    std::vector<Problem> problems;  ///< located: their texts begin with file:line
};

PressureFile read_pressures(std::istream& in, const std::string& file_name);
}  // namespace hdem
