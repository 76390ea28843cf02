#include "verification/unit/core/rock/region_cases.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

namespace hdem
{
namespace
{
using test::case_of;
using test::laws;
using test::square;

/// Faults typed with a few digits lie almost along joints of a set. A cut that leaves nothing on one side is none.
TEST(Regions, BesideJointsAlmostAlongFaultsHaveAreas)
{
    const std::string sets = "[[joint_set]]\ndip_deg = 0.0\nspacing = 0.5\norigin = [0, 0]\n"
                             "[[joint_set]]\ndip_deg = 90.0\nspacing = 1.0\norigin = [0, 0]\n";
    std::mt19937 random(1);
    for (int i = 0; i < 60; ++i)
    {
        const double off = std::pow(10.0, -9.0 + 6e-10 * static_cast<double>(random())), turn = 3.0 * i;
        const std::string text = square + fmt::format("[[fault]]\nname = \"a\"\npoints = [[-1, 1.5], [5, {}]]\n", 1.5 + off) +
                                 fmt::format("[[fault]]\nname = \"b\"\npoints = [[-1, {}], [5, {}]]\n", 2.5 + off, 2.5 - off) +
                                 sets + laws;
        SCOPED_TRACE(text + fmt::format("turned by {}", turn));
        const RockMass rock = generate_rock_mass(case_of(text, turn));
        for (const RockBlock& block : rock.blocks)
            EXPECT_GT(area(block), 1e-12) << block.name;
        EXPECT_NEAR(summed_area(rock), 16.0, 1e-9);
    }
}

/// Two faults meet on the side of the domain within a rounding. An edge of a rounding between them would give next to no time step, and blocks around an island lost a corner there.
TEST(Regions, BesideFaultsThatMeetAlmostInAPointLoseNoArea)
{
    for (const double off : {0.0, 1e-15, 1e-13, 1e-11, 1e-9})
        for (const double turn : {0.0, 31.0, 90.0})
        {
            const std::string text = "[domain]\npolygon = [[0, 0], [16, 0], [16, 12], [0, 12]]\n"
                                     "[[fault]]\nname = \"a\"\npoints = [[-4, 6.2], [17, 16.7]]\n" +
                                     fmt::format("[[fault]]\nname = \"b\"\npoints = [[-1, {}], [17, 13.3]]\n", 7.9 + off) +
                                     "[[region]]\nname = \"r\"\npolygon = [[10, 1], [11, 1.1], [11, 2], [10.2, 2]]\n"
                                     "[[joint_set]]\ndip_deg = 26\nspacing = 20\norigin = [8, 4]\n" +
                                     laws;
            const RockMass rock = generate_rock_mass(case_of(text, turn));
            EXPECT_NEAR(summed_area(rock), 192.0, 1e-7) << off << ", turned by " << turn;
            for (const RockBlock& block : rock.blocks)
            {
                EXPECT_TRUE(moments(block).centroid.allFinite()) << block.name;
                for (const ConvexPart& part : block.parts)
                    for (std::size_t i = 0; i < part.vertices.size(); ++i)
                        EXPECT_GT((part.vertices[next(i, part.vertices.size())] - part.vertices[i]).norm(), 1e-9) << block.name;
            }
        }
}

/// Three sets without origin meet in the middle of the domain within a rounding. The stretches between them were edges, and a block, of a rounding.
TEST(Regions, BesideSetsThroughOnePointHaveNoEdgesOfARounding)
{
    const auto set = [](double dip, double spacing, const std::string& more)
    { return fmt::format("[[joint_set]]\ndip_deg = {}\nspacing = {}\n{}\n", dip, spacing, more); };
    const auto island = [](int number, double x, double y, double a)
    {
        return fmt::format("[[region]]\nname = \"r{0}\"\npolygon = [[{1}, {2}], [{3}, {2}], [{3}, {4}], [{1}, {4}]]\n", number, x,
                           y, x + a, y + a);
    };
    const RockMass rock = generate_rock_mass(case_of(
        "[domain]\nwidth = 22\nheight = 23.8\n[generator]\nseed = 280\n" + set(70.7, 11.0, "") + set(-42.5, 10.4, "") +
        set(9.8, 12.1, "") + set(-1.6, 8.0, "trace = 7.6\ngap = 2.3") + set(46.5, 3.9, "persistence = 0.95\norigin = [6.6, 8.8]") +
        island(0, 16.9, 14.2, 1.2) + island(1, 7.8, 7.1, 1.0) + island(2, 11.0, 2.1, 1.4) + island(3, 3.2, 18.7, 1.4) + laws));
    EXPECT_NEAR(summed_area(rock), 22.0 * 23.8, 1e-7);
    for (const RockBlock& block : rock.blocks)
    {
        EXPECT_GT(area(block), 1e-6) << block.name;
        for (const ConvexPart& part : block.parts)
            for (std::size_t i = 0; i < part.vertices.size(); ++i)
                EXPECT_GT((part.vertices[next(i, part.vertices.size())] - part.vertices[i]).norm(), 1e-9) << block.name;
    }
}
}  // namespace
}  // namespace hdem
