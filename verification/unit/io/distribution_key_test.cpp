#include "core/rock/rock_checks.h"
#include "io/distribution_key.h"
#include "verification/unit/io/case_text.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using test::problems_of;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

const std::string laws = R"([material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 30.0
[[stage]]
cycles = 10
)";
const std::string
    head = "[domain]\nwidth = 10.0\nheight = 8.0\n[[fault]]\nname = \"f\"\npoints = [[-1, 4], [11, 4]]\n[[joint_set]]\n";

CaseDef read(const std::string& set)
{
    return test::read(head + set + laws);
}

TEST(DistributionKey, APlainNumberIsNoDistribution)
{
    const JointSetDef set = read("dip_deg = 20\nspacing = 1.5\n").joint_sets[0];
    EXPECT_EQ(set.dip_deg, 20.0);
    EXPECT_FALSE(set.dip_law.is_random() || set.spacing_law.is_random() || set.trace || set.gap);
}

TEST(DistributionKey, TablesAreRead)
{
    const JointSetDef set = read("dip_deg = {mean = 20, distribution = \"von_mises\", kappa = 50}\n"
                                 "spacing = {mean = 1.5, distribution = \"exponential\", most = 4}\n"
                                 "trace = {mean = 3, distribution = \"lognormal\", sd = 1}\ngap = 0.5\n")
                                .joint_sets[0];
    EXPECT_EQ(set.dip_law, (DistributionDef{.kind = DistributionKind::von_mises, .mean = 20.0, .kappa = 50.0}));
    EXPECT_EQ(set.spacing, 1.5);
    EXPECT_EQ(set.spacing_law, (DistributionDef{.kind = DistributionKind::exponential, .mean = 1.5, .least = 0.3, .most = 4.0}))
        << "least is a fifth of the mean";
    EXPECT_EQ(set.trace->sd, 1.0);
    EXPECT_FALSE(set.trace->least) << "only a spacing has one that is not given";
    EXPECT_FALSE(set.gap->is_random());
    EXPECT_EQ(read("dip_deg = 0\nspacing = {distribution = \"uniform\", least = 1, most = 3}\n").joint_sets[0].spacing, 2.0);
    const CaseDef over = test::read(head + "dip_deg = 0\nspacing = {mean = 1.5, distribution = \"exponential\"}\n" + laws,
                                    {{"joint_set[0].spacing.mean", "2.5"}});
    EXPECT_EQ(over.joint_sets[0].spacing, 2.5);
}

TEST(DistributionKey, OrientationsBecomeDipAndSpacingInTheSection)
{
    const JointSetDef set = read("orientation = {dip = 60, dip_direction = 130, section = 90}\n"
                                 "spacing = {mean = 1.5, distribution = \"exponential\", least = 0.5}\n")
                                .joint_sets[0];
    EXPECT_NEAR(set.dip_deg, -52.9955, 5e-5);
    EXPECT_NEAR(set.spacing, 1.805633, 5e-7);
    EXPECT_NEAR(set.spacing_law.mean, 1.805633, 5e-7);
    EXPECT_NEAR(*set.spacing_law.least, 1.805633 / 3.0, 5e-7);
}

