#include "io/case_override.h"
#include "verification/unit/io/case_text.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using test::problems_of;
using test::read;
using test::two_blocks;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string with_sets = two_blocks +
                              "[domain]\nwidth = 9\nheight = 9\n[[joint_set]]\nname = \"bedding\"\ndip_deg = 0\nspacing = 2\n"
                              "[[joint_set]]\ndip_deg = 90\nspacing = 2\n";

TEST(Override, SplitsAtTheFirstEqualsSign)
{
    const Override set = parse_override(" title = a=b ");
    EXPECT_EQ(set.key, "title");
    EXPECT_EQ(set.value, "a=b");
    EXPECT_THROW(parse_override("title"), InputError);
    EXPECT_THROW(parse_override("=5"), InputError);
}

TEST(Override, ReplacesAndAddsValues)
{
    const CaseDef def = read(with_sets, {{"joint.default.friction_angle_deg", "20"},
                                         {"joint.default.cohesion", "1e4"},
                                         {"stage[0].cycles", "77"},
                                         {"joint_set.bedding.dip_deg", "-15"},
                                         {"joint_set.set2.spacing", "3"},
                                         {"joint_set[1].dip_deg", "80"},
                                         {"contact.method", "force"},
                                         {"contact.threshold_scale", "model"},
                                         {"block.top.polygon[2]", "[1, 2]"},
                                         {"block.top.fixed", "[\"x\"]"},
                                         {"gravity.vector", "[0, -1]"},
                                         {"title", "a bare title"}});
    EXPECT_EQ(def.joints[0].friction_angle_deg, 20.0);
    EXPECT_EQ(def.joints[0].cohesion, 1e4);
    EXPECT_EQ(def.stages[0].cycles, 77);
    EXPECT_EQ(def.joint_sets[0].dip_deg, -15.0);
    EXPECT_EQ(def.joint_sets[1].spacing, 3.0);
    EXPECT_EQ(def.joint_sets[1].dip_deg, 80.0);
    EXPECT_EQ(def.contact.method, Method::force);
    EXPECT_EQ(def.blocks[1].polygon[2], Vec2(1, 2));
    EXPECT_TRUE(def.blocks[1].fix_x);
    EXPECT_EQ(def.gravity, Vec2(0, -1));
    EXPECT_EQ(def.title, "a bare title");
}

TEST(Override, OneNumberIsTheLengthOfAVectorThatTheCaseGives)
{
    const std::string pushed = two_blocks + "[[load]]\nname = \"push\"\nblocks = [\"top\"]\nforce = [-3e3, 4e3]\n"
                                            "[[load]]\nblocks = [\"top\"]\nforce = [0, 0]\nmoment = 1\n";
    EXPECT_EQ(read(pushed, {{"load.push.force", "10"}}).loads[0].force, Vec2(-6, 8));
    EXPECT_EQ(read(pushed, {{"load[0].force", "-2.5e3"}}).loads[0].force, Vec2(1500, -2000)) << "turned back";
    EXPECT_EQ(read(pushed, {{"load.push.force[0]", "7"}}).loads[0].force, Vec2(7, 4e3));
    EXPECT_EQ(read(pushed, {{"load.load2.moment", "7"}}).loads[1].moment, 7.0) << "by its name of default";
    EXPECT_EQ(read(pushed, {{"gravity.vector", "[0, -2]"}, {"gravity.vector", "3"}}).gravity, Vec2(0, -3));
    EXPECT_THAT(problems_of(pushed, {{"load.load2.force", "7"}}), ElementsAre(HasSubstr("and this vector has none")));
    EXPECT_THAT(problems_of(pushed, {{"load.pull.force", "7"}}), ElementsAre(HasSubstr("no entry of load is called 'pull'")));
    EXPECT_FALSE(problems_of(with_sets, {{"domain.origin", "7"}}).empty()) << "a place has no direction";
    EXPECT_THAT(problems_of(two_blocks + "[[load]]\nname = \"a\"\nblocks = [\"top\"]\nmoment = 1\n"
                                         "[[load]]\nname = \"a\"\nblocks = [\"top\"]\nmoment = 1\n"),
                ElementsAre(HasSubstr("load 1 has this name already")));
}

TEST(Override, TheLastOfOneKeyHolds)
{
    EXPECT_EQ(read(two_blocks, {{"stage[0].cycles", "5"}, {"stage[0].cycles", "6"}}).stages[0].cycles, 6);
}

