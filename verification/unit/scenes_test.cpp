#include "verification/unit/case_run.h"

namespace hdem
{
namespace
{
using test::CaseRun;

TEST(Scenes, AreWhatTheySay)
{
    const CaseDef wall = scenes::wall(3, 4);
    EXPECT_EQ(wall.blocks.size(), 13u);
    EXPECT_EQ(scenes::grid(4, 5).blocks.size(), 23u);
    EXPECT_EQ(scenes::stack(7).blocks.size(), 8u);
    EXPECT_EQ(scenes::pile(10, 4).blocks.size(), 13u);
}

TEST(Scenes, WallStandsUnderItsWeight)
{
    CaseRun run(scenes::wall(3, 4));
    run.advance(3000);
    for (const std::string name : {"1.1", "2.4", "3.2"})
        EXPECT_LT(run.displacement(name).norm(), 1e-4) << name;
}

TEST(Scenes, VoronoiCellsFillTheirRectangle)
{
    const hdem::Setup setup = build_model(scenes::voronoi(8, 6, 3));
    double area = 0.0;
    for (const double a : setup.model.area)
        area += a;
    EXPECT_NEAR(area, 48.0, 1e-9);
    EXPECT_EQ(setup.model.blocks(), 48);
}

TEST(Scenes, VoronoiRockStands)
{
    CaseRun run(scenes::voronoi(8, 6, 3));
    run.advance(3000);
    for (Index i = 0; i < run.model().blocks(); ++i)
        EXPECT_LT(run.state().blocks.displacement(i).norm(), 1e-3) << run.model().name[i];
}

TEST(Scenes, PileFallsIntoAHeapAndTheSameSeedGivesTheSame)
{
    CaseDef scene = scenes::pile(12, 4, 5);
    CaseRun run(scene);
    EXPECT_EQ(run.simulation.count_contacts().closed(), 0);
    run.advance(80000);
    run.simulation.check_state();
    EXPECT_GE(run.simulation.count_contacts().closed(), 18) << "two points carry a block at rest; three quarters of the twelve are";
    EXPECT_EQ(scenes::pile(12, 4, 5).blocks[7].polygon, scene.blocks[7].polygon);
    EXPECT_NE(scenes::pile(12, 4, 6).blocks[7].polygon, scene.blocks[7].polygon);
}
}  // namespace
}  // namespace hdem
