#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost 1.74 includes one of its own

#include "core/rock/block_overlap.h"

#include "core/geometry/polygon.h"

#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>

#include <iterator>
#include <map>
#include <utility>

namespace hdem
{
namespace
{
namespace bg = boost::geometry;
using BoostPoint = bg::model::d2::point_xy<double>;
using BoostBox = bg::model::box<BoostPoint>;

struct PartSlot
{
    std::size_t block;
    std::size_t part;
};
using Entry = std::pair<BoostBox, PartSlot>;

BoostBox box_of(const ConvexPart& part)
{
    const Box box = bounding_box(part.vertices);
    return {BoostPoint(box.low.x(), box.low.y()), BoostPoint(box.high.x(), box.high.y())};
}
}  // namespace

std::vector<BlockOverlap> find_overlaps(const std::vector<RockBlock>& blocks, std::size_t first_b, double share)
{
    std::vector<Entry> entries;
    for (std::size_t b = 0; b < blocks.size(); ++b)
    {
        for (std::size_t p = 0; p < blocks[b].parts.size(); ++p)
        {
            entries.emplace_back(box_of(blocks[b].parts[p]), PartSlot{b, p});
        }
    }
    const bg::index::rtree<Entry, bg::index::quadratic<16>, bg::index::indexable<Entry>, bg::index::equal_to<Entry>> tree(entries);

    std::vector<BlockOverlap> overlaps;
    std::vector<Entry> found;
    for (std::size_t b = first_b; b < blocks.size(); ++b)
    {
        std::map<std::size_t, double> common;
        for (const ConvexPart& part : blocks[b].parts)
        {
            found.clear();
            tree.query(bg::index::intersects(box_of(part)), std::back_inserter(found));
            for (const auto& [box, other] : found)
            {
                if (other.block < b)
                {
                    common[other.block] += convex_overlap_area(part.vertices, blocks[other.block].parts[other.part].vertices);
                }
            }
        }
        for (const auto& [a, overlap] : common)
        {
            if (overlap > share * std::min(area(blocks[a]), area(blocks[b])))
            {
                overlaps.push_back({a, b, overlap});
            }
        }
    }
    return overlaps;
}
}  // namespace hdem