TEST(DistributionKey, SaysWhatIsWrongAndWhere)
{
    const std::pair<const char*, const char*> mistakes[] = {
        {"spacing = {mean = 1, distribution = \"exponental\"}\n",
         "9:37: joint set \"set1\": spacing.distribution = \"exponental\" (unknown "
         "choice; did you mean 'exponential'?). Choose from \"uniform\""},
        {"spacing = {mean = 1, distribution = 7}\n", "spacing.distribution = 7 m (expected text in quotes"},
        {"spacing = {mean = \"1\", distribution = \"exponential\"}\n", "spacing.mean = \"1\" (expected a number"},
        {"spacing = {distribution = \"uniform\", least = 1}\n", "(uniform: least and most are missing, and there is no mean"},
        {"spacing = {distribution = \"uniform\", mean = 1}\n", "(uniform: least and most are missing, and there is no sd"},
        {"spacing = {mean = inf, distribution = \"exponential\"}\n", "spacing.mean = inf m (must be > 0"},
        {"spacing = {mean = -1, distribution = \"exponential\"}\n", "spacing.mean = -1 m (must be > 0"},
        {"spacing = {mean = 1, distribution = \"normal\", sd = 0.2, kapa = 3}\n",
         "spacing.kapa = 3 m (unknown key; did you mean 'kappa'?)"},
        {"spacing = {mean = 1, distribution = \"exponential\", sd = 3}\n", "spacing.sd = 3 m (exponential has none)"},
        {"spacing = {mean = 1, distribution = \"lognormal\"}\n", "spacing = {...} (sd is missing"},
        {"spacing = {distribution = \"exponential\"}\n", "(mean is missing). Add mean"},
        {"spacing = {mean = 1, least = 0.2}\n", "(has no distribution). Add distribution, one of"},
        {"spacing = {mean = 1, distribution = \"exponential\", least = 3, most = 2}\n",
         "spacing.most = 2 m (must be greater than least, 3)"},
        {"spacing = {mean = 1, distribution = \"exponential\", least = 30}\n",
         "of the distribution, less than 1e-06). Give limits"},
        {"spacing = {mean = 1, distribution = \"von_mises\", kappa = 3}\n", "unknown choice"},
        {"spacing = \"1\"\n", "expected a number in m or a distribution, got text"},
        {"spacing = 0\n", "9:11: joint set \"set1\": spacing = 0 m (must be > 0"},
        {"", "7:1: joint set \"set1\": spacing (is missing). Add it: a number in m or a distribution"},
        {"spacing = 1\ntrace = 3\n", "gap (is missing: joints of finite length"},
        {"spacing = 1\ngap = 3\n", "gap (belongs to trace, which is not given)"},
        {"spacing = 1\np21 = 3\ntrace = 1\n", "p21 (contradicts spacing)"},
        {"spacing = 1\ntrace = 3\ngap = 1\npersistence = 0.5\n", "persistence (is for through-going joints). Give trace and gap"},
        {"spacing = 1\nstops_at = [\"g\"]\n", "stops_at = \"g\" (no fault has this name"},
        {"spacing = 1\norientation = {dip = 1, dip_direction = 2, section = 3}\n", "orientation (contradicts dip_deg)"},
    };
    for (const auto& [keys, says] : mistakes)
        EXPECT_THAT(problems_of(head + "dip_deg = 20\n" + keys + laws),
                    ElementsAre(AllOf(StartsWith("case.toml:"), HasSubstr(says))));
    const std::pair<const char*, const char*> dips[] = {
        {"dip_deg = {mean = 20, distribution = \"normal\", sd = 3}\ndeviation_deg = 2\n",
         "deviation_deg (contradicts the distribution of dip_deg)"},
        {"dip_deg = {mean = 200, distribution = \"normal\", sd = 3}\n", "dip_deg.mean = 200 deg (must be -180 to 180"},
        {"orientation = {dip = 100, dip_direction = 2, section = 3}\n", "orientation.dip = 100 deg (must be a number, 0 to 90"},
        {"orientation = {dip = 10, section = 3}\n", "orientation = {...} (dip_direction is missing"},
        {"orientation = {dip = 90, dip_direction = 0, section = 90}\n", "are parallel to the section"},
    };
    for (const auto& [keys, says] : dips)
        EXPECT_THAT(problems_of(head + keys + std::string("spacing = 1\n") + laws),
                    ElementsAre(AllOf(StartsWith("case.toml:"), HasSubstr(says))));
}

TEST(DistributionKey, TooManyTracesAreRefused)
{
    const CaseDef def = test::read(head + "dip_deg = 20\np21 = 1e6\ntrace = 1e-3\n" + laws);
    const std::vector<Problem> problems = find_rock_problems(def);
    ASSERT_EQ(problems.size(), 1u);
    EXPECT_EQ(problems[0].key, "joint_set[0].p21");
    EXPECT_THAT(problems[0].text, HasSubstr("p21 = 1e+06 m/m2 (makes 8.0018e+10 joints across the domain). Give a smaller p21"));
}
}  // namespace
}  // namespace hdem
