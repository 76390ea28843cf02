#include "parallel/stages.h"
#include "verification/unit/case_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;

constexpr double g = 9.81;

/// `lower` with its face at height `y` above the ground and `upper` on it; the joint between them is rough.
CaseDef two_on_each_other(double y, Method method)
{
    CaseDef scene = scenes::empty_scene();
    scene.contact.method = method;
    scene.materials.push_back({.name = "rough", .density = 2700.0});
    JointDef rough = scene.joints[0];
    rough.name = "rough";
    rough.friction_angle_deg = 60.0;
    rough.materials = {"rough", "rough"};
    scene.joints.push_back(rough);
    scenes::add_fixed_block(scene, "ground", rectangle({-50.0, -2.0}, {50.0, 0.0}));
    scenes::add_block(scene, "lower", rectangle({0.0, y}, {3.0, y + 1.0})).material = "rough";
    scenes::add_block(scene, "upper", rectangle({0.5, y + 1.0}, {2.5, y + 2.0})).material = "rough";
    return scene;
}

/// Runs for a second at most, and returns the time.
double run_for(CaseRun& run, double time)
{
    while (run.state().time < time)
        run.advance(1);
    return run.state().time;
}

class MovingGroup : public testing::TestWithParam<Method>
{
};

TEST_P(MovingGroup, FallsWithGravity)
{
    for (const double angle : {0.0, 37.0})
    {
        CaseRun run(scenes::turned(two_on_each_other(5.0, GetParam()), angle));
        const double t = run_for(run, 0.6);
        for (const char* block : {"lower", "upper"})
            EXPECT_NEAR(run.displacement(block).norm(), 0.5 * g * t * t, 2e-3 * g) << block << " turned by " << angle;
    }
}

TEST_P(MovingGroup, SlidesAsOneBlock)
{
    constexpr double slope = 30.0 * std::numbers::pi / 180.0, friction = 20.0 * std::numbers::pi / 180.0;
    CaseDef scene = two_on_each_other(0.0, GetParam());
    scene.joints[0].friction_angle_deg = 20.0;
    scene.gravity = {g * std::sin(slope), -g * std::cos(slope)};
    for (const bool mirrored : {false, true})
    {
        CaseRun run(mirrored ? scenes::mirrored(scene) : scene);
        const double t = run_for(run, 1.0);
        const double way = 0.5 * g * (std::sin(slope) - std::cos(slope) * std::tan(friction)) * t * t;
        for (const char* block : {"lower", "upper"})
            EXPECT_NEAR(run.displacement(block).norm(), way, 0.01 * way) << block << (mirrored ? " mirrored" : "");
    }
}

TEST_P(MovingGroup, ThatIsHeldIsDampedAsEver)
{
    CaseRun run(two_on_each_other(1e-3, GetParam()));
    run_for(run, 0.3);
    EXPECT_LT(run.velocity("upper").norm(), 1e-6);
    EXPECT_LT(run.velocity("lower").norm(), 1e-6);
}

/// More than 128 blocks that are fast are not looked at in each cycle, and which parts have fast blocks is remembered from cycle to cycle: neither may be seen.
TEST_P(MovingGroup, OfManyFallsLikeOneAndLikeARunThatIsTakenUpInEachCycle)
{
    CaseDef scene = two_on_each_other(5.0, GetParam());
    for (int i = 0; i < 80; ++i)
    {
        const double x = 5.0 + 4.0 * i, y = 5.0 + 0.02 * i;
        scenes::add_block(scene, "lower " + std::to_string(i), rectangle({x, y}, {x + 3.0, y + 1.0})).material = "rough";
        scenes::add_block(scene, "upper " + std::to_string(i), rectangle({x + 0.5, y + 1.0}, {x + 2.5, y + 2.0}))
            .material = "rough";
    }
    CaseRun run(scene);
    const double t = run_for(run, 0.2);
    EXPECT_GT(run.state().cycle, 100);
    EXPECT_GT(run.state().moving.size(), 128u);
    for (const char* block : {"lower", "upper", "lower 79", "upper 79"})
        EXPECT_NEAR(run.displacement(block).norm(), 0.5 * g * t * t, 2e-3 * g * t * t) << block;
    State state = CaseRun(scene).state();
    for (std::int64_t i = 0; i < run.state().cycle; ++i)
    {
        Simulation taken_up(run.model(), state);
        taken_up.advance(1);
        state = taken_up.state();
    }
    EXPECT_EQ(state_hash(run.model(), state), run.hash());
}

