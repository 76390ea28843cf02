#include "core/model/block_order.h"
#include "verification/unit/core/boundary/sides.h"

#include <algorithm>
#include <map>

namespace hdem
{
namespace
{
using namespace test;

/// Of 2 MPa 1 MPa is left in the second stage: each of the five joints opens by sigma / K.
TEST(Boundary, StressThatEndsLetsTheColumnExpand)
{
    CaseDef scene = square_pattern(1.0, 5.0);
    scene.insitu = {.given = true, .stress = StressDef{0.0, -2e6, 0.0}};
    scene.boundaries = {side("bottom", BoundaryKind::roller), pressed("top", 1e6), pressed("top", 1e6)};
    scene.boundaries[2].stages = {"held"};
    scene.stages = {{.name = "held", .cycles = 100}, {.name = "off", .cycles = 4000}};
    std::map<std::int64_t, double> first_speed;
    for (const std::int64_t relax : {0, 500})
    {
        scene.stages[1].relax_cycles = relax;
        CaseRun run(scene);
        run.advance(100);
        run.simulation.begin_stage(1);
        run.advance(1);
        first_speed[relax] = run.velocity("b5").y();
        run.advance(3999);
        for (int i = 1; i <= 5; ++i)
            EXPECT_NEAR(run.displacement("b" + std::to_string(i)).y(), i * 1e-4, 1e-9) << "relax_cycles " << relax;
        EXPECT_LT(ledger_residual(run), 1e-9);
    }
    EXPECT_GT(first_speed[0], 1e-3);
    EXPECT_LT(first_speed[500], 0.01 * first_speed[0]) << "it is taken off over 500 cycles";
}

/// A wall that ends is taken away; one that begins touches the rock without force.
TEST(Boundary, WallsBeginAndEndWithTheirStages)
{
    CaseDef scene = square_pattern(1.0, 5.0);
    scene.insitu = {.given = true, .stress = StressDef{0.0, -2e6, 0.0}};
    scene.gravity = {0.0, -9.81};
    scene.insitu.gradient.yy = 2700.0 * 9.81;
    scene.insitu.reference = 5.0;
    scene.boundaries = {side("bottom", BoundaryKind::fixed), side("top", BoundaryKind::roller)};
    scene.boundaries[1].stages = {"held", "again"};
    scene.stages = {
        {.name = "held", .cycles = 100}, {.name = "off", .cycles = 5000, .relax_cycles = 2000}, {.name = "again", .cycles = 500}};
    CaseRun run(scene);
    run.advance(100);
    const Index wall = run.slot("top");
    EXPECT_NEAR(run.state().blocks.force[wall].y, 2e6, 1e-3);
    run.simulation.begin_stage(1);
    EXPECT_EQ(run.state().blocks.present[wall], 0);
    run.advance(4000);
    EXPECT_NEAR(run.displacement("b5").y(), 8e-4, 1e-9) << "four joints, the lowest block is fixed";
    run.simulation.begin_stage(2);
    EXPECT_EQ(run.state().blocks.present[wall], 1);
    run.advance(500);
    EXPECT_NEAR(run.state().blocks.force[wall].y, 0.0, 1.0);
    const double rise = run.position("top").y() - run.model().boundaries[1].walls[0].centre.y();
    EXPECT_NEAR(rise, 8e-4, 1e-9) << "the wall stands where the block has come to";
}

TEST(Boundary, FixedSideThatEndsFreesItsBlocks)
{
    CaseDef scene = square_pattern(3.0, 3.0);
    scene.insitu = {.given = true, .stress = StressDef{-1e6, -1e6, 0.0}};
    scene.boundaries = {side("bottom", BoundaryKind::fixed), side("top", BoundaryKind::fixed), side("left", BoundaryKind::fixed),
                        side("right", BoundaryKind::fixed)};
    scene.boundaries[1].stages = {"held"};
    scene.stages = {{.name = "held", .cycles = 10}, {.name = "off", .cycles = 4000}};
    CaseRun run(scene);
    run.advance(10);
    EXPECT_FALSE(run.state().blocks.is_free(run.slot("b8")));
    run.simulation.begin_stage(1);
    EXPECT_TRUE(run.state().blocks.is_free(run.slot("b8")));
    EXPECT_FALSE(run.state().blocks.is_free(run.slot("b9"))) << "the right side still holds it";
    run.advance(4000);
    EXPECT_GT(run.displacement("b8").y(), 1e-5) << "the stress of the joint below it moves it";
    EXPECT_LT(ledger_residual(run), 1e-9);
}

/// `fix` holds until `free`, whatever sides do.
TEST(Boundary, FixedSideThatEndsDoesNotFreeWhatAStageHolds)
{
    for (const std::size_t stage_of_fix : {0U, 1U})
    {
        CaseDef scene = square_pattern(3.0, 3.0);
        scene.boundaries = {side("bottom", BoundaryKind::fixed), side("top", BoundaryKind::fixed)};
        scene.boundaries[1].stages = {"first", "held"};
        scene.stages = {{.name = "first", .cycles = 10},
                        {.name = "held", .cycles = 10},
                        {.name = "off", .cycles = 10},
                        {.name = "free", .cycles = 10}};
        scene.stages[stage_of_fix].fix = {"b8"};
        scene.stages[3].free = {"b8"};
        CaseRun run(scene);
        for (const Index stage : {1, 2, 3})
        {
            run.advance(10);
            run.simulation.begin_stage(stage);
            EXPECT_EQ(run.state().blocks.is_free(run.slot("b8")), stage == 3) << stage_of_fix << " " << stage;
            EXPECT_EQ(run.state().blocks.is_free(run.slot("b7")), stage >= 2) << stage_of_fix << " " << stage;
        }
    }
}

TEST(Boundary, FixedSideHoldsWhatIsToBeExcavated)
{
    CaseDef scene = square_pattern(3.0, 3.0);
    ExcavationDef& pit = scene.excavations.emplace_back();
    pit.name = "pit";
    pit.shape = OutlineShape::rectangle;
    pit.position = {1.5, 0.0};
    pit.width = pit.height = 1.0;
    scene.boundaries = {side("bottom", BoundaryKind::fixed)};
    scene.stages = {{.name = "held", .cycles = 10}, {.name = "dig", .cycles = 10, .excavate = {"pit"}}};
    CaseRun run(scene);
    EXPECT_FALSE(run.state().blocks.is_free(run.slot("pit.1")));
    run.advance(10);
    run.simulation.begin_stage(1);
    EXPECT_EQ(run.state().blocks.present[run.slot("pit.1")], 0);
    run.advance(10);
    EXPECT_EQ(run.displacement("pit.1"), Vec2(0.0, 0.0));
}

/// Blocks are sorted anew in memory while they move; sides keep theirs.
TEST(Boundary, KeepsItsBlocksWhenTheyAreSorted)
{
    CaseDef scene = square_pattern(4.0, 3.0);
    scene.boundaries = {side("left", BoundaryKind::roller), side("bottom", BoundaryKind::fixed), pressed("top", 1e6)};
    Model model = build_model(scene).model;
    const auto names = [&]
    {
        std::vector<std::string> found;
        for (const Boundary& boundary : model.boundaries)
        {
            for (const BoundaryFace& face : boundary.faces)
                found.push_back(model.name[face.block]);
            for (const BoundaryWall& wall : boundary.walls)
                found.push_back(model.name[wall.block]);
            for (const BoundaryForce& force : boundary.forces)
                found.push_back(model.name[force.block]);
            for (const Index block : boundary.holds)
                found.push_back(model.name[block]);
        }
        return found;
    };
    const std::vector<std::string> before = names();
    EXPECT_EQ(before.size(), 3U + 1U + 4U + 4U + 4U + 4U);
    std::vector<Index> order = model.user_number;
    std::reverse(order.begin(), order.end());
    reorder_blocks(order, model);
    EXPECT_EQ(names(), before);
}
}  // namespace
}  // namespace hdem
