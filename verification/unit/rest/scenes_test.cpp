/// Scenes of rest.*: always the same, and what is said of them holds by limit analysis too.

#include "io/load_case.h"
#include "verification/checks/case_run.h"
#include "verification/rest/families.h"
#include "verification/rest/run.h"
#include "verification/rest/springs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hdem::verification::rest
{
namespace
{
constexpr int scenes = 12;

struct Family
{
    const char* name;
    Scene (*scene)(int);
};

class RestScenes : public testing::TestWithParam<Family>
{
  protected:
    void SetUp() override { case_folder() = HDEM_SOURCE_DIR "/verification/cases"; }
};

TEST_P(RestScenes, AreOfConvexPartsAndAlwaysTheSame)
{
    for (int i = 0; i < scenes; ++i)
    {
        const Scene scene = GetParam().scene(i);
        EXPECT_EQ(scene_text(scene, scene.placement), scene_text(GetParam().scene(i), scene.placement));
        EXPECT_EQ(scene.fate.size(), scene.def.blocks.size());
        EXPECT_GE(scene.settle, scene.def.gravity.norm() > 0.0 ? 1e-9 : 0.0) << scene.name();
        for (const Body& body : bodies_of(scene))
            for (const ConvexPart& part : body.parts)
                EXPECT_TRUE(is_convex(part.vertices)) << scene.name();
    }
}

TEST_P(RestScenes, StayOrMoveByLimitAnalysisToo)
{
    for (int i = 0; i < scenes; ++i)
    {
        const Scene scene = GetParam().scene(i);
        if (!scene.def.loads.empty() || scene.def.gravity.norm() == 0.0)
            continue;
        const std::vector<Body> bodies = bodies_of(scene);
        const JointDef& joint = scene.def.joints.front();
        const double off = least_unbalance(bodies, touching_at_start(scene, bodies),
                                           {std::tan(radians(joint.friction_angle_deg)), joint.cohesion}, scene.def.gravity);
        const bool moves = scene.someone_moves || std::ranges::count(scene.fate, Fate::moves) > 0;
        const bool all_stay = std::ranges::count(scene.fate, Fate::stays) + std::ranges::count_if(bodies, &Body::fixed) ==
                              static_cast<std::ptrdiff_t>(bodies.size());
        const bool thrown = std::ranges::any_of(scene.def.blocks, [](const BlockDef& b) { return b.velocity.norm() > 0.0; });
        if (moves && !thrown)
        {
            EXPECT_GT(off, 1e-6) << scene.name() << ": " << scene.what;
        }
        if (all_stay)
        {
            EXPECT_LT(off, 1e-6) << scene.name() << ": " << scene.what;
        }
    }
}

TEST_P(RestScenes, AreReadBackFromTheirCaseFilesToTheLastBit)
{
    for (int i = 0; i < 6; ++i)
    {
        const Scene scene = GetParam().scene(i);
        const std::string text = scene_text(scene, scene.placement);
        const CaseDef read = load_case(text, {}, scene.name(), {}).file.def;
        const CaseDef meant = placed(scene.def, scene.placement);
        ASSERT_EQ(read.blocks.size(), meant.blocks.size());
        for (std::size_t b = 0; b < read.blocks.size(); ++b)
        {
            EXPECT_EQ(read.blocks[b].polygon, meant.blocks[b].polygon);
            EXPECT_EQ(read.blocks[b].velocity, meant.blocks[b].velocity);
            EXPECT_EQ(read.blocks[b].material, meant.blocks[b].material);
            EXPECT_EQ(read.blocks[b].fix_x, meant.blocks[b].fix_x);
        }
        EXPECT_EQ(read.gravity, meant.gravity);
        EXPECT_EQ(read.joints.front().cohesion, meant.joints.front().cohesion);
        EXPECT_EQ(read.time.step, meant.time.step);
        EXPECT_EQ(read.contact.method, meant.contact.method);
        EXPECT_EQ(read.damping.preset, meant.damping.preset);
        ASSERT_EQ(read.stages.size(), meant.stages.size());
        EXPECT_EQ(read.stages.back().max_cycles, meant.stages.back().max_cycles);
        EXPECT_EQ(read.stages.back().duration, meant.stages.back().duration);
        ASSERT_EQ(read.loads.size(), meant.loads.size());
        for (std::size_t k = 0; k < read.loads.size(); ++k)
            EXPECT_EQ(read.loads[k].force, meant.loads[k].force);
    }
}

INSTANTIATE_TEST_SUITE_P(Families, RestScenes,
                         testing::Values(Family{"incline", incline_scene}, Family{"tiles", tiles_scene},
                                         Family{"stack", stack_scene}, Family{"notch", notch_scene}, Family{"wedge", wedge_scene},
                                         Family{"arch", arch_scene}, Family{"drop", drop_scene}, Family{"heap", heap_scene},
                                         Family{"concave", concave_scene}, Family{"rubble", rubble_scene},
                                         Family{"known", known_scene}),
                         [](const testing::TestParamInfo<Family>& family) { return family.param.name; });

TEST(RestDraw, GivesTheSameNumbersOnEveryMachine)
{
    Draw draw("incline", 17);
    EXPECT_EQ(draw.count(0, 999'999), 118'498);
    EXPECT_EQ(draw.count(1, 6), 4);
    EXPECT_NE(Draw("incline", 18).count(0, 999'999), 118'498);
}

TEST(RestPlacement, TurnsBackWhatItTurned)
{
    for (int i = 0; i < 20; ++i)
    {
        Draw draw("placement", i);
        const Placement placement = draw_placement(draw);
        const Vec2 v(0.3, -1.7);
        EXPECT_NEAR((placement.turned_back(placement.turned(v)) - v).norm(), 0.0, 1e-15);
        EXPECT_NEAR(cross(placement.turned({1.0, 0.0}), placement.turned({0.0, 1.0})), placement.sense(), 1e-15);
    }
    EXPECT_EQ(turned_by(270.0).turned({1.0, 0.0}), Vec2(0.0, -1.0));
    EXPECT_EQ(turned_by(90.0).turned({1.0, 0.0}), Vec2(0.0, 1.0));
}

TEST(RestRun, EndsAlikeInAnotherPlacement)
{
    case_folder() = HDEM_SOURCE_DIR "/verification/cases";
    Scene scene = new_scene("test", 0);
    add_fixed(scene, "ground", rectangle(-5.0, -1.0, 5.0, 0.0));
    add_block(scene, "block", rectangle(-0.5, 0.01, 0.5, 1.01), Fate::open);
    scene.def.stages = {{.name = "fall", .cycles = 100}};
    Placement other = turned_by(90.0);
    other.mirrored = true;
    other.shift = {1e3, -2e3};
    const Outcome upright = run_scene(scene, {});
    const Outcome turned = run_scene(scene, other);
    ASSERT_EQ(upright.failure, "");
    ASSERT_EQ(turned.failure, "");
    EXPECT_LT(upright.way[1].y(), 0.0);
    EXPECT_NEAR((upright.way[1] - turned.way[1]).norm(), 0.0, 1e-12);
    EXPECT_NEAR((upright.net[1] - turned.net[1]).norm(), 0.0, 1e-9 * rock * g);
}
}  // namespace
}  // namespace hdem::verification::rest
