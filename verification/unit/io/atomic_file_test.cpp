#include "core/check.h"
#include "io/atomic_file.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>

namespace hdem
{
namespace
{
using test::message_of;
using test::ScratchFolder;
using test::text_in;
using testing::AllOf;
using testing::HasSubstr;

std::ptrdiff_t files_in(const std::filesystem::path& folder)
{
    const std::filesystem::directory_iterator files(folder);
    return std::distance(begin(files), end(files));
}

TEST(AtomicFile, ReplacesTheOldContentAndLeavesNothingElse)
{
    const ScratchFolder folder("atomic");
    write_atomically(folder / "sub/file.txt", std::string_view("old and long"));
    write_atomically(folder / "sub/file.txt", std::string_view("new"));
    EXPECT_EQ(text_in(folder / "sub/file.txt"), "new");
    EXPECT_EQ(files_in(folder / "sub"), 1);
}

TEST(AtomicFile, CanBeReadAtOnceWhenItIsFlushedLater)
{
    const ScratchFolder folder("atomic_later");
    write_atomically(folder / "file.txt", std::string_view("new"), Flush::later);
    EXPECT_EQ(text_in(folder / "file.txt"), "new");
    EXPECT_EQ(files_in(folder.path()), 1);
    flush_folder(folder.path());
    flush_folder(folder / "absent");  // nothing was written there
    EXPECT_THAT(message_of([&] { flush_folder(folder / "file.txt"); }),
                HasSubstr("cannot be brought to the disk (Not a directory)"));
}

/// A limit on file sizes stands in for a full disk: write() fails half-way.
TEST(AtomicFile, KeepsTheOldFileWhenTheNewOneDoesNotFit)
{
    const ScratchFolder folder("atomic_full");
    write_atomically(folder / "file.txt", std::string_view("old"));
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
    const std::string message = message_of([&] { write_atomically(folder / "file.txt", std::string(5000, 'x')); });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    EXPECT_THAT(message, AllOf(HasSubstr("file.txt: cannot be written (File too large)"), HasSubstr("ulimit")));
    EXPECT_EQ(text_in(folder / "file.txt"), "old");
    EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(AtomicFile, NamesTheFolderThatCannotBeMade)
{
    const ScratchFolder folder("atomic_folder");
    write_atomically(folder / "file", std::string_view("a file, not a folder"));
    EXPECT_THAT(message_of([&] { write_atomically(folder / "file/inside.txt", std::string_view("x")); }), HasSubstr("-o"));
}
/// Root could replace /dev/null by a file.
TEST(AtomicFile, DoesNotReplaceADeviceOrAPipe)
{
    const auto pipe = std::filesystem::path(testing::TempDir()) / "hdem_atomic_pipe";
    std::filesystem::remove(pipe);
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_THROW(write_atomically(pipe, std::string_view("text")), RunError);
    EXPECT_TRUE(std::filesystem::is_fifo(pipe));
    std::filesystem::remove(pipe);
}
}  // namespace
}  // namespace hdem
