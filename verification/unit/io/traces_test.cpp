#include "core/geometry/polygon.h"
#include "core/geometry/unit_direction.h"
#include "io/load_case.h"
#include "io/traces.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>

#include <fstream>
#include <random>
#include <sstream>

namespace hdem
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const Polygon square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};

TraceFile read(const std::string& text, const std::string& name = "t.wkt")
{
    std::istringstream in(text);
    return read_traces(in, name);
}

double total_area(const std::vector<std::vector<Polygon>>& cells)
{
    double sum = 0.0;
    for (const std::vector<Polygon>& cell : cells)
        for (const Polygon& piece : cell)
            sum += signed_area(piece);
    return sum;
}

TEST(TraceFile, ReadsLinesOfWkt)
{
    const TraceFile file = read("# mapped\n\nLINESTRING(0 2, 8 5.5)\nlinestring ( 3 0 , 4 3 , 6 9 )\r\n");
    EXPECT_THAT(file.problems, IsEmpty());
    ASSERT_THAT(file.traces, SizeIs(2));
    EXPECT_THAT(file.traces[1], ElementsAre(Vec2(3, 0), Vec2(4, 3), Vec2(6, 9)));
}

TEST(TraceFile, ReadsRowsOfCsvWithAndWithoutHeading)
{
    const std::string rows = "a, 0, 2\na,8,5.5\nb,3,0\nb,4,3\nb,6,9\n";
    for (const std::string& text : {rows, "name,x,y\n" + rows})
    {
        const TraceFile file = read(text, "t.csv");
        EXPECT_THAT(file.problems, IsEmpty());
        ASSERT_THAT(file.traces, SizeIs(2));
        EXPECT_THAT(file.traces[0], ElementsAre(Vec2(0, 2), Vec2(8, 5.5)));
    }
}

TEST(TraceFile, SaysWhatIsWrongAndWhere)
{
    const auto problem = [](const std::string& text, const std::string& name = "t.wkt")
    {
        const TraceFile file = read(text, name);
        return file.problems.empty() ? "" : file.problems.front().text;
    };
    EXPECT_THAT(problem("LINESTRING(0 0, 1 1)\nPOINT(1 1)"),
                HasSubstr("t.wkt:2: trace: line (expected LINESTRING, got \"POINT(1 1)\")"));
    EXPECT_THAT(problem("MULTILINESTRING((0 0, 1 1))"), HasSubstr("on a line of its own"));
    EXPECT_THAT(problem("LINESTRING(0 0, 1 nan)"), HasSubstr("expected a finite number, got \"nan)\""));
    EXPECT_THAT(problem("LINESTRING(0 0 0, 1 1 1)"), HasSubstr("A point has two coordinates"));
    EXPECT_THAT(problem("LINESTRING Z (0 0 0, 1 1 1)"), HasSubstr("(expected ( after LINESTRING, got \"Z"));
    EXPECT_THAT(problem("LINESTRING EMPTY"), HasSubstr("(expected ( after LINESTRING"));
    EXPECT_THAT(problem("LINESTRING(0 0)"), HasSubstr("a trace has at least 2"));
    EXPECT_THAT(problem("LINESTRING(0 0, 1 1, 1 1)"), HasSubstr("points 2 and 3 are the same"));
    EXPECT_THAT(problem("LINESTRING(0 0, 1e9 1)"), HasSubstr("farther than"));
    EXPECT_THAT(problem("LINESTRING(0 0, 1 1) x"), HasSubstr("follows the line"));
    EXPECT_THAT(problem("# nothing\n"), HasSubstr("the file has no trace"));
    EXPECT_THAT(problem("a,1,2\na,3", "t.csv"), HasSubstr("t.csv:2: trace: line (the row has 2 columns). Write name,x,y."));
    const TraceFile of_gdal = read("WKT,set\n\"LINESTRING (0 3,5 4,11 5)\",a\n\"LINESTRING (4 -1,5 9)\",b\n", "t.csv");
    ASSERT_THAT(of_gdal.problems, SizeIs(1));
    EXPECT_THAT(of_gdal.problems[0].text,
                HasSubstr("t.csv:1: trace: line (is the heading of a table with shapes in WKT). Make GeoJSON"));
    EXPECT_THAT(problem("a,1,2\na,3,x", "t.csv"), HasSubstr("got \"x\""));
    EXPECT_THAT(problem("a,1,2\n,3,4", "t.csv"), HasSubstr("t.csv:2: trace: line (the row has no name). Write name,x,y."));
    EXPECT_THAT(problem("a,1,2\na,3,1e9", "t.csv"), HasSubstr("farther than"));
    EXPECT_THAT(problem(std::string(3'000'000, '0')), HasSubstr("line is longer"));
    std::string nonsense;
    for (int i = 0; i < 1000; ++i)
        nonsense += "nonsense\n";
    const TraceFile many = read(nonsense, "t.wkt");
    EXPECT_THAT(many.problems, SizeIs(51));
    EXPECT_THAT(many.problems.back().text, HasSubstr("too many problems, the rest was not read"));
    EXPECT_THAT(problem("a,1,2\nb,3,4\nb,5,6", "t.csv"), HasSubstr("t.csv:1: trace: line (has 1 point"));
}

