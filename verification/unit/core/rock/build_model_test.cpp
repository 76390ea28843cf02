#include "core/rock/build_model.h"
#include "verification/unit/case_run.h"

#include <gmock/gmock.h>

#include <numeric>

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::CaseRun;
using testing::HasSubstr;

std::vector<Problem> problems_of(const CaseDef& def)
{
    try
    {
        build_model(def);
    }
    catch (const InputError& error)
    {
        return error.problems();
    }
    return {};
}

TEST(BuildModel, GivesMassAndInertiaOfTheShapes)
{
    CaseDef scene = scenes::empty_scene();
    scene.materials.push_back({.name = "steel", .density = 7850.0});
    scenes::add_block(scene, "plate", rectangle({0, 0}, {3, 0.5})).material = "steel";
    scenes::add_block(scene, "triangle", {{10, 0}, {13, 0}, {10, 2}});
    scenes::add_block(scene, "l", {{20, 0}, {22, 0}, {22, 1}, {21, 1}, {21, 2}, {20, 2}});
    const hdem::Setup setup = build_model(scene);
    const Model& model = setup.model;
    const auto at = [&](const std::string& name) { return model.find_block(name); };
    EXPECT_NEAR(model.mass[at("plate")], 7850.0 * 1.5, 1e-9);
    EXPECT_NEAR(model.inertia[at("plate")], 7850.0 * 1.5 * (9.0 + 0.25) / 12.0, 1e-9);
    EXPECT_NEAR(model.mass[at("triangle")], 2700.0 * 3.0, 1e-9);
    EXPECT_NEAR(model.inertia[at("triangle")], 2700.0 * 6.0 * 13.0 / 36.0, 1e-9);  // b h (b^2 + h^2) / 36
    // Three unit squares, each 1/6 about its own centre, about their common centroid (5/6, 5/6).
    double squares = 0.0;
    for (const Vec2& c : {Vec2(0.5, 0.5), Vec2(1.5, 0.5), Vec2(0.5, 1.5)})
        squares += 1.0 / 6.0 + (c - Vec2(5.0 / 6.0, 5.0 / 6.0)).squaredNorm();
    EXPECT_NEAR(model.inertia[at("l")], 2700.0 * squares, 1e-8);
    const BlockMotion& l = setup.state.blocks.motion[at("l")];
    EXPECT_NEAR((Vec2(l.x, l.y) + model.origin - Vec2(20.0 + 5.0 / 6.0, 5.0 / 6.0)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(model.radius[at("triangle")], Vec2(2.0, -2.0 / 3.0).norm(), 1e-12);
}

/// As maps have them, with a vertex wherever a neighbour has a corner.
TEST(BuildModel, MakesOneSideOfPiecesInOneLine)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "lower", {{0, 0}, {4, 0}, {4, 1}, {3, 1}, {1.5, 1}, {0, 1}});
    scenes::add_block(scene, "upper", {{0, 1}, {2, 1}, {4, 1}, {4, 2}, {0, 2}});
    scenes::add_block(scene, "hook", {{10, 0}, {12, 0}, {12, 1}, {11, 1}, {11, 2}, {10, 2}, {10, 1}});
    for (const double angle : {0.0, 23.0, 90.0})
        for (const CaseDef& seen : {scenes::turned(scene, angle), scenes::mirrored(scenes::turned(scene, angle))})
        {
            CaseRun run(seen);
            EXPECT_EQ(run.model().shapes.parts(), 4);
            EXPECT_EQ(run.model().shapes.vertex.size(), 16U);
            run.advance();
            ASSERT_EQ(run.state().contacts.size(), 1);
            EXPECT_NEAR(report_contact(run.state(), 0).bearing_length, 4.0, 1e-12) << angle;
        }
}

TEST(BuildModel, KeepsNamesAndTheUsersOrderAlongTheCurve)
{
    CaseDef scene = scenes::grid(8, 8);
    const Model model = build_model(scene).model;
    ASSERT_EQ(model.blocks(), static_cast<Index>(scene.blocks.size()));
    bool sorted_anew = false;
    for (Index user = 0; user < model.blocks(); ++user)
    {
        const Index slot = model.slot_of_user[user];
        EXPECT_EQ(model.user_number[slot], user);
        EXPECT_EQ(model.name[slot], scene.blocks[user].name);
        sorted_anew = sorted_anew || slot != user;
    }
    EXPECT_TRUE(sorted_anew);
}

