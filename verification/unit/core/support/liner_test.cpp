#include "core/support/bolt_link.h"
#include "core/support/liner_beam.h"
#include "core/support/liner_forces.h"
#include "io/case_reader.h"
#include "io/frame_writer.h"
#include "io/hdf5_reader.h"
#include "verification/unit/core/support/liner_scenes.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>

#include <numbers>

namespace hdem
{
namespace
{
using namespace test;

/// Two free blocks that move apart and turn, lined along their lower side; no gravity, no damping.
CaseDef flying_pair(const LinerDef& liner)
{
    CaseDef scene = scenes::empty_scene();
    scene.blocks = {
        {.name = "left", .polygon = {{-1, 0}, {0, 0}, {0, 1}, {-1, 1}}, .velocity = {-0.05, 0.01}, .angular_velocity = 0.03},
        {.name = "right", .polygon = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, .velocity = {0.05, -0.02}}};
    scene.gravity = {0.0, 0.0};
    scene.contact.method = Method::force;
    scene.damping.preset = DampingPreset::dynamic;
    scene.liners = {liner};
    scene.stages = {{.name = "fly", .cycles = 2000}};
    return scene;
}

TEST(Liners, KeepMomentumAndTheEnergyLedger)
{
    LinerDef light = lining();
    light.density = 1e-3;  // so that next to all momentum is that of the blocks
    CaseRun run(flying_pair(light));
    run.simulation.begin_stage(0);
    const Momentum before = momentum(run.model(), run.state().blocks);
    run.advance(2000);
    const Momentum after = momentum(run.model(), run.state().blocks);
    const LinerRecord& liner = run.state().support.liners[0];
    EXPECT_GT(run.state().support.liners[0].displacement, 1e-4);
    EXPECT_LT((after.linear - before.linear).norm(), 1e-3);
    EXPECT_NEAR(after.angular, before.angular, 1e-3 * std::abs(before.angular) + 1.0);
    EXPECT_LT(std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state()))), 1e-6);
    EXPECT_NEAR(-run.state().ledger.support, liner.stored + liner.spent, 0.05 * (liner.stored + liner.spent));
}

TEST(Liners, HaveNoForceWhenInstalledNorWhereNoBlockIsLeft)
{
    CaseDef scene = flying_pair(lining());
    scene.liners[0].stage = "hold";
    scene.stages = {{.name = "fly", .cycles = 200},
                    {.name = "hold", .cycles = 10},
                    {.name = "dig", .cycles = 10, .excavate = {"left", "right"}}};
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(200);
    EXPECT_EQ(run.state().support.liners[0].installed, 0);
    EXPECT_EQ(run.state().ledger.support, 0.0);
    run.simulation.begin_stage(1);
    LinerSolvers solvers;
    State state = run.state();
    std::vector<BlockPush> pushes;
    press_liners(run.model(), state, solvers, pushes);
    EXPECT_TRUE(pushes.empty());
    run.advance(10);
    EXPECT_NE(run.state().ledger.support, 0.0);
    run.simulation.begin_stage(2);
    const double work = run.state().ledger.support;
    run.advance(10);
    EXPECT_EQ(run.state().ledger.support, work);
    State after = run.state();
    pushes.clear();
    press_liners(run.model(), after, solvers, pushes);
    EXPECT_TRUE(pushes.empty());
}

