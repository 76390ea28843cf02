#include "io/factor_table.h"
#include "verification/unit/io/case_text.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>

#include <sstream>

namespace hdem
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

FactorFile read(const std::string& text)
{
    std::istringstream in(text);
    return read_factors(in, "push.csv");
}

std::string problem_of(const std::string& text)
{
    const std::vector<Problem> found = read(text).problems;
    return found.empty() ? "none" : found.front().text;
}

TEST(FactorTable, HasAHeadingAndRows)
{
    const FactorFile file = read("# a record\ncycle,factor\n0,0\n\n 10 , 1.5 \n20,-3e-1\n");
    EXPECT_TRUE(file.problems.empty());
    EXPECT_EQ(file.by, TableColumn::cycle);
    EXPECT_EQ(file.rows, (FactorTable{{0.0, 0.0}, {10.0, 1.5}, {20.0, -0.3}}));
    EXPECT_EQ(read("time,factor\n0,0\n1,1\n").by, TableColumn::time);
}

TEST(FactorTable, SaysWhereItIsWrong)
{
    EXPECT_THAT(problem_of("0,0\n1,1\n"), StartsWith("push.csv:1: factors: line (the heading is \"0,0\"). Write cycle,factor"));
    EXPECT_THAT(problem_of("cycle,factor\n0,0\n0,1\n"), StartsWith("push.csv:3: factors: line (0 comes after 0). Sort the rows"));
    EXPECT_THAT(problem_of("cycle,factor\n0,0\n5\n"), HasSubstr("expected two numbers, got \"5\""));
    EXPECT_THAT(problem_of("cycle,factor\n0,0\n5,1,2\n"), HasSubstr("expected two numbers"));
    EXPECT_THAT(problem_of("cycle,factor\n0,0\n5,nan\n"), HasSubstr("expected two numbers"));
    EXPECT_THAT(problem_of("cycle,factor\n0,0\n5,1e300\n"), HasSubstr("too great"));
    EXPECT_THAT(problem_of("cycle,factor\n0,0\n"), HasSubstr("has 1 rows). Give two at least"));
    EXPECT_THAT(problem_of(""), HasSubstr("has 0 rows"));
    EXPECT_THAT(problem_of("cycle,factor\n0,0\n" + std::string(3'000'000, '0')), HasSubstr("line is longer"));
    std::string rows = "cycle,factor\n";
    for (int i = 0; i < 1'000'000; ++i)
        rows += std::to_string(i) + ",1\n";
    EXPECT_EQ(problem_of(rows), "none");
    EXPECT_THAT(problem_of(rows + "1000000,1\n"), StartsWith("push.csv:1000002: factors: line (more than 1000000 rows)"));
}

TEST(FactorTable, OfWhatAStageSetsIsReadBesideTheCase)
{
    const test::ScratchFolder folder("shares");
    std::ofstream(folder / "weaker.csv") << "time,factor\n0,0\n0.5,0.3\n2,1\n";
    std::ofstream(folder / "case.toml")
        << test::two_blocks
        << "[[stage]]\nduration = 3\nset = [\"joint.default.friction_angle_deg = 5\"]\nset_table_file = "
           "\"weaker.csv\"\n";
    const CaseFile file = read_case_file(folder / "case.toml");
    EXPECT_EQ(file.def.stages.back().set_table, (FactorTable{{0.0, 0.0}, {0.5, 0.3}, {2.0, 1.0}}));
    EXPECT_EQ(file.def.stages.back().set_table_by, TableColumn::time);
    EXPECT_EQ(file.files.count("weaker.csv"), 1U) << "a checkpoint takes it along";
    std::ofstream(folder / "weaker.csv") << "time,factor\n0,0\n0.5,0.3\n";
    EXPECT_THROW(read_case_file(folder / "case.toml"), InputError) << "not whole at the end";
}

TEST(FactorTable, IsReadBesideTheCase)
{
    const test::ScratchFolder folder("factors");
    std::ofstream(folder / "push.csv") << "time,factor\n0,0\n0.5,1\n";
    std::ofstream(folder / "case.toml") << test::two_blocks
                                        << "[[load]]\nblocks = [\"top\"]\nforce = [1, 0]\ntable_file = \"push.csv\"\n";
    const CaseFile file = read_case_file(folder / "case.toml");
    EXPECT_EQ(file.def.loads[0].factor.table, (FactorTable{{0.0, 0.0}, {0.5, 1.0}}));
    EXPECT_EQ(file.def.loads[0].factor.table_by, TableColumn::time);
    EXPECT_EQ(file.files.count("push.csv"), 1U) << "a checkpoint takes it along";
    std::ofstream(folder / "push.csv") << "time,factor\n0.5,0\n0,1\n";
    try
    {
        read_case_file(folder / "case.toml");
        FAIL();
    }
    catch (const InputError& error)
    {
        EXPECT_THAT(std::string(error.what()), HasSubstr("push.csv:3: factors: line (0 comes after 0.5)"));
    }
}
}  // namespace
}  // namespace hdem