/// A slender block on its lower edge tips; on a steep slope it slides meanwhile. Damping that takes hold of it as it begins is all that parts it from a run without any.
TEST_P(MovingGroup, OfOneThatTipsMovesAsUndamped)
{
    struct Tipping
    {
        double height, slope_deg, friction_deg, time, share;
    };
    for (const Tipping& tip :
         {Tipping{2.4, 40.0, 25.0, 0.9, 0.03}, Tipping{2.5, 45.0, 30.0, 0.9, 0.03}, Tipping{3.0, 25.0, 60.0, 0.9, 0.08}})
        for (const bool mirrored : {false, true})
        {
            const auto run = [&](DampingPreset preset)
            {
                CaseDef scene = scenes::empty_scene();
                scene.contact.method = GetParam();
                scene.damping.preset = preset;
                scene.joints[0].friction_angle_deg = tip.friction_deg;
                scenes::add_fixed_block(scene, "ground", rectangle({-50.0, -2.0}, {50.0, 0.0}));
                scenes::add_block(scene, "column", rectangle({0.0, 0.0}, {1.0, tip.height}));
                scene = scenes::turned(scene, -tip.slope_deg);
                scene.gravity = {0.0, -g};
                CaseRun moves(mirrored ? scenes::mirrored(scene) : scene);
                run_for(moves, tip.time);
                return moves;
            };
            const CaseRun free = run(DampingPreset::dynamic), damped = run(DampingPreset::automatic);
            SCOPED_TRACE(fmt::format("1 m x {} m on {} degrees{}", tip.height, tip.slope_deg, mirrored ? ", mirrored" : ""));
            EXPECT_GT(free.displacement("column").norm(), 0.1);
            EXPECT_NEAR(damped.displacement("column").norm(), free.displacement("column").norm(),
                        tip.share * free.displacement("column").norm());
        }
}

/// A pile of blocks topples over a corner as one block does.
TEST_P(MovingGroup, OfSeveralThatTipMovesAsUndamped)
{
    const auto way = [](DampingPreset preset, int blocks, bool mirrored)
    {
        CaseDef scene = scenes::empty_scene();
        scene.contact.method = GetParam();
        scene.damping.preset = preset;
        scene.joints[0].friction_angle_deg = 40.0;
        scenes::add_fixed_block(scene, "ground", rectangle({-20.0, -3.0}, {20.0, 0.0}));
        for (int i = 0; i < blocks; ++i)
            scenes::add_block(scene, fmt::format("b{}", i), rectangle({0.0, 4.0 / blocks * i}, {1.0, 4.0 / blocks * (i + 1)}));
        scene = scenes::turned(scene, 25.0);
        scene.gravity = {0.0, -g};
        CaseRun run(mirrored ? scenes::mirrored(scene) : scene);
        run_for(run, 0.6);
        return run.displacement(fmt::format("b{}", blocks - 1)).norm();
    };
    for (const int blocks : {2, 4})
    {
        const double free = way(DampingPreset::dynamic, blocks, false);
        EXPECT_GT(free, 0.2);
        for (const bool mirrored : {false, true})
            EXPECT_NEAR(way(DampingPreset::automatic, blocks, mirrored), free, 0.15 * free);
    }
}

/// A many-sided block rolls down a slope from side to side: what damping took of it would be most of its weight's work.
TEST_P(MovingGroup, OfOneThatRollsMovesAsUndamped)
{
    const auto way = [](DampingPreset preset, bool mirrored)
    {
        CaseDef scene = scenes::empty_scene();
        scene.contact.method = GetParam();
        scene.damping.preset = preset;
        scene.joints[0].friction_angle_deg = 45.0;
        scenes::add_fixed_block(scene, "ground", rectangle({-50.0, -2.0}, {50.0, 0.0}));
        Polygon wheel;
        for (int i = 0; i < 36; ++i)
        {
            const double angle = (10.0 * i - 85.0) * std::numbers::pi / 180.0;
            wheel.emplace_back(std::cos(angle), std::sin(angle) + std::cos(5.0 * std::numbers::pi / 180.0));
        }
        scenes::add_block(scene, "wheel", wheel);
        scene = scenes::turned(scene, -12.0);
        scene.gravity = {0.0, -g};
        CaseRun run(mirrored ? scenes::mirrored(scene) : scene);
        run_for(run, 2.0);
        return run.displacement("wheel").norm();
    };
    const double free = way(DampingPreset::dynamic, false);
    EXPECT_GT(free, 1.5);
    for (const bool mirrored : {false, true})
        EXPECT_NEAR(way(DampingPreset::automatic, mirrored), free, 0.15 * free);
}

