/// hold = "mean": rock that tractions press from all sides, and that nothing fixes.

#include "core/boundary/mean_hold.h"
#include "core/geometry/unit_direction.h"
#include "parallel/stages.h"
#include "verification/unit/core/boundary/sides.h"

#include <cmath>

namespace hdem
{
namespace
{
using namespace test;

CaseDef held(CaseDef scene)
{
    scene.domain.hold = DomainHold::mean;
    for (StageDef& stage : scene.stages)
        stage.fix.clear();
    return scene;
}

/// Joints of three directions under (-8, -5, 1) MPa, which grow with depth, and sigma n on all sides.
CaseDef pressed_all_around(double size)
{
    CaseDef scene = square_pattern(size, size);
    scene.joint_sets.clear();
    for (const double dip : {25.0, -55.0, 90.0})
        scene.joint_sets.push_back({.name = "dip" + std::to_string(dip), .dip_deg = dip, .spacing = 1.7});
    scene.generator.smallest_block_area = scene.generator.smallest_edge = 0.02;
    scene.joints[0].friction_angle_deg = 50.0;
    scene.insitu = {.given = true, .stress = StressDef{-8e6, -5e6, 1e6}, .gradient = {0.0, 2700.0 * 9.81, 0.0}};
    scene.gravity = {0.0, -9.81};
    for (const char* name : {"left", "right", "bottom", "top"})
        scene.boundaries.push_back(in_situ(side(name, BoundaryKind::stress)));
    return held(scene);
}

/// Mean displacement of the blocks at the sides, and how far they have turned about their centre.
struct MeanMove
{
    Vec2 way = {0.0, 0.0};
    double turn = 0.0;
};

MeanMove mean_move(const CaseRun& run)
{
    const std::vector<Index> blocks = blocks_held_on_average(run.model(), run.state());
    const Model& model = run.model();
    MeanMove mean;
    Vec2 centre(0.0, 0.0);
    double mass = 0.0, inertia = 0.0;
    for (const Index b : blocks)
    {
        mass += model.mass[b];
        centre += model.mass[b] * run.state().blocks.reference_position[b];
        mean.way += model.mass[b] * run.state().blocks.displacement(b);
    }
    for (const Index b : blocks)
    {
        const Vec2 arm = run.state().blocks.reference_position[b] - centre / mass;
        inertia += model.mass[b] * arm.squaredNorm() + model.inertia[b];
        mean.turn += model.mass[b] * cross(arm, run.state().blocks.displacement(b)) +
                     model.inertia[b] * run.state().blocks.motion[b].angle;
    }
    return {mean.way / mass, mean.turn / inertia};
}

TEST(MeanHold, LeavesRockInEquilibriumWhereItIsDrawn)
{
    expect_nothing_moves(pressed_all_around(8.0));
}

/// E = K_N s = 1e10 Pa: 1 MPa more makes 6 m shorter by 0.5 mm, the bottom's half joint included; the middle stays.
TEST(MeanHold, RockIsStrainedAboutItsMiddle)
{
    for (const Method method : {Method::force, Method::hybrid})
    {
        CaseDef scene = square_pattern(4.0, 6.0);
        scene.contact.method = method;
        scene.insitu = {.given = true, .stress = StressDef{-1e6, -1e6, 0.0}};
        scene.boundaries = {pressed("left", 1e6), pressed("right", 1e6), pressed("bottom", 2e6), pressed("top", 2e6)};
        scene.stages = {{.name = "press", .until_converged = true}};  // then rock keeps its springs
        CaseRun run(held(scene));
        run.advance(8000);
        for (int column = 0; column < 4; ++column)
            for (const auto& [y, way] : {std::pair{0.5, 2.5e-4}, {2.5, 0.5e-4}, {5.5, -2.5e-4}})
            {
                const Vec2 at = Vec2(column + 0.5, y) - run.model().origin;
                for (Index b = 0; b < run.model().blocks(); ++b)
                    if ((run.state().blocks.reference_position[b] - at).norm() < 1e-6)
                    {
                        EXPECT_NEAR(run.state().blocks.displacement(b).y(), way, 1e-8) << y;
                        EXPECT_NEAR(run.state().blocks.displacement(b).x(), 0.0, 1e-9);
                    }
            }
        EXPECT_LT(mean_move(run).way.norm(), 1e-14);
        EXPECT_LT(ledger_residual(run), 1e-9);
    }
}

/// Two sets of joints give way more to one side: rock turns as a whole against its blocks. Dead loads would go on turning it over.
TEST(MeanHold, RockDoesNotTurn)
{
    CaseDef scene = pressed_all_around(12.0);
    scene.joint_sets.pop_back();
    for (BoundaryDef& boundary : scene.boundaries)
        boundary.is_insitu = false;
    scene.gravity = {0.0, 0.0};
    scene.insitu.gradient = {};
    const Vec2 more[4] = {{8.1e6, 0.6e6}, {8.1e6, 0.6e6}, {5e6, -0.6e6}, {5e6, -0.6e6}};
    for (int k = 0; k < 4; ++k)
        scene.boundaries[static_cast<std::size_t>(k)].stress = more[k];
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
    {
        scene.contact.method = method;
        CaseRun run(scene);
        run.advance(3000);
        double farthest = 0.0;
        for (Index b = 0; b < run.model().blocks(); ++b)
            farthest = std::max(farthest, run.state().blocks.displacement(b).norm());
        if (method != Method::impulse)  // which gives nothing way
        {
            EXPECT_GT(farthest, 1e-5) << name_of(method);
        }
        farthest = std::max(farthest, 1e-5);
        const MeanMove mean = mean_move(run);
        EXPECT_LT(mean.way.norm(), 1e-6 * farthest) << name_of(method);
        EXPECT_LT(std::abs(mean.turn), 1e-3 * farthest / 12.0) << name_of(method) << ": the arms change";
        EXPECT_LT(ledger_residual(run), method == Method::impulse ? 1e-4 : 1e-6) << name_of(method);
    }
}

/// Under gravity tractions that were in equilibrium push up once rock is taken out: its weight is carried at the sides, and the stage ends.
TEST(MeanHold, CarriesTheWeightOfWhatIsExcavated)
{
    CaseDef scene = square_pattern(11.0, 11.0);
    scene.gravity = {0.0, -9.81};
    scene.insitu = {.given = true, .stress = StressDef{-1e6, -1e6, 0.0}, .gradient = {0.0, 2700.0 * 9.81, 0.0}};
    for (const char* name : {"left", "right", "bottom", "top"})
        scene.boundaries.push_back(in_situ(side(name, BoundaryKind::stress)));
    scene.excavations = {
        {.name = "hole", .shape = OutlineShape::rectangle, .position = Vec2(5.5, 5.0), .width = 1.0, .height = 1.0}};
    scene.joints[0].friction_angle_deg = 60.0;
    scene.contact.method = Method::hybrid;
    scene.stages = {{.name = "dig", .until_converged = true, .max_cycles = 100000, .excavate = {"hole"}}};
    CaseRun run(held(scene));
    const StageResult stage = run_stages(run.simulation, {}).front();
    EXPECT_TRUE(stage.at_rest);
    const MeanMove mean = mean_move(run);
    EXPECT_LT(mean.way.norm(), 1e-12);
    EXPECT_LT(std::abs(mean.turn), 1e-12);
    EXPECT_LT(ledger_residual(run), 1e-6);
}

/// A small block falls on the ground, a thousandth of all: the mean of all free blocks would push the others up by a thousandth of its way.
TEST(MeanHold, AFallingBlockPushesNothingUp)
{
    CaseDef scene = square_pattern(7.0, 7.0);
    scene.gravity = {0.0, -9.81};
    scene.insitu = {.given = true, .stress = StressDef{-1e6, 0.0, 0.0}, .gradient = {0.0, 2700.0 * 9.81, 0.0}, .reference = 7.0};
    for (const char* name : {"left", "right", "bottom"})
        scene.boundaries.push_back(in_situ(side(name, BoundaryKind::stress)));
    scenes::add_block(scene, "stone", scenes::rectangle({3.4, 8.0}, {3.65, 8.25}));
    CaseRun run(held(scene));
    while (run.state().time < 0.3)
        run.advance(100);
    EXPECT_NEAR(run.displacement("stone").y(), -0.5 * 9.81 * 0.09, 1e-2);
    for (Index b = 0; b < run.model().blocks(); ++b)
        if (run.model().name[b] != "stone")
        {
            EXPECT_LT(run.state().blocks.displacement(b).norm(), 1e-9) << run.model().name[b];
        }
}

TEST(MeanHold, IsTheSameOnSeveralThreadsAndAfterARestart)
{
    CaseDef scene = pressed_all_around(20.0);
    for (std::size_t k : {0U, 1U})  // left, right
    {
        scene.boundaries[k].is_insitu = false;
        scene.boundaries[k].stress = Vec2(7e6, 1e6);
    }
    scene.gravity = {0.0, 0.0};
    scene.insitu.gradient = {};
    for (const Method method : {Method::force, Method::hybrid, Method::impulse})
    {
        scene.contact.method = method;
        CaseRun one(scene, 1), two(scene, 2), three(scene, 3);
        one.advance(150);
        Simulation again(one.model(), one.state(), 2);
        for (CaseRun* run : {&two, &three})
            run->advance(300);
        one.advance(150);
        again.advance(150);
        EXPECT_EQ(one.hash(), two.hash()) << name_of(method);
        EXPECT_EQ(one.hash(), three.hash()) << name_of(method);
        EXPECT_EQ(one.hash(), state_hash(again.model(), again.state())) << name_of(method);
        EXPECT_EQ(one.state().ledger.load_work, three.state().ledger.load_work);
        EXPECT_NE(one.state().ledger.load_work, 0.0);
    }
}

TEST(MeanHold, LeavesNoBlockOut)
{
    CaseDef scene = pressed_all_around(8.0);
    scene.stages = {{.name = "run", .until_converged = true}};
    CaseRun run(scene);
    const StageRules rules = resolve_rules(run.model(), run.state());
    EXPECT_FALSE(rules.rest.leaves_out);
    EXPECT_TRUE(rules.step.varies);
    const StageResult stage = run_stages(run.simulation, {}).front();
    EXPECT_TRUE(stage.at_rest);
}

TEST(MeanHold, IsRefusedWhereItMakesNoSense)
{
    const CaseDef good = pressed_all_around(8.0);
    const auto says = [](const CaseDef& scene, const std::string& key, const std::string& text)
    {
        try
        {
            build_model(scene);
            ADD_FAILURE() << "built, instead of: " << text;
        }
        catch (const InputError& error)
        {
            ASSERT_EQ(error.problems().size(), 1U);
            EXPECT_EQ(error.problems()[0].key, key);
            EXPECT_NE(error.problems()[0].text.find(text), std::string::npos) << error.problems()[0].text;
        }
    };
    CaseDef scene = good;
    scene.boundaries.clear();
    says(scene, "domain.hold", "no side is of kind stress");
    scene = good;
    scene.boundaries[2] = side("bottom", BoundaryKind::roller);
    says(scene, "domain.hold", "\"bottom\" holds the rock already");
    scene.boundaries[2] = side("bottom", BoundaryKind::fixed);
    says(scene, "domain.hold", "\"bottom\" holds the rock already");
    scene = good;
    scene.boundaries.erase(scene.boundaries.begin() + 2);
    says(scene, "domain.hold", "leave a force of");
    scene.domain.fixed = {"bottom"};
    says(scene, "domain.hold", "is fixed, and holds the rock already");
    scene = good;
    for (BoundaryDef& boundary : scene.boundaries)
    {
        boundary.is_insitu = false;
        boundary.stress = Vec2(1e6, 1e5);  // all shear stresses anticlockwise
    }
    scene.gravity = {0.0, 0.0};
    says(scene, "domain.hold", "leave a moment of");
    scene = good;
    scene.stages[0].fix = {"b1"};
    says(scene, "domain.hold", "fixes blocks, which hold the rock already");
    scene = good;
    scene.stages = {{.name = "run", .until_converged = true, .solver = RestSolver::statics}};
    says(scene, "stage[0].solver", "needs something that stands still");
    scene = good;
    scene.stages = {{.name = "pressed", .cycles = 10}, {.name = "off", .cycles = 10}};
    for (BoundaryDef& boundary : scene.boundaries)
        boundary.stages = {"pressed"};
    says(scene, "domain.hold", "stage \"off\": no side is of kind stress");
}
}  // namespace
}  // namespace hdem
