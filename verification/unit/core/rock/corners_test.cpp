#include "verification/unit/core/rock/region_cases.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <random>

namespace hdem
{
namespace
{
using test::case_of;

/// A slope with its toe in (12, 8), turned by an angle, and what else its case says.
RockMass slope(const std::string& lines, double turn_deg)
{
    const std::string text = "[domain]\npolygon = [[0, 0], [30, 0], [30, 16], [12, 16], [12, 8], [0, 8]]\nfixed_edges = [0]\n" +
                             lines +
                             "[material.rock]\ndensity = 2700\n[joint.default]\nnormal_stiffness = 7e9\nshear_stiffness = "
                             "5e8\nfriction_angle_deg = 35\n"
                             "[[stage]]\ncycles = 1\n";
    return generate_rock_mass(case_of(text, turn_deg));
}

/// From the left side to the right one, past the toe at a height of `above`.
std::string fault_past_toe(double slope, double above)
{
    return fmt::format("[[fault]]\nname = \"f\"\npoints = [[-1, {:.17g}], [36, {:.17g}]]\n", 8.0 + above - 13.0 * slope,
                       8.0 + above + 24.0 * slope);
}

constexpr double round_offs[] = {0.0,   1e-15, -1e-15, 1e-12, -1e-12, 1e-10, -1e-10, 1e-9,
                                 -1e-9, 1e-8,  -1e-8,  1e-7,  -1e-7,  1e-6,  -1e-6};

TEST(Corners, ALineThroughAReentrantOnePartsTheRockThere)
{
    std::mt19937 random(4);
    for (const double above : round_offs)
        for (int i = 0; i < 4; ++i)
        {
            const double inclined = 0.05 + 0.25 * static_cast<double>(random()) / 4294967296.0;
            SCOPED_TRACE(fmt::format("slope {:.17g}, {} m above the toe", inclined, above));
            const RockMass rock = slope(fault_past_toe(inclined, above), i % 2 == 0 ? 0.0 : 37.0);
            expect_sound(rock, 1e-8);
            EXPECT_EQ(rock.blocks.size(), 3u) << "below, the wedge at the toe, and the slope";
        }
}

TEST(Corners, OutlinesAreCutWhereALinePassesOneByRoundOff)
{
    std::mt19937 random(5);
    for (const double above : round_offs)
        for (const char* shape : {"circle\"\ndiameter = 5.0", "rectangle\"\nwidth = 5\nheight = 5"})
            for (const char* inside : {"one_block", "jointed"})
            {
                const double inclined = 0.05 + 0.25 * static_cast<double>(random()) / 4294967296.0;
                const std::string lines = fault_past_toe(inclined, above) +
                                          "[[joint_set]]\nname = \"q\"\ndip_deg = 85\nspacing = 6\norigin = [27, 1]\n" +
                                          "[[joint_set]]\nname = \"c\"\ndip_deg = 31\np21 = 0.2\ntrace = 9.2\n" +
                                          fmt::format(
                                              "[[excavation]]\nname = \"t\"\nshape = \"{}\nposition = [17, {}]\ninside = \"{}\"\n",
                                              shape, shape[0] == 'c' ? 7.0 : 4.5, inside);
                SCOPED_TRACE(lines);
                expect_sound(slope(lines, 0.0), 1e-8);
            }
}
}  // namespace
}  // namespace hdem