TEST(Liners, AreInTheFrameOnceInstalled)
{
    const ScratchFolder folder("liner_frame");
    CaseDef scene = flying_pair(lining());
    scene.liners[0].stage = "hold";
    scene.stages = {{.name = "fly", .cycles = 200}, {.name = "hold", .cycles = 100}};
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(200);
    write_liner_frame(folder / "liners_000000.hdf", run.model(), run.state());
    EXPECT_TRUE(Hdf5Reader(folder / "liners_000000.hdf").read<std::int32_t>("/VTKHDF/CellData/liner", {any_extent}).empty());
    run.simulation.begin_stage(1);
    run.advance(100);
    write_liner_frame(folder / "liners_000001.hdf", run.model(), run.state());
    const Hdf5Reader in(folder / "liners_000001.hdf");
    EXPECT_THAT(in.read_texts("/hdem/liner_names"), testing::ElementsAre("liner"));
    const auto thrust = in.read<float>("/VTKHDF/CellData/thrust", {any_extent});
    ASSERT_EQ(thrust.size(), 20U) << "2 m in segments of 0.1 m";
    EXPECT_LT(*std::ranges::min_element(thrust), -1e3F) << "the blocks pull it apart in its middle";
    const auto points = in.read<double>("/VTKHDF/Points", {40, 3});
    const Blocks& blocks = run.state().blocks;
    const Vec2 corner = run.model().origin + Vec2(blocks.motion[1].x, blocks.motion[1].y) +
                        turned_with(blocks.motion[1], Vec2(0.5, -0.5));
    EXPECT_NEAR(points[0], corner.x(), 3e-4) << "it follows the rock behind it";
    EXPECT_NEAR(points[1], corner.y(), 3e-4);
    EXPECT_GT((corner - Vec2(1.0, 0.0)).norm(), 9e-4) << "it has come far enough to tell";
}

TEST(LinerBeam, StaysWithinItsStrengthsAndGivesItsTangents)
{
    const BeamLaw law{
        .axial = 1e6, .bending = 1e3, .compressive_strength = 500.0, .tensile_strength = 100.0, .moment_strength = 10.0};
    for (const double e : {-1e-3, -1e-4, 5e-5, 2e-3})
        for (const double first : {-0.01, -1e-3, 0.0, 2e-3, 0.02})
            for (const double second : {-0.015, -2e-3, 0.0, 1e-3, 0.01})
            {
                const BeamAnswer a = answer_of_beam(law, e, {first, second});
                EXPECT_GE(a.thrust, -500.0);
                EXPECT_LE(a.thrust, 100.0);
                for (int end = 0; end < 2; ++end)
                {
                    EXPECT_LE(std::abs(a.moment[end]), 10.0 * (1.0 + 1e-12));
                    EXPECT_GE(a.moment[end] * a.turned[end], 0.0) << "flow against the moment";
                }
                // What has not flowed is elastic.
                const double p = first - a.turned[0], q = second - a.turned[1];
                EXPECT_NEAR(a.moment[0], 1e3 * (4.0 * p + 2.0 * q), 1e-9);
                EXPECT_NEAR(a.moment[1], 1e3 * (2.0 * p + 4.0 * q), 1e-9);
                const double by = 1e-9;
                const BeamAnswer next = answer_of_beam(law, e, {first, second + by});
                if (next.flows == a.flows)
                {
                    EXPECT_NEAR((next.moment[1] - a.moment[1]) / by, a.bending[2], 1.0);
                    EXPECT_NEAR((next.stored + next.spent - a.stored - a.spent) / by, a.moment[1], 1e-3)
                        << "force is the slope of the energy";
                }
            }
}

TEST(Liners, KeepTheirForcesAsTheyHarden)
{
    LinerDef fresh = lining();
    fresh.hardening = {{{0.0, 0.1}, {400.0, 0.1}, {401.0, 1.0}}};
    fresh.density = 1e-3;
    CaseDef scene = flying_pair(fresh);
    CaseRun run(scene);
    run.simulation.begin_stage(0);
    run.advance(400);
    const double before = run.state().support.liners[0].moment;
    run.advance(2);
    EXPECT_GT(before, 0.0);
    EXPECT_NEAR(run.state().support.liners[0].moment, before, 0.1 * before) << "ten times as stiff";
}
/// Put on at once the weight would swing to twice itself.
TEST(Liners, HangByABondThatBearsTheirWeight)
{
    CaseRun holds(hanging(1.05)), falls(hanging(0.95));
    run_all(holds);
    run_all(falls);
    EXPECT_EQ(holds.state().support.liners[0].parted, 0.0);
    EXPECT_NEAR(falls.state().support.liners[0].parted, 2.0, 1e-9);
    EXPECT_LT(holds.state().support.liners[0].displacement, 1e-3);
    EXPECT_GT(falls.state().support.liners[0].displacement, 3e-2) << "when the stone is at rest";
}

