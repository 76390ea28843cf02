/// Spikes and wedges in hollow corners of concave blocks, under loads of tens of their weights: they bear on both sides of the corner, and contacts give no energy as they change.

#include "parallel/stages.h"
#include "verification/scenes/scenes.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
using test::CaseRun;

class HollowCorner : public testing::TestWithParam<Method>
{
  protected:
    static CaseDef scene(const Polygon& block, const Polygon& wedge, const Vec2& gravity, const Vec2& force)
    {
        CaseDef scene = scenes::empty_scene();
        scene.contact.method = GetParam();
        scene.joints[0].normal_stiffness = 1e10;
        scene.joints[0].shear_stiffness = 5e9;
        scenes::add_fixed_block(scene, "block", block);
        scenes::add_block(scene, "wedge", wedge);
        scene.gravity = gravity;
        scene.loads = {{.name = "push", .blocks = {"wedge"}, .force = force}};
        return scene;
    }

    /// Does the contact give less than a hundredth of what the load does?
    static void expect_no_energy_by_changes(const CaseRun& run)
    {
        const EnergyLedger& ledger = run.state().ledger;
        EXPECT_GT(ledger.contact_changes, -0.01 * ledger.load_work);
    }
};

/// It lies on its side in the end. Springs gave 20 times the energy that went in.
TEST_P(HollowCorner, LetsASpikeTurnOut)
{
    const Polygon block{{-1.68905661473908, 0.630148992069449},  {-0.517711427022667, -0.990946455834095},
                        {0.292836296929104, -0.405273861975886}, {0.878508890787313, -1.21582158592766},
                        {1.68905661473908, -0.630148992069449},  {0.517711427022667, 0.990946455834095},
                        {-0.292836296929104, 0.405273861975886}, {-0.878508890787313, 1.21582158592766}};
    const Polygon spike{
        {-0.291458113223412, 0.40627230503131}, {-0.0367767315958469, 1.01663034127905}, {-0.169242702153313, 1.05624379044963}};
    CaseDef drawn = scene(block, spike, {2.84686395769806, -9.38783604492322}, {-5073.18731005203, -10923.0733814941});
    drawn.blocks.back().velocity = {-0.0162109544790354, -0.0117134518771642};
    drawn.damping.preset = DampingPreset::dynamic;
    drawn.stages = {{.name = "turn", .duration = 0.25}};
    for (const double angle : {0.0, 57.3})
        for (const bool mirrored : {false, true})
        {
            CaseRun run(scenes::turned(mirrored ? scenes::mirrored(drawn) : drawn, angle));
            run_stages(run.simulation, {});
            expect_no_energy_by_changes(run);
            if (GetParam() != Method::force)
            {
                EXPECT_NEAR(run.displacement("wedge").norm(), 0.3477, 5e-4) << angle << ' ' << mirrored;
            }
        }
}

