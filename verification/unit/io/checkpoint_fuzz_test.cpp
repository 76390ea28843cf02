/// Checkpoints that somebody else has changed. HDEM_FUZZ_FILES=100000 makes the test as long as one likes.

#include "io/checkpoint.h"
#include "io/load_case.h"
#include "parallel/simulation.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>
#include <hdf5.h>

#include <cstdlib>
#include <random>

namespace hdem
{
namespace
{
using test::ScratchFolder;
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
    simulation.note_outcome(false);
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

int files_to_try(int by_default)
{
    const char* const wanted = std::getenv("HDEM_FUZZ_FILES");
    return wanted != nullptr ? std::atoi(wanted) : by_default;
}

class Mutator
{
  public:
    explicit Mutator(std::uint64_t seed) : random_(seed) {}

    std::size_t below(std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random_() % n); }

    /// Bytes flipped, overwritten by numbers that hurt, or cut off.
    std::string changed_bytes(std::string bytes)
    {
        static const std::string tokens[] = {std::string(8, '\xff'), std::string(8, '\0'), std::string("\xff\xff\xff\x7f", 4),
                                             std::string("\0\0\0\0\0\0\xf8\x7f", 8), std::string(1, '\x80')};
        if (below(10) == 0)
            bytes.resize(below(bytes.size()));
        for (std::size_t edits = 1 + below(4); edits > 0 && !bytes.empty(); --edits)
        {
            const std::size_t at = below(bytes.size());
            const std::string& token = tokens[below(std::size(tokens))];
            if (below(2) == 0)
                bytes[at] = static_cast<char>(random_());
            else
                bytes.replace(at, std::min(token.size(), bytes.size() - at), token, 0, std::min(token.size(), bytes.size() - at));
        }
        return bytes;
    }

    /// One object changed through the library, so that every checksum is right.
    void change_object(const fs::path& file)
    {
        const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        static const std::vector<std::string> datasets = {
            "/blocks/user_number",        "/blocks/motion",        "/blocks/rebuilt_at",      "/blocks/force",
            "/blocks/joint_use",          "/blocks/contact_kinds", "/blocks/inverse_inertia", "/blocks/present",
            "/blocks/reference_position", "/contacts/features",    "/contacts/swapped",       "/contacts/stale",
            "/contacts/regime",           "/contacts/edges",       "/contacts/seen",          "/contacts/length",
            "/contacts/point_0",          "/state/stages_done",    "/run/history_axes",       "/case/text"};
        static const std::vector<std::string> attributes = {"cycle",
                                                            "time",
                                                            "stage",
                                                            "stage_begun",
                                                            "stage_begin_cycle",
                                                            "method",
                                                            "damping",
                                                            "excavation_cycle",
                                                            "contacts_outdated"};
        const std::string& path = datasets[below(datasets.size())];
        switch (below(6))
        {
        case 0:
            H5Ldelete(id, path.c_str(), H5P_DEFAULT);
            break;
        case 1:
            H5Ldelete(id, path.c_str(), H5P_DEFAULT);
            H5Lcreate_external("/etc/passwd", "/", id, path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
            break;
        case 2:
            replace_by_another_shape(id, path);
            break;
        case 3:
            change_attribute(id, attributes[below(attributes.size())]);
            break;
        default:
            change_element(id, path);
        }
        H5Fclose(id);
    }

  private:
    double number()
    {
        static const double numbers[] = {0.0,           1.0,          -1.0, 2.0,   3.0, 255.0,   1e9,
                                         -2147483648.0, 2147483647.0, 9e18, 1e308, NAN, INFINITY};
        return numbers[below(std::size(numbers))];
    }

    void change_element(hid_t file, const std::string& path)
    {
        if (path == "/case/text")
            return;  // case files have a test of their own
        const hid_t dataset = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
        const hid_t space = H5Dget_space(dataset);
        std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
        H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        if (!values.empty())
            values[below(values.size())] = number();
        H5Dwrite(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
        H5Sclose(space);
        H5Dclose(dataset);
    }

    void change_attribute(hid_t file, const std::string& name)
    {
        const double value = number();
        const hid_t attribute = H5Aopen_by_name(file, "/state", name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
        H5Awrite(attribute, H5T_NATIVE_DOUBLE, &value);
        H5Aclose(attribute);
    }

    /// The old type with other extents, nothing stored: a small file that claims much.
    void replace_by_another_shape(hid_t file, const std::string& path)
    {
        const hid_t old = H5Dopen2(file, path.c_str(), H5P_DEFAULT);
        const hid_t type = H5Dget_type(old);
        H5Dclose(old);
        H5Ldelete(file, path.c_str(), H5P_DEFAULT);
        const hsize_t extents[] = {1ULL << below(40), 1ULL << below(20), 1};
        const hsize_t chunk[] = {std::min<hsize_t>(extents[0], 1U << 16U), std::min<hsize_t>(extents[1], 1U << 10U), 1};
        const int rank = static_cast<int>(1 + below(3));
        const hid_t space = H5Screate_simple(rank, extents, nullptr);
        const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
        H5Pset_chunk(properties, rank, chunk);
        H5Dclose(H5Dcreate2(file, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT));
        H5Pclose(properties);
        H5Sclose(space);
        H5Tclose(type);
    }

    std::mt19937_64 random_;
};

void write_bytes(const fs::path& file, const std::string& bytes)
{
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

TEST(CheckpointReader, AcceptsTheSoundFileOfTheMutationTests)
{
    const ScratchFolder folder("fuzz_sound");
    EXPECT_TRUE(goes_on(sound_checkpoint(folder.path())));
}

TEST(CheckpointReader, SurvivesRandomBytes)
{
    const ScratchFolder folder("fuzz_bytes");
    const std::string sound = test::text_in(sound_checkpoint(folder.path()));
    Mutator mutator(11);
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
    Mutator mutator(12);
    int accepted = 0;
    const int files = files_to_try(600);
    for (int i = 0; i < files; ++i)
    {
        write_bytes(folder / "mutated.h5", sound);
        mutator.change_object(folder / "mutated.h5");
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

TEST(CheckpointReader, RefusesAnotherMajorVersionAndAnotherModel)
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
    change("version", {1, 77});
    EXPECT_EQ(refusal_of(file), "accepted") << "something was added that this program does not need";
    change("version", {2, 0});
    EXPECT_THAT(refusal_of(file), testing::HasSubstr("version = 2 (this hdem"));
    change("version", {1, 0});
    change("model_hash", {5});
    EXPECT_THAT(refusal_of(file), testing::HasSubstr("Go on with the hdem that wrote it"));
}
}  // namespace
}  // namespace hdem
