/// Checkpoints that somebody else has changed. HDEM_FUZZ_FILES=100000 makes the test as long as one likes.

#include "io/checkpoint.h"
#include "io/load_case.h"
#include "parallel/simulation.h"
#include "verification/unit/io/hdf5_mutator.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>
#include <hdf5.h>

namespace hdem
{
namespace
{
using test::files_to_try;
using test::Hdf5Mutator;
using test::ScratchFolder;
using test::write_bytes;
namespace fs = std::filesystem;

constexpr const char* case_text = R"(
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 30.0
[time]
step = 1e-4
[[block]]
name = "ground"
polygon = [[-1, -1], [9, -1], [9, 0], [-1, 0]]
fixed = true
[[block]]
name = "sledge"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
velocity = [1, 0]
[[block]]
name = "rider"
polygon = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[block]]
name = "prop"
polygon = [[6, 0], [7, 0], [7, 1], [6, 1]]
[[stage]]
cycles = 100
[[stage]]
excavate = ["prop"]
cycles = 100
[[history]]
between = ["ground", "sledge"]
quantities = ["normal_force"]
)";

fs::path sound_checkpoint(const fs::path& folder)
{
    const LoadedCase loaded = load_case(case_text, {}, "case.toml", {});
    Simulation simulation(loaded.setup.model, loaded.setup.state);
    simulation.begin_stage(0);
    simulation.advance(100);
    simulation.note_outcome({.cycles = simulation.state().cycle}, {2});
    simulation.begin_stage(1);
    simulation.advance(20);
    RunRecord record;
    record.case_text = case_text;
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

TEST(CheckpointReader, AcceptsTheSoundFileOfTheMutationTests)
{
    const ScratchFolder folder("fuzz_sound");
    EXPECT_TRUE(goes_on(sound_checkpoint(folder.path())));
}

TEST(CheckpointReader, SurvivesRandomBytes)
{
    const ScratchFolder folder("fuzz_bytes");
    const std::string sound = test::text_in(sound_checkpoint(folder.path()));
    Hdf5Mutator mutator(11);
    int accepted = 0;
    const int files = files_to_try(600);
    for (int i = 0; i < files; ++i)
    {
        write_bytes(folder / "mutated.h5", mutator.changed_bytes(sound));
        accepted += goes_on(folder / "mutated.h5") ? 1 : 0;
    }
    EXPECT_LT(accepted, files) << "no edit did any harm";
}

TEST(CheckpointReader, SurvivesObjectsThatDoNotFit)
{
    const ScratchFolder folder("fuzz_objects");
    const std::string sound = test::text_in(sound_checkpoint(folder.path()));
    Hdf5Mutator mutator(12);
    int accepted = 0;
    const int files = files_to_try(600);
    for (int i = 0; i < files; ++i)
    {
        write_bytes(folder / "mutated.h5", sound);
        mutator.change_object(folder / "mutated.h5", targets);
        accepted += goes_on(folder / "mutated.h5") ? 1 : 0;
    }
    EXPECT_LT(accepted, files / 2) << "most changes should be found out";
}

std::string refusal_of(const fs::path& file)
{
    try
    {
        const CheckpointReader reader(file);
        LoadedCase loaded = load_case(case_text, {}, "case.toml", {});
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
    change("version", {2, 4});
    EXPECT_EQ(refusal_of(file), "accepted");
    change("model_hash", {5});
    EXPECT_THAT(refusal_of(file), testing::HasSubstr("Go on with the hdem that wrote it"));
}
}  // namespace
}  // namespace hdem