TEST(TraceCells, CloseWhereTracesMeetAndDropDeadEnds)
{
    // A T of two traces makes three cells; beyond the T one end hangs free, and one trace lies alone.
    const TraceCells cut = cut_into_cells(square, {{{-1, 5}, {11, 5}}, {{4, 0}, {4, 6}}, {{7, 7}, {8, 8}}}, 0.0);
    EXPECT_THAT(cut.cells, SizeIs(3));
    EXPECT_EQ(cut.dead_ends, 2);
    EXPECT_EQ(cut.traces, 3);
    EXPECT_DOUBLE_EQ(total_area(cut.cells), 100.0);
}

TEST(TraceCells, LengtheningMakesMappedTracesMeet)
{
    const std::vector<Polygon> traces = {{{0.02, 5}, {9.98, 5}}, {{4, 0.02}, {4, 4.98}}};
    EXPECT_THAT(cut_into_cells(square, traces, 0.0).cells, SizeIs(1));
    const TraceCells cut = cut_into_cells(square, traces, 0.05);
    EXPECT_THAT(cut.cells, SizeIs(3));
    EXPECT_EQ(cut.dead_ends, 0) << "what lengthening left over is not the user's";
}

/// What crosses a slanted side meets it: cut off there first, it would end a rounding short of it.
TEST(TraceCells, CloseAtSlantedSides)
{
    for (int turn = 1; turn < 90; ++turn)
    {
        const Vec2 by = unit_direction(turn);
        const auto turned = [&](Polygon points)
        {
            for (Vec2& p : points)
                p = {by.x() * p.x() - by.y() * p.y(), by.y() * p.x() + by.x() * p.y()};
            return points;
        };
        const TraceCells cut = cut_into_cells(turned(square), {turned({{-1, 5}, {11, 6}}), turned({{3, -1}, {4, 11}})}, 0.0);
        EXPECT_THAT(cut.cells, SizeIs(4)) << turn;
        EXPECT_EQ(cut.dead_ends, 0) << turn;
        EXPECT_NEAR(total_area(cut.cells), 100.0, 1e-9);
    }
}

/// Ends that lie on a side or on another trace, as they are mapped: turned, they are a rounding short of it or beyond it.
TEST(TraceCells, CloseWhereTracesEndOnALine)
{
    for (const double away : {0.0, 1e4})
        for (int turn = 0; turn < 90; ++turn)
        {
            const Vec2 by = unit_direction(turn);
            const auto turned = [&](Polygon points)
            {
                for (Vec2& p : points)
                    p = {by.x() * p.x() - by.y() * p.y() + away, by.y() * p.x() + by.x() * p.y() - away};
                return points;
            };
            const std::vector<Polygon> traces = {turned({{0, 5}, {10, 6}}), turned({{3, 0}, {3, 5.3}}), turned({{7, 10}, {6, 5.6}}),
                                                 turned({{3, 5.3}, {2, 7}, {0, 8}}), turned({{9, 1}, {9, 3}})};
            const TraceCells cut = cut_into_cells(turned(square), traces, 0.0);
            EXPECT_THAT(cut.cells, SizeIs(5)) << turn;
            EXPECT_EQ(cut.dead_ends, 1) << turn;
            EXPECT_NEAR(cut.trace_dropped, 2.0, 1e-9) << turn;
            EXPECT_NEAR(total_area(cut.cells), 100.0, 1e-6);
        }
}

TEST(TraceCells, ABlockAroundALoneRingComesInTriangles)
{
    const Polygon ring = {{4, 4}, {6, 4}, {6, 6}, {4, 6}, {4, 4}};
    const TraceCells cut = cut_into_cells(square, {{{0, 2}, {10, 2}}, ring, {{4, 5}, {6, 5}}}, 0.0);
    ASSERT_THAT(cut.cells, SizeIs(4));
    EXPECT_EQ(cut.dead_ends, 0);
    EXPECT_DOUBLE_EQ(total_area(cut.cells), 100.0);
    EXPECT_EQ(std::ranges::count_if(cut.cells, [](const auto& cell) { return cell.size() > 1; }), 1);
}

