/// Spikes that slide past the corner of a concave block: a seam of its parts that ends there is no crack into which they could go.

#include "core/geometry/polygon.h"
#include "verification/scenes/scenes.h"
#include "verification/unit/case_run.h"

#include <Eigen/Dense>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
using test::CaseRun;
namespace bg = boost::geometry;
using Point = bg::model::d2::point_xy<double>;

class SpikeAtCorner : public testing::TestWithParam<Method>
{
};

/// How deep the vertices of a shape lie in another one, at most [m].
double depth_in(const Polygon& block, const Polygon& shape)
{
    bg::model::polygon<Point, false, false> inside;
    bg::model::linestring<Point> outline;
    for (std::size_t i = 0; i <= block.size(); ++i)
    {
        const Point p(block[i % block.size()].x(), block[i % block.size()].y());
        bg::append(outline, p);
        if (i < block.size())
            bg::append(inside.outer(), p);
    }
    bg::correct(inside);
    double depth = 0.0;
    for (const Vec2& v : shape)
        if (const Point p(v.x(), v.y()); bg::within(p, inside))
            depth = std::max(depth, bg::distance(p, outline));
    return depth;
}

/// A triangle as its block has moved and turned.
Polygon moved(const Polygon& triangle, CaseRun& run, const char* block)
{
    const BlockMotion& motion = run.motion(block);
    const Vec2 drawn = (triangle[0] + triangle[1] + triangle[2]) / 3.0, now = drawn + run.displacement(block),
               x(motion.c, motion.s);
    Polygon there = triangle;
    for (Vec2& p : there)
    {
        const Vec2 arm = p - drawn;
        p = now + arm.x() * x + arm.y() * turned_left(x);
    }
    return there;
}

/// A block with a corner in the origin, to which a seam leads, and the same without its hollow. Beside the corner stands a triangle on its tip.
struct Corner
{
    Polygon hollow{{-2.0, 0.3}, {-2.65, -0.67}, {-2.3, -1.78}, {-1.32, -1.94}, {-0.66, -0.97}, {0.34, -1.12}, {0.0, 0.0}};
    Polygon full{{-2.0, 0.3}, {-2.65, -0.67}, {-2.3, -1.78}, {-1.32, -1.94}, {0.34, -1.12}, {0.0, 0.0}};
    Polygon spike{{0.6601, 0.97}, {-0.3399, 1.12}, {0.0001, 0.0}};
};

CaseDef corner_scene(Method method, const Polygon& block)
{
    CaseDef scene = scenes::empty_scene();
    scene.contact.method = method;
    scene.joints[0].normal_stiffness = 5e9;
    scene.joints[0].shear_stiffness = 2.5e9;
    scenes::add_fixed_block(scene, "block", block);
    scenes::add_block(scene, "spike", Corner().spike);
    return scene;
}

Vec2 pushed_way(Method method, const Polygon& block, double angle_deg, bool mirrored)
{
    CaseDef scene = corner_scene(method, block);
    BlockDef& spike = scene.blocks.back();
    spike.velocity = {-0.02, -0.05};
    spike.fix_rotation = true;
    scene.loads = {{.name = "push", .blocks = {"spike"}, .force = {-1e4, 0.0}}};
    scene = scenes::turned(mirrored ? scenes::mirrored(scene) : scene, angle_deg);
    CaseRun run(scene);
    while (run.state().time < 0.4)
        run.advance(20);
    const double angle = angle_deg * std::numbers::pi / 180.0;
    const Vec2 way = run.displacement("spike"), x(std::cos(angle), std::sin(angle));
    return {(mirrored ? -1.0 : 1.0) * way.dot(x), cross(x, way)};
}

TEST_P(SpikeAtCorner, SlidesDownAsBesideABlockWithoutAHollow)
{
    const Corner corner;
    const Vec2 way = pushed_way(GetParam(), corner.full, 0.0, false);
    EXPECT_LT(way.y(), -0.08);
    for (const double angle : {0.0, 57.3, 200.0})
        for (const bool mirrored : {false, true})
            EXPECT_LT((pushed_way(GetParam(), corner.hollow, angle, mirrored) - way).norm(), 0.02 * way.norm())
                << angle << ' ' << mirrored;
}

