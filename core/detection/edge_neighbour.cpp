#include "core/detection/edge_neighbour.h"

#include "core/detection/edge_scan.h"

#include <algorithm>

namespace hdem
{
Index part_of(const Shapes& shapes, Index block, Index edge)
{
    const auto begin = shapes.vertex_begin.begin();
    const auto first = begin + shapes.part_begin[block], last = begin + shapes.part_begin[block + 1];
    return static_cast<Index>(std::upper_bound(first, last, edge) - begin) - 1;
}

EdgeNeighbour neighbour_of(const Shapes& shapes, Index part, Index edge, bool at_end)
{
    const auto beside = [&](const EdgeNeighbour& at)
    {
        if (at_end)
            return shapes.next_vertex(at.part, at.edge);
        return at.edge > shapes.vertex_begin[at.part] ? at.edge - 1 : shapes.vertex_begin[at.part + 1] - 1;
    };
    const Index block = shapes.part_block[part];
    EdgeNeighbour at{edge, part};
    for (Index turns = shapes.part_begin[block]; turns < shapes.part_begin[block + 1]; ++turns)  // internal edges at a corner
    {
        at.edge = beside(at);
        if (is_external(shapes, at.edge) || shapes.to_twin[at.edge] == 0)
            break;
        at.edge += shapes.to_twin[at.edge];
        at.part = part_of(shapes, block, at.edge);
    }
    return at;
}
}  // namespace hdem
