#include "core/check.h"
#include "io/fresh_file.h"
#include "io/run_lock.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <optional>

namespace hdem
{
namespace
{
using test::ScratchFolder;
using test::text_in;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(RunLock, LetsOneRunInAndTellsTheOtherWhoIsThere)
{
    const ScratchFolder scratch("lock");
    std::optional<RunLock> lock(std::in_place, scratch / "run");
    EXPECT_THAT(text_in(lock->file()), HasSubstr("\"process\":" + std::to_string(::getpid())));
    EXPECT_THAT([&] { RunLock(scratch / "run"); },
                ThrowsMessage<InputError>(
                    AllOf(HasSubstr("another run is in this folder: process " + std::to_string(::getpid())), HasSubstr("-o"))));
    lock.reset();
    EXPECT_NO_THROW(RunLock(scratch / "run"));
}

TEST(RunLock, EndsWithItsProcess)
{
    const ScratchFolder scratch("lock_death");
    const pid_t child = ::fork();
    if (child == 0)
    {
        new RunLock(scratch / "run");  // never removed
        ::_exit(0);
    }
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_EQ(status, 0);
    EXPECT_TRUE(std::filesystem::exists(scratch / "run/.lock"));
    EXPECT_NO_THROW(RunLock(scratch / "run"));
}

TEST(RunLock, TakesItsFoldersAwayUnlessSomethingIsInThem)
{
    const ScratchFolder scratch("lock_folders");
    {
        const RunLock lock(scratch / "a/b/c");
        EXPECT_TRUE(std::filesystem::exists(scratch / "a/b/c/.lock"));
    }
    EXPECT_FALSE(std::filesystem::exists(scratch / "a"));
    EXPECT_TRUE(std::filesystem::exists(scratch.path()));
    {
        const RunLock lock(scratch / "a/b/c");
        std::ofstream(scratch / "a/b/result") << "kept";
    }
    EXPECT_FALSE(std::filesystem::exists(scratch / "a/b/c"));
    EXPECT_TRUE(std::filesystem::exists(scratch / "a/b/result"));
}

TEST(RunLock, RemovesWhatKilledRunsHaveLeftAndNothingElse)
{
    const ScratchFolder scratch("lock_leftovers");
    std::filesystem::create_directories(scratch / "frames");
    const auto left = {temporary_name(scratch / "results.h5"), temporary_name(scratch / "frames/blocks_000001.hdf")};
    const auto others = {scratch / "notes.tmp", scratch / "my.0123456789ab", scratch / "results.0123456789xy.tmp"};
    for (const auto& file : left)
        std::ofstream(file) << "half";
    for (const auto& file : others)
        std::ofstream(file) << "mine";
    const RunLock lock(scratch.path());
    for (const auto& file : left)
        EXPECT_FALSE(std::filesystem::exists(file)) << file;
    for (const auto& file : others)
        EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

TEST(RunLock, IsLostWithTheFolderButNotWithItsFile)
{
    const ScratchFolder scratch("lock_lost");
    const RunLock lock(scratch / "run");
    std::filesystem::remove(lock.file());
    EXPECT_TRUE(lock.is_held());
    std::ofstream(lock.file()) << "of another run";
    EXPECT_FALSE(lock.is_held());
    EXPECT_THROW(lock.check(), RunError);
    std::filesystem::rename(scratch / "run", scratch / "moved");
    EXPECT_FALSE(lock.is_held());
}

TEST(RunLock, TemporaryNamesAreNeverTheSame)
{
    EXPECT_NE(temporary_name("a"), temporary_name("a"));
}
}  // namespace
}  // namespace hdem
