#include "io/block_shapes.h"
#include "io/geojson.h"
#include "io/load_case.h"
#include "verification/unit/core/rock/region_cases.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

namespace hdem
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST(GeoJson, LinesAreTraces)
{
    const TraceFile file = read_geojson_traces(R"({"type": "FeatureCollection", "name": "mapped", "features": [
        {"type": "Feature", "properties": {"set": 1}, "geometry": {"type": "LineString", "coordinates": [[0, 2], [8, 5.5]]}},
        {"type": "Feature", "properties": null,
         "geometry": {"type": "MultiLineString", "coordinates": [[[3, 0, 7], [4, 3, 7]], [[6, 9], [7, 9], [8, 8]]]}}]})",
                                               "t.geojson");
    EXPECT_THAT(file.problems, IsEmpty());
    ASSERT_THAT(file.traces, SizeIs(3));
    EXPECT_THAT(file.traces[0], ElementsAre(Vec2(0, 2), Vec2(8, 5.5)));
    EXPECT_THAT(file.traces[1], ElementsAre(Vec2(3, 0), Vec2(4, 3)));
}

TEST(GeoJson, NamesMayBeCodesAndKeysInCapitals)
{
    const PolygonFile file = read_geojson_blocks(R"({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"NAME": 12, "MATERIAL": 2.0, "FIXED": 1},
         "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]}},
        {"type": "Feature", "properties": {"name": null, "Material": "soft", "fixed": null},
         "geometry": {"type": "Polygon", "coordinates": [[[2, 0], [3, 0], [3, 1], [2, 0]]]}}]})",
                                                 "b.geojson", 0);
    EXPECT_THAT(file.problems, IsEmpty());
    ASSERT_THAT(file.blocks, SizeIs(2));
    EXPECT_EQ(file.blocks[0].block.name, "12");
    EXPECT_EQ(file.blocks[0].block.material, "2");
    EXPECT_TRUE(file.blocks[0].block.fix_rotation);
    EXPECT_EQ(file.blocks[1].block.name, "block2");
    EXPECT_EQ(file.blocks[1].block.material, "soft");
}

TEST(GeoJson, MaterialThatIsNoNameIsAnError)
{
    const PolygonFile file = read_geojson_blocks(R"({"type": "Feature", "properties": {"material": 2.5},
         "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]}})",
                                                 "b.geojson", 0);
    ASSERT_THAT(file.problems, SizeIs(1));
    EXPECT_THAT(file.problems[0].text, HasSubstr("b.geojson: blocks: feature 1 (material is neither a text nor a whole number)"));
}

TEST(GeoJson, NumberThatIsTooLargeIsAnErrorOfTheFile)
{
    const PolygonFile file = read_geojson_blocks("[1e400]", "b.geojson", 0);
    ASSERT_THAT(file.problems, SizeIs(1));
    EXPECT_EQ(file.problems[0].text, "b.geojson: blocks: (has a number that is too large). Export it once more.");
}

TEST(GeoJson, PolygonsAreBlocks)
{
    const PolygonFile file = read_geojson_blocks(R"({"type": "FeatureCollection", "features": [
        {"type": "Feature", "properties": {"name": "ground", "material": "shale", "fixed": true},
         "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [1, 0], [1, 1], [0, 0]]]}},
        {"type": "Feature", "properties": {"fixed": "x rotation"},
         "geometry": {"type": "MultiPolygon", "coordinates": [[[[2, 0], [3, 0], [3, 1], [2, 0]]]]}}]})",
                                                 "b.geojson", 4);
    EXPECT_THAT(file.problems, IsEmpty());
    ASSERT_THAT(file.blocks, SizeIs(2));
    EXPECT_EQ(file.blocks[0].block.name, "ground");
    EXPECT_EQ(file.blocks[0].block.material, "shale");
    EXPECT_TRUE(file.blocks[0].block.fix_y);
    EXPECT_EQ(file.blocks[1].block.name, "block6");
    EXPECT_TRUE(file.blocks[1].block.fix_x && !file.blocks[1].block.fix_y && file.blocks[1].block.fix_rotation);
}

TEST(GeoJson, PartsOfAPolygonAreBlocksOfTheirOwn)
{
    const PolygonFile file = read_geojson_blocks(R"({"type": "Feature", "properties": {"name": "pair", "fixed": "y, rotation"},
         "geometry": {"type": "MultiPolygon", "coordinates": [[[[0, 0], [1, 0], [1, 1], [0, 0]]], [[[2, 0], [3, 0], [3, 1], [2, 0]]]]}})",
                                                 "b.geojson", 0);
    EXPECT_THAT(file.problems, IsEmpty());
    ASSERT_THAT(file.blocks, SizeIs(2));
    EXPECT_EQ(file.blocks[0].block.name, "pair");
    EXPECT_EQ(file.blocks[1].block.name, "pair.2");
    for (const PolygonFile::Line& line : file.blocks)
        EXPECT_TRUE(!line.block.fix_x && line.block.fix_y && line.block.fix_rotation);
}