/// Tip on tip, driven along neither side. The spring of the side that it takes gave a tenth of the energy of the blow when that side was found late.
TEST_P(SpikeAtCorner, IsThrownBackWithNoMoreThanItHad)
{
    const Polygon stair{{0.0, -1.3416}, {1.7889, 0.4472}, {1.3416, 0.8944}, {0.8944, 0.4472}, {-0.8944, 0.4472}, {-1.7889, 0.4472}};
    const Polygon tip{{1.788903, 0.4472}, {2.7902, 0.7451}, {2.0316, 1.4633}};
    CaseDef drawn = scenes::empty_scene();
    drawn.contact.method = GetParam();
    drawn.joints[0].normal_stiffness = 1e10;
    drawn.joints[0].shear_stiffness = 5e9;
    drawn.joints[0].friction_angle_deg = 50.0;
    drawn.gravity = {-9.6388, 1.8246};
    scenes::add_fixed_block(drawn, "stair", stair);
    BlockDef& block = scenes::add_block(drawn, "tip", tip);
    block.velocity = {-0.5141, 0.0141};
    block.fix_rotation = true;
    for (const double angle : {0.0, 57.3})
        for (const bool mirrored : {false, true})
        {
            CaseRun run(scenes::turned(mirrored ? scenes::mirrored(drawn) : drawn, angle));
            while (run.state().time < 0.25)
                run.advance(20);
            const EnergyLedger& ledger = run.state().ledger;
            EXPECT_GT(ledger.contact_changes, -0.05 * (ledger.initial + ledger.gravity_work)) << angle << ' ' << mirrored;
        }
}

/// The spike is driven over the block: it rides up on the corner.
TEST_P(SpikeAtCorner, RidesUpWhereItIsDriven)
{
    const Corner corner;
    for (const Polygon& block : {corner.full, corner.hollow})
    {
        CaseDef scene = corner_scene(GetParam(), block);
        BlockDef& spike = scene.blocks.back();
        spike.fix_x = spike.fix_rotation = true;
        scene.loads = {{.name = "drive", .blocks = {"spike"}, .velocity_x = -0.05}};
        CaseRun run(scene);
        while (run.state().time < 0.5)
            run.advance(20);
        EXPECT_NEAR(run.displacement("spike").y(), 0.15 * 0.0249, 1e-3);
        EXPECT_LT(depth_in(block, moved(corner.spike, run, "spike")), 1e-3);
    }
}

/// Spikes beside a corner of a C or a U, found by a search among random ones: they went 0.07 to 0.3 m deep into the block.
struct FoundScene
{
    Polygon block, spike;
    Vec2 velocity, gravity, force;
    bool turns;
};

const FoundScene found[] = {
    {.block = {{0.0, 0.0},
               {2.74687765463935, 1.20609417146548},
               {2.34484626415086, 2.12172005634526},
               {0.513594494391292, 1.31765727536828},
               {0.1115631039028, 2.23328316024806},
               {1.94281487366237, 3.03734594122505},
               {1.54078348317388, 3.95297182610483},
               {-1.20609417146548, 2.74687765463935}},
     .spike = {{-1.20609819177938, 2.7468868108982}, {-1.43822663248413, 3.16268703673129}, {-1.6511901271415, 2.91619897780439}},
     .velocity = {0.0165388471257642, -0.0119080665788451},
     .gravity = {8.98228993067069, 3.94392794069211},
     .force = {776.108475517165, -1767.58588127821},
     .turns = true},
    {.block = {{0.0, 0.0},
               {0.181997809979914, 0.983298935808697},
               {1.65694621369296, 0.710302220838826},
               {1.83894402367287, 1.69360115664752},
               {0.363995619959827, 1.96659787161739},
               {0.545993429939741, 2.94989680742609},
               {3.00424076946148, 2.49490228247631},
               {2.45824733952174, -0.454994524949784}},
     .spike = {{2.45824551954364, -0.455004357939142},
               {2.72362574755937, -0.922773788533874},
               {2.86760792920788, -0.803798456476499}},
     .velocity = {-0.0147915120109047, 0.0319831163474276},
     .gravity = {-9.64616256028331, 1.78539851590295},
     .force = {476.871449497981, 2576.44412787531},
     .turns = true},
    {.block = {{0.0, 0.0},
               {0.197766139326768, 2.99347432829075},
               {-0.80005863677015, 3.05939637473301},
               {-0.931902729654662, 1.06374682253917},
               {-1.92972750575158, 1.12966886898143},
               {-1.79788341286707, 3.12531842117527},
               {-2.79570818896399, 3.19124046761752},
               {-2.99347432829075, 0.197766139326768}},
     .spike = {{-2.99357411076836, 0.197772731531412},
               {-3.30363234686861, 0.343928762967529},
               {-3.11083280534825, -0.124326777695426}},
     .velocity = {0.0178045016102351, 0.0147420540639941},
     .gravity = {4.49749016944299, 8.55111683792028},
     .force = {1546.22038503612, -102.152215974254},
     .turns = false}};

TEST_P(SpikeAtCorner, GoesIntoNoBlock)
{
    for (const FoundScene& start : found)
        for (const double angle : {0.0, 57.3, 200.0})
        {
            CaseDef scene = scenes::empty_scene();
            scene.contact.method = GetParam();
            scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = 1e10;
            scene.joints[0].friction_angle_deg = 40.0;
            scenes::add_fixed_block(scene, "block", start.block);
            BlockDef& spike = scenes::add_block(scene, "spike", start.spike);
            spike.velocity = start.velocity;
            spike.fix_rotation = !start.turns;
            scene.gravity = start.gravity;
            scene.loads = {{.name = "push", .blocks = {"spike"}, .force = start.force}};
            scene = scenes::turned(scene, angle);
            CaseRun run(scene);
            double depth = 0.0;
            while (run.state().time < 0.25)
            {
                run.advance(50);
                depth = std::max(depth, depth_in(scene.blocks[0].polygon, moved(scene.blocks[1].polygon, run, "spike")));
            }
            EXPECT_LT(depth, 0.01) << &start - found << ' ' << angle;
        }
}