/// A block slides without friction on a wedge that slides without friction: a = m g sin(s) cos(s) / (M + m sin(s)^2) of the wedge, M = m, s = 45 degrees.
TEST_P(MovingGroup, OfTwoThatSlideOnEachOtherKeepsItsMomentum)
{
    CaseDef scene = scenes::empty_scene();
    scene.contact.method = GetParam();
    scene.joints[0].friction_angle_deg = 0.0;
    scene.materials.push_back({.name = "light", .density = 400.0});
    scene.materials.push_back({.name = "heavy", .density = 5000.0});
    scenes::add_fixed_block(scene, "ground", rectangle({-10.0, -2.0}, {10.0, 0.0}));
    scenes::add_block(scene, "wedge", {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}).material = "light";
    scenes::add_block(scene, "block", {{0.05, 0.95}, {0.25, 0.75}, {0.35, 0.85}, {0.15, 1.05}}).material = "heavy";
    for (const bool mirrored : {false, true})
    {
        CaseRun run(mirrored ? scenes::mirrored(scene) : scene);
        const double t = run_for(run, 0.3), way = (mirrored ? -0.5 : 0.5) * g / 3.0 * t * t;
        EXPECT_NEAR(run.displacement("wedge").x(), -way, 0.015 * std::abs(way));
        EXPECT_NEAR(run.displacement("block").x(), way, 0.015 * std::abs(way));
    }
}

/// A bar slides down between two planes and turns.
CaseDef bar_between_planes()
{
    CaseDef scene = scenes::empty_scene();
    scene.joints[0].friction_angle_deg = 2.0;
    const auto turned_by = [](double angle_deg, const Vec2& at) -> Vec2
    {
        const double a = angle_deg * std::numbers::pi / 180.0;
        return {std::cos(a) * at.x() - std::sin(a) * at.y(), std::sin(a) * at.x() + std::cos(a) * at.y()};
    };
    const auto plane = [&](const char* name, double angle, double along, double below)
    {
        std::vector<Vec2> corners;
        for (const Vec2& at : {Vec2(0.0, 0.0), Vec2(along, 0.0), Vec2(along, below), Vec2(0.0, below)})
            corners.push_back(turned_by(angle, at));
        scenes::add_fixed_block(scene, name, corners);
    };
    plane("left", 135.0, 12.0, 3.0);
    plane("right", 12.0, 12.0, -3.0);
    const Vec2 from(-2.0, 2.0), to(2.0, 2.0 * std::tan(12.0 * std::numbers::pi / 180.0));
    const Vec2 along = (to - from).normalized(), up(-0.4 * along.y(), 0.4 * along.x());
    scenes::add_block(scene, "mover", {from, to, to + up, from + up});
    return scene;
}

/// Two slabs lean on each other; their feet slide apart.
CaseDef leaning_slabs()
{
    CaseDef scene = scenes::empty_scene();
    scene.joints[0].friction_angle_deg = 11.1;
    scenes::add_fixed_block(scene, "floor", rectangle({-12.0, -1.0}, {12.0, 0.0}));
    const double top = 2.0 * std::numbers::sqrt3, outer = 2.0 + 0.8 / std::numbers::sqrt3;
    scenes::add_block(scene, "mover", {{-2.0, 0.0}, {0.0, top}, {0.0, top + 0.8}, {-outer, 0.0}});
    scenes::add_block(scene, "other", {{2.0, 0.0}, {outer, 0.0}, {0.0, top + 0.8}, {0.0, top}});
    return scene;
}

/// No joint alone holds a block that must turn as it slides: it moves as undamped.
TEST_P(MovingGroup, ThatTurnsAsItSlidesMovesAsUndamped)
{
    const auto way = [&](CaseDef scene, DampingPreset preset, double angle)
    {
        scene.contact.method = GetParam();
        scene.damping.preset = preset;
        CaseRun run(scenes::turned(scene, angle));
        run_for(run, 1.0);
        return run.displacement("mover").norm();
    };
    const auto expect_as_undamped = [&](const CaseDef& scene, double share)
    {
        for (const double angle : {0.0, 37.0})
        {
            const double free = way(scene, DampingPreset::dynamic, angle);
            EXPECT_GT(free, 0.09);
            EXPECT_NEAR(way(scene, DampingPreset::automatic, angle), free, share * free) << angle;
        }
    };
    expect_as_undamped(bar_between_planes(), 0.005);
    expect_as_undamped(leaning_slabs(), 0.13);
}

