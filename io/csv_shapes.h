#pragma once
/// Polygons and polylines as a table: rows of name,x,y; rows with the same name that follow each other are one shape.
///
///   name,x,y,material,fixed
///   bench,0,0,rock,fixed
///   bench,1,0
///   bench,1,1
///
/// A first row with these names, or the first of them, is a heading. Material and what is fixed stand in a shape's first row.

#include "core/types.h"

#include <string>
#include <string_view>
#include <vector>

namespace hdem
{
class CsvShapes
{
  public:
    struct Shape
    {
        std::string name;
        int line = 0;                   ///< of its first row
        Polygon points;                 ///< [m]
        std::vector<std::string> more;  ///< material and fixed of its first row
    };
    /// @param further  how many columns may follow the coordinates: 2 for blocks, 0 for traces
    explicit CsvShapes(std::size_t further) : further_(further) {}

    std::vector<Shape> shapes;

    /// One row; returns what is wrong with it, or "".
    std::string add(int line, std::string_view row);

  private:
    std::size_t further_;
    bool any_row_ = false;
    bool is_foreign_ = false;  ///< what is wrong has been said at the first row
};
}  // namespace hdem