/// Neighbours along the curve are neighbours in space: that is what it is for.
TEST(BuildModel, StoresNeighboursNearEachOther)
{
    CaseDef scene = scenes::empty_scene();
    for (int i = 0; i < 256; ++i)  // in an order that is none
    {
        const int k = (i * 37) % 256;
        scenes::add_block(scene, std::to_string(k),
                          rectangle({2.0 * (k % 16), 2.0 * (k / 16)}, {2.0 * (k % 16) + 1.0, 2.0 * (k / 16) + 1.0}));
    }
    const hdem::Setup setup = build_model(scene);
    double way = 0.0;
    for (Index i = 1; i < 256; ++i)
    {
        const BlockMotion& p = setup.state.blocks.motion[i - 1];
        const BlockMotion& q = setup.state.blocks.motion[i];
        way += std::hypot(q.x - p.x, q.y - p.y);
    }
    EXPECT_LT(way / 255.0, 2.5) << "a Hilbert curve through points 2 m apart takes steps of little more than 2 m";
}

TEST(BuildModel, TakesJointsBySetByMaterialsOrByDefault)
{
    CaseDef scene = scenes::joints(6.0, 6.0, 1.5);
    scene.materials.push_back({.name = "concrete", .density = 2400.0});
    scene.joints.push_back({.name = "bedding", .normal_stiffness = 1e9, .shear_stiffness = 1e8, .friction_angle_deg = 20.0});
    scene.joints.push_back({.name = "lining",
                            .normal_stiffness = 2e9,
                            .shear_stiffness = 1e8,
                            .friction_angle_deg = 40.0,
                            .restitution = 0.7,
                            .materials = {"rock", "concrete"}});
    scene.joint_sets[0].joint = "bedding";
    scenes::add_block(scene, "slab", rectangle({2, 6}, {4, 7})).material = "concrete";
    const CaseRun run(scene);
    const Model& model = run.model();
    const Contacts& contacts = run.state().contacts;
    std::set<std::string> seen;
    const Index slab = run.slot("slab");
    for (Index i = 0; i < contacts.size(); ++i)
    {
        if (report_contact(run.state(), i).length < 0.1)
            continue;  // beside each other, or a corner on a corner
        const std::string& name = model.joints.names[contacts.law[i]];
        const std::int32_t source = model.shapes.edge_source[contacts.ref_edge[i]];
        const bool on_slab = contacts.ref[i] == slab || contacts.inc[i] == slab;
        if (source == 0 || model.shapes.edge_source[contacts.inc_edge[i]] == 0)
            EXPECT_EQ(name, "bedding") << "on the slab too, where a face of this set meets it";
        else
            EXPECT_EQ(name, on_slab ? "lining" : "default");
        seen.insert(name);
    }
    EXPECT_EQ(seen, (std::set<std::string>{"bedding", "default", "lining"}));
    EXPECT_DOUBLE_EQ(model.joints.laws[2].restitution, 0.7);
    EXPECT_DOUBLE_EQ(model.joints.laws[1].restitution, scene.contact.restitution);
    EXPECT_DOUBLE_EQ(model.joints.laws[2].friction_coefficient, std::tan(radians(40.0)));
}

/// A rough joint is made ready for twice the weight of the rock above it: the height of the rock is that along gravity, or along what a load accelerates.
TEST(BuildModel, MakesJointsReadyForTheSameStressInATurnedModel)
{
    const auto stiffness = [](int quarters, bool is_load)
    {
        const auto turned = [&](Vec2 v)
        {
            for (int i = 0; i < quarters; ++i)
                v = Vec2(-v.y(), v.x());
            return v;
        };
        CaseDef scene = scenes::empty_scene();
        scenes::add_fixed_block(scene, "ground", rectangle({-30, -1}, {30, 0}));
        scenes::add_block(scene, "block", rectangle({0, 0}, {1, 1}));
        for (BlockDef& block : scene.blocks)
            for (Vec2& vertex : block.polygon)
                vertex = turned(vertex);
        scene.joints[0] = {.name = "default", .law = JointLaw::barton_bandis, .normal_stiffness = 1e10, .shear_stiffness = 1.0};
        scene.joints[0].jrc = 10.0;
        scene.joints[0].jcs = 5e7;
        scene.joints[0].residual_friction_angle_deg = 28.0;
        scene.gravity = is_load ? Vec2(0.0, 0.0) : turned({0.0, -9.81});
        if (is_load)
            scene.loads.push_back({.blocks = {"block"}, .acceleration = turned({0.0, -9.81})});
        return build_model(scene).model.joints.laws[0].shear_stiffness;
    };
    for (const bool is_load : {false, true})
        for (int quarters = 1; quarters < 4; ++quarters)
            EXPECT_EQ(stiffness(quarters, is_load), stiffness(0, is_load)) << quarters << ", " << is_load;
}

