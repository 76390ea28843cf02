#include "core/rock/rock_mass.h"
#include "io/load_case.h"
#include "verification/unit/core/rock/region_cases.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using test::case_of;
using test::lens;
using test::two_halves;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> all_warnings(const std::string& text)
{
    std::vector<std::string> texts;
    for (const Problem& problem : load_case(text, NamedFiles{}, "case.toml", {}).warnings)
        texts.push_back(problem.text);
    return texts;
}

/// What is wrong with a legal file's geometry.
std::string problem_of(const std::string& text)
{
    try
    {
        (void)load_case(text, NamedFiles{}, "case.toml", {});
    }
    catch (const InputError& error)
    {
        return error.what();
    }
    return {};
}

TEST(RegionErrors, DeadEndsAreDroppedWithAWarning)
{
    const std::string alone = test::with(test::with(two_halves, "[5, 2]]", "[2.5, 2]]"), "region = \"upper\"\n", "");
    const std::string without_region = test::with(alone, "[[region]]\nname = \"upper\"\nabove = \"main\"\n", "");
    EXPECT_THAT(all_warnings(without_region),
                Contains(HasSubstr("fault \"main\": points (2.5 m end inside a block and part nothing: they are dropped)")));
    EXPECT_EQ(generate_rock_mass(case_of(without_region)).blocks.size(), 4u);
    EXPECT_THAT(problem_of(alone), HasSubstr("case.toml:7:1: region \"upper\": block around (2, 2) (it lies on both sides of fault "
                                             "\"main\", which ends inside it)"));
    // Beyond the fault that it meets it is left out, and the part before it is cut.
    const std::string held = without_region + "[[fault]]\nname = \"cross\"\npoints = [[2, -1], [2, 5]]\n";
    EXPECT_THAT(all_warnings(held), Contains(HasSubstr("(0.5 m end inside a block")));
    EXPECT_EQ(generate_rock_mass(case_of(held)).blocks.size(), 6u);
}

TEST(RegionErrors, WhatCannotBeCutIsRefused)
{
    const auto with_points = [](const std::string& points)
    { return problem_of(test::with(two_halves, "[[-1, 2], [5, 2]]", points)); };
    EXPECT_THAT(with_points("[[5, 5], [6, 7]]"),
                HasSubstr("case.toml:5:10: fault \"main\": points: from (5, 5) to (6, 7) (the fault lies "
                          "outside the domain, which spans (0, 0) to (4, 4)). Move it."));
    EXPECT_THAT(with_points("[[1, 1], [1, 1], [3, 2]]"), HasSubstr("points 0 and 1 are the same"));
    EXPECT_THAT(with_points("[[0, 0], [3, 3], [3, 0], [0, 3]]"), HasSubstr("the stretches from points 0 and 2 meet"));
    EXPECT_THAT(with_points("[[0, 0], [3, 3], [1, 1]]"), HasSubstr("the stretches from points 0 and 1 meet"));
    EXPECT_THAT(with_points("[[1, -1], [2, 2], [1, 5]]"),
                HasSubstr("region \"upper\": above = \"main\" (the fault ends straight above"));
    EXPECT_THAT(with_points("[[1, 1], [3, 1], [3, 3], [2, 3], [2, 2]]"), HasSubstr("(the fault winds"));
    EXPECT_THAT(with_points("[[-1, 2], [5, 2], [5, 2.000005], [-2, 2.000005]]"), HasSubstr("a sliver of "));
    const auto with_polygon = [](const std::string& polygon)
    { return problem_of(test::with(lens, "[[1, 1], [3, 1], [3, 3], [1, 3]]", polygon)); };
    EXPECT_THAT(with_polygon("[[1, 1], [3, 3], [3, 1], [1, 3]]"), HasSubstr("region \"lens\": polygon: edges 0 and 2 meet"));
    EXPECT_THAT(with_polygon("[[5, 5], [6, 5], [6, 6]]"),
                HasSubstr("region \"lens\": blocks = 0 (nothing of the domain lies in it)"));
}

TEST(RegionErrors, KeysAreChecked)
{
    const auto problems = [](const std::string& text, const std::string& old, const std::string& by)
    { return testing::PrintToString(test::problems_of(test::with(text, old, by))); };
    EXPECT_THAT(problems(two_halves, "[[-1, 2], [5, 2]]", "[[-1, 2]]"), HasSubstr("has 1 points, a line has at least 2"));
    EXPECT_THAT(problems(two_halves, "above = \"main\"", "above = \"mian\""),
                HasSubstr("(no fault has this name; did you mean 'main'?)"));
    EXPECT_THAT(problems(two_halves, "region = \"upper\"", "region = \"uper\""), HasSubstr("did you mean 'upper'?"));
    EXPECT_THAT(problems(two_halves, "joint = \"fault\"", "joint = \"falut\""), HasSubstr("did you mean 'fault'?"));
    EXPECT_THAT(problems(lens, "material = \"shale\"\njoint", "material = \"slate\"\njoint"),
                HasSubstr("no material has this name"));
    EXPECT_THAT(problems(two_halves, "above = \"main\"", "above = \"main\"\njoint = \"fault\""),
                HasSubstr("belongs to polygon, which is not given"));
    EXPECT_THAT(problem_of(test::with(two_halves, "above = \"main\"\n", "")),
                HasSubstr("region \"upper\": polygon, above and below (none is given)"));
    EXPECT_THAT(test::problems_of(test::two_blocks + "[[fault]]\nname = \"f\"\npoints = [[0, 0], [1, 1]]\n"),
                ElementsAre(HasSubstr("[[fault]] (cuts the domain only, and there is no [domain])")));
}
}  // namespace
}  // namespace hdem
