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

TEST_F(TextFiles, ThatArePipesAreNotDescribedEither)
{
    EXPECT_THROW(static_cast<void>(describe_file(silent_pipe())), InputError);
}
}  // namespace
}  // namespace hdem
