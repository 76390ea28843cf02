#include "io/case_format.h"
#include "io/polygons.h"
#include "verification/unit/io/case_text.h"
#include "verification/unit/small_run.h"

#include <algorithm>
#include <filesystem>
#include <random>
#include <sstream>

namespace hdem
{
namespace
{
/// One to four random edits: bytes flipped, pieces dropped, doubled, swapped, or replaced by tokens that hurt.
std::string mutated(std::string text, std::mt19937_64& random)
{
    static const std::vector<std::string> tokens = {"[",
                                                    "]",
                                                    "[[",
                                                    "]]",
                                                    "{",
                                                    "}",
                                                    "\"",
                                                    "'''",
                                                    "\"\"\"",
                                                    "\\",
                                                    "=",
                                                    ".",
                                                    ",",
                                                    "#",
                                                    "\n",
                                                    "nan",
                                                    "-inf",
                                                    "1e308",
                                                    "-1e308",
                                                    "9223372036854775807",
                                                    "-9223372036854775808",
                                                    "1e999",
                                                    "0",
                                                    "-1",
                                                    "true",
                                                    "[]",
                                                    "[[]]",
                                                    "{}",
                                                    "1979-05-27",
                                                    "\"*\"",
                                                    "\"\\u001b\"",
                                                    "\xff",
                                                    std::string(1, '\0'),
                                                    "\xef\xbb\xbf",
                                                    "a.b.c.d.e",
                                                    "fixed",
                                                    "polygon",
                                                    "stage",
                                                    "joint",
                                                    "default",
                                                    "0x7f",
                                                    "[1,2,3]",
                                                    "[[0,0],[1,0]]",
                                                    "\"\"",
                                                    "blocks_file = \"/\"\n"};
    static const std::vector<std::string> values = {"nan",
                                                    "-inf",
                                                    "1e308",
                                                    "-1e308",
                                                    "9223372036854775807",
                                                    "-9223372036854775808",
                                                    "0",
                                                    "-1",
                                                    "1",
                                                    "2.5",
                                                    "true",
                                                    "[]",
                                                    "[[]]",
                                                    "{}",
                                                    "1979-05-27",
                                                    "\"*\"",
                                                    "[\"*\"]",
                                                    "\"\\u001b\"",
                                                    "[1,2,3]",
                                                    "[[0,0],[1,0]]",
                                                    "[[0,0],[1,0],[2,\"a\"]]",
                                                    "\"\"",
                                                    "\"tunnel\"",
                                                    "[\"top\", \"top\"]",
                                                    "{x = 1, y = [2]}",
                                                    "'circle'",
                                                    "\"converged\""};
    const auto below = [&](std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random() % n); };
    for (std::size_t edits = 1 + below(4); edits > 0; --edits)
    {
        const std::size_t at = below(text.size());
        const std::size_t length = std::min(below(40), text.size() - at);
        switch (below(15))
        {
        case 0:
            text.insert(at, tokens[below(tokens.size())]);
            break;
        case 1:
            text.replace(at, length, tokens[below(tokens.size())]);
            break;
        case 2:
            text.erase(at, length);
            break;
        case 3:
            text.insert(below(text.size()), text.substr(at, length));
            break;
        case 4:
            text.insert(at, 1, static_cast<char>(random()));
            break;
        default:  // a value, so that the text stays TOML and reaches the checks
            if (const auto equals = text.find("= ", at); equals != std::string::npos)
                text.replace(equals + 2, std::min(text.find('\n', equals), text.size()) - equals - 2, values[below(values.size())]);
        }
    }
    return text;
}

/// Whatever the text, the reader returns a case or throws InputError with at least one printable line.
void expect_case_or_problems(const std::string& text, int& legal, int& toml)
{
    try
    {
        read_case_text(text, "case.toml");
        ++legal;
        ++toml;
    }
    catch (const InputError& error)
    {
        ASSERT_FALSE(error.problems().empty());
        toml += error.problems().front().text.find("not valid TOML") == std::string::npos ? 1 : 0;
        for (const Problem& problem : error.problems())
        {
            ASSERT_FALSE(problem.text.empty());
            ASSERT_TRUE(
                std::none_of(problem.text.begin(), problem.text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }))
                << problem.text;
        }
    }
}

/// The example of the format, and every case of the verification and of the guide: together they have nearly all sections and keys.
std::vector<std::string> legal_texts()
{
    std::vector<std::string> texts = {std::string(case_example()), test::two_blocks};
    std::vector<std::filesystem::path> files;
    for (const char* folder : {"verification/cases", "tools/guide/cases"})
        for (const auto& file : std::filesystem::recursive_directory_iterator(std::filesystem::path(HDEM_SOURCE_DIR) / folder))
            if (file.path().extension() == ".toml")
                files.push_back(file.path());
    std::ranges::sort(files);
    for (const std::filesystem::path& file : files)
        texts.push_back(test::text_in(file));
    return texts;
}

TEST(CaseReader, SurvivesRandomEditsOfLegalCases)
{
    std::mt19937_64 random(20240501);
    const std::vector<std::string> texts = legal_texts();
    EXPECT_GT(texts.size(), 50u);
    int legal = 0, toml = 0;
    for (int i = 0; i < 6000; ++i)
    {
        const std::string text = mutated(texts[i % texts.size()], random);
        ASSERT_NO_FATAL_FAILURE(expect_case_or_problems(text, legal, toml)) << text;
    }
    EXPECT_GT(legal, 30);
    EXPECT_GT(toml, 1000) << "the edits are so hard that little but the TOML parser was tested";
    EXPECT_LT(toml, 5000) << "the edits are so soft that the TOML parser was hardly tested";
}

TEST(CaseReader, SurvivesRandomOverrides)
{
    std::mt19937_64 random(7);
    const std::string set = "block.top.polygon[2]=[1, 2]";
    for (int i = 0; i < 3000; ++i)
    {
        const std::string text = mutated(set, random);
        try
        {
            const Override one = parse_override(text);
            read_case_text(test::two_blocks, "case.toml", {&one, 1});
        }
        catch (const InputError& error)
        {
            ASSERT_FALSE(error.problems().empty()) << text;
        }
    }
}

TEST(PolygonFile, SurvivesRandomEdits)
{
    std::mt19937_64 random(3);
    for (int i = 0; i < 6000; ++i)
    {
        std::istringstream in(
            mutated("# blocks\nPOLYGON((0 0, 1 0, 1 1, 0 0)); a; rock; fixed\nPOLYGON((5 5, 6e0 5, 6 -1, 5 5))\n", random));
        const PolygonFile file = read_polygons(in, "blocks.wkt");
        for (const auto& line : file.blocks)
            for (const Vec2& vertex : line.block.polygon)
                ASSERT_TRUE(vertex.allFinite());
    }
}
}  // namespace
}  // namespace hdem