/// Short traces that cross close hundreds of cells amid rock that hangs together. Islands touch each other and the sides in points.
TEST(TraceCells, OfManyIslandsLieBesideEachOther)
{
    constexpr double size = 30.0, half_length = 2.0;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> place(-half_length, size + half_length), direction(0.0, 180.0);
    for (int scene = 0; scene < 8; ++scene)
    {
        std::vector<Polygon> traces;
        for (int t = 0; t < 330; ++t)
        {
            const Vec2 middle(place(random), place(random)), way = half_length * unit_direction(direction(random));
            traces.push_back({middle - way, middle + way});
        }
        const TraceCells cut = cut_into_cells({{0, 0}, {size, 0}, {size, size}, {0, size}}, traces, 0.0);
        EXPECT_GT(cut.cells.size(), 100U);
        double sum = 0.0;
        for (const std::vector<Polygon>& cell : cut.cells)
            for (const Polygon& piece : cell)
            {
                EXPECT_GT(signed_area(piece), 0.0) << scene;
                sum += std::abs(signed_area(piece));
            }
        EXPECT_NEAR(sum, size * size, 1e-6) << scene;
    }
}

/// Random finite traces, joint sets and an excavation together: nothing is lost, and neighbours meet end to end.
TEST(TraceCells, FillTheDomainTogetherWithSetsAndExcavations)
{
    const test::ScratchFolder folder("trace_case");
    std::mt19937 random(3);
    std::uniform_real_distribution<double> place(0.0, 10.0);
    {
        std::ofstream traces(folder / "t.wkt");
        for (int i = 0; i < 40; ++i)
            traces << "LINESTRING(" << place(random) << ' ' << place(random) << ", " << place(random) << ' ' << place(random)
                   << ")\n";
    }
    std::ofstream(folder / "case.toml")
        << "[domain]\nwidth = 10.0\nheight = 10.0\nfixed = [\"bottom\"]\ntraces_file = \"t.wkt\"\n"
           "traces_joint = \"mapped\"\n[[joint_set]]\ndip_deg = 30.0\nspacing = 2.0\n"
           "[[excavation]]\nname = \"hole\"\nshape = \"circle\"\nposition = [5, 5]\ndiameter = 3.0\n"
           "[material.rock]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n"
           "friction_angle_deg = 30.0\n[joint.mapped]\nnormal_stiffness = 2e9\nshear_stiffness = 1e9\n"
           "friction_angle_deg = 10.0\n[[stage]]\ncycles = 1\n";
    const LoadedCase loaded = load_case(folder / "case.toml");
    const Model& model = loaded.setup.model;
    double sum = 0.0;
    for (const double a : model.area)
        sum += a;
    EXPECT_NEAR(sum, 100.0, 1e-9);
    EXPECT_GT(loaded.setup.rock.dead_ends, 0);
    EXPECT_GT(model.blocks(), 100);
    EXPECT_EQ(model.joints.names[model.joints.of_joint_set.back()], "mapped");
    EXPECT_THAT(model.shapes.edge_source, testing::Contains(1)) << "traces come after the one joint set";
}

TEST(TraceCells, ProblemsOfKeysAreLocated)
{
    const test::ScratchFolder folder("trace_keys");
    const std::string rest = "[material.rock]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n"
                             "friction_angle_deg = 30.0\n[[stage]]\ncycles = 1\n";
    const auto problem = [&](const std::string& keys)
    {
        try
        {
            (void)read_case_text("[domain]\nwidth = 10.0\nheight = 10.0\n" + keys + rest, folder / "case.toml");
        }
        catch (const InputError& error)
        {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(problem("traces_file = \"none.wkt\"\n"), HasSubstr("case.toml:4:"));
    EXPECT_THAT(problem("traces_file = \"none.wkt\"\n"), HasSubstr("none.wkt does not exist"));
    EXPECT_THAT(problem("traces_snap = 0.1\n"), HasSubstr("belongs to traces_file"));
    std::ofstream(folder / "t.wkt") << "LINESTRING(0 5, 10 5)\n";
    EXPECT_EQ(problem("traces_file = \"t.wkt\"\n"), "");
    EXPECT_THAT(problem("traces_file = \"t.wkt\"\ntraces_joint = \"defaut\"\n"), HasSubstr("did you mean 'default'"));
}
}  // namespace
}  // namespace hdem