/// What a stage sets may be wrong only together with what stands elsewhere: the stage is named, where it stands.
TEST(Override, OfAStageIsNamedWhereItMakesTheCaseWrong)
{
    const auto set = [](const std::string& joint, const std::string& lines)
    {
        return test::with(two_blocks, "friction_angle_deg = 30.0\n", "friction_angle_deg = 30.0\n" + joint) +
               "[[stage]]\nname = \"cut\"\ncycles = 5\n" + lines;
    };
    const std::string bonded = "cohesion = 1e4\ntension = 1e4\n";
    EXPECT_THAT(problems_of(set(bonded, "set = [\"joint.default.cohesion = 0\"]\n")),
                ElementsAre(testing::AllOf(
                    testing::StartsWith(
                        "case.toml:21:7: stage \"cut\": set = \"joint.default.cohesion=0\": then joint \"default\": tension ("),
                    HasSubstr("is greater than cohesion / tan(friction) = 0 Pa). Give less, or more cohesion."))));
    EXPECT_THAT(problems_of(set(bonded, "set = [\"joint.default.friction_angle_deg = 60\"]\nset_cycles = 5\n")),
                ElementsAre(HasSubstr("case.toml:21:7: stage \"cut\": set = \"joint.default.friction_angle_deg=60\": then joint")));
    EXPECT_THAT(problems_of(set(bonded, "set = [\"joint.default.tension = 5e4\"]\n")),
                ElementsAre(testing::StartsWith(
                    "case.toml:21:7: stage \"cut\": set joint.default.tension=5e4: joint \"default\": tension (is greater")));
    EXPECT_THAT(problems_of(set(bonded, "set = [\"material.rock.density = 0\"]\n")),
                ElementsAre(testing::StartsWith(
                    "case.toml:21:7: stage \"cut\": set material.rock.density=0: material \"rock\": density = 0")));
    EXPECT_THAT(problems_of(set(bonded, "set = [\"joint.default.tension = 5e3\"]\n[[stage]]\nname = \"open\"\ncycles = 5\n"
                                        "set = [\"joint.default.cohesion = 0\"]\n")),
                ElementsAre(testing::StartsWith("case.toml:25:7: stage \"open\": set = \"joint.default.cohesion=0\": then joint")))
        << "the tension is of an earlier stage";
}

TEST(Override, IsNamedWhereItIsWrong)
{
    EXPECT_THAT(problems_of(two_blocks, {{"joint.default.fricton_angle_deg", "20"}}),
                ElementsAre(testing::AllOf(
                    testing::StartsWith(
                        "--set joint.default.fricton_angle_deg=20: joint \"default\": fricton_angle_deg = 20 (unknown key; "),
                    HasSubstr("did you mean 'friction_angle_deg'?"))));
    EXPECT_THAT(problems_of(two_blocks, {{"time.step", "-1"}}),
                ElementsAre(testing::StartsWith("--set time.step=-1: [time]: step = -1 s (must be > 0")));
    EXPECT_THAT(problems_of(two_blocks, {{"time.step", "fast"}}), ElementsAre(HasSubstr("expected a number in s, got text")));
    EXPECT_THAT(problems_of(two_blocks, {{"contct.method", "force"}}),
                ElementsAre(HasSubstr("unknown section; did you mean 'contact'?")));
    EXPECT_THAT(problems_of(two_blocks, {{"stage[3].cycles", "1"}}), ElementsAre(HasSubstr("stage has 1 entries, counted from 0")));
    EXPECT_THAT(problems_of(two_blocks, {{"joint_set[0].dip_deg", "1"}}), ElementsAre(HasSubstr("the case has no [[joint_set]]")));
    EXPECT_THAT(problems_of(with_sets, {{"joint_set.beding.dip_deg", "1"}}),
                ElementsAre(HasSubstr("no entry of joint_set is called 'beding'; there are 2, from joint_set[0] on")));
    EXPECT_THAT(problems_of(two_blocks, {{"stage[0].cycles.x", "1"}}), ElementsAre(HasSubstr("inside a key that has a value")));
    for (const char* path : {"a..b", "stage[", "stage[x].cycles", "stage[-1].cycles", "[0]", "stage[99999999999999999999].cycles",
                             "a.b.c.d.e.f.g.h.i.j"})
        EXPECT_THAT(problems_of(two_blocks, {{path, "1"}}), ElementsAre(HasSubstr("not a path of keys"))) << path;
    for (const char* value : {"[1, 2", "\"open", "{a = 1", "1\n[stage]", "1, 2"})
        EXPECT_EQ(problems_of(two_blocks, {{"title", value}}).size(), 1U) << value;
    EXPECT_THAT(problems_of(two_blocks, {{"time.step", "nan"}}), ElementsAre(HasSubstr("must be finite")));
    EXPECT_THAT(problems_of(two_blocks, {{"time", "5"}}), ElementsAre(HasSubstr("is a section, not a value")));
}
}  // namespace
}  // namespace hdem
