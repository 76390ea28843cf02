/// One mistake is told once: not what the reader would say of other keys because of it.

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

std::string rock_with_joint(const std::string& joint)
{
    return "[domain]\nwidth = 4.0\nheight = 4.0\nfixed = [\"bottom\"]\n[material.rock]\ndensity = 2700.0\n"
           "[joint.default]\nnormal_stiffness = 7e9\nshear_stiffness = 5e8\n" +
           joint;
}
const std::string stage = "[[stage]]\nname = \"stand\"\ncycles = 10\n";
const std::string plain = rock_with_joint("friction_angle_deg = 30.0\n");

TEST(ErrorsThatFollow, FromAWrongValueAreLeftOut)
{
    struct Mistake
    {
        std::string text;
        const char *object, *says;
    };
    const Mistake mistakes[] = {
        {rock_with_joint("law = \"paton\"\nfriction_angle_deg = 30.0\nasperity_angle_deg = 10.0\n") + stage, "law = \"paton\"",
         "did you mean 'patton'?"},
        {rock_with_joint("friction_angle_deg = 30.0\ncohesion = \"1\"\ntension = 10.0\nresidual_cohesion = 5.0\n") + stage,
         "cohesion = \"1\"", "expected a number"},
        {rock_with_joint("friction_angle_deg = \"30\"\nresidual_friction_angle_deg = 25.0\ndilation_angle_deg = 5.0\n") + stage,
         "friction_angle_deg = \"30\"", "expected a number"},
        {plain + stage +
             "[[bolt]]\nkind = \"grout\"\nfrom = [1, 1]\nto = [3, 3]\narea = 4e-4\nbond_stiffness = 1e9\nbond_strength = 2e5\n",
         "kind = \"grout\"", "unknown choice"},
        {plain + stage +
             "[[excavation]]\nnam = \"e\"\nshape = \"circle\"\nposition = [2, 2]\ndiameter = 1\n"
             "[[bolt]]\naround = \"e\"\nlength = 1\nalong = 1\narea = 4e-4\n",
         "nam = \"e\"", "did you mean 'name'?"},
        {plain + "[[stage]]\nname = 3\ncycles = 10\n[[load]]\nblocks = [\"b1\"]\nforce = [1, 0]\nsince = \"dig\"\n", "name = 3",
         "expected text"},
        {plain + "[[stage]]\ncycles = 10\nset = ['joint.default.law = \"patton\"']\n", "joint.default.law = ...",
         "contacts bear by it already"}};
    for (const Mistake& mistake : mistakes)
        EXPECT_THAT(problems_of(mistake.text), ElementsAre(AllOf(HasSubstr(mistake.object), HasSubstr(mistake.says))))
            << mistake.text;
}

TEST(ErrorsThatFollow, AreToldOfNamesWhereAllAreWhole)
{
    EXPECT_THAT(problems_of(plain + stage + "[[load]]\nblocks = [\"b1\"]\nforce = [1, 0]\nsince = \"dig\"\n"),
                ElementsAre(HasSubstr("no stage has this name")));
}
}  // namespace
}  // namespace hdem
