#include "core/model/edge_sources.h"
#include "core/rock/rock_mass.h"
#include "core/rock/voronoi_edges.h"
#include "verification/unit/core/rock/region_cases.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using test::laws;

const std::string box_20 = "[domain]\nwidth = 20.0\nheight = 15.0\n";

void expect_filled(const RockMass& rock)
{
    EXPECT_NEAR(summed_area(rock), rock.domain_area, 1e-9 * rock.domain_area);
    double common = 0.0;
    for (const BlockOverlap& overlap : find_overlaps(rock.blocks, 0, 0.0))
        common += overlap.area;
    EXPECT_LE(common, 1e-9 * rock.domain_area);
}

TEST(Voronoi, FillsTheDomainWithCellsOfTheEdgeThatIsAskedFor)
{
    for (const char* more : {"iterations = 0\n", "iterations = 1\n", "", "iterations = 20\n"})
    {
        const CaseDef def = test::read("[domain]\nwidth = 60.0\nheight = 50.0\n[voronoi]\nedge = 1.0\n" + std::string(more) + laws);
        const RockMass rock = generate_rock_mass(def);
        expect_filled(rock);
        EXPECT_NEAR(rock.sets.back().trace.mean(), 1.0, 0.04) << more;
        EXPECT_EQ(rock.sets.back().dead_ends, 0.0);
        EXPECT_TRUE(identical(rock, generate_rock_mass(test::read("[domain]\nwidth = 60.0\nheight = 50.0\n[voronoi]\nedge = 1.0\n" +
                                                                  std::string(more) + laws))));
    }
}

/// A cell is what is nearer to its point than to any other one: it is convex, and three cells meet at a vertex.
TEST(Voronoi, CellsAreConvexAndAlikeAfterIterations)
{
    const auto spread = [](int iterations)
    {
        const RockMass rock = generate_rock_mass(
            test::read("[domain]\nwidth = 60.0\nheight = 50.0\n[voronoi]\nedge = 1.5\niterations = " + std::to_string(iterations) +
                       "\n" + laws));
        double n = 0.0, sum = 0.0, squares = 0.0;
        for (const RockBlock& block : rock.blocks)
        {
            if (distance_to_boundary({{0, 0}, {60, 0}, {60, 50}, {0, 50}}, moments(block).centroid) < 3.0)
                continue;
            EXPECT_EQ(block.parts.size(), 1u);
            n += 1.0;
            sum += area(block);
            squares += area(block) * area(block);
        }
        return (squares / n - sum * sum / n / n) / (sum * sum / n / n);
    };
    EXPECT_GT(spread(0), 0.2);
    EXPECT_LT(spread(5), 0.08);
}

TEST(Voronoi, FillsARegionAndNoMore)
{
    const CaseDef def = test::read(box_20 +
                                   "[[region]]\nname = \"zone\"\npolygon = [[4, 3], [16, 4], [15, 12], [5, 11]]\n"
                                   "[voronoi]\nedge = 0.8\nregion = \"zone\"\njoint = \"bedding\"\n" +
                                   laws);
    const RockMass rock = generate_rock_mass(def);
    expect_filled(rock);
    EXPECT_GT(rock.blocks.size(), 30u);
    const std::int32_t source = EdgeSources(def).voronoi();
    std::size_t outside = 0, cells = 0;
    for (const RockBlock& block : rock.blocks)
        (contains(def.regions[0].polygon, moments(block).centroid) && area(block) < 50.0 ? cells : outside) += 1;
    EXPECT_EQ(outside, 1u);
    for (const DirectedEdge& edge : all_edges(rock))
        EXPECT_TRUE(edge.source != source || contains(def.regions[0].polygon, 0.5 * (edge.from + edge.to)));
}

TEST(Voronoi, EdgesBelowTheSmallestInsideAreGone)
{
    const std::string text = "[domain]\nwidth = 60.0\nheight = 50.0\n[voronoi]\nedge = 1.0\niterations = 0\n";
    const auto shortest = [&](const std::string& more)
    {
        const RockMass rock = generate_rock_mass(test::read(text + more + laws));
        expect_filled(rock);
        double least = 1e9;
        for (const DirectedEdge& edge : all_edges(rock))
        {
            const auto is_inside = [](const Vec2& p) { return p.x() > 2.0 && p.x() < 58.0 && p.y() > 2.0 && p.y() < 48.0; };
            if (is_inside(edge.from) && is_inside(edge.to))
                least = std::min(least, (edge.to - edge.from).norm());
        }
        return least;
    };
    EXPECT_LT(shortest(""), 0.05);
    EXPECT_GE(shortest("[generator]\nsmallest_edge = 0.2\n"), 0.2);
}

TEST(Voronoi, SeedsChangeTheCellsOnly)
{
    const auto rock = [](const std::string& seed)
    { return generate_rock_mass(test::read(box_20 + "[voronoi]\nedge = 1.0\n" + seed + laws)); };
    EXPECT_FALSE(identical(rock("seed = 3\n"), rock("seed = 4\n")));
    EXPECT_TRUE(identical(rock("seed = 3\n"), rock("seed = 3\n[generator]\nseed = 9\n")));
}
}  // namespace
}  // namespace hdem
