#include "verification/unit/case_run.h"

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;

/// Three unit blocks in a row on the ground and one on the middle; the middle one is taken out.
CaseDef keystone()
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "ground", rectangle({-3, -1}, {6, 0}));
    scenes::add_block(scene, "left", rectangle({0, 0}, {1, 1}));
    scenes::add_block(scene, "middle", rectangle({1, 0}, {2, 1}));
    scenes::add_block(scene, "right", rectangle({2, 0}, {3, 1}));
    scenes::add_block(scene, "top", rectangle({1.1, 1}, {1.9, 1.8}));
    scenes::add_block(scene, "far", rectangle({4, 0}, {5, 1}));
    scene.contact.method = Method::force;
    scene.stages = {{.name = "settle", .cycles = 1000}, {.name = "dig", .cycles = 1000, .excavate = {"middle"}}};
    return scene;
}

TEST(Excavation, FindsTheNeighboursRemovesTheContactsAndCountsDisplacementsAnew)
{
    CaseRun run(keystone());
    run.advance(1000);
    EXPECT_GT(run.displacement("top").norm(), 1e-6);
    run.simulation.begin_stage(1);
    std::set<std::string> near;
    for (const Index i : run.state().next_to_excavation)
        near.insert(run.model().name[i]);
    EXPECT_EQ(near, (std::set<std::string>{"ground", "left", "right", "top"}));
    EXPECT_EQ(run.state().excavation_cycle, 1000);
    EXPECT_EQ(run.displacement("top").norm(), 0.0);
    run.advance(1);
    const Index gone = run.slot("middle");
    EXPECT_FALSE(run.state().blocks.is_free(gone));
    for (Index i = 0; i < run.state().contacts.size(); ++i)
        EXPECT_TRUE(run.state().contacts.ref[i] != gone && run.state().contacts.inc[i] != gone);
    const Vec2 before = run.position("top");
    run.advance(300);
    EXPECT_LT(run.position("top").y(), before.y() - 1e-3) << "it falls into the hole";
    EXPECT_EQ(run.velocity("middle").norm(), 0.0);
}

TEST(Excavation, OfAnOutlineRemovesAllBlocksInIt)
{
    CaseDef scene = scenes::joints(10.0, 10.0, 1.0);
    scene.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {5.0, 5.0}, .diameter = 3.0}};
    scene.stages = {{.name = "dig", .cycles = 10, .excavate = {"tunnel"}}};
    CaseRun run(scene);
    double removed = 0.0;
    for (Index i = 0; i < run.model().blocks(); ++i)
        if (run.state().blocks.present[i] == 0)
            removed += run.model().area[i];
    EXPECT_NEAR(removed, 8.0 * 2.25 * std::sin(radians(22.5)), 1e-6) << "16 edges: n/2 r^2 sin(2 pi/n)";
    EXPECT_FALSE(run.state().next_to_excavation.empty());
    for (const Index i : run.state().next_to_excavation)
    {
        EXPECT_NE(run.state().blocks.present[i], 0);
        const BlockMotion& m = run.state().blocks.motion[i];
        EXPECT_LT((Vec2(m.x, m.y) + run.model().origin - Vec2(5.0, 5.0)).norm(), 1.5 + 1.5);
    }
}

TEST(Stage, FixesAndFreesBlocks)
{
    CaseDef scene = scenes::stack(2);
    scene.stages = {{.name = "hold", .cycles = 100, .fix = {"block2"}},
                    {.name = "release", .cycles = 100, .free = {"block2"}},
                    {.name = "all", .cycles = 100, .fix = {"block1"}}};
    for (Vec2& p : scene.blocks[2].polygon)
        p.y() += 0.5;
    scene.blocks[2].velocity = {1.0, 0.0};
    CaseRun run(scene);
    run.advance(100);
    EXPECT_EQ(run.displacement("block2").norm(), 0.0) << "it hangs in the air";
    run.simulation.begin_stage(1);
    run.advance(100);
    EXPECT_NEAR(run.velocity("block2").y(), -9.81 * 100 * run.model().time_step, 1e-12);
    run.simulation.begin_stage(2);
    run.advance(10);
    EXPECT_EQ(run.velocity("block1").norm(), 0.0);
}

/// Two fixed blocks have no contact; once one is freed they must.
TEST(Stage, FindsTheContactsOfABlockThatItFrees)
{
    CaseDef scene = scenes::block_on_ground();
    scenes::add_block(scene, "other", rectangle({10, 10}, {11, 11}));
    scene.blocks[1].fix_x = scene.blocks[1].fix_y = scene.blocks[1].fix_rotation = true;
    scene.stages = {{.name = "held", .cycles = 10}, {.name = "freed", .cycles = 2000, .free = {"block"}}};
    CaseRun run(scene);
    run.advance(10);
    EXPECT_EQ(run.state().contacts.size(), 0);
    run.simulation.begin_stage(1);
    for (int i = 0; i < 2000; ++i)
    {
        run.advance(1);
        ASSERT_NEAR(run.displacement("block").y(), 0.0, 1e-5)
            << "cycle " << run.state().cycle << ": twice the static deflection is 7.6 um";
    }
    EXPECT_NEAR(run.forces_between("ground", "block").x(), 2700.0 * 9.81, 1.0);
}

TEST(Stage, SetsMethodAndDampingFromThereOn)
{
    CaseDef scene = scenes::block_on_ground();
    scene.contact.method = Method::force;
    scene.stages = {{.name = "one", .cycles = 10},
                    {.name = "two", .cycles = 10, .method = Method::impulse, .damping = DampingPreset::paper},
                    {.name = "three", .cycles = 10}};
    CaseRun run(scene);
    run.advance(10);
    EXPECT_EQ(run.simulation.count_contacts().points[static_cast<int>(Regime::impulse)], 0);
    run.simulation.begin_stage(1);
    run.advance(10);
    EXPECT_EQ(run.simulation.count_contacts().points[static_cast<int>(Regime::impulse)], 2);
    EXPECT_EQ(run.state().damping, DampingPreset::paper);
    run.simulation.begin_stage(2);
    EXPECT_EQ(run.state().method, Method::impulse) << "until another stage says otherwise";
}

TEST(Simulation, CountsCyclesTimeAndContactPoints)
{
    CaseDef scene = scenes::stack(3);
    scene.contact.method = Method::force;
    CaseRun run(scene);
    run.advance(1000);
    EXPECT_EQ(run.state().cycle, 1000);
    EXPECT_NEAR(run.state().time, 1000 * run.model().time_step, 1e-15);
    EXPECT_EQ(run.simulation.count_contacts().closed(), 6);
    EXPECT_LE(run.simulation.contact_point_updates(), 6000);
    EXPECT_GT(run.simulation.contact_point_updates(), 4000);
}
}  // namespace
}  // namespace hdem
