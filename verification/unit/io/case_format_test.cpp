#include "io/case_format.h"
#include "io/case_schema.h"
#include "verification/unit/io/case_text.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

namespace hdem
{
namespace
{
const std::filesystem::path source_folder = HDEM_SOURCE_DIR;

std::string text_of(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

TEST(CaseFormat, PageInTheTreeIsTheOneTheTableGives)
{
    EXPECT_TRUE(text_of(source_folder / "io/case_format.md") == case_format_markdown())
        << "io/case_format.md is out of date: hdem schema --markdown > io/case_format.md";
}

TEST(CaseFormat, ExampleIsALegalCaseWithoutWarnings)
{
    EXPECT_THAT(test::problems_of(std::string(case_example())), testing::ElementsAre());
    EXPECT_TRUE(read_case_text(std::string(case_example()), "example.toml").warnings.empty());
}

TEST(CaseFormat, EveryKeyHasAnEffectAndAKnownDefault)
{
    std::set<std::string> sections;
    for (const SectionSpec& section : case_schema())
    {
        EXPECT_TRUE(sections.insert(section.name).second) << section.name << " stands twice in the table";
        std::set<std::string> keys;
        for (const KeySpec& key : section.keys)
        {
            EXPECT_TRUE(keys.insert(key.name).second) << key.name << " stands twice in " << section.heading();
            EXPECT_FALSE(key.effect.empty()) << section.heading() << ' ' << key.name;
            EXPECT_TRUE(key.required || !key.default_json.empty() || !key.default_note.empty())
                << section.heading() << ' ' << key.name;
            EXPECT_TRUE(key.assign != nullptr) << section.heading() << ' ' << key.name;
        }
    }
}

/// What a case can say: all headers core/model/*_def.h.
std::string text_of_definitions()
{
    std::string text;
    for (const auto& file : std::filesystem::directory_iterator(source_folder / "core/model"))
        if (file.path().filename().string().ends_with("_def.h"))
            text += text_of(file.path());
    return text;
}

/// A field of these that no key sets would be a setting that users cannot reach.
TEST(CaseFormat, EveryFieldOfTheStructsHasItsKey)
{
    const std::map<std::string, std::string> section_of = {{"DomainDef", "domain"},
                                                           {"FaultDef", "fault"},
                                                           {"RegionDef", "region"},
                                                           {"JointSetDef", "joint_set"},
                                                           {"VoronoiDef", "voronoi"},
                                                           {"GeneratorDef", "generator"},
                                                           {"ExcavationDef", "excavation"},
                                                           {"BlockDef", "block"},
                                                           {"MaterialDef", "material"},
                                                           {"JointDef", "joint"},
                                                           {"InsituDef", "insitu"},
                                                           {"BoundaryDef", "boundary"},
                                                           {"LoadDef", "load"},
                                                           {"Interval", "load"},
                                                           {"FactorDef", "load"},
                                                           {"ContactDef", "contact"},
                                                           {"DampingDef", "damping"},
                                                           {"TimeDef", "time"},
                                                           {"ConvergenceDef", "convergence"},
                                                           {"StageDef", "stage"},
                                                           {"WaterDef", "water"},
                                                           {"WaterCrackDef", "water_crack"},
                                                           {"FactorOfSafetyDef", "factor_of_safety"},
                                                           {"BoltDef", "bolt"},
                                                           {"LinerDef", "liner"},
                                                           {"HistoryDef", "history"},
                                                           {"OutputDef", "output"}};
    const std::set<std::string> otherwise = {
        "domain.given",    "insitu.given",      "block.fix_x",           "block.fix_y",  "block.fix_rotation", "material.name",
        "joint.name",      "load.interval",     "stage.until_converged", "stage.ends",   "stage.joints",       "boundary.is_insitu",
        "stage.materials", "load.factor",       "boundary.factor",       "water.given",  "water.pressures",    "joint.library",
        "joint.function",  "joint_set.dip_law", "joint_set.spacing_law", "voronoi.given"};
    std::istringstream header(text_of_definitions());
    std::string line, section;
    int fields = 0;
    while (std::getline(header, line))
    {
        line = line.substr(0, line.find("//"));
        while (line.ends_with("=") || line.ends_with("= "))  // the value stands on the next line
        {
            std::string value;
            if (!std::getline(header, value))
                break;
            line += value.substr(0, value.find("//"));
        }
        const std::string declaration = line.substr(0,
                                                    line.find_first_of("=;"));  // "    double width " of "    double width = 0.0;"
        const auto end = declaration.find_last_not_of(' ') + 1;
        const std::string name = declaration.substr(0, end).substr(declaration.find_last_of(" >", end - 1) + 1);
        if (line.starts_with("struct "))
        {
            const auto found = section_of.find(name);
            section = found == section_of.end() ? "" : found->second;
            EXPECT_TRUE(!section.empty() || name == "CaseDef" || name == "StressDef" || name == "OrientationDef" ||
                        name == "DistributionDef")
                << name << " is a struct this test does not know";
        }
        else if (line.starts_with("    ") && line.find(';') != std::string::npos && !section.empty() && name != "operator" &&
                 !otherwise.contains(section + "." + name))
        {
            ++fields;
            EXPECT_NE(find_section(section)->find(name), nullptr)
                << name << " of [" << section << "] is not in io/case_schema*.cpp";
        }
    }
    EXPECT_GT(fields, 80) << "the pattern of a field does not fit the headers any more";
}

TEST(JsonSchema, IsJsonOfDraft7)
{
    const auto schema = nlohmann::json::parse(case_json_schema());
    EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    EXPECT_EQ(schema["properties"]["excavation"]["items"]["required"], nlohmann::json({"name", "shape"}));
}

/// The validator of python3-jsonschema is independent of hdem: it accepts what hdem accepts and refuses a wrong key.
TEST(JsonSchema, AgreesWithTheReader)
{
    if (std::system("/usr/bin/python3 -c 'import jsonschema, tomllib' 2> /dev/null") != 0)
        GTEST_SKIP() << "needs python3-jsonschema";
    const auto folder = std::filesystem::path(testing::TempDir()) / "hdem_json_schema";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "schema.json") << case_json_schema();
    const auto validates = [&](const std::string& toml)
    {
        std::ofstream(folder / "case.toml") << toml;
        const std::string command = "/usr/bin/python3 " + (source_folder / "verification/unit/io/validate_case.py").string() + ' ' +
                                    (folder / "schema.json").string() + ' ' + (folder / "case.toml").string() + " > " +
                                    (folder / "log").string();
        return std::system(command.c_str()) == 0;
    };
    EXPECT_TRUE(validates(std::string(case_example()))) << text_of(folder / "log");
    EXPECT_TRUE(validates(test::two_blocks)) << text_of(folder / "log");
    for (const char* name : {"paper_static/static", "paper_dynamic/dynamic", "paper_tunnel/tunnel"})
        EXPECT_TRUE(validates(text_of(source_folder / "verification/cases" / (std::string(name) + ".toml"))))
            << text_of(folder / "log");

    for (const auto& [old, wrong] : {std::pair("cycles = 10", "cycle = 10"), std::pair("density = 2700.0", "density = -1"),
                                     std::pair("fixed = true", "fixed = [\"z\"]"), std::pair("[joint.default]", "[joint.other]"),
                                     std::pair("[0, 1]]", "[0]]"), std::pair("cycles = 10", "cycles = 10.5")})
    {
        const std::string text = test::with(test::two_blocks, old, wrong);
        EXPECT_FALSE(validates(text)) << wrong;
        EXPECT_FALSE(test::problems_of(text).empty()) << wrong;
    }
}
}  // namespace
}  // namespace hdem
