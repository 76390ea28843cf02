#include "io/frame_writer.h"
#include "io/hdf5_reader.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace hdem
{
namespace
{
using test::ScratchFolder;
using test::SmallRun;
using test::text_in;
using testing::ElementsAre;
using testing::FloatEq;
using testing::HasSubstr;
using testing::Not;
using testing::Pointwise;

constexpr Index l = 1;
constexpr Index block = 2;

TEST(BlockFrame, HasOneCellAPartInTheUsersOrderAndCoordinates)
{
    const ScratchFolder folder("frame_cells");
    const SmallRun run = test::small_run();
    write_block_frame(folder / "blocks_000000.hdf", run.model, run.state);
    const Hdf5Reader in(folder / "blocks_000000.hdf");
    EXPECT_THAT(in.read<std::int32_t>("/VTKHDF/CellData/id", {any_extent}), ElementsAre(0, 1, 2, 2));
    EXPECT_THAT(in.read<std::int64_t>("/VTKHDF/Offsets", {5}), ElementsAre(0, 4, 8, 13, 17));
    EXPECT_THAT(in.read<std::uint8_t>("/VTKHDF/Types", {4}), ElementsAre(7, 7, 7, 7));
    EXPECT_THAT(in.read<std::uint8_t>("/VTKHDF/CellData/fixed", {4}), ElementsAre(1, 0, 0, 0));
    EXPECT_THAT(in.read<std::int32_t>("/VTKHDF/CellData/material", {4}), ElementsAre(1, 0, 0, 0));
    EXPECT_THAT(in.read_texts("/hdem/names"), ElementsAre("ground", "block", "l"));
    const auto points = in.read<double>("/VTKHDF/Points", {17, 3});
    EXPECT_NEAR(points[0], 99.0, 1e-12);
    EXPECT_NEAR(points[1], 199.0, 1e-12);
    EXPECT_NEAR(points[3 * 4], 100.0, 1e-12) << "the block, which is stored last, comes second";
    const auto outer = in.read<std::uint8_t>("/hdem/outer_edge", {17});
    EXPECT_EQ(std::count(outer.begin(), outer.end(), 0), 2) << "both sides of the edge inside the l";
    EXPECT_EQ(in.attribute<std::int64_t>("/hdem", "cycle", {}).front(), 7);
    EXPECT_EQ(in.text("/hdem", "stage"), "rest");
}

TEST(BlockFrame, ValuesAreThoseOfTheState)
{
    const ScratchFolder folder("frame_values");
    SmallRun run = test::small_run();
    BlockMotion& m = run.state.blocks.motion[block];
    m.x += 0.25;
    m.y -= 0.5;
    m.vx = 3.0;
    m.vy = -4.0;
    m.w = 2.0;
    m.angle = 0.125;
    run.state.blocks.force[block].contacts = contact_force;
    run.state.blocks.force[l].contacts = contact_force | contact_impulse;
    run.state.next_to_excavation = {l};
    test::load_contact(run, 0, 1e5, 0.0, Regime::stick);
    write_block_frame(folder / "b.hdf", run.model, run.state);
    const Hdf5Reader in(folder / "b.hdf");
    const auto floats = [&](const std::string& name) { return in.read<float>("/VTKHDF/CellData/" + name, {4}); };
    const auto bytes = [&](const std::string& name) { return in.read<std::uint8_t>("/VTKHDF/CellData/" + name, {4}); };
    const auto displacement = in.read<float>("/VTKHDF/CellData/displacement", {4, 3});
    EXPECT_FLOAT_EQ(displacement[3], 0.25f);
    EXPECT_FLOAT_EQ(displacement[4], -0.5f);
    EXPECT_FLOAT_EQ(displacement[5], 0.0f);
    EXPECT_THAT(floats("speed"), Pointwise(FloatEq(), {0.0f, 5.0f, 0.0f, 0.0f}));
    EXPECT_THAT(floats("rotation"), Pointwise(FloatEq(), {0.0f, 0.125f, 0.0f, 0.0f}));
    EXPECT_THAT(floats("angular_velocity"), Pointwise(FloatEq(), {0.0f, 2.0f, 0.0f, 0.0f}));
    EXPECT_THAT(floats("kinetic_energy"), Pointwise(FloatEq(), {0.0f, 34650.0f, 0.0f, 0.0f}));
    EXPECT_THAT(bytes("regime"), ElementsAre(0, 1, 2, 2));
    EXPECT_THAT(bytes("detached"), ElementsAre(0, 1, 0, 0)) << "farther than detached_distance = 0.1 m";
    EXPECT_THAT(bytes("next_to_excavation"), ElementsAre(0, 0, 1, 1));
    EXPECT_GT(floats("stress_yy")[1], 0.0f) << "compression is positive";
}

TEST(BlockFrame, TurnsVerticesWithTheirBlock)
{
    const ScratchFolder folder("frame_pose");
    SmallRun run = test::small_run();
    BlockMotion& m = run.state.blocks.motion[block];
    m.c = 0.0;
    m.s = 1.0;
    write_block_frame(folder / "b.hdf", run.model, run.state);
    const auto points = Hdf5Reader(folder / "b.hdf").read<double>("/VTKHDF/Points", {17, 3});
    EXPECT_NEAR(points[3 * 4], 101.0, 1e-12) << "the lower left corner, turned by 90 degrees about the centroid";
    EXPECT_NEAR(points[3 * 4 + 1], 200.0, 1e-12);
}

TEST(BlockFrame, LeavesOutExcavatedBlocksAndDrawsTheirOutline)
{
    const ScratchFolder folder("frame_excavated");
    SmallRun run = test::small_run();
    run.state.blocks.present[l] = 0;
    write_block_frame(folder / "b.hdf", run.model, run.state);
    const Hdf5Reader in(folder / "b.hdf");
    EXPECT_THAT(in.read<std::int32_t>("/VTKHDF/CellData/id", {any_extent}), ElementsAre(0, 1));
    EXPECT_THAT(in.read<std::int32_t>("/hdem/block_id", {any_extent}), ElementsAre(0, 1));
    EXPECT_EQ(in.read_texts("/hdem/names").size(), 3U) << "ids keep their names";
    const auto segments = in.read<double>("/hdem/outline_segments", {any_extent, 2, 2});
    double length = 0.0;
    for (std::size_t i = 0; i < segments.size(); i += 4)
        length += std::hypot(segments[i + 2] - segments[i], segments[i + 3] - segments[i + 1]);
    EXPECT_NEAR(length, 8.0, 1e-12) << "of the l, without the edge inside it";
}

/// A wall is not there in stages in which its side does not act: nothing was excavated.
TEST(BlockFrame, DrawsNoOutlineOfWallsThatDoNotAct)
{
    const ScratchFolder folder("frame_wall");
    SmallRun run = test::small_run();
    run.state.blocks.present[l] = 0;
    run.model.mass[l] = 0.0;
    write_block_frame(folder / "b.hdf", run.model, run.state);
    EXPECT_THAT(Hdf5Reader(folder / "b.hdf").read<double>("/hdem/outline_segments", {any_extent, 2, 2}), testing::IsEmpty());
}

TEST(ContactFrame, HasALineForEachClosedContact)
{
    const ScratchFolder folder("frame_contacts");
    SmallRun run = test::small_run();
    run.state.blocks.motion[block].y -= 1e-5;
    run.state.blocks.motion[block].x += 1.5;  // it hangs half over the ground's end
    write_contact_frame(folder / "none.hdf", run.model, run.state);
    EXPECT_TRUE(Hdf5Reader(folder / "none.hdf").read<double>("/VTKHDF/Points", {any_extent, 3}).empty());

    test::load_contact(run, 0, 3e4, -4e4, Regime::slip);
    write_contact_frame(folder / "one.hdf", run.model, run.state);
    const Hdf5Reader in(folder / "one.hdf");
    const auto value = [&](const std::string& name) { return in.read<float>("/VTKHDF/CellData/" + name, {1}).front(); };
    EXPECT_THAT(in.read<std::int32_t>("/VTKHDF/CellData/blocks", {1, 2}), ElementsAre(0, 1)) << "in the user's numbers";
    EXPECT_THAT(in.read<float>("/VTKHDF/CellData/normal", {1, 3}), ElementsAre(FloatEq(0.0f), FloatEq(1.0f), 0.0f));
    EXPECT_FLOAT_EQ(value("normal_force"), 3e4f);
    EXPECT_FLOAT_EQ(value("shear_force"), -4e4f);
    EXPECT_EQ(value("tilt_force"), 0.0f);
    EXPECT_FLOAT_EQ(value("normal_stress"), 6e4f) << "half a metre long";
    EXPECT_FLOAT_EQ(value("shear_stress"), -8e4f);
    EXPECT_FLOAT_EQ(value("traction"), 1e5f);
    EXPECT_NEAR(value("length"), 0.5f, 1e-6f);
    EXPECT_NEAR(value("overlap"), 1e-5f, 1e-10f);
    EXPECT_FLOAT_EQ(value("slip"), 1.5f) << "against the shear axis, which points to the left";
    EXPECT_THAT(in.read<std::uint8_t>("/VTKHDF/CellData/regime", {1}), ElementsAre(2));
    const auto points = in.read<double>("/VTKHDF/Points", {2, 3});
    EXPECT_NEAR(points[0], 102.0, 1e-9);
    EXPECT_NEAR(points[1], 200.0 - 0.5e-5, 1e-9);
    EXPECT_NEAR(points[3], 101.5, 1e-9);
}

/// A block that turns about its contact does not slip there, though its centroid moves along the contact.
TEST(ContactFrame, SlipIsThatOfTheContactNotOfTheCentroids)
{
    const ScratchFolder folder("frame_slip");
    SmallRun run = test::small_run();
    const double turn = 1e-4;
    BlockMotion& m = run.state.blocks.motion[block];
    const Vec2 middle = {m.x, m.y - 0.5};
    const Vec2 arm = Vec2(m.x, m.y) - middle;
    m.c = std::cos(turn);
    m.s = std::sin(turn);
    m.angle += turn;
    m.x = middle.x() + m.c * arm.x() - m.s * arm.y();
    m.y = middle.y() + m.s * arm.x() + m.c * arm.y();
    test::load_contact(run, 0, 3e4, -4e4, Regime::stick);
    write_contact_frame(folder / "one.hdf", run.model, run.state);
    EXPECT_NEAR(Hdf5Reader(folder / "one.hdf").read<float>("/VTKHDF/CellData/slip", {1}).front(), 0.0f, 1e-8f);
    EXPECT_NEAR(run.state.blocks.displacement(block).x(), -0.5 * turn, 1e-8) << "the centroid moved all the same";
}

TEST(FrameWriter, SeriesNamesTheFramesWithTheirTimes)
{
    const ScratchFolder folder("frame_series");
    SmallRun run = test::small_run();
    FrameWriter writer(folder.path(), run.model);
    writer.write(run.model, run.state);
    run.state.time = 0.25;
    EXPECT_EQ(writer.write(run.model, run.state).number, 1);
    writer.write_series();
    for (const std::string kind : {"blocks", "contacts"})
    {
        const auto series = nlohmann::json::parse(text_in(folder / (kind + ".hdf.series")));
        EXPECT_EQ(series["file-series-version"], "1.0");
        ASSERT_EQ(series["files"].size(), 2U);
        EXPECT_EQ(series["files"][1]["name"], "frames/" + kind + "_000001.hdf");
        EXPECT_EQ(series["files"][1]["time"], 0.25);
        EXPECT_TRUE(std::filesystem::exists(folder / series["files"][1]["name"]));
    }
}

TEST(FrameWriter, WritesNoContactsWhenTheCaseSaysSo)
{
    const ScratchFolder folder("frame_no_contacts");
    SmallRun run = test::small_run();
    run.model.output.contacts = false;
    FrameWriter writer(folder.path(), run.model);
    writer.write(run.model, run.state);
    writer.write_series();
    EXPECT_TRUE(std::filesystem::exists(folder / "frames/blocks_000000.hdf"));
    EXPECT_FALSE(std::filesystem::exists(folder / "frames/contacts_000000.hdf"));
    EXPECT_FALSE(std::filesystem::exists(folder / "contacts.hdf.series"));
}

/// A new run must not leave frames of an older one behind that look like its own; a restart keeps those that led to it.
TEST(FrameWriter, NewRunsRemoveOldFramesAndRestartsKeepThem)
{
    const ScratchFolder folder("frame_again");
    SmallRun run = test::small_run();
    {
        FrameWriter writer(folder.path(), run.model);
        for (const std::int64_t cycle : {0, 10, 20})
        {
            run.state.cycle = cycle;
            writer.write(run.model, run.state);
        }
    }
    std::ofstream(folder / "frames/notes_000000.hdf") << "the user's own";
    run.state.cycle = 10;
    EXPECT_EQ(FrameWriter(folder.path(), run.model, run.state).frames().size(), 1U) << "of an interruption";
    run.model.output.frame_every = 10;
    FrameWriter restarted(folder.path(), run.model, run.state);
    ASSERT_EQ(restarted.frames().size(), 2U);
    EXPECT_THAT(test::text_in(folder / "blocks.hdf.series"), Not(HasSubstr("blocks_000002.hdf")));
    EXPECT_TRUE(std::filesystem::exists(folder / "frames/blocks_000002.hdf")) << "results.h5 may still name it";
    restarted.remove_younger_frames();
    EXPECT_FALSE(std::filesystem::exists(folder / "frames/blocks_000002.hdf"));
    run.state.cycle = 15;
    EXPECT_EQ(restarted.write(run.model, run.state).number, 2);

    FrameWriter anew(folder.path(), run.model);
    EXPECT_TRUE(anew.frames().empty());
    EXPECT_FALSE(std::filesystem::exists(folder / "frames/blocks_000000.hdf"));
    EXPECT_TRUE(std::filesystem::exists(folder / "frames/notes_000000.hdf"));
}

/// Frames younger than the checkpoint may be empty after a power failure; that must not keep a run from going on.
TEST(FrameWriter, RestartRemovesDamagedYoungerFramesAndLeavesOlderOnes)
{
    const ScratchFolder folder("frame_damaged");
    SmallRun run = test::small_run();
    FrameWriter before(folder.path(), run.model);
    for (run.state.cycle = 0; run.state.cycle < 30; run.state.cycle += 10)
        before.write(run.model, run.state);
    std::ofstream(folder / "frames/blocks_000001.hdf") << "half a fr";
    std::ofstream(folder / "frames/blocks_000003.hdf") << "";
    std::ofstream(folder / "frames/contacts_000003.hdf") << "half a fr";
    FrameWriter restarted(folder.path(), run.model, run.state);
    EXPECT_EQ(restarted.frames().size(), 2U);
    EXPECT_THAT(text_in(folder / "blocks.hdf.series"), Not(HasSubstr("000001")));
    restarted.remove_younger_frames();
    EXPECT_FALSE(std::filesystem::exists(folder / "frames/blocks_000003.hdf"));
    EXPECT_FALSE(std::filesystem::exists(folder / "frames/contacts_000003.hdf"));
    EXPECT_TRUE(std::filesystem::exists(folder / "frames/blocks_000001.hdf")) << "not this restart's to remove";
    EXPECT_TRUE(std::filesystem::exists(folder / "frames/blocks_000002.hdf"));
    EXPECT_EQ(restarted.write(run.model, run.state).number, 3);
}
}  // namespace
}  // namespace hdem