/// A wedge is pressed into a hollow corner of 100 degrees, whose sides its own face at 10 and 30 degrees. Its tip bears on both: their forces N balance the push, and go in by N / (K L / 2) each, L of its
/// sides over them.
TEST_P(SpikeAtCorner, RestsInAHollow)
{
    const Polygon hollow{{0.0, 0.0}, {1.29903810567666, 0.75}, {-1.0, 1.6}, {-1.0, -1.6}, {0.964181414529809, -1.14906666467847}};
    const Polygon kite{{1e-5, 0.0}, {0.939692620785908, -0.342020143325669}, {1.6, 0.0}, {0.939692620785908, 0.342020143325669}};
    const auto way_in = [&](double angle_deg, bool mirrored)
    {
        CaseDef scene = scenes::empty_scene();
        scene.contact.method = GetParam();
        scene.joints[0].normal_stiffness = 1e10;
        scene.joints[0].shear_stiffness = 5e9;
        scene.joints[0].friction_angle_deg = 0.0;
        scenes::add_fixed_block(scene, "ground", hollow);
        scenes::add_block(scene, "wedge", kite).fix_rotation = true;
        scene.gravity = {0.0, 0.0};
        scene.loads = {{.name = "push", .blocks = {"wedge"}, .force = {-1e5, 0.0}}};
        scene.stages = {{.name = "rest", .until_converged = true, .max_cycles = 20'000}};
        CaseRun run(scenes::turned(mirrored ? scenes::mirrored(scene) : scene, angle_deg));
        run.advance(3000);
        EXPECT_LT(run.velocity("wedge").norm(), 1e-6) << angle_deg << ' ' << mirrored;
        return run.displacement("wedge").norm();
    };
    const auto in_degrees = [](double angle) { return angle * std::numbers::pi / 180.0; };
    const Vec2 of_upper(std::sin(in_degrees(30.0)), -std::cos(in_degrees(30.0))),
        of_lower(std::sin(in_degrees(50.0)), std::cos(in_degrees(50.0)));
    const auto compliance = [&](double angle) { return 2.0 / (1e10 * std::cos(in_degrees(angle))); };
    Eigen::Matrix2d normals;
    normals << of_upper, of_lower;
    const Vec2 forces = normals.colPivHouseholderQr().solve(Vec2(1e5, 0.0));
    const Vec2 pressed(forces.x() * compliance(10.0), forces.y() * compliance(30.0));
    const double way = 1e-5 +
                       (GetParam() == Method::impulse ? 0.0 : normals.transpose().colPivHouseholderQr().solve(pressed).norm());
    for (const double angle : {0.0, 57.3})
        for (const bool mirrored : {false, true})
            EXPECT_NEAR(way_in(angle, mirrored), way, 0.01 * way + 2e-7) << angle << ' ' << mirrored;
}

/// An arrow is pressed with its tip into a hollow corner. A seam of its own ends in the tip, two of the block in the corner.
TEST_P(SpikeAtCorner, HoldsAnArrowInAHollow)
{
    for (const double angle : {0.0, 57.3})
        for (const bool mirrored : {false, true})
        {
            CaseDef scene = scenes::empty_scene();
            scene.contact.method = GetParam();
            scene.joints[0].normal_stiffness = 1e9;
            scene.joints[0].shear_stiffness = 5e8;
            scene.joints[0].friction_angle_deg = 0.0;
            scenes::add_fixed_block(scene, "block", {{0.0, 0.0}, {0.7, 0.8}, {-1.0, 1.0}, {-1.2, -0.4}, {0.9, -0.7}});
            scenes::add_block(
                scene, "arrow",
                {{1e-6, 0.0}, {0.594161841244942, -0.0835038605760393}, {0.300001, 0.0}, {0.594161841244942, 0.0835038605760393}})
                .fix_rotation = true;
            scene.gravity = {0.0, 0.0};
            scene.loads = {{.name = "push", .blocks = {"arrow"}, .force = {-3317.65013261633, 0.0}}};
            CaseRun run(scenes::turned(mirrored ? scenes::mirrored(scene) : scene, angle));
            while (run.state().time < 0.15)
                run.advance(20);
            EXPECT_LT(run.displacement("arrow").norm(), 2e-3) << angle << ' ' << mirrored;
        }
}

INSTANTIATE_TEST_SUITE_P(Methods, SpikeAtCorner, testing::Values(Method::force, Method::hybrid, Method::impulse),
                         [](const auto& method) {
                             return method.param == Method::force ? "force"
                                                                  : (method.param == Method::hybrid ? "hybrid" : "impulse");
                         });
}  // namespace
}  // namespace hdem