/// Where rest is sought it does not creep, but comes to its end: the bar lies across the notch.
TEST_P(MovingGroup, ThatTurnsAsItSlidesComesToRestWhereItEnds)
{
    for (const double angle : {0.0, 37.0})
    {
        CaseDef scene = bar_between_planes();
        scene.contact.method = GetParam();
        scene.stages = {{.name = "rest", .until_converged = true, .max_cycles = 100'000}};
        CaseRun run(scenes::turned(scene, angle));
        const std::vector<StageResult> stages = run_stages(run.simulation, {});
        EXPECT_TRUE(stages.back().at_rest) << angle;
        EXPECT_NEAR(run.displacement("mover").norm(), 2.127, 0.005) << angle;
    }
}

/// A stone is thrown onto a slab, which it drags along until both have the same speed; then both slide on.
/// @param pieces  of the slab, one behind the other: the stone stays on the first, which pushes the others
CaseDef thrown_onto_slab(Method method, const std::vector<double>& pieces)
{
    CaseDef scene = scenes::empty_scene();
    scene.contact.method = method;
    scene.joints[0].normal_stiffness = 5.5e10;
    scene.joints[0].shear_stiffness = 2.75e10;
    scene.joints[0].friction_angle_deg = 7.1025807;
    scene.materials.push_back({.name = "slab", .density = 2500.0});
    scene.materials.push_back({.name = "stone", .density = 12497.0268});
    JointDef rough = scene.joints[0];
    rough.name = "stone on slab";
    rough.friction_angle_deg = 20.5741223;
    rough.materials = {"slab", "stone"};
    scene.joints.push_back(rough);
    scenes::add_fixed_block(scene, "ground", rectangle({-20.0, -3.0}, {80.0, 0.0}));
    double from = 0.0;
    for (const double to : pieces)
    {
        scenes::add_block(scene, fmt::format("slab to {}", to), rectangle({from, 0.0}, {to, 0.43427})).material = "slab";
        from = to;
    }
    BlockDef& stone = scenes::add_block(scene, "stone", rectangle({0.71055, 0.43427}, {2.37533, 0.66005}));
    stone.material = "stone";
    stone.velocity = {3.2562, 0.0};
    scene.stages = {{.name = "rest", .cycles = {}, .until_converged = true, .max_cycles = 200'000}};
    return scene;
}

/// The slab moves 0.1143 m, in one piece or in several, also where rest is looked for.
TEST_P(MovingGroup, DragsWhatItSlidesOn)
{
    for (const std::vector<double>& pieces : {std::vector{7.1055}, std::vector{5.0, 7.1055}, std::vector{4.5, 5.5, 7.1055}})
        for (const double angle : {0.0, 37.0})
        {
            hdem::Setup setup = build_model(scenes::turned(thrown_onto_slab(GetParam(), pieces), angle));
            Simulation simulation(std::move(setup.model), std::move(setup.state));
            EXPECT_TRUE(run_stages(simulation, {}).back().at_rest);
            for (const double to : pieces)
            {
                const Index slab = simulation.model().find_block(fmt::format("slab to {}", to));
                EXPECT_NEAR(simulation.state().blocks.displacement(slab).norm(), 0.1143, 0.003) << pieces.size() << " " << angle;
            }
        }
}

/// A stone is thrown against its like, which lies at rest: that one goes on alone, v^2 / (2 mu g), also where rest is looked for. R = 1, so both methods give back all. Until the joint of the other
/// slides, which takes 0.1 um here, it is damped.
TEST_P(MovingGroup, PushesWhatItHits)
{
    constexpr double speed = 1.0, friction = 0.1;
    CaseDef scene = scenes::empty_scene();
    scene.contact.method = GetParam();
    scene.joints[0].friction_angle_deg = std::atan(friction) * 180.0 / std::numbers::pi;
    scene.joints[0].shear_stiffness = scene.joints[0].normal_stiffness;
    scene.joints[0].restitution = 1.0;
    scene.time.step = 2e-5;
    scenes::add_fixed_block(scene, "ground", rectangle({-20.0, -3.0}, {20.0, 0.0}));
    scenes::add_block(scene, "thrown", rectangle({0.0, 0.0}, {1.0, 0.3})).velocity = {speed, 0.0};
    scenes::add_block(scene, "hit", rectangle({1.05, 0.0}, {2.05, 0.3}));
    scene.stages = {{.name = "rest", .cycles = {}, .until_converged = true, .max_cycles = 200'000}};
    const double way = speed * speed / (2.0 * friction * g) - 0.05;
    for (const double angle : {0.0, 37.0})
    {
        hdem::Setup setup = build_model(scenes::turned(scene, angle));
        Simulation simulation(std::move(setup.model), std::move(setup.state));
        EXPECT_TRUE(run_stages(simulation, {}).back().at_rest);
        EXPECT_NEAR(simulation.state().blocks.displacement(simulation.model().find_block("hit")).norm(), way, 0.025 * way);
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, MovingGroup, testing::Values(Method::force, Method::hybrid),
                         [](const auto& method) { return method.param == Method::force ? "force" : "hybrid"; });
}  // namespace
}  // namespace hdem