/// An arc that begins at a corner leaves a piece of round-off before it.
TEST(Liners, HaveNoBeamOfRoundOff)
{
    CaseDef scene = hanging(1e3);
    scene.liners[0].path = {{1.0, 0.0}, {1.0 - 1e-14, 0.0}, {-1.0, 0.0}, {-1.0, 1e-15}};
    CaseRun run(scene);
    for (const LinerSegment& segment : run.model().support.liners[0].segments)
        EXPECT_GT(segment.length, 0.01);
    run_all(run);
    const double sag = run.model().support.liners[0].mass * 9.81 / 1e8;
    EXPECT_NEAR(run.state().support.liners[0].displacement, sag, 1e-3 * sag);
}

/// However long its beams may be: points of a path are its shape.
TEST(Liners, KeepThePointsOfTheirPath)
{
    CaseDef scene = hanging(1e3);
    scene.liners[0].path = {{1.0, 0.0}, {0.96, 0.0}, {0.92, 0.0}, {-0.95, 0.0}, {-1.0, 0.0}};
    scene.liners[0].segment = 10.0;
    const CaseRun run(scene);
    EXPECT_EQ(run.model().support.liners[0].nodes.size(), 5U);
}

TEST(Liners, InTheAirAreWarnedOf)
{
    for (const auto& [end, is_told] : {std::pair("0", false), std::pair("-0.05", true)})
    {
        const std::string text = std::string("[material.rock]\ndensity = 2700\n[joint.default]\nnormal_stiffness = 1e9\n"
                                             "shear_stiffness = 1e9\nfriction_angle_deg = 30\n"
                                             "[[block]]\nname = \"a\"\npolygon = [[-3, 0], [0, 0], [0, 1], [-3, 1]]\nfixed = true\n"
                                             "[[block]]\nname = \"b\"\npolygon = [[0, 0], [2, 0], [2, 1], [0, 1]]\n"
                                             "[[liner]]\nname = \"l\"\nthickness = 0.1\nmodulus = 2e10\nnormal_stiffness = 2e9\n"
                                             "shear_stiffness = 1e9\npath = [[2, 0], [-2.5, ") +
                                 end + "]]\n[[stage]]\ncycles = 10\n";
        const std::vector<Problem> warnings = build_model(read_case_text(text, "case.toml").def).warnings;
        ASSERT_EQ(warnings.size(), is_told ? 1u : 0u) << end;
        for (const Problem& warning : warnings)
            EXPECT_NE(warning.text.find(" m have no block behind them"), std::string::npos) << warning.text;
    }
}

/// The rock behind it is one block with a notch.
TEST(Liners, HaveNoRockBehindThemAtANotch)
{
    CaseDef scene = flying_pair(lining());
    scene.blocks.resize(1);
    scene.blocks[0].polygon = {{-1, 0}, {-0.5, 0}, {-0.5, 0.5}, {0.5, 0.5}, {0.5, 0}, {1, 0}, {1, 1}, {-1, 1}};
    const CaseRun run(scene);
    const Liner& liner = run.model().support.liners[0];
    for (const LinerSegment& segment : liner.segments)
    {
        const double middle = 0.5 * (liner.nodes[segment.node[0]] + liner.nodes[segment.node[1]]).x() + run.model().origin.x();
        EXPECT_EQ(segment.block == no_index, std::abs(middle) < 0.5) << middle;
    }
}
}  // namespace
}  // namespace hdem
