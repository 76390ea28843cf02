#include "io/case_reader.h"
#include "io/case_schema.h"
#include "verification/unit/io/case_text.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

namespace hdem
{
namespace
{
using test::read;
using test::two_blocks;
using test::with;
using testing::ElementsAre;

TEST(CaseReader, LeavesWhatIsNotGivenAtItsDefault)
{
    const CaseDef def = read(two_blocks);
    EXPECT_FALSE(def.domain.given);
    EXPECT_EQ(def.gravity, CaseDef{}.gravity);
    EXPECT_EQ(def.contact.method, ContactDef{}.method);
    EXPECT_EQ(def.contact.restitution, ContactDef{}.restitution);
    EXPECT_FALSE(def.contact.threshold_scale);
    EXPECT_EQ(def.damping.preset, DampingPreset::automatic);
    EXPECT_FALSE(def.time.step);
    EXPECT_EQ(def.convergence.criteria, ConvergenceDef{}.criteria);
    EXPECT_EQ(def.output.row_every, OutputDef{}.row_every);
    EXPECT_TRUE(def.output.contacts);
}

TEST(CaseReader, ReadsStressInEitherForm)
{
    const InsituDef
        tensor = read(two_blocks + "[insitu]\nstress = [-8e6, -5e6, 1e6]\ngradient = [1.0, 2.0, 3.0]\nreference = 4.0\n").insitu;
    EXPECT_TRUE(tensor.given);
    EXPECT_EQ(tensor.stress->xy, 1e6);
    EXPECT_EQ(tensor.gradient.yy, 2.0);
    EXPECT_EQ(tensor.reference, 4.0);
    const InsituDef ground = read(two_blocks + "[insitu]\nsurface = 120.0\nratio = 1.5\nratio_offset = 1e6\n").insitu;
    EXPECT_EQ(ground.surface, 120.0);
    EXPECT_EQ(ground.ratio, 1.5);
    EXPECT_EQ(ground.ratio_offset, 1e6);
    const auto complains = [](const std::string& keys, const char* what)
    { EXPECT_THAT(test::problems_of(two_blocks + "[insitu]\n" + keys), testing::Contains(testing::HasSubstr(what))) << keys; };
    complains("", "stress (is missing, and there is no surface)");
    complains("surface = 1.0", "ratio (is missing");
    complains("stress = [1.0, 2.0]", "has 2 numbers, a stress has three");
    complains("stress = [1.0, 2.0, 3.0]\nsurface = 1.0\nratio = 1.0", "contradicts stress");
    complains("stress = [1.0, 2.0, 3.0]\nratio = 1.0", "belongs to surface");
    complains("surface = 1.0\nratio = 1.0\ngradient = [0.0, 0.0, 0.0]", "belongs to stress");
    EXPECT_THAT(test::problems_of(two_blocks + "[insitu]\nstress = [inf, 2.0, 3.0]\nreference = 1.0"),
                ElementsAre(testing::HasSubstr("stress[0] = inf Pa (must be finite)")))
        << "a number that is wrong is not missing";
    complains("surface = 1.0\nratio = 1.0\n[gravity]\nvector = [1.0, -9.81]", "straight down");
}

/// Every default that the documentation shows, written into a file, is legal and reads back as the same value.
TEST(CaseReader, ReadsEveryDocumentedDefaultBack)
{
    int defaults = 0;
    for (const SectionSpec& section : case_schema())
    {
        if (section.kind != SectionKind::table || section.name == "domain" || section.name == "insitu" ||
            section.name == "voronoi")  // these need more than their defaults
            continue;
        std::string text = two_blocks + "[" + section.name + "]\n";
        for (const KeySpec& key : section.keys)
            if (!key.default_json.empty())
            {
                text += key.name + " = " + key.default_json + "\n";
                ++defaults;
            }
        EXPECT_THAT(test::problems_of(text), ElementsAre()) << text;
        const CaseDef def = read(text);
        EXPECT_EQ(def.generator.seed, GeneratorDef{}.seed);
        EXPECT_EQ(def.gravity, CaseDef{}.gravity);
        EXPECT_EQ(def.contact.method, ContactDef{}.method);
        EXPECT_EQ(def.contact.threshold_scale, ContactDef{}.threshold_scale);
        EXPECT_EQ(def.contact.allowed_overlap, ContactDef{}.allowed_overlap);
        EXPECT_EQ(def.contact.length_floor, ContactDef{}.length_floor);
        EXPECT_EQ(def.damping.preset, DampingDef{}.preset);
        EXPECT_EQ(def.damping.local, DampingDef{}.local);
        EXPECT_EQ(def.time.fraction, TimeDef{}.fraction);
        EXPECT_EQ(def.time.stable_fraction, TimeDef{}.stable_fraction);
        EXPECT_EQ(def.convergence.mean_speed, ConvergenceDef{}.mean_speed);
        EXPECT_EQ(def.convergence.criteria, ConvergenceDef{}.criteria);
        EXPECT_EQ(def.output.contacts, OutputDef{}.contacts);
    }
    EXPECT_GT(defaults, 20);
}

TEST(CaseReader, AppendsBlocksFileBesideTheCase)
{
    const auto folder = std::filesystem::path(testing::TempDir()) / "hdem_blocks_file";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "blocks.wkt")
        << "# two\nPOLYGON((5 0, 6 0, 6 1, 5 0))\n\nPOLYGON((7 0, 8 0, 8 1, 7 0)); far; rock; fixed\n";
    std::ofstream(folder / "case.toml") << "blocks_file = \"blocks.wkt\"\n" << two_blocks;
    const CaseFile file = read_case_file(folder / "case.toml");
    ASSERT_EQ(file.def.blocks.size(), 4U);
    EXPECT_EQ(file.def.blocks[2].name, "block3");
    EXPECT_EQ(file.def.blocks[3].name, "far");
    EXPECT_TRUE(file.def.blocks[3].fix_x);
    // A problem that the model finds later in such a block is traced to its line.
    const Problem later{Problem::Severity::error, "block[3].polygon", "block \"far\": too far."};
    EXPECT_EQ(file.source.located(later), (folder / "blocks.wkt").string() + ":4: block \"far\": too far.");
}

TEST(CaseReader, TakesTablesThatBeginWithAByteOrderMark)
{
    const auto folder = std::filesystem::path(testing::TempDir()) / "hdem_marked_file";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "ground.csv") << "\xEF\xBB\xBFx,y\n0,2\n10,3\n";
    std::ofstream(folder / "case.toml") << with(
        with(two_blocks, "[material.rock]", "[domain]\nprofile = \"ground.csv\"\nbottom = 0\n[material.rock]"),
        "[[block]]\nname = \"top\"\npolygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n", "");
    EXPECT_EQ(read_case_file(folder / "case.toml").def.domain.polygon.size(), 4U);
}

