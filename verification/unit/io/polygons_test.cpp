#include "io/polygons.h"

#include <gmock/gmock.h>

#include <random>
#include <sstream>

namespace hdem
{
namespace
{
PolygonFile read(const std::string& text)
{
    std::istringstream in(text);
    return read_polygons(in, "blocks.wkt");
}

TEST(Wkt, ReadsPolygonWithoutItsClosingVertex)
{
    const auto parsed = parse_wkt("  polygon ( ( 0 0 , 1e0 -0.5, +1 1, 0 0 ) ) ");
    ASSERT_TRUE(std::holds_alternative<Polygon>(parsed)) << std::get<std::string>(parsed);
    EXPECT_THAT(std::get<Polygon>(parsed), testing::ElementsAre(Vec2(0, 0), Vec2(1, -0.5), Vec2(1, 1)));
}

TEST(Wkt, RoundTripsDoublesExactly)
{
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> coordinate(-1e6, 1e6);
    for (int i = 0; i < 200; ++i)
    {
        Polygon polygon;
        for (int k = 0; k < 3 + i % 5; ++k)
            polygon.emplace_back(coordinate(random), coordinate(random) * 1e-9);
        const auto parsed = parse_wkt(to_wkt(polygon));
        ASSERT_TRUE(std::holds_alternative<Polygon>(parsed)) << std::get<std::string>(parsed);
        ASSERT_EQ(std::get<Polygon>(parsed), polygon);
    }
}

struct BadLine
{
    const char* text;
    const char* message;
};

TEST(Wkt, RefusesEverythingElseWithAReason)
{
    const BadLine lines[] = {
        {"POLYGON((0 0, 1 0, 1 1, 0 1))", "the ring is not closed"},
        {"POLYGON((0 0, 1 0, 0 0))", "has 3 points"},
        {"POLYGON((0 0, 1 0, 1 1, 0 0), (0.1 0.1, 0.2 0.1, 0.2 0.2, 0.1 0.1))", "has a hole"},
        {"MULTIPOLYGON(((0 0, 1 0, 1 1, 0 0)))", "MULTIPOLYGON"},
        {"POLYGON Z((0 0 0, 1 0 0, 1 1 0, 0 0 0))", "no Z"},
        {"POLYGON((0 0 0, 1 0 0, 1 1 0, 0 0 0))", "two coordinates"},
        {"POLYGON EMPTY", "not EMPTY"},
        {"POLYGON()", "expected (( after POLYGON"},
        {"POLYGON(())", "expected a finite number"},
        {"POLYGON((0 0, 1 0, 1 1, 0 0)) tail", "\"tail\" follows the polygon"},
        {"POLYGON((0 0, 1 0, 1 1, 0 0)", "expected )) at the end"},
        {"POLYGON((0 0, 1 0, 1 nan, 0 0))", "expected a finite number"},
        {"POLYGON((0 0, 1 0, 1 inf, 0 0))", "expected a finite number"},
        {"POLYGON((0 0, 1 0, 1 1e999, 0 0))", "expected a finite number"},
        {"POLYGON((0 0, 1-2, 1 1, 0 0))", "expected a finite number"},
        {"POLYGON((0 0, 1 0, 1 0x10, 0 0))", "expected a finite number"},
        {"POLYGON((0 0, 1 0, 1 1e12, 0 0))", "farther than"},
        {"LINESTRING(0 0, 1 1)", "expected POLYGON"},
        {"POLY", "expected POLYGON"},
        {"\x01\x02\x7f", "expected POLYGON"},
        {"POLYGON((0 0, 1 0, 1 1, 0 0)); a; b; slippery", "does not say what is fixed"},
        {"POLYGON((0 0, 1 0, 1 1, 0 0)); a; b; x; y", "fields behind the polygon"},
    };
    for (const auto& [text, message] : lines)
    {
        const PolygonFile file = read(std::string("\n# comment\n") + text + "\n");
        ASSERT_EQ(file.problems.size(), 1U) << text;
        EXPECT_THAT(file.problems[0].text, testing::StartsWith("blocks.wkt:3: block: polygon (")) << text;
        EXPECT_THAT(file.problems[0].text, testing::HasSubstr(message)) << text;
    }
}

TEST(PolygonFile, ReadsNameMaterialAndWhatIsFixed)
{
    const PolygonFile file = read("POLYGON((0 0, 1 0, 1 1, 0 0)); ground ; granite; fixed\r\nPOLYGON((0 0, 1 0, 1 1, 0 0))\n"
                                  "POLYGON((0 0, 1 0, 1 1, 0 0));;; x, rotation");
    ASSERT_TRUE(file.problems.empty()) << file.problems[0].text;
    ASSERT_EQ(file.blocks.size(), 3U);
    EXPECT_EQ(file.blocks[0].block.name, "ground");
    EXPECT_EQ(file.blocks[0].block.material, "granite");
    EXPECT_TRUE(file.blocks[0].block.fix_y);
    EXPECT_EQ(file.blocks[1].block.name, "block2");
    EXPECT_EQ(file.blocks[1].block.material, "rock");
    EXPECT_EQ(file.blocks[2].line, 3);
    EXPECT_TRUE(file.blocks[2].block.fix_x && !file.blocks[2].block.fix_y && file.blocks[2].block.fix_rotation);
}

TEST(PolygonFile, WritesWhatItReads)
{
    const std::vector<BlockDef> blocks = {
        {.name = "a",
         .polygon = {{0.1, 0.2}, {1.0 / 3.0, 0}, {1, 1}},
         .material = "rock",
         .fix_x = true,
         .fix_y = true,
         .fix_rotation = true},
        {.name = "b", .polygon = {{0, 0}, {1, 0}, {1, 1}}, .material = "clay", .fix_rotation = true},
        {.name = "c", .polygon = {{0, 0}, {1, 0}, {1, 1}}, .material = "clay", .fix_x = true},
        {.name = "d", .polygon = {{0, 0}, {1, 0}, {1, 1}}, .material = "clay", .fix_y = true, .fix_rotation = true},
        {.name = "e", .polygon = {{0, 0}, {1, 0}, {1, 1}}, .material = "clay"}};
    std::ostringstream out;
    write_polygons(out, blocks);
    const PolygonFile file = read(out.str());
    ASSERT_EQ(file.blocks.size(), blocks.size()) << out.str();
    for (std::size_t i = 0; i < blocks.size(); ++i)
    {
        EXPECT_EQ(file.blocks[i].block.name, blocks[i].name);
        EXPECT_EQ(file.blocks[i].block.material, blocks[i].material);
        EXPECT_EQ(file.blocks[i].block.polygon, blocks[i].polygon);
        EXPECT_EQ(file.blocks[i].block.fix_x, blocks[i].fix_x);
        EXPECT_EQ(file.blocks[i].block.fix_y, blocks[i].fix_y);
        EXPECT_EQ(file.blocks[i].block.fix_rotation, blocks[i].fix_rotation);
    }
}

TEST(PolygonFile, ReportsManyProblemsAndThenStops)
{
    std::string text;
    for (int i = 0; i < 1000; ++i)
        text += "nonsense\n";
    const PolygonFile file = read(text);
    EXPECT_EQ(file.problems.size(), 51U);
    EXPECT_THAT(file.problems.back().text, testing::HasSubstr("too many problems"));
}

TEST(PolygonFile, RefusesAnEndlessLineBeforeItFillsTheMemory)
{
    const PolygonFile file = read(std::string(3'000'000, '0'));
    ASSERT_EQ(file.problems.size(), 1U);
    EXPECT_THAT(file.problems[0].text, testing::HasSubstr("line is longer"));
}

TEST(PolygonFile, ReadsRowsOfATable)
{
    std::istringstream in(
        "name,x,y,material,fixed\nbench,0,0,chalk,fixed\nbench,1,0\nbench,1,1\nlid, 0,1\nlid,1,1\nlid,0,2\nlid,0,1\n");
    const PolygonFile file = read_polygons(in, "blocks.csv");
    EXPECT_THAT(file.problems, testing::IsEmpty());
    ASSERT_EQ(file.blocks.size(), 2U);
    EXPECT_EQ(file.blocks[0].block.name, "bench");
    EXPECT_EQ(file.blocks[0].block.material, "chalk");
    EXPECT_TRUE(file.blocks[0].block.fix_rotation);
    EXPECT_EQ(file.blocks[0].line, 2);
    EXPECT_THAT(file.blocks[1].block.polygon, testing::ElementsAre(Vec2(0, 1), Vec2(1, 1), Vec2(0, 2)))
        << "a repeated first vertex is dropped";
}

TEST(PolygonFile, SaysWhichRowOfATableIsWrong)
{
    std::istringstream in("a,0,0\na,1,0\na,1,zero\nb,0,0,rock,all\nb,1,0\nb,1,1\n");
    const PolygonFile file = read_polygons(in, "blocks.csv");
    ASSERT_EQ(file.problems.size(), 3U);
    EXPECT_THAT(file.problems[0].text, testing::HasSubstr("blocks.csv:3: block: polygon (expected a finite number, got \"zero\")"));
    EXPECT_THAT(file.problems[1].text, testing::HasSubstr("blocks.csv:1: block: polygon (\"a\" has 2 rows"));
    EXPECT_THAT(file.problems[2].text, testing::HasSubstr("\"all\" does not say what is fixed"));
}

/// Columns are read by their place. A table that names others, or says what is fixed where it is not looked for, is refused.
TEST(PolygonFile, LooksAtTheHeadingAndAtLaterRowsOfATable)
{
    const std::string rows = "a,0,0\na,4,0\na,4,1\n";
    const auto problem = [](const std::string& text)
    {
        std::istringstream in(text);
        const PolygonFile file = read_polygons(in, "blocks.CSV");
        return file.problems.empty() ? "" : file.problems[0].text;
    };
    for (const char* heading : {"", "name,x,y\n", "block, X [m], Y [m]\n", "\xef\xbb\xbfname,x,y,material,fixed\r\n"})
        EXPECT_EQ(problem(heading + rows), "");
    for (const char* heading : {"name,y,x\n", "x,y,name\n", "name,x,y,fixed,material\n", "name,x\n"})
        EXPECT_THAT(problem(heading + rows), testing::StartsWith("blocks.CSV:1: block: polygon (")) << heading;
    EXPECT_THAT(
        problem("a,0,0\na,4,0,rock,fixed\na,4,1\n"),
        testing::HasSubstr("blocks.CSV:2: block: polygon (\"rock\" stands in a later row of \"a\"). Write material and fixed in"));
    EXPECT_EQ(problem("a,0,0,rock,fixed\na,4,0,rock,fixed\na,4,1,,\n"), "");
    EXPECT_THAT(problem("a,0,0,rock,x,7\n" + rows), testing::HasSubstr("has 6 columns). Write at most name,x,y,material,fixed."));
}

TEST(PolygonFile, TakesTextBetweenQuotesAndAMarkOfUtf8)
{
    std::istringstream in("\xef\xbb\xbf\"name\",\"x\",\"y\"\n\"a\",0,0\n\"a\",4,0\n\"a\",4,1\n");
    const PolygonFile file = read_polygons(in, "blocks.csv");
    EXPECT_THAT(file.problems, testing::IsEmpty());
    EXPECT_EQ(file.blocks.at(0).block.name, "a");
    EXPECT_THAT(read("\xef\xbb\xbfPOLYGON((0 0, 1 0, 1 1, 0 0))\n").problems, testing::IsEmpty());
}

/// Names go into files that say they are UTF-8.
TEST(PolygonFile, RefusesTextInAnotherEncoding)
{
    const std::string square = "POLYGON((0 0, 1 0, 1 1, 0 0)); ";
    EXPECT_EQ(read(square + "B\xc3\xb6schung").blocks.at(0).block.name, "B\xc3\xb6schung");
    for (const std::string name : {"B\xf6schung", "Bl\xc3", "\xb6", "\xff\xfe"})
        EXPECT_THAT(read(square + "a\n" + square + name).problems.at(0).text,
                    testing::HasSubstr("2: block: polygon (the line is not UTF-8 text). Save the file as UTF-8."));
}

TEST(PolygonFile, RefusesAnEmptyFile)
{
    EXPECT_THAT(read("").problems.at(0).text, testing::HasSubstr("no polygon"));
}
}  // namespace
}  // namespace hdem
