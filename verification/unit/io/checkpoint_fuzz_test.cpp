/// Checkpoints that somebody else has changed. HDEM_FUZZ_FILES=100000 makes the test as long as one likes.

#include "io/checkpoint.h"
#include "io/load_case.h"
#include "parallel/simulation.h"
#include "verification/unit/io/checkpoint_subjects.h"
#include "verification/unit/io/hdf5_mutator.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>
#include <hdf5.h>

namespace hdem
{
namespace
{
using test::case_of_checkpoints;
using test::CheckpointSubject;
using test::files_to_try;
using test::Hdf5Mutator;
using test::ScratchFolder;
using test::write_bytes;
namespace fs = std::filesystem;

fs::path sound_checkpoint(const fs::path& folder, const std::string& text = case_of_checkpoints)
{
    const LoadedCase loaded = load_case(text, {}, "case.toml", {});
    Simulation simulation(loaded.setup.model, loaded.setup.state);
    simulation.begin_stage(0);
    simulation.advance(100);
    simulation.note_outcome({.cycles = simulation.state().cycle}, {2});
    simulation.begin_stage(1);
    simulation.advance(20);
    RunRecord record;
    record.case_text = text;
    record.begin = "now";
    record.history_axes = {{0.0, 1.0}};
    write_checkpoint(folder, record, simulation.model(), simulation.state());
    return checkpoint_file(folder);
}

/// As `hdem run --restart` does it. True when the file was accepted; then its state must be fit to run.
bool goes_on(const fs::path& file)
{
    try
    {
        const CheckpointReader reader(file);
        LoadedCase loaded = load_case(reader.record().case_text, reader.record().files, "case.toml", {});
        State state = reader.state(loaded.setup.model);
        Simulation simulation(std::move(loaded.setup.model), std::move(state));
        simulation.advance(3);
        simulation.check_state();
        return true;
    }
    catch (const InputError& error)
    {
        EXPECT_FALSE(error.problems().empty() || error.problems().front().text.empty());
    }
    catch (const RunError& error)
    {
        EXPECT_THAT(error.what(), testing::HasSubstr("cycle ")) << "only the motion itself may fail after a file was accepted";
    }
    return false;
}

const Hdf5Mutator::Targets targets = {.datasets = {"/blocks/user_number",
                                                   "/blocks/motion",
                                                   "/blocks/rebuilt_at",
                                                   "/blocks/force",
                                                   "/blocks/joint_use",
                                                   "/blocks/contact_kinds",
                                                   "/blocks/inverse_inertia",
                                                   "/blocks/present",
                                                   "/blocks/reference_position",
                                                   "/contacts/features",
                                                   "/contacts/swapped",
                                                   "/contacts/stale",
                                                   "/contacts/regime",
                                                   "/contacts/edges",
                                                   "/contacts/seen",
                                                   "/contacts/length",
                                                   "/contacts/point_0",
                                                   "/state/stages_done",
                                                   "/state/stages_ended",
                                                   "/state/not_at_rest",
                                                   "/state/statics",
                                                   "/state/statics_residual",
                                                   "/state/came_loose",
                                                   "/run/history_axes",
                                                   "/case/text"},
                                      .attributes = {"/state@cycle", "/state@time", "/state@stage", "/state@stage_begun",
                                                     "/state@stage_begin_cycle", "/state@method", "/state@damping",
                                                     "/state@excavation_cycle", "/state@contacts_outdated"}};

Hdf5Mutator::Targets targets_of(const CheckpointSubject& subject)
{
    Hdf5Mutator::Targets all = targets;
    all.datasets.insert(all.datasets.end(), subject.more.begin(), subject.more.end());
    return all;
}

class CheckpointReaders : public testing::TestWithParam<CheckpointSubject>
{
};

TEST_P(CheckpointReaders, AcceptTheSoundFileOfTheMutationTests)
{
    const ScratchFolder folder("fuzz_sound");
    const fs::path file = sound_checkpoint(folder.path(), GetParam().text);
    EXPECT_TRUE(goes_on(file));
    const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    for (const std::string& path : targets_of(GetParam()).datasets)
    {
        const hid_t dataset = H5Dopen2(id, path.c_str(), H5P_DEFAULT);
        EXPECT_GE(dataset, 0) << path;
        const hid_t space = H5Dget_space(dataset);
        EXPECT_TRUE(std::ranges::find(GetParam().more, path) == GetParam().more.end() || H5Sget_simple_extent_npoints(space) > 0)
            << path << " is empty: nothing in it can be changed";
        H5Sclose(space);
        H5Dclose(dataset);
    }
    H5Fclose(id);
}

TEST_P(CheckpointReaders, SurviveRandomBytes)
{
    const ScratchFolder folder("fuzz_bytes");
    const std::string sound = test::text_in(sound_checkpoint(folder.path(), GetParam().text));
    Hdf5Mutator mutator(11);
    int accepted = 0;
    const int files = files_to_try(400);
    for (int i = 0; i < files; ++i)
    {
        write_bytes(folder / "mutated.h5", mutator.changed_bytes(sound));
        accepted += goes_on(folder / "mutated.h5") ? 1 : 0;
    }
    EXPECT_LT(accepted, files) << "no edit did any harm";
}

TEST_P(CheckpointReaders, SurviveObjectsThatDoNotFit)
{
    const ScratchFolder folder("fuzz_objects");
    const std::string sound = test::text_in(sound_checkpoint(folder.path(), GetParam().text));
    const Hdf5Mutator::Targets all = targets_of(GetParam());
    Hdf5Mutator mutator(12);
    int accepted = 0;
    const int files = files_to_try(400);
    for (int i = 0; i < files; ++i)
    {
        write_bytes(folder / "mutated.h5", sound);
        mutator.change_object(folder / "mutated.h5", all);
        accepted += goes_on(folder / "mutated.h5") ? 1 : 0;
    }
    EXPECT_LT(accepted, files / 2) << "most changes should be found out";
}

INSTANTIATE_TEST_SUITE_P(Cases, CheckpointReaders, testing::ValuesIn(test::checkpoint_subjects()),
                         [](const auto& subject) { return subject.param.name; });

std::string refusal_of(const fs::path& file)
{
    try
    {
        const CheckpointReader reader(file);
        LoadedCase loaded = load_case(case_of_checkpoints, {}, "case.toml", {});
        return reader.state(loaded.setup.model).cycle > 0 ? "accepted" : "";
    }
    catch (const InputError& error)
    {
        return error.what();
    }
}

TEST(CheckpointReader, FollowsNoLinkToAnotherFile)
{
    const ScratchFolder folder("checkpoint_link");
    const fs::path file = sound_checkpoint(folder.path());
    const fs::path other = folder / "other.h5";
    fs::copy_file(file, other);
    ASSERT_EQ(refusal_of(file), "accepted");
    const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(id, "/blocks/motion", H5P_DEFAULT);
    H5Lcreate_external(other.c_str(), "/blocks/motion", id, "/blocks/motion", H5P_DEFAULT, H5P_DEFAULT);
    H5Fclose(id);
    EXPECT_THAT(refusal_of(file), testing::HasSubstr("/blocks/motion: cannot be read (not in this file)"));
}

/// HDF5 can keep the elements of a dataset in any file, at any place.
TEST(CheckpointReader, ReadsNoElementsFromAnotherFile)
{
    const ScratchFolder folder("checkpoint_external");
    const fs::path file = sound_checkpoint(folder.path());
    write_bytes(folder / "secret", std::string(4096, 's'));
    const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    Hdf5Mutator::store_elsewhere(id, "/blocks/present", folder / "secret");
    H5Fclose(id);
    EXPECT_THAT(refusal_of(file), testing::HasSubstr("/blocks/present: cannot be read (its elements are not in this file)"));
}

TEST(CheckpointReader, RefusesAnotherVersionAndAnotherModel)
{
    const ScratchFolder folder("checkpoint_version");
    const fs::path file = sound_checkpoint(folder.path());
    const auto change = [&](const char* name, std::vector<std::int64_t> values)
    {
        const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        const hid_t attribute = H5Aopen(id, name, H5P_DEFAULT);
        H5Awrite(attribute, H5T_NATIVE_INT64, values.data());
        H5Aclose(attribute);
        H5Fclose(id);
    };
    change("version", {2, 77});
    EXPECT_THAT(refusal_of(file), testing::HasSubstr("version = 2.77 (this hdem"));
    change("version", {3, 0});
    EXPECT_THAT(refusal_of(file), testing::HasSubstr("version = 3.0 (this hdem"));
    change("version", {2, 7});
    EXPECT_THAT(refusal_of(file), testing::HasSubstr("version = 2.7 (this hdem"));
    change("version", {2, 8});
    EXPECT_EQ(refusal_of(file), "accepted");
    change("model_hash", {5});
    EXPECT_THAT(refusal_of(file), testing::HasSubstr("Go on with the hdem that wrote it"));
}
}  // namespace
}  // namespace hdem
