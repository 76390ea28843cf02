/// The judge of rest.* finds what is wrong, each kind of it, and nothing in what is right.

#include "verification/rest/judge.h"
#include "verification/rest/springs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hdem::verification::rest
{
namespace
{
/// A unit block on level ground that stays, and what becomes of it when all is well: it sinks a little.
class JudgeOfABlock : public testing::Test
{
  protected:
    JudgeOfABlock()
    {
        scene.def.joints = {{.name = "default", .normal_stiffness = 7e9, .shear_stiffness = 5e8, .friction_angle_deg = 30.0}};
        scene.def.materials = {{.name = "rock", .density = rock}};
        scene.def.stages = {{.name = "rest", .until_converged = true}};
        add_fixed(scene, "ground", rectangle(-5.0, -1.0, 5.0, 0.0));
        add_block(scene, "block", rectangle(-0.5, 0.0, 0.5, 1.0), Fate::stays);
        scene.settle = elastic_settle(scene);
        scene.stay = 1e-3;
        scene.least_way = 0.1;
        scene.supports.push_back({0, 1, rock * g, 0.01 * rock * g});
        outcome.converged = true;
        outcome.net.assign(2, Eigen::Vector3d(0.0, 0.0, 0.0));
        outcome.carried = {{0.0, rock * g}};
        put({0.0, -scene.settle}, 0.0);
    }
    /// The block ends there.
    void put(const Vec2& way, double rotation)
    {
        outcome.way = {{0.0, 0.0}, way};
        outcome.rotation = {0.0, rotation};
        outcome.bodies = bodies_of(scene);
        const Placement turn = turned_by(rotation / radians(1.0));
        Body& block = outcome.bodies[1];
        for (Vec2& v : block.parts.front().vertices)
            v = block.centroid + way + turn.turned(v - block.centroid);
        block.centroid += way;
    }
    [[nodiscard]] std::vector<Judged> wrong() const
    {
        std::vector<Judged> kinds;
        for (const Finding& finding : judge(scene, outcome))
            if (finding.is_wrong())
                kinds.push_back(finding.what);
        return kinds;
    }
    using Kinds = std::vector<Judged>;

    Scene scene;
    Outcome outcome;
};

TEST_F(JudgeOfABlock, FindsNothingWhereAllIsWell)
{
    EXPECT_EQ(wrong(), Kinds{});
}

TEST_F(JudgeOfABlock, FindsARunThatStops)
{
    outcome.failure = "cycle 7: overlap above contact.overlap_limit";
    EXPECT_EQ(wrong(), Kinds{Judged::finished});
    scene.overlap_stops = true;
    EXPECT_EQ(wrong(), Kinds{});
}

TEST_F(JudgeOfABlock, FindsWhatDoesNotComeToRestAndWhatMustNot)
{
    outcome.converged = false;
    EXPECT_EQ(wrong(), Kinds{Judged::converged});
    scene.end = End::never;
    EXPECT_EQ(wrong(), Kinds{});
    outcome.converged = true;
    EXPECT_EQ(wrong(), Kinds{Judged::converged});
}

TEST_F(JudgeOfABlock, FindsABlockThatWalks)
{
    put({2e-3, -scene.settle}, 0.0);
    EXPECT_EQ(wrong(), Kinds{Judged::stays});
    scene.fate[1] = Fate::moves;
    EXPECT_EQ(wrong(), Kinds{Judged::moves});
    put({0.2, -scene.settle}, 0.0);
    EXPECT_EQ(wrong(), Kinds{});
}

TEST_F(JudgeOfABlock, FindsAWrongPlace)
{
    scene.fate[1] = Fate::open;
    scene.places.push_back({1, {0.0, 0.5}, 1e-3});
    EXPECT_EQ(wrong(), Kinds{});
    put({2e-3, -scene.settle}, 0.0);
    EXPECT_EQ(wrong(), Kinds{Judged::place});
    scene.places.clear();
    scene.most_ways.push_back({1, 1e-3});
    EXPECT_EQ(wrong(), Kinds{Judged::place});
    scene.most_ways.clear();
    scene.region = Box{{-1.0, 0.0}, {1e-3, 1.0}};
    EXPECT_EQ(wrong(), Kinds{Judged::place});
    scene.region = Box{{-1.0, 0.0}, {1.0, 1.0}};
    EXPECT_EQ(wrong(), Kinds{});
}

TEST_F(JudgeOfABlock, FindsEnergyFromNowhere)
{
    outcome.peak = {.share = 1.1, .block = 1};
    EXPECT_EQ(wrong(), Kinds{Judged::speed});
    outcome.peak.share = 0.9;
    outcome.rise = 0.02;
    EXPECT_EQ(wrong(), Kinds{Judged::energy});
    outcome.rise = 0.0;
    outcome.residual = 1e-5;
    EXPECT_EQ(wrong(), Kinds{Judged::ledger});
    outcome.had_impulses = true;
    EXPECT_EQ(wrong(), Kinds{});
    outcome.residual = std::nan("");
    EXPECT_EQ(wrong(), Kinds{Judged::ledger});
}

TEST_F(JudgeOfABlock, FindsABlockOutOfBalance)
{
    outcome.net[1] = {0.0, 0.02 * rock * g, 0.0};
    EXPECT_EQ(wrong(), Kinds{Judged::balance});
    outcome.net[1] = {0.0, 0.0, 0.02 * rock * g * outcome.bodies[1].radius};
    EXPECT_EQ(wrong(), Kinds{Judged::balance});
    outcome.converged = false;
    scene.end = End::open;
    EXPECT_EQ(wrong(), Kinds{});
}

TEST_F(JudgeOfABlock, FindsABlockInTheAir)
{
    scene.fate[1] = Fate::open;
    put({0.0, 1e-3}, 0.0);
    EXPECT_EQ(wrong(), Kinds{Judged::support});
    put({0.0, 0.05}, radians(5.0));  // on a corner
    EXPECT_EQ(wrong(), Kinds{Judged::support});
}

TEST_F(JudgeOfABlock, FindsABlockInAnother)
{
    scene.fate[1] = Fate::open;
    put({0.0, -0.03}, 0.0);
    const Kinds kinds = wrong();
    EXPECT_NE(std::ranges::find(kinds, Judged::overlap), kinds.end());
}

TEST_F(JudgeOfABlock, FindsWeightThatIsNotCarried)
{
    outcome.carried = {{0.0, 0.98 * rock * g}};
    EXPECT_EQ(wrong(), Kinds{Judged::carried});
}

TEST_F(JudgeOfABlock, FindsATwinThatEndsElsewhere)
{
    Outcome twin = outcome;
    EXPECT_FALSE(judge_twins(scene, outcome, twin)[0].is_wrong());
    twin.way[1].x() += 3e-6;
    EXPECT_TRUE(judge_twins(scene, outcome, twin)[0].is_wrong());
    scene.fate[1] = Fate::moves;
    outcome.way[1].x() += 1.0;
    twin.way[1].x() += 1.003;
    EXPECT_FALSE(judge_twins(scene, outcome, twin)[0].is_wrong());
    twin.way[1].x() += 0.003;
    EXPECT_TRUE(judge_twins(scene, outcome, twin)[0].is_wrong());
}
}  // namespace
}  // namespace hdem::verification::rest
