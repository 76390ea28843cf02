#include "core/check.h"
#include "core/joint/all_laws.h"
#include "io/checkpoint.h"
#include "io/hdf5_reader.h"
#include "io/run_recorder.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>
#include <sys/wait.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <memory>
#include <thread>

namespace hdem
{
namespace
{
using test::ScratchFolder;
using test::SmallRun;
using testing::ElementsAre;

SmallRun run_with_histories()
{
    SmallRun run = test::small_run();
    run.model.histories = {test::history("contact", {"ground", "block"}, contact_history_quantities(), 5),
                           test::history("block", {"block"}, block_history_quantities(), 2)};
    run.model.output = {.row_every = 10, .frame_every = 20, .contacts = true};
    run.state.cycle = 0;
    run.state.time = 0.0;
    test::load_contact(run, 0, 26487.0, 10.0, Regime::stick);
    return run;
}

Provenance some_provenance()
{
    return {.case_file = "a.toml",
            .case_text = "title = \"a\"\n",
            .overrides = {},
            .command_line = {"hdem", "run", "a.toml"},
            .seed = 3,
            .threads = 2,
            .cpu = "c",
            .hostname = "h",
            .environment = {},
            .begin = "b",
            .end = ""};
}

/// What a run does: show the cycles that are asked for.
void show(SmallRun& run, RunRecorder& recorder, std::int64_t last)
{
    while (run.state.cycle < last)
    {
        run.state.cycle = std::min(last, recorder.next_cycle(run.state.cycle));
        run.state.time = 1e-4 * static_cast<double>(run.state.cycle);
        recorder.observe(run.model, run.state);
    }
}

TEST(RunRecorder, AsksForTheNextCycleThatAnythingNeeds)
{
    const ScratchFolder folder("recorder_next");
    const SmallRun run = run_with_histories();
    const RunRecorder recorder(folder.path(), run.model, some_provenance());
    EXPECT_EQ(recorder.next_cycle(0), 2);
    EXPECT_EQ(recorder.next_cycle(4), 5);
    EXPECT_EQ(recorder.next_cycle(19), 20);
}

TEST(RunRecorder, TakesRowsAndFramesAtTheirIntervalsAndAtTheEndOfAStage)
{
    const ScratchFolder folder("recorder_rows");
    SmallRun run = run_with_histories();
    RunRecorder recorder(folder.path(), run.model, some_provenance());
    recorder.observe(run.model, run.state);
    show(run, recorder, 23);
    recorder.end_stage(run.model, run.state);
    recorder.save();

    const Hdf5Reader in(folder / "results.h5");
    EXPECT_THAT(in.read<std::int64_t>("/history/contact/cycle", {any_extent}), ElementsAre(0, 5, 10, 15, 20, 23));
    EXPECT_THAT(in.read<std::int64_t>("/history/block/cycle", {any_extent}),
                ElementsAre(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 23));
    EXPECT_THAT(in.read<std::int64_t>("/energy/cycle", {any_extent}), ElementsAre(0, 10, 20, 23));
    EXPECT_EQ(in.text("/energy/residual", "unit"), "J");
    EXPECT_THAT(in.read<double>("/energy/stick_points", {4}), ElementsAre(2.0, 2.0, 2.0, 2.0));
    EXPECT_THAT(in.read<std::int64_t>("/frames/cycle", {any_extent}), ElementsAre(0, 20, 23));
    EXPECT_THAT(in.read<double>("/history/contact/normal_force", {6}), testing::Each(26487.0));
    EXPECT_EQ(in.text("/provenance", "end"), "") << "the run goes on";
    recorder.finish(run.model, run.state);
    const Hdf5Reader last(folder / "results.h5");
    EXPECT_NE(last.text("/provenance", "end"), "");
    EXPECT_EQ(last.read<std::int64_t>("/energy/cycle", {any_extent}).size(), 4U) << "nothing new since the end of the stage";
    EXPECT_EQ(last.text("/provenance", "case_sha256"), "90491c6e4037bedf0914b90026a47dd3ce491e73825e407b6b196617674467e9");
}

/// Independent reader, every object against the page, and what ParaView needs.
TEST(RunRecorder, FilesAreAsTheirPageSays)
{
    if (std::system("/usr/bin/python3 -c 'import h5py' 2> /dev/null") != 0)
        GTEST_SKIP() << "needs python3-h5py";
    const ScratchFolder folder("recorder_page");
    SmallRun run = run_with_histories();
    run.state.contacts.has_preload = run.state.contacts.has_memory = true;
    run.state.contacts.resize(run.state.contacts.size());
    run.model.joints.rows.assign(run.model.joints.laws.size(), {.kind = kind_of<CoulombResidual>()});
    run.model.support.bolts = {{.name = "bolt", .links = {{.first = 0, .second = 1}}}};
    run.state.support = {.bolts = {{.force = 1.0}}, .history = {2.0}};
    HistoryDef of_bolt{.name = "bolt", .quantities = bolt_history_quantities()};
    of_bolt.bolt = "bolt";
    run.model.histories.push_back(of_bolt);
    run.model.support.liners = {{.name = "liner"}};
    run.state.support.liners = {{.installed = 1}};
    HistoryDef of_liner{.name = "liner", .quantities = liner_history_quantities()};
    of_liner.liner = "liner";
    run.model.histories.push_back(of_liner);
    run.model.water = {.given = true,
                       .unit_weight = 9810.0,
                       .tables = {{.points = {{0.0, 0.5}}}},
                       .table_of_stage = std::vector<Index>(run.model.stages.size(), 0),
                       .wet_law = std::vector<std::uint8_t>(run.model.joints.laws.size(), 1),
                       .drawn = std::vector<Vec2>(run.model.user_number.size(), Vec2(0.0, 0.0))};
    run.model.histories.push_back({.name = "gauge", .point = Vec2(0.0, 0.0), .quantities = point_history_quantities()});
    RunRecorder recorder(folder.path(), run.model, some_provenance());
    recorder.observe(run.model, run.state);
    show(run, recorder, 20);
    run.state.blocks.present[1] = 0;
    test::load_contact(run, 0, 0.0, 0.0, Regime::open);  // a frame without contacts
    show(run, recorder, 40);
    recorder.finish(run.model, run.state);
    RunRecord record;
    record.files = {{"a.wkt", "# none"}};
    record.history_axes = recorder.history_axes();
    run.state.rebuilt_at = run.state.blocks.motion;
    run.state.stages_done = {{.cycles = 7, .at_rest = false}};
    run.state.not_at_rest = {{.stage = 0, .block = 1}};
    run.state.statics = {{.stage = 0}};
    run.state.came_loose = {{.stage = 0, .block = 2}};
    run.state.water.assign(run.state.blocks.present.size(), {});
    write_checkpoint(folder.path(), record, run.model, run.state);
    const std::string source = HDEM_SOURCE_DIR;
    const std::string command = "/usr/bin/python3 " + source + "/verification/unit/io/check_results.py " + source +
                                "/io/hdf5_format.md " + folder.path().string() + " > " + (folder / "log").string() + " 2>&1";
    EXPECT_EQ(std::system(command.c_str()), 0) << test::text_in(folder / "log");
}

TEST(RunRecorder, RestartKeepsWhatLedToIt)
{
    const ScratchFolder folder("recorder_restart");
    SmallRun run = run_with_histories();
    {
        RunRecorder recorder(folder.path(), run.model, some_provenance());
        recorder.observe(run.model, run.state);
        show(run, recorder, 60);
        recorder.end_stage(run.model, run.state);
        recorder.save();
    }
    run.state.cycle = 40;
    RunRecorder recorder(folder.path(), run.model, some_provenance(), run.state, {});
    recorder.begin_stage(run.model, run.state);
    EXPECT_THAT(Hdf5Reader(folder / "results.h5").read<std::int64_t>("/frames/cycle", {any_extent}), ElementsAre(0, 20, 40));
    EXPECT_FALSE(std::filesystem::exists(folder / "frames/blocks_000003.hdf")) << "of cycle 60";
    show(run, recorder, 50);
    recorder.finish(run.model, run.state);
    const Hdf5Reader in(folder / "results.h5");
    EXPECT_THAT(in.read<std::int64_t>("/energy/cycle", {any_extent}), ElementsAre(0, 10, 20, 30, 40, 50));
    EXPECT_EQ(in.read<double>("/history/block/speed", {any_extent}).size(), 26U);
    EXPECT_THAT(in.read<std::int64_t>("/frames/cycle", {any_extent}), ElementsAre(0, 20, 40, 50));
}

/// While two blocks are apart, a history counts along the normal they had: a checkpoint must not forget it.
TEST(RunRecorder, RestartKeepsTheAxesOfHistories)
{
    const ScratchFolder folder("recorder_axes");
    std::vector<std::vector<double>> sheared;
    for (const bool restarted : {false, true})
    {
        SmallRun run = run_with_histories();
        auto recorder = std::make_unique<RunRecorder>(folder.path(), run.model, some_provenance());
        recorder->observe(run.model, run.state);
        recorder->save();
        test::load_contact(run, 0, 0.0, 0.0, Regime::open);
        run.state.blocks.motion[2].x += 0.3;  // the line of centroids is no longer that normal
        if (restarted)
        {
            const std::vector<Vec2> axes = recorder->history_axes();
            recorder = std::make_unique<RunRecorder>(folder.path(), run.model, some_provenance(), run.state, axes);
            recorder->begin_stage(run.model, run.state);
        }
        show(run, *recorder, 20);
        recorder->finish(run.model, run.state);
        sheared.push_back(Hdf5Reader(folder / "results.h5").read<double>("/history/contact/shear_displacement", {any_extent}));
    }
    EXPECT_NEAR(sheared[0].back(), 0.3, 1e-12);
    EXPECT_EQ(sheared[1], sheared[0]);
}

/// A run that blew up leaves a picture of that moment.
TEST(RunRecorder, WritesAStateThatIsNotFinite)
{
    const ScratchFolder folder("recorder_not_finite");
    SmallRun run = run_with_histories();
    RunRecorder recorder(folder.path(), run.model, some_provenance());
    recorder.observe(run.model, run.state);
    run.state.cycle = 15;
    run.state.blocks.motion[2].x = std::numeric_limits<double>::quiet_NaN();
    run.state.blocks.motion[2].vx = std::numeric_limits<double>::infinity();
    recorder.finish(run.model, run.state);
    EXPECT_THAT(Hdf5Reader(folder / "results.h5").read<std::int64_t>("/frames/cycle", {any_extent}), ElementsAre(0, 15));
    EXPECT_EQ(Hdf5Reader(folder / "frames/blocks_000001.hdf").attribute<std::int64_t>("/hdem", "cycle", {}).front(), 15);
}

TEST(RunRecorder, RefusesHistoriesThatCannotBeGroups)
{
    const ScratchFolder folder("recorder_names");
    for (const char* name : {"a/b", ".", "", "block"})
    {
        SmallRun run = run_with_histories();
        run.model.histories[0].name = name;
        EXPECT_THROW(RunRecorder(folder.path(), run.model, some_provenance()), InputError) << name;
    }
}

/// An older hdem did not know a column: its rows stay, without that number.
TEST(ResultsWriter, TakesOverRowsThatLackAColumn)
{
    const ScratchFolder folder("results_columns");
    {
        ResultsWriter older(folder / "results.h5", some_provenance());
        const std::size_t table = older.add_table("/energy", {{"old", "J"}});
        for (const std::int64_t cycle : {0, 10, 20})
            older.add_row(table, cycle, 0.1 * static_cast<double>(cycle), std::vector<double>{static_cast<double>(cycle)});
        older.write({}, {});
    }
    ResultsWriter now(folder / "results.h5", some_provenance());
    now.add_table("/energy", {{"new", "J"}, {"old", "J"}});
    now.take_over_rows(10);
    const Table& rows = now.tables().front();
    EXPECT_EQ(rows.cycle, (std::vector<std::int64_t>{0, 10}));
    ASSERT_EQ(rows.values[1].size(), 2U);
    EXPECT_EQ(rows.values[1], (std::vector<double>{0.0, 10.0}));
    ASSERT_EQ(rows.values[0].size(), 2U);
    EXPECT_TRUE(std::isnan(rows.values[0][0]) && std::isnan(rows.values[0][1]));
}

/// Another process writes without pause and is killed at any moment: what is on the disk is whole each time. The first three may be killed before
/// there is a file; then one is waited for, however slow the machine is.
TEST(ResultsWriter, FileIsWholeWheneverTheRunIsKilled)
{
    const ScratchFolder folder("results_killed");
    const std::filesystem::path file = folder / "results.h5";
    int seen = 0;
    for (int kill_number = 0; kill_number < 20; ++kill_number)
    {
        const pid_t child = fork();
        if (child == 0)
        {
            SmallRun run = run_with_histories();
            FrameWriter frames(folder.path(), run.model);
            ResultsWriter results(file, some_provenance());
            const std::size_t table = results.add_table("/energy", {{"cycle_again", "1"}});
            for (std::int64_t cycle = 0;; ++cycle)
            {
                for (int i = 0; i < 500; ++i)
                    results.add_row(table, 500 * cycle + i, 0.0, std::vector<double>{static_cast<double>(500 * cycle + i)});
                frames.write(run.model, run.state);
                results.write(frames.frames(), frames.kinds());
            }
        }
        for (int waited = 0; kill_number >= 3 && waited < 6000 && !std::filesystem::exists(file); ++waited)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        std::this_thread::sleep_for(std::chrono::milliseconds(40 + 13 * kill_number));
        kill(child, SIGKILL);
        waitpid(child, nullptr, 0);
        if (!std::filesystem::exists(file))
            continue;
        ++seen;
        const Hdf5Reader in(file);
        const auto cycle = in.read<std::int64_t>("/energy/cycle", {any_extent});
        const auto again = in.read<double>("/energy/cycle_again", {cycle.size()});
        EXPECT_EQ(cycle.size() % 500, 0U);
        EXPECT_TRUE(std::equal(cycle.begin(), cycle.end(), again.begin(),
                               [](std::int64_t a, double b) { return static_cast<double>(a) == b; }));
    }
    EXPECT_GE(seen, 17);
}
}  // namespace
}  // namespace hdem
