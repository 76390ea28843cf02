#include "io/load_case.h"
#include "io/profile.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

namespace hdem
{
namespace
{
using testing::HasSubstr;

const std::string laws = "[material.rock]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n"
                         "friction_angle_deg = 30.0\n[[stage]]\ncycles = 1\n";
const std::string slope = "x,y\n# surveyed\n0,10\n12,10\n20,25.5\n40,26\n";

TEST(Profile, BoundsTheDomainFromAbove)
{
    const test::ScratchFolder folder("profile_case");
    std::ofstream(folder / "topo.csv") << slope;
    std::ofstream(folder / "case.toml")
        << "[domain]\nprofile = \"topo.csv\"\nbottom = -5\nfixed = [\"left\", \"right\", \"bottom\"]\n"
           "[[joint_set]]\ndip_deg = 30.0\nspacing = 4.0\n"
        << laws;
    const LoadedCase loaded = load_case(folder / "case.toml");
    double sum = 0.0;
    for (const double area : loaded.setup.model.area)
        sum += area;
    EXPECT_NEAR(sum, 5 * 40 + 10 * 12 + 8 * 0.5 * (10 + 25.5) + 20 * 0.5 * (25.5 + 26), 1e-9);
    Index fixed = 0;
    for (Index b = 0; b < loaded.setup.state.blocks.size(); ++b)
        fixed += loaded.setup.state.blocks.is_free(b) ? 0 : 1;
    EXPECT_GT(fixed, 5);
    EXPECT_LT(fixed, loaded.setup.state.blocks.size());
    // The file goes with the case: from a checkpoint it is read without the disk.
    const LoadedCase again = load_case(loaded.file.source.text(), loaded.file.files, "elsewhere/case.toml", {});
    EXPECT_EQ(again.setup.model.area, loaded.setup.model.area);
}

TEST(Profile, SaysWhatIsWrongAndWhere)
{
    const auto problem = [](const std::string& text)
    {
        std::istringstream in(text);
        const ProfileFile file = read_profile(in, "topo.csv");
        return file.problems.empty() ? "" : file.problems.front().text;
    };
    EXPECT_EQ(problem(slope), "");
    EXPECT_THAT(problem("0,1\n1\n"), HasSubstr("topo.csv:2: profile: line (expected two finite numbers, got \"1\")"));
    EXPECT_THAT(problem("0,1\n1,1\n1,3\n"), HasSubstr("topo.csv:3: profile: line (x = 1 does not follow 1)"));
    EXPECT_THAT(problem("x,y\n0,1\n"), HasSubstr("has 1 points"));
    EXPECT_THAT(problem("0,nan\n1,2\n2,2\n"),
                HasSubstr("topo.csv:1: profile: line (expected the heading x,y or two finite numbers"));
    EXPECT_THAT(problem("y,x\n1,2\n2,2\n"), HasSubstr("expected the heading x,y or two finite numbers, got \"y,x\""));
    EXPECT_EQ(problem("\xef\xbb\xbfX [m],Y [m]\n1,2\n2,2\n"), "");
    EXPECT_THAT(problem("0,1\n1,1e9\n"), HasSubstr("topo.csv:2: profile: line (the point is farther than"));
    EXPECT_THAT(problem(std::string(3'000'000, '0')), HasSubstr("line is longer"));
    std::string long_one;
    for (int i = 0; i < 20'000; ++i)
        long_one += std::to_string(i) + ",1\n";
    EXPECT_EQ(problem(long_one), "");
    EXPECT_THAT(problem(long_one + "20000,1\n"),
                HasSubstr("topo.csv:20001: profile: line (more than 20000 points). Leave some out."));

    const test::ScratchFolder folder("profile_keys");
    std::ofstream(folder / "topo.csv") << slope;
    const auto problem_of = [&](const std::string& keys)
    {
        try
        {
            (void)read_case_text("[domain]\n" + keys + laws, folder / "case.toml");
        }
        catch (const InputError& error)
        {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(problem_of("profile = \"topo.csv\"\n"), HasSubstr("bottom (is missing: a profile is the upper side only)"));
    EXPECT_THAT(problem_of("profile = \"topo.csv\"\nbottom = 12\n"),
                HasSubstr("case.toml:3:10: [domain]: bottom = 12 m (is not below the profile, whose lowest point is at 10 m)"));
    EXPECT_THAT(problem_of("profile = \"none.csv\"\nbottom = 1\n"), HasSubstr("none.csv does not exist"));
    EXPECT_THAT(problem_of("profile = \"topo.csv\"\nbottom = 1\nwidth = 3\n"), HasSubstr("width (contradicts profile)"));
    const std::string below = "profile = \"topo.csv\"\nbottom = -5\n", roller = "[[boundary]]\nkind = \"roller\"\n";
    EXPECT_THAT(problem_of(below + roller + "side = \"bottom\"\n" + roller + "edges = [0]\n"),
                HasSubstr("boundary \"boundary2\": edges (boundary \"boundary1\" acts there in the same stage)"));
    EXPECT_THAT(problem_of(below + "fixed = [\"right\"]\n" + roller + "edges = [1]\n"), HasSubstr("edges (is fixed by [domain])"));
    EXPECT_THAT(problem_of(below + "fixed_edges = [1]\n" + roller + "side = \"right\"\n"), HasSubstr("(is fixed by [domain])"));
    EXPECT_THAT(problem_of(below + "fixed = [\"left\"]\n" + roller + "edges = [5]\n"), HasSubstr("edges (is fixed by [domain])"));
    EXPECT_EQ(problem_of(below + "fixed = [\"left\"]\n" + roller + "edges = [1]\n" + roller + "side = \"bottom\"\n"), "");
    EXPECT_THAT(problem_of("width = 3\nheight = 2\nbottom = 1\n"), HasSubstr("bottom (belongs to profile, which is not given)"));
}
}  // namespace
}  // namespace hdem