TEST(GeoJson, SaysWhatIsWrongAndWhere)
{
    const auto trace = [](const std::string& text)
    {
        const TraceFile file = read_geojson_traces(text, "t.geojson");
        return file.problems.empty() ? "" : file.problems.front().text;
    };
    const auto line = [&](const std::string& points) { return trace(R"({"type": "LineString", "coordinates": )" + points + "}"); };
    EXPECT_EQ(line("[[0, 0], [1, 1]]"), "") << "a bare geometry will do";
    EXPECT_THAT(trace("{\n\"type\": \n"), HasSubstr("t.geojson:3: traces: (not valid JSON)"));
    EXPECT_THAT(line("[[0, 0]]"), HasSubstr("t.geojson: traces: feature 1 (has 1 point, a trace has at least 2)"));
    EXPECT_THAT(line("[[0, 0], [\"1\", 1]]"), HasSubstr("point 2 is not [x, y]"));
    EXPECT_THAT(line("[[0, 0], [1e9, 1]]"), HasSubstr("point 2 is farther than"));
    EXPECT_THAT(line("[[0, 0], [1, 1], [1, 1]]"), HasSubstr("points 2 and 3 are the same"));
    EXPECT_THAT(trace(R"({"type": "Point", "coordinates": [1, 2]})"), HasSubstr("is a Point, not a LineString"));
    EXPECT_THAT(trace(R"({"type": "FeatureCollection", "features": []})"), HasSubstr("t.geojson: traces: (has no feature)"));
    EXPECT_THAT(trace(R"({"type": "GeometryCollection", "geometries": [{"type": "LineString", "coordinates": [[0, 0], [1, 1]]}]})"),
                HasSubstr("ogr2ogr -explodecollections"));
    EXPECT_THAT(trace("[1, 2]"), HasSubstr("has no coordinates"));
    EXPECT_THAT(line("7"), HasSubstr("coordinates are not a list"));
    for (const char* none : {"7", "[]"})
        EXPECT_THAT(trace(R"({"type": "MultiLineString", "coordinates": )" + std::string(none) + "}"),
                    HasSubstr("is a MultiLineString, not a LineString or MultiLineString with points"))
            << none;
    EXPECT_THAT(trace(R"({"type": "FeatureCollection", "features": 7})"), HasSubstr("has no coordinates"));
    const auto block = [](const std::string& rings, const std::string& fixed)
    {
        const PolygonFile file = read_geojson_blocks(R"({"type": "Feature", "properties": {"fixed": )" + fixed +
                                                         R"(}, "geometry": {"type": "Polygon", "coordinates": )" + rings + "}}",
                                                     "b.geojson");
        return file.problems.empty() ? "" : file.problems.front().text;
    };
    for (const char* fixed : {"false", "\"false\"", "0", "null", "true", "\"true\"", "1", "\"fixed \"", "\"x, y\""})
        EXPECT_EQ(block("[[[0, 0], [1, 0], [1, 1], [0, 0]]]", fixed), "") << fixed;
    EXPECT_THAT(block("[[[0, 0], [1, 0], [1, 1], [0, 0]]]", "2"), HasSubstr("fixed does not say what is fixed"));
    EXPECT_THAT(block("[[[0, 0], [1, 0], [1, 1], [0, 0]]]", "\"z\""), HasSubstr("fixed does not say what is fixed"));
    EXPECT_THAT(block("[[[0, 0], [1, 0], [1, 1], [0, 1]]]", "false"), HasSubstr("its ring is not closed"));
    EXPECT_THAT(block("[[[0, 0], [1, 0], [0, 0]]]", "false"), HasSubstr("its ring is not closed"));
    EXPECT_THAT(block("[[]]", "false"), HasSubstr("its ring is not closed"));
    for (const char* rings : {"[]", "7"})
        EXPECT_THAT(block(rings, "false"), HasSubstr("feature 1 (has no ring)")) << rings;
    for (const char* other : {R"({"type": "Point", "coordinates": [1, 2]})", R"({"type": "MultiPolygon", "coordinates": []})"})
    {
        const PolygonFile file = read_geojson_blocks(other, "b.geojson");
        ASSERT_THAT(file.problems, SizeIs(1)) << other;
        EXPECT_THAT(file.problems[0].text, HasSubstr(", not a Polygon or MultiPolygon with rings")) << other;
    }
    EXPECT_THAT(block("[[[0, 0], [9, 0], [9, 9], [0, 0]], [[2, 1], [3, 1], [3, 2], [2, 1]]]", "false"), HasSubstr("has a hole"));
}

const std::string mapped = "[domain]\nwidth = 12.0\nheight = 9.0\nfixed = [\"bottom\"]\n"
                           "[[joint_set]]\nname = \"beds\"\ndip_deg = 8.0\nspacing = 1.7\n"
                           "[[joint_set]]\nname = \"cross\"\ndip_deg = 85.0\nspacing = 1.5\ntrace = 3.0\ngap = 1.0\n"
                           "[[excavation]]\nname = \"hole\"\nshape = \"circle\"\nposition = [6, 4]\ndiameter = 2.5\n";

