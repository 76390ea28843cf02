#include "core/statics/static_contacts.h"
#include "verification/unit/case_run.h"

namespace hdem
{
namespace
{
using test::CaseRun;

/// Forces and moments of a contact on ref and inc, in the order of its stiffness.
Eigen::Matrix<double, 6, 1> loads_of(const Model& model, const State& state, const std::vector<StaticPoint>& points, Index contact)
{
    std::vector<BlockLoad> loads(2 * static_cast<std::size_t>(state.contacts.size()));
    put_loads({contact, contact + 1}, model, state, points, false, loads);
    const Index swapped = state.contacts.swapped[contact];
    const BlockLoad &ref = loads[2 * contact + swapped], &inc = loads[2 * contact + 1 - swapped];
    Eigen::Matrix<double, 6, 1> all;
    all << ref.x, ref.y, ref.moment, inc.x, inc.y, inc.moment;
    return all;
}

/// A block pressed into the ground, whose face is tilted by 20 degrees, and slid along it by `way` [m].
struct TiltedContact
{
    explicit TiltedContact(double way) : run(scenes::turned(scene(), 20.0)), state(run.state())
    {
        for (Index i = 0; i < state.contacts.size(); ++i)
            if (state.contacts.ref[i] == run.slot("block") || state.contacts.inc[i] == run.slot("block"))
                contact = i;
        points.resize(2 * static_cast<std::size_t>(state.contacts.size()));
        tangents.resize(static_cast<std::size_t>(state.contacts.size()));
        begin_points({0, state.contacts.size()}, run.model(), state, points);
        const double a = radians(20.0);
        move("block", way * std::cos(a) + 1e-5 * std::sin(a), way * std::sin(a) - 1e-5 * std::cos(a), 2e-6);
        for (StaticPoint& point : points)
            point.trust = 0.0;
        renew_points({0, state.contacts.size()}, run.model(), state, {.is_first = true}, points, tangents);
    }

    static CaseDef scene()
    {
        CaseDef scene = scenes::block_on_ground(2.0, 1.0);
        scene.joints[0].cohesion = 1e4;
        return scene;
    }

    void move(const std::string& name, double x, double y, double turn)
    {
        BlockMotion& m = state.blocks.motion[run.slot(name)];
        m.x += x;
        m.y += y;
        const double c = m.c, s = m.s;
        m.c = c * std::cos(turn) - s * std::sin(turn);
        m.s = s * std::cos(turn) + c * std::sin(turn);
    }

    CaseRun run;
    State state;
    Index contact = no_index;
    std::vector<StaticPoint> points;
    std::vector<ContactTangent> tangents;
};

class StaticContacts : public testing::TestWithParam<double>
{
};

/// What the change of lengths and axes adds is of the order overlap over length, 1e-5.
TEST_P(StaticContacts, StiffnessIsTheDerivativeOfTheForcesOnBothBlocks)
{
    TiltedContact c(GetParam());
    const PointStatus expected = GetParam() > 1e-4 ? PointStatus::slip : PointStatus::stick;
    ASSERT_EQ(c.points[2 * c.contact].status, expected);
    Matrix6 stiffness;
    stiffness << c.tangents[c.contact].stiffness(0).coupled, c.tangents[c.contact].stiffness(1).coupled;
    const double h = 1e-8;
    for (int column = 0; column < 6; ++column)
    {
        const bool on_ref = column < 3;
        const Index block = on_ref ? c.state.contacts.ref[c.contact] : c.state.contacts.inc[c.contact];
        const std::string& name = c.run.model().name[block];
        const auto by = [&](double step)
        { c.move(name, column % 3 == 0 ? step : 0.0, column % 3 == 1 ? step : 0.0, column % 3 == 2 ? step : 0.0); };
        by(h);
        const Eigen::Matrix<double, 6, 1> after = loads_of(c.run.model(), c.state, c.points, c.contact);
        by(-2.0 * h);
        const Eigen::Matrix<double, 6, 1> before = loads_of(c.run.model(), c.state, c.points, c.contact);
        by(h);
        const Eigen::Matrix<double, 6, 1> difference = (before - after) / (2.0 * h);
        EXPECT_LT((difference - stiffness.col(column)).norm(), 1e-4 * stiffness.norm()) << "column " << column;
    }
}

INSTANTIATE_TEST_SUITE_P(Ways, StaticContacts, testing::Values(1e-6, 1e-3),
                         [](const auto& way) { return way.param > 1e-4 ? "Slip" : "Stick"; });

TEST(StaticContacts, TrustFollowsTheStatus)
{
    TiltedContact c(1e-3);
    StaticPoint& point = c.points[2 * c.contact];
    const auto renew = [&] { return renew_points({0, c.state.contacts.size()}, c.run.model(), c.state, {}, c.points, c.tangents); };
    point.trust = 0.04;
    renew();
    EXPECT_DOUBLE_EQ(point.trust, 0.01) << "it slips as before";
    point.status = PointStatus::stick;
    renew();
    EXPECT_DOUBLE_EQ(point.trust, 0.16) << "it has begun to slip";
}

TEST(StaticContacts, APartedPointThatClosesAgainBearsAsIfItHadNotParted)
{
    TiltedContact c(1e-6);
    const double a = radians(20.0);
    const auto renew = [&](bool all) {
        return renew_points({0, c.state.contacts.size()}, c.run.model(), c.state, {.part_all_open = all}, c.points, c.tangents);
    };
    const auto lift = [&](double by) { c.move("block", -by * std::sin(a), by * std::cos(a), 0.0); };
    const Eigen::Matrix<double, 6, 1> before = loads_of(c.run.model(), c.state, c.points, c.contact);
    lift(1e-3);
    renew(true);
    ASSERT_TRUE(c.points[2 * c.contact].is_parted);
    lift(-1e-3);
    EXPECT_EQ(renew(false).newly_parted, 2) << "the search is not at its end";
    EXPECT_FALSE(c.points[2 * c.contact].is_parted);
    EXPECT_LT((loads_of(c.run.model(), c.state, c.points, c.contact) - before).norm(), 1e-9 * before.norm());
    lift(1e-3);
    renew(true);
    lift(-1e-3);
    EXPECT_EQ(renew(false).newly_parted, 0) << "once a search";
    EXPECT_TRUE(c.points[2 * c.contact].is_parted);
}

TEST(StaticContacts, AnOpenPointPartsAfterThreeIterationsOrWhenAllDo)
{
    TiltedContact c(1e-3);
    const double a = radians(20.0);
    c.move("block", -1e-3 * std::sin(a), 1e-3 * std::cos(a), 0.0);
    const auto renew = [&](bool all) {
        return renew_points({0, c.state.contacts.size()}, c.run.model(), c.state, {.part_all_open = all}, c.points, c.tangents);
    };
    EXPECT_EQ(renew(false).newly_parted, 0);
    EXPECT_EQ(renew(false).open, 2);
    EXPECT_LT(c.points[2 * c.contact].iterations_open, 3);
    EXPECT_EQ(renew(false).newly_parted, 2);
    EXPECT_EQ(loads_of(c.run.model(), c.state, c.points, c.contact).norm(), 0.0);
}
}  // namespace
}  // namespace hdem