TEST_P(HollowCorner, BringsAWedgeToRest)
{
    const Polygon block{
        {1.18471512647671, -0.237200302724573},   {0.947022051211222, 0.259058654215053},  {1.57591290662639, 0.5139713147396},
        {0.282372931725037, 1.24843890632318},    {-0.962074138824933, 0.393135025586865}, {-0.857857982890994, 0.227018216714767},
        {-1.42321649273222, -0.0223856330981246}, {-1.66309310735131, -0.647616336167573}, {-1.09130580423037, -0.502747128508795},
        {-0.361554869003913, -0.667938808051695}, {-0.579498452158066, -1.60582665631898}};
    const Polygon wedge{{0.947024848727053, 0.259057570746005},
                        {1.86076423336249, -0.0910501682433721},
                        {2.51242973853818, 0.23269535712515},
                        {1.87203474346373, 0.578199837726508}};
    CaseDef drawn = scene(block, wedge, {-3.21745441650973, 9.26736678230025}, {-258488.150417576, 491286.187483766});
    drawn.joints[0].friction_angle_deg = 0.0;
    drawn.blocks.back().velocity = {-0.278028413014654, -0.112695170954896};
    drawn.blocks.back().fix_rotation = true;
    drawn.stages = {{.name = "rest", .until_converged = true, .max_cycles = 20'000}};
    for (const double angle : {0.0, 57.3})
        for (const bool mirrored : {false, true})
        {
            CaseRun run(scenes::turned(mirrored ? scenes::mirrored(drawn) : drawn, angle));
            EXPECT_TRUE(run_stages(run.simulation, {})[0].at_rest) << angle << ' ' << mirrored;
            expect_no_energy_by_changes(run);
            EXPECT_LT(run.displacement("wedge").norm(), 1e-3) << angle << ' ' << mirrored;
        }
}

/// A spike slides into the corner and hits its other side. Where that side was found a part of a millimetre late, its spring gave energy at each turn: 20 and 400 times what went in.
TEST_P(HollowCorner, StopsASpikeThatSlidesIn)
{
    const Polygon saw{
        {0.0494330697038941, 1.10134167581789},  {-1.46716102015258, -0.341130667491495}, {-1.23073547888422, -1.12287949527983},
        {0.109949219955334, -0.742060387135035}, {0.8201366583882, -1.20709829370029},    {1.13214276209629, 1.46193425105004},
        {0.645478984458235, 1.34947443395933},   {0.393103350964821, 0.681663328503992},  {0.389762388008098, 1.27438530770427}};
    const Polygon arrow{{0.109948767205955, -0.742063352774595},
                        {0.148070155260536, -1.61040795070134},
                        {0.276355632649946, -1.14353271695703},
                        {0.697312593174702, -1.38274995082323}};
    CaseDef undamped = scene(saw, arrow, {2.46724332854545, 9.49467273568436}, {46339.6074918826, 128795.706396348});
    undamped.damping.preset = DampingPreset::dynamic;
    const Polygon hook{{1.49619584309042, -0.0798596350321643},
                       {1.17840967783018, 0.0397649313350547},
                       {-0.110228367917841, 1.93909516587987},
                       {-0.825951171729992, -0.199488269304002},
                       {-1.11313410831788, -1.75119846915171}};
    const Polygon wedge{{1.17842824493042, 0.039788495349757},
                        {2.23939323012147, 0.0034612157116292},
                        {2.79347725114598, 0.565764366852772},
                        {2.01452530142484, 0.693935331441411}};
    CaseDef smooth = scene(hook, wedge, {-0.72768032788226, -9.78297405395789}, {-28849.9500178672, -15329.4124317766});
    smooth.joints[0].friction_angle_deg = 0.0;
    for (CaseDef drawn : {undamped, smooth})
    {
        drawn.joints[0].normal_stiffness = 1e11;
        drawn.joints[0].shear_stiffness = 5e10;
        drawn.blocks.back().fix_rotation = true;
        drawn.stages = {{.name = "slide", .until_converged = true, .max_cycles = 20'000}};
        for (const double angle : {0.0, 57.3})
            for (const bool mirrored : {false, true})
            {
                CaseRun run(scenes::turned(mirrored ? scenes::mirrored(drawn) : drawn, angle));
                run_stages(run.simulation, {});
                const EnergyLedger& ledger = run.state().ledger;
                EXPECT_GT(ledger.contact_changes, -0.01 * (ledger.load_work + ledger.gravity_work)) << angle << ' ' << mirrored;
                EXPECT_LT(run.displacement("wedge").norm(), 1e-3) << angle << ' ' << mirrored;
            }
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, HollowCorner, testing::Values(Method::force, Method::hybrid, Method::impulse),
                         [](const auto& method) {
                             return method.param == Method::force ? "force"
                                                                  : (method.param == Method::hybrid ? "hybrid" : "impulse");
                         });
}  // namespace
}  // namespace hdem