TEST(CaseReader, KeepsTheTextForProvenance)
{
    EXPECT_EQ(read_case_text(two_blocks, "case.toml").source.text(), two_blocks);
}

TEST(CaseSource, FindsTheNearestParentOfAKey)
{
    const CaseFile file = read_case_text(two_blocks, "case.toml");
    EXPECT_EQ(file.source.place("block[1].polygon"), (Place{13, 11}));
    EXPECT_EQ(file.source.place("block[1].polygon[2]"), (Place{13, 11}));
    EXPECT_EQ(file.source.place("block[1].density"), (Place{11, 1}));
    EXPECT_EQ(file.source.place("joint.default.cohesion"), (Place{3, 1}));
    EXPECT_EQ(file.source.place("nothing"), Place{});
}

TEST(ShippedCases, AreLegal)
{
    int cases = 0;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(HDEM_SOURCE_DIR) / "verification/cases"))
        if (entry.path().extension() == ".toml")
        {
            ++cases;
            try
            {
                const bool has_foam = entry.path().filename() == "known_sink.toml" || entry.path().filename() == "blocks.toml";
                for (const Problem& warning : read_case_file(entry.path()).warnings)
                    EXPECT_TRUE(has_foam) << warning.text;
            }
            catch (const InputError& error)
            {
                ADD_FAILURE() << error.what();
            }
        }
    EXPECT_GE(cases, 3);
}
}  // namespace
}  // namespace hdem