TEST(BuildModel, ScalesTheThresholdByModelAreaOverBlockArea)
{
    CaseDef scene = scenes::grid(4, 3);
    // Twelve unit squares, ground 6 m2, walls 3 m2 each: 15 blocks on 24 m2, in a box of 6 m x 4 m. [Lee2025] Eq. (28).
    EXPECT_NEAR(build_model(scene).model.threshold_scale, 24.0 / (24.0 / 15.0), 1e-9);
    scene.contact.threshold_scale = 1.0;
    EXPECT_EQ(build_model(scene).model.threshold_scale, 1.0);
}

TEST(BuildModel, RefusesNamesThatNobodyDefined)
{
    CaseDef scene = scenes::block_on_ground();
    scene.blocks[1].material = "cheese";
    ASSERT_EQ(problems_of(scene).size(), 1u);
    EXPECT_THAT(problems_of(scene)[0].text, HasSubstr("cheese"));

    scene = scenes::block_on_ground();
    scene.loads = {{.blocks = {"blok"}}};
    scene.stages[0].excavate = {"tunel"};
    scene.stages[0].fix = {"a"};
    scene.stages[0].free = {"b"};
    scene.histories = {{.name = "h", .block = "c"}, {.name = "i", .between = {"block", "d"}}};
    std::string keys;
    for (const Problem& problem : problems_of(scene))
        keys += problem.key + " ";
    EXPECT_EQ(keys, "load[0].blocks stage[0].excavate stage[0].fix stage[0].free history[0].block history[1].between ")
        << "all of them, not the first";
}

TEST(BuildModel, WarnsOfAStaticSolutionOfFewBlocks)
{
    for (const auto& [columns, is_told] : {std::pair(19, true), std::pair(20, false)})
    {
        CaseDef scene = scenes::grid(columns, 10);
        scene.stages = {{.name = "rest", .until_converged = true, .solver = RestSolver::statics}};
        const std::vector<Problem> warnings = build_model(scene).warnings;
        ASSERT_EQ(warnings.size(), is_told ? 1u : 0u) << columns;
        for (const Problem& warning : warnings)
            EXPECT_THAT(warning.text, HasSubstr("solver = \"static\" (has no effect: there are 190 free blocks, and below 200"));
    }
}

TEST(BuildModel, RefusesAModelThatCannotMove)
{
    CaseDef scene = scenes::empty_scene();
    EXPECT_EQ(problems_of(scene).size(), 1u);
    scenes::add_fixed_block(scene, "rock", rectangle({0, 0}, {1, 1}));
    ASSERT_EQ(problems_of(scene).size(), 1u);
    EXPECT_THAT(problems_of(scene)[0].text, HasSubstr("every block is fixed"));
    scene.stages = {{.name = "free", .cycles = 10, .free = {"rock"}}};
    EXPECT_TRUE(problems_of(scene).empty());
}

/// The step is good for blocks that are freed later, as if they had been free from the start.
TEST(BuildModel, TakesAStepForBlocksThatAStageFrees)
{
    CaseDef scene = scenes::block_on_ground(5.0, 5.0);
    scenes::add_block(scene, "small", rectangle({4.0, 0.0}, {4.1, 0.1}));
    const double step = build_model(scene).model.time_step, paper_step = build_model(scene).model.paper_time_step;
    scene.blocks[2].fix_x = scene.blocks[2].fix_y = scene.blocks[2].fix_rotation = true;
    EXPECT_GT(build_model(scene).model.time_step, 2.0 * step);
    scene.stages.push_back({.name = "free", .cycles = 10, .free = {"small"}});
    EXPECT_EQ(build_model(scene).model.time_step, step);
    EXPECT_EQ(build_model(scene).model.paper_time_step, paper_step);
}

TEST(BuildModel, RefusesAPrescribedVelocityOfAFreeComponent)
{
    CaseDef scene = scenes::block_on_ground();
    scene.blocks[1].fix_y = true;
    scene.loads = {{.blocks = {"block"}, .velocity_x = 1.0, .velocity_y = 1.0, .angular_velocity = 1.0}};
    EXPECT_EQ(problems_of(scene).size(), 2u) << "x and rotation";
}

TEST(BuildModel, KeepsItsDigitsFarFromTheOrigin)
{
    const Vec2 by(1e6, -3e6);
    const hdem::Setup here = build_model(scenes::pile(10, 5)), there = build_model(scenes::moved(scenes::pile(10, 5), by));
    EXPECT_EQ(there.model.origin - here.model.origin, by);
    for (Index i = 0; i < here.model.blocks(); ++i)
    {
        // The user's own coordinates are rounded to 5e-10 m there.
        EXPECT_NEAR(here.state.blocks.motion[i].x, there.state.blocks.motion[i].x, 1e-9);
        EXPECT_NEAR(here.model.mass[i], there.model.mass[i], 1e-5);
    }
}
}  // namespace
}  // namespace hdem
