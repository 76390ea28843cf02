#include "core/check.h"
#include "io/describe_file.h"
#include "io/text_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <fstream>

namespace hdem
{
namespace
{
class TextFiles : public testing::Test
{
  protected:
    [[nodiscard]] std::filesystem::path holding(const std::string& text) const
    {
        std::ofstream(folder / "text") << text;
        return folder / "text";
    }

    /// A named pipe that nobody writes to: opening it would wait for ever.
    [[nodiscard]] std::filesystem::path silent_pipe() const
    {
        const std::filesystem::path pipe = folder / "hdem_silent_pipe";
        std::filesystem::remove(pipe);
        EXPECT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
        return pipe;
    }

    const std::filesystem::path folder = testing::TempDir();
};

TEST_F(TextFiles, AreReadWholeUpToTheGreatestSize)
{
    const std::string text = "a\r\n" + std::string(100'000, 'x');
    EXPECT_EQ(read_text_file(holding(text), text.size()).text, text);
    EXPECT_EQ(read_text_file(holding(text), text.size()).obstacle, "");
    EXPECT_EQ(read_text_file(holding(text), text.size() - 1).obstacle, "larger than 100002 bytes");
    EXPECT_EQ(read_text_file(holding(""), 0).obstacle, "");
}

TEST_F(TextFiles, ThatAreNoneAreNamedForWhatTheyAre)
{
    EXPECT_EQ(read_text_file(folder / "absent", 10).obstacle, "does not exist");
    EXPECT_EQ(read_text_file(folder, 10).obstacle, "is a folder");
    for (const std::filesystem::path& file : {std::filesystem::path("/dev/zero"), silent_pipe()})
    {
        EXPECT_EQ(read_text_file(file, 10).obstacle, "is a pipe, a socket or a device") << file;
        EXPECT_THAT(read_text_file(file, 10).remedy, testing::HasSubstr("to a file first"));
    }
}

TEST_F(TextFiles, ThatAreCasesAreDescribedWithTheEndsOfTheirStages)
{
    std::ofstream(folder / "case.toml")
        << "[material.rock]\ndensity = 2700.0\n[joint.default]\nnormal_stiffness = 1e9\nshear_stiffness = 1e9\n"
           "friction_angle_deg = 30.0\n[[block]]\npolygon = [[0, 0], [1, 0], [1, 1]]\n"
           "[[stage]]\ncycles = 5\n[[stage]]\nduration = 0.5\n"
           "[[stage]]\nuntil = [\"speed > 3\", \"converged\"]\nmax_cycles = 70\n"
           "[[stage]]\nuntil = \"cycles > 9\"\n";
    const std::string page = describe_file(folder / "case.toml");
    for (const char* line : {"stage1: 5 cycles\n", "stage2: 0.5 s\n", "stage3: until converged or speed > 3, at most 70 cycles\n",
                             "stage4: until cycles > 9, at most 1000000 cycles\n"})
        EXPECT_THAT(page, testing::HasSubstr(line));
}

TEST_F(TextFiles, ThatArePipesAreNotDescribedEither)
{
    EXPECT_THROW(static_cast<void>(describe_file(silent_pipe())), InputError);
}
}  // namespace
}  // namespace hdem
