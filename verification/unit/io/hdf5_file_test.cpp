#include "core/check.h"
#include "io/hdf5_reader.h"
#include "io/hdf5_writer.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <future>
#include <numeric>
#include <thread>

#ifdef __SANITIZE_ADDRESS__
/// HDF5 1.10.8 loses some memory when it cannot open a damaged file.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions()
{
    return "leak:libhdf5";
}
#endif

namespace hdem
{
namespace
{
using test::message_of;
using test::ScratchFolder;
using test::text_in;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::vector<double> ramp(std::size_t n)
{
    std::vector<double> values(n);
    std::iota(values.begin(), values.end(), 0.5);
    return values;
}

TEST(Hdf5File, GivesBackWhatWasWritten)
{
    const ScratchFolder folder("hdf5");
    Hdf5Writer out(folder / "a.h5");
    out.write("/deep/in/reals", ramp(300000), {100000, 3});
    out.write("/floats", std::vector<float>{1.5f, -2.5f});
    out.write("/none", std::vector<std::int32_t>{}, {0, 2});
    out.write("/bytes", std::vector<std::uint8_t>{0, 255});
    out.write("/longs", std::vector<std::int64_t>{INT64_MIN, INT64_MAX});
    out.write_texts("/texts", {"short", "", "Überlänge"});
    out.write_texts("/no_texts", {});
    out.set_attribute("/deep", "seed", std::uint64_t{UINT64_MAX});
    out.set_attribute("/deep", "version", std::vector<std::int64_t>{1, 0});
    out.set_text("/deep", "title", "α = 30°");
    out.set_text("/deep", "empty", "");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.h5")) << "before commit()";
    out.commit();

    const Hdf5Reader in(folder / "a.h5");
    EXPECT_EQ(in.read<double>("/deep/in/reals", {any_extent, 3}), ramp(300000));
    EXPECT_THAT(in.read<float>("/floats", {2}), ElementsAre(1.5f, -2.5f));
    EXPECT_THAT(in.read<std::int32_t>("/none", {any_extent, 2}), ElementsAre());
    EXPECT_THAT(in.read<std::uint8_t>("/bytes", {2}), ElementsAre(0, 255));
    EXPECT_THAT(in.read<std::int64_t>("/longs", {2}), ElementsAre(INT64_MIN, INT64_MAX));
    EXPECT_THAT(in.read_texts("/texts"), ElementsAre("short", "", "Überlänge"));
    EXPECT_THAT(in.read_texts("/no_texts"), ElementsAre());
    EXPECT_THAT(in.attribute<std::uint64_t>("/deep", "seed", {}), ElementsAre(UINT64_MAX));
    EXPECT_THAT(in.attribute<std::int64_t>("/deep", "version", {2}), ElementsAre(1, 0));
    EXPECT_EQ(in.text("/deep", "title"), "α = 30°");
    EXPECT_EQ(in.text("/deep", "empty"), "");
    EXPECT_THAT(in.children("/"), ElementsAre("bytes", "deep", "floats", "longs", "no_texts", "none", "texts"));
    EXPECT_EQ(in.shape("/deep/in/reals"), (Shape{100000, 3}));
    EXPECT_TRUE(in.has("/deep/in"));
    EXPECT_FALSE(in.has("/deep/out"));
    EXPECT_FALSE(in.has("/floats/x"));
    EXPECT_FALSE(in.has_attribute("/deep", "nothing"));
}

TEST(Hdf5File, AProcessIsForkedOffWhenNoFileIsOpen)
{
    const ScratchFolder folder("hdf5_fork");
    std::promise<void> opened;
    std::atomic<bool> was_open_long = false;
    std::thread other(
        [&]
        {
            Hdf5Writer file(folder / "a.h5");
            opened.set_value();
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
            file.commit();
            was_open_long = true;
        });
    opened.get_future().wait();
    const pid_t child = ::fork();
    if (child == 0)
    {
        ::alarm(20);  // it would wait for ever
        Hdf5Writer file(folder / "b.h5");
        file.write("/x", std::vector<double>{1.0});
        file.commit();
        const char* result = was_open_long ? "true" : "false";
        ::execlp(result, result, nullptr);  // not _exit: the thread sanitizer would look for the other thread here
        ::abort();
    }
    int status = -1;
    ::waitpid(child, &status, 0);
    other.join();
    EXPECT_EQ(status, 0);
    EXPECT_EQ(Hdf5Reader(folder / "b.h5").read<double>("/x", {1}), std::vector<double>{1.0});
}

TEST(Hdf5File, AThreadThatForksDoesNotWaitForItself)
{
    const ScratchFolder folder("hdf5_own_fork");
    Hdf5Writer file(folder / "a.h5");
    ::alarm(20);  // it would wait for ever
    const pid_t child = ::fork();
    if (child == 0)
        ::_exit(0);
    ::alarm(0);
    int status = -1;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
}

TEST(Hdf5File, SameContentGivesTheSameBytesAtAnyTime)
{
    const ScratchFolder folder("hdf5_bytes");
    const auto write = [&](const char* name)
    {
        Hdf5Writer out(folder / name);
        out.make_group("/made/inside");
        out.write("/group/inside/reals", ramp(1000));
        out.set_text("/group", "title", "same");
        out.link("/links/elsewhere", "other.h5", "/reals");
        out.commit();
    };
    write("a.h5");
    for (const std::time_t second = std::time(nullptr); std::time(nullptr) == second;)  // HDF5 would keep the second
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
    write("b.h5");
    EXPECT_TRUE(text_in(folder / "a.h5") == text_in(folder / "b.h5"));
}

TEST(Hdf5File, ErrorsNameFileObjectAndReason)
{
    const ScratchFolder folder("hdf5_errors");
    Hdf5Writer out(folder / "a.h5");
    out.write("/reals", ramp(6), {2, 3});
    EXPECT_THAT(message_of([&] { out.write("/reals", ramp(1)); }),
                AllOf(HasSubstr("a.h5: /reals: cannot be written"), HasSubstr("exists")));
    EXPECT_THAT(message_of([&] { out.write("/wrong", ramp(5), {2, 3}); }), HasSubstr("5 elements do not fill its shape of 6"));
    EXPECT_THAT(message_of([&] { out.set_attribute("/nowhere", "x", 1.0); }), HasSubstr("/nowhere@x: cannot be written"));
    out.link("/elsewhere", "other.h5", "/reals");
    out.commit();
    Hdf5Writer other(folder / "other.h5");
    other.write("/reals", ramp(6), {2, 3});
    other.commit();

    EXPECT_THAT(message_of([&] { const Hdf5Reader in(folder / "b.h5"); }), HasSubstr("b.h5: /: cannot be read"));
    std::ofstream(folder / "text.h5") << "no HDF5 at all";
    EXPECT_THAT(message_of([&] { const Hdf5Reader in(folder / "text.h5"); }), HasSubstr("text.h5: /: cannot be read"));
    const Hdf5Reader in(folder / "a.h5");
    EXPECT_THAT(message_of([&] { (void)in.read<double>("/reals", {6}); }),
                HasSubstr("/reals: cannot be read (shape [2, 3], expected [6])"));
    EXPECT_THAT(message_of([&] { (void)in.read<float>("/reals", {2, 3}); }), HasSubstr("another type of element"));
    EXPECT_THAT(message_of([&] { (void)in.read<std::int64_t>("/reals", {2, 3}); }), HasSubstr("another type of element"));
    EXPECT_THAT(message_of([&] { (void)in.read<double>("/absent", {any_extent}); }),
                HasSubstr("/absent: cannot be read (not in this file)"));
    EXPECT_THAT(message_of(
                    [&] {
                        (void)in.read<double>("/elsewhere", {2, 3});
                    }),
                HasSubstr("not in this file"))
        << "an external link was followed";
    EXPECT_THAT(message_of([&] { (void)in.read_texts("/reals"); }), HasSubstr("not a text"));
}

/// Without a checksum each of these would be another number.
int refused_flips(const ScratchFolder& folder, std::uint64_t count, Hdf5Writer::Packing packing)
{
    std::vector<double> values = ramp(count);
    for (double& value : values)
        value = std::sin(1e3 * value);  // so that the packed data is long
    Hdf5Writer out(folder / "a.h5");
    out.write("/reals", values, {count}, packing);
    out.commit();
    const std::string good = text_in(folder / "a.h5");
    int refused = 0;
    for (std::size_t i = 0; i < 50; ++i)
    {
        std::string bad = good;
        bad[bad.size() / 2 + i * 97] ^= 4;
        std::ofstream(folder / "bad.h5", std::ios::binary) << bad;
        if (message_of([&] { (void)Hdf5Reader(folder / "bad.h5").read<double>("/reals", {count}); }) != "no error")
            ++refused;
    }
    return refused;
}

TEST(Hdf5File, AFlippedBitInTheDataIsAnError)
{
    const ScratchFolder folder("hdf5_bits");
    for (const std::uint64_t count : {1500U, 4000U, 20000U})  // in the header, in one chunk, packed
        for (const Hdf5Writer::Packing packing : {Hdf5Writer::Packing::deflated, Hdf5Writer::Packing::plain})
            EXPECT_EQ(refused_flips(folder, count, packing), 50) << count;
}

template <class T>
std::uintmax_t size_of_zeros(const ScratchFolder& folder, std::uint64_t count)
{
    Hdf5Writer out(folder / "a.h5");
    out.write("/zeros", std::vector<T>(count));
    out.commit();
    return std::filesystem::file_size(folder / "a.h5");
}

TEST(Hdf5File, OnlyLargeDatasetsOfWholeNumbersAreDeflated)
{
    const ScratchFolder folder("hdf5_size");
    EXPECT_GT(size_of_zeros<std::int64_t>(folder, 1000), 8000U);
    EXPECT_LT(size_of_zeros<std::int64_t>(folder, 100'000), 100'000U);
    EXPECT_GT(size_of_zeros<double>(folder, 100'000), 800'000U);
}

/// Whatever bytes are changed, or the file cut short: an error or some values, never a crash or a huge allocation.
TEST(Hdf5File, DamagedFilesAreReadOrRefused)
{
    const ScratchFolder folder("hdf5_damage");
    Hdf5Writer out(folder / "a.h5");
    out.write("/group/reals", ramp(40), {20, 2});
    out.write_texts("/texts", {"one", "two"});
    out.set_text("/group", "title", "damage");
    out.commit();
    const std::string good = text_in(folder / "a.h5");
    std::uint64_t random = 12345;
    const auto next_random = [&](std::uint64_t n)
    {
        random = random * 6364136223846793005U + 1442695040888963407U;
        return (random >> 33U) % n;
    };
    int refused = 0;
    for (int i = 0; i < 1000; ++i)
    {
        std::string bad = good;
        if (i % 10 == 0)
            bad.resize(next_random(bad.size()));
        for (std::uint64_t k = 0; k <= next_random(4) && !bad.empty(); ++k)
            bad[next_random(bad.size())] = static_cast<char>(next_random(256));
        std::ofstream(folder / "bad.h5", std::ios::binary) << bad;
        refused += message_of(
                       [&]
                       {
                           const Hdf5Reader in(folder / "bad.h5");
                           (void)in.children("/");
                           (void)in.read<double>("/group/reals", {any_extent, 2});
                           (void)in.read_texts("/texts");
                           (void)in.text("/group", "title");
                       }) != "no error"
                       ? 1
                       : 0;
    }
    EXPECT_GT(refused, 100);
}
}  // namespace
}  // namespace hdem
