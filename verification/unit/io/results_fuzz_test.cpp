/// Frames and results that somebody else has changed, read by `hdem info` and by a run that goes on.

#include "core/check.h"
#include "io/describe_file.h"
#include "io/run_recorder.h"
#include "verification/unit/io/hdf5_mutator.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using test::Hdf5Mutator;
using test::ScratchFolder;
using test::SmallRun;
using test::text_in;
using test::write_bytes;
namespace fs = std::filesystem;

const Hdf5Mutator::Targets of_results = {.datasets = {"/energy/cycle", "/energy/time", "/energy/kinetic_energy", "/energy/residual",
                                                      "/history/block/cycle", "/history/block/time", "/history/block/velocity_x",
                                                      "/frames/number", "/frames/cycle", "/frames/time", "/frames/stage",
                                                      "/provenance/command_line", "/provenance/overrides"},
                                         .attributes = {"/@version", "/@filetype", "/provenance@seed", "/provenance@threads",
                                                        "/provenance@end", "/provenance@git_dirty"}};
const Hdf5Mutator::Targets of_blocks = {
    .datasets = {"/hdem/block_id", "/VTKHDF/NumberOfCells", "/VTKHDF/NumberOfPoints", "/VTKHDF/Points", "/VTKHDF/CellData/id",
                 "/VTKHDF/CellData/velocity"},
    .attributes = {"/hdem@version", "/hdem@filetype", "/hdem@cycle", "/hdem@time", "/hdem@stage", "/hdem@title"}};
const Hdf5Mutator::Targets of_contacts = {
    .datasets = {"/VTKHDF/NumberOfCells", "/VTKHDF/CellData/blocks", "/VTKHDF/CellData/normal_force", "/VTKHDF/Offsets"},
    .attributes = of_blocks.attributes};

SmallRun model_of_run()
{
    SmallRun run = test::small_run();
    run.model.histories = {test::history("block", {"block"}, {"velocity_x"}, 5)};
    run.model.output = {.row_every = 10, .frame_every = 20, .contacts = true};
    return run;
}

void advance(SmallRun& run, RunRecorder& recorder, std::int64_t last)
{
    for (; run.state.cycle < last; run.state.cycle += 5)
        recorder.observe(run.model, run.state);
}

void make_run(const fs::path& folder)
{
    SmallRun run = model_of_run();
    run.state.cycle = 0;
    RunRecorder recorder(folder, run.model, Provenance{.command_line = {"hdem", "run"}});
    advance(run, recorder, 45);
    recorder.finish(run.model, run.state);
}

/// True when it had something to say, false when it refused the file.
bool informs(const fs::path& file)
{
    try
    {
        return !describe_file(file).empty();
    }
    catch (const InputError& error)
    {
        EXPECT_FALSE(error.problems().empty());
        return false;
    }
}

/// As `hdem run --restart` at cycle 20 does it. True when nothing is in its way.
bool goes_on(const fs::path& folder)
{
    SmallRun run = model_of_run();
    run.state.cycle = 20;
    try
    {
        RunRecorder recorder(folder, run.model, Provenance{}, run.state, {});
        recorder.begin_stage(run.model, run.state);
        return true;
    }
    catch (const RunError& error)
    {
        EXPECT_THAT(error.what(), testing::HasSubstr("results.h5"));
        return false;
    }
}

struct Outcome
{
    int informed = 0;
    int went_on = 0;
};

/// Changes the file in many ways and lets both readers at each.
template <class Change>
Outcome try_changes(const fs::path& folder, const std::string& name, int files, const Change& change)
{
    make_run(folder / "sound");
    Outcome outcome;
    for (int i = 0; i < files; ++i)
    {
        fs::remove_all(folder / "run");
        fs::copy(folder / "sound", folder / "run", fs::copy_options::recursive);
        change(folder / "run" / name);
        outcome.informed += informs(folder / "run" / name) ? 1 : 0;
        outcome.went_on += goes_on(folder / "run") ? 1 : 0;
    }
    return outcome;
}

struct Kind
{
    const char* name;
    const char* file;
    const Hdf5Mutator::Targets* targets;
};

class ReadersOfARun : public testing::TestWithParam<Kind>
{
};

TEST_P(ReadersOfARun, AcceptTheSoundFileOfTheMutationTests)
{
    const ScratchFolder folder("fuzz_sound_run");
    const Outcome outcome = try_changes(folder.path(), GetParam().file, 1, [](const fs::path&) {});
    EXPECT_EQ(outcome.informed, 1);
    EXPECT_EQ(outcome.went_on, 1);
}

TEST_P(ReadersOfARun, SurviveRandomBytes)
{
    const ScratchFolder folder("fuzz_run_bytes");
    Hdf5Mutator mutator(21);
    const int files = test::files_to_try(60);
    const Outcome outcome = try_changes(folder.path(), GetParam().file, files,
                                        [&](const fs::path& file) { write_bytes(file, mutator.changed_bytes(text_in(file))); });
    EXPECT_LT(outcome.informed, files) << "no edit did any harm";
}

TEST_P(ReadersOfARun, SurviveObjectsThatDoNotFit)
{
    const ScratchFolder folder("fuzz_run_objects");
    Hdf5Mutator mutator(22);
    const int files = test::files_to_try(60);
    const Outcome outcome = try_changes(folder.path(), GetParam().file, files,
                                        [&](const fs::path& file) { mutator.change_object(file, *GetParam().targets); });
    EXPECT_LT(outcome.informed, files) << "no change did any harm";
}

INSTANTIATE_TEST_SUITE_P(Files, ReadersOfARun,
                         testing::Values(Kind{"results", "results.h5", &of_results},
                                         Kind{"blocks", "frames/blocks_000001.hdf", &of_blocks},
                                         Kind{"contacts", "frames/contacts_000001.hdf", &of_contacts}),
                         [](const auto& kind) { return kind.param.name; });
}  // namespace
}  // namespace hdem
