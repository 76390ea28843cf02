#include "verification/unit/io/case_text.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using test::problems_of;
using test::two_blocks;
using testing::Contains;
using testing::HasSubstr;

/// Keys of a joint behind its materials, the key that does not fit, and what is said of it.
struct Mistake
{
    const char* keys;
    const char* key;
    const char* says;
};

void expect_said(const Mistake& mistake, const std::string& besides = "")
{
    const std::string joint = std::string("[joint.j]\nmaterials = [\"rock\", \"rock\"]\nshear_stiffness = 5e8\n") + mistake.keys;
    EXPECT_THAT(problems_of(two_blocks + joint + "\n" + besides),
                Contains(testing::AllOf(HasSubstr(std::string("joint \"j\": ") + mistake.key), HasSubstr(mistake.says))))
        << mistake.keys;
}

const std::string bandis = "law = \"barton_bandis\"\nresidual_friction_angle_deg = 25\njrc = 8\njcs = 50e6\n";

TEST(JointErrors, TellOfNormalSpringsThatDoNotFit)
{
    const std::string with_strength = bandis + "rock_strength = 100e6\n";
    const Mistake mistakes[] = {
        {"normal_stiffness = 7e9\nfriction_angle_deg = 30\ngreatest_closure = 1e-4\nnormal_exponent = 0.5", "normal_exponent",
         "greatest_closure"},
        {"law = \"saeb_amadei\"\nnormal_stiffness = 7e9\nfriction_angle_deg = 30\nnormal_exponent = 0.5", "normal_exponent",
         "is not possible with saeb_amadei). Give greatest_closure, or a linear spring."},
        {"normal_stiffness = 7e9\nfriction_angle_deg = 30\nclosure_cycle = 2", "closure_cycle",
         "does not belong to law \"coulomb\""},
    };
    for (const Mistake& mistake : mistakes)
        expect_said(mistake);
    expect_said({(with_strength + "normal_stiffness = 7e9").c_str(), "normal_stiffness",
                 "contradicts rock_strength, which gives the closure by Bandis). Remove one of the two."});
    expect_said({(bandis + "rock_strength = 10e6").c_str(), "rock_strength", "is less than jcs"});
    expect_said({(bandis + "normal_stiffness = 7e9\nclosure_cycle = 2").c_str(), "closure_cycle",
                 "belongs to rock_strength, which is not given). Remove it."});
    expect_said({bandis.c_str(), "normal_stiffness", "is missing, and so is rock_strength). Add one of the two."});
    // Walls so weak and smooth that the formula of the initial stiffness ends below 0.
    expect_said({"law = \"barton_bandis\"\nresidual_friction_angle_deg = 25\njrc = 1\njcs = 1e6\nrock_strength = 1e6",
                 "rock_strength", "gives an initial stiffness of -4.4e+09 Pa/m"});
}

TEST(JointErrors, TellOfStrengthsThatDoNotFit)
{
    const Mistake mistakes[] = {
        {"normal_stiffness = 7e9\nfriction_angle_deg = 30\ncohesion = 1e6\ntension = 1e5\nresidual_tension = 2e5",
         "residual_tension", "is greater than tension). Give no more than that."},
        {"normal_stiffness = 7e9\nfriction_angle_deg = 30\ncohesion = 1e6\nresidual_cohesion = 2e6", "residual_cohesion",
         "is greater than cohesion). Give no more than that."},
        {"normal_stiffness = 7e9\nfriction_angle_deg = 30\nresidual_friction_angle_deg = 35", "residual_friction_angle_deg",
         "is greater than friction_angle_deg"},
        {"normal_stiffness = 7e9\nfriction_angle_deg = 30\ncohesion = 1e6\ntension = 1e5\nnormal_exponent = 0.5", "tension",
         "is not possible with normal_exponent: K_N is 0 at no stress). Remove one of the two."},
        {"normal_stiffness = 7e9\nfriction_angle_deg = 45\ncohesion = 1e5\ntension = 2e5", "tension",
         "is greater than cohesion / tan(friction) = 100000 Pa"},
        {"normal_stiffness = 7e9\nfriction_angle_deg = 30\ndilation_limit = 1e-3", "dilation_limit",
         "belongs to dilation_angle_deg, which is not given"},
        {"law = \"patton\"\nnormal_stiffness = 7e9\nfriction_angle_deg = 60\nasperity_angle_deg = 40\ncohesion = "
         "1e5\nresidual_friction_angle_deg = 30",
         "asperity_angle_deg", "and friction_angle_deg are 90 degrees or more together). Give less."},
        {"law = \"plesha\"\nnormal_stiffness = 7e9\nfriction_angle_deg = 60\nasperity_angle_deg = 40", "asperity_angle_deg",
         "and friction_angle_deg are 90 degrees or more together). Give less."},
        {"law = \"continuously_yielding\"\nnormal_stiffness = 7e9\nfriction_angle_deg = 30\nmobilised_angle_deg = "
         "20\nwear_length = 1e-3",
         "mobilised_angle_deg", "is less than friction_angle_deg). Give no less than that."},
        {"law = \"barton_bandis\"\nresidual_friction_angle_deg = 75\njrc = 8\njcs = 50e6\nrock_strength = 100e6",
         "residual_friction_angle_deg", "is 70 degrees or more: the law ends there). Give less."},
    };
    for (const Mistake& mistake : mistakes)
        expect_said(mistake);
}

TEST(JointErrors, TellOfSpringsThatALawOfASharedLibraryHasItself)
{
    const std::string library = "law = \"law.so\"\nnormal_stiffness = 7e9\nfriction_angle_deg = 30\n";
    for (const char* spring : {"greatest_closure = 1e-4", "normal_exponent = 0.5"})
        expect_said({(library + spring).c_str(), std::string(spring).substr(0, std::string(spring).find(' ')).c_str(),
                     "does not belong to a law of a shared library, which has its own normal spring). Remove it."});
}

TEST(JointErrors, TellOfWhatImpulsesCannotCompute)
{
    const std::string impulses = "[contact]\nmethod = \"impulse\"\n";
    expect_said({"normal_stiffness = 7e9\nfriction_angle_deg = 30\ngreatest_closure = 1e-4", "greatest_closure",
                 "cannot be computed by impulses, which know no stiffness). Use method \"force\" or \"hybrid\" in all stages."},
                impulses);
}

TEST(JointErrors, TellOfTwoJointsOfTheSameMaterials)
{
    const std::string joint = "materials = [\"rock\", \"rock\"]\nnormal_stiffness = 7e9\nshear_stiffness = "
                              "5e8\nfriction_angle_deg = 30\n";
    EXPECT_THAT(problems_of(two_blocks + "[joint.a]\n" + joint + "[joint.b]\n" + joint),
                testing::ElementsAre(HasSubstr("joint \"a\" has the same two")));
}
}  // namespace
}  // namespace hdem
