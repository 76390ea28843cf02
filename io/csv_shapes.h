#pragma once
/// Polygons and polylines as a table: rows of name,x,y; rows with the same name that follow each other are one shape.
///
///   name,x,y,material,fixed
///   bench,0,0,rock,fixed
///   bench,1,0
///   bench,1,1
///
/// A first row whose second column is no number is a heading. What follows the coordinates is kept from a shape's first row.

#include "core/types.h"

#include <string>
#include <string_view>
#include <vector>

namespace hdem
{
struct CsvShapes
{
    struct Shape
    {
        std::string name;
        int line = 0;                   ///< of its first row
        Polygon points;                 ///< [m]
        std::vector<std::string> more;  ///< further columns of its first row
    };
    std::vector<Shape> shapes;

    /// One row; returns what is wrong with it, or "".
    std::string add(int line, std::string_view row);

  private:
    bool any_row_ = false;
    bool is_foreign_ = false;  ///< what is wrong has been said at the first row
};
}  // namespace hdem