/// Blocks written and read again are the same blocks.
TEST(BlockShapes, AreReadAgain)
{
    const test::ScratchFolder folder("block_shapes");
    std::ofstream(folder / "case.toml") << mapped << test::laws;
    const LoadedCase loaded = load_case(folder / "case.toml");
    const std::vector<BlockShape> shapes = block_shapes(loaded.file.def, generate_rock_mass(loaded.file.def));
    ASSERT_EQ(static_cast<Index>(shapes.size()), loaded.setup.model.blocks());
    std::ofstream(folder / "b.wkt") << to_wkt(shapes);
    std::ofstream(folder / "b.geojson") << to_geojson(shapes);
    for (const char* name : {"b.wkt", "b.geojson"})
    {
        std::ofstream(folder / "again.toml") << "blocks_file = \"" << name << "\"\n" << test::laws;
        const LoadedCase again = load_case(folder / "again.toml");
        ASSERT_EQ(again.setup.model.blocks(), loaded.setup.model.blocks()) << name;
        for (const BlockShape& shape : block_shapes(again.file.def, generate_rock_mass(again.file.def)))
            EXPECT_EQ(shape.edges, std::vector<std::string>(shape.block.polygon.size(), "block")) << shape.block.name;
        for (Index b = 0; b < again.setup.model.blocks(); ++b)
        {
            const Index as_cut = loaded.setup.model.slot_of_user[b], as_read = again.setup.model.slot_of_user[b];
            EXPECT_EQ(again.setup.model.name[as_read], loaded.setup.model.name[as_cut]);
            EXPECT_NEAR(again.setup.model.area[as_read], loaded.setup.model.area[as_cut], 1e-12);
            EXPECT_EQ(again.setup.state.blocks.is_free(as_read), loaded.setup.state.blocks.is_free(as_cut));
        }
    }
}

/// An opening in one block: its ring is a hole, also where a corner of it touches the outline of the block.
TEST(BlockShapes, HaveTheRingsOfTheBlocksInsideAsHoles)
{
    for (const char* opening : {"[[2, 2], [4, 2], [3, 4]]", "[[2, 2], [4, 2], [3, 6]]", "[[0, 3], [3, 0], [4, 4]]"})
    {
        const test::ScratchFolder folder("block_holes");
        std::ofstream(folder / "case.toml")
            << "[domain]\nwidth = 6.0\nheight = 6.0\n[[excavation]]\nname = \"hole\"\nshape = \"polygon\"\n"
            << "polygon = " << opening << "\n"
            << test::laws;
        const LoadedCase loaded = load_case(folder / "case.toml");
        double sum = 0.0;
        for (const BlockShape& shape : block_shapes(loaded.file.def, generate_rock_mass(loaded.file.def)))
        {
            double area = std::abs(signed_area(shape.block.polygon));
            for (const Polygon& hole : shape.holes)
                area -= std::abs(signed_area(hole));
            EXPECT_NEAR(area, shape.area, 1e-12) << opening;
            std::set<std::pair<double, double>> corners;
            for (const Vec2& corner : shape.block.polygon)
                EXPECT_TRUE(corners.emplace(corner.x(), corner.y()).second) << "a ring that meets itself: " << opening;
            EXPECT_EQ(shape.edges.size(), shape.block.polygon.size());
            ASSERT_EQ(shape.hole_edges.size(), shape.holes.size());
            for (std::size_t hole = 0; hole < shape.holes.size(); ++hole)
                EXPECT_EQ(shape.hole_edges[hole], std::vector<std::string>(shape.holes[hole].size(), "excavation hole"));
            sum += shape.area;
            const std::string text = to_wkt(std::span(&shape, 1));
            EXPECT_EQ(text.find("), (") != std::string::npos, !shape.holes.empty()) << text;
            EXPECT_EQ(text.find("# edges of a hole: excavation hole; ") != std::string::npos, !shape.holes.empty()) << text;
            EXPECT_EQ(to_geojson(std::span(&shape, 1)).find("hole_edges") != std::string::npos, !shape.holes.empty());
        }
        EXPECT_NEAR(sum, 36.0, 1e-12);
    }
}

TEST(BlockShapes, SayWhatEachEdgeWasCutBy)
{
    const test::ScratchFolder folder("block_edges");
    std::ofstream(folder / "case.toml") << mapped << test::laws;
    const LoadedCase loaded = load_case(folder / "case.toml");
    const auto document = nlohmann::json::parse(to_geojson(block_shapes(loaded.file.def, generate_rock_mass(loaded.file.def))));
    std::map<std::string, int> seen;
    for (const auto& feature : document["features"])
    {
        const auto& properties = feature["properties"];
        EXPECT_EQ(properties["edges"].size() + 1, feature["geometry"]["coordinates"][0].size());
        for (const auto& edge : properties["edges"])
            ++seen[edge.get<std::string>()];
        EXPECT_EQ(properties["excavation"] == "hole", properties["name"].get<std::string>().starts_with("hole"));
    }
    for (const char* name : {"domain", "beds", "cross", "excavation hole"})
        EXPECT_GT(seen[name], 3) << name;
    EXPECT_EQ(seen.size(), 4u);
}
}  // namespace
}  // namespace hdem
