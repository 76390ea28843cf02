/// What springs give they were given before: forces are the gradient of their energy, and neither contact length nor features add any.

#include "verification/unit/block_pair.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace hdem::test
{
namespace
{
/// A face 2 m long, 1 m deep, and a block of 1 m x 0.4 m.
BlockPair face_and_block()
{
    CaseDef scene = pair_scene(scenes::rectangle({-1.0, -1.0}, {1.0, 0.0}), scenes::rectangle({-0.5, -0.2}, {0.5, 0.2}));
    scene.contact.method = Method::force;
    return BlockPair(scene);
}

/// Energy of the normal springs with the features as they are [J].
double normal_energy(const BlockPair& pair)
{
    const Contact contact = pair.state.contacts.get(0);
    const EdgeTouch t = pair.touch(contact);
    const double stiffness = pair.model.joints.laws[contact.law].normal_stiffness * point_length(t.length, contact.length_floor);
    double energy = 0.0;
    for (const TouchPoint& p : t.point)
        if (is_closed(t.length, p.overlap, contact.length_floor))
            energy += 0.5 * stiffness * std::pow(std::max(p.overlap, 0.0), 2);
    return energy;
}

void shift(BlockPair& pair, Index block, int along, double by)
{
    const BlockMotion& m = pair.motion(block);
    pair.place(block, {m.x + (along == 0 ? by : 0.0), m.y + (along == 1 ? by : 0.0)}, m.angle + (along == 2 ? by : 0.0));
}

/// Is a vertex near an end of the reference edge, where the tilt force leaves out a part of dV/dL?
bool is_at_an_end(const EdgeTouch& touch)
{
    return std::any_of(touch.point, touch.point + 2,
                       [](const TouchPoint& p) { return p.inside > -0.01 && p.inside < p.overlap + 0.01; });
}

TEST(SpringEnergy, HasTheForcesForItsGradient)
{
    std::array<int, 3> seen{};  // ends of the reference edge among the two points
    for (const double angle : {-0.6, -0.3, -0.02, 0.015, 0.2, 0.5})
        for (const double x : {-1.3, -0.7, 0.2, 0.75, 1.2})
        {
            BlockPair pair = face_and_block();
            pair.place(pair.a, {0.3, -0.4}, 0.1);
            const double lowest = 0.5 * std::abs(std::sin(angle)) + 0.2 * std::cos(angle);
            pair.place(pair.b, Vec2(0.3, -0.4) + Eigen::Rotation2D<double>(0.1) * Vec2(x, 0.5 + lowest - 0.03), angle + 0.1);
            pair.search();
            if (pair.state.contacts.size() == 0 || !pair.is_closed_at(pair.state.contacts.get(0)) ||
                is_at_an_end(pair.touch(pair.state.contacts.get(0))))
                continue;
            const EdgeTouch touch = pair.touch(pair.state.contacts.get(0));
            ++seen[(touch.point[0].inside < 0.0) + (touch.point[1].inside < 0.0)];
            pair.evaluate();
            for (const Index block : {pair.a, pair.b})
            {
                const std::array<double, 3> force{pair.force(block).x(), pair.force(block).y(), pair.moment(block)};
                for (int along = 0; along < 3; ++along)
                {
                    constexpr double h = 1e-6;
                    shift(pair, block, along, h);
                    const double above = normal_energy(pair);
                    shift(pair, block, along, -2.0 * h);
                    const double below = normal_energy(pair);
                    shift(pair, block, along, h);
                    EXPECT_NEAR(force[along], (below - above) / (2.0 * h), 1e-6 * std::abs(force[1]))
                        << "angle " << angle << ", x " << x << ", along " << along;
                }
            }
        }
    EXPECT_GT(seen[0], 2);
    EXPECT_GT(seen[1], 2);
}

TEST(SpringEnergy, OfShearStaysWhenTheContactLengthChanges)
{
    BlockPair pair = face_and_block();
    pair.place(pair.a, {0.0, -0.5}, 0.0);
    const auto slide_to = [&](double x)
    {
        pair.place(pair.b, {x, 0.2 - 1e-3}, 0.0);
        pair.evaluate();
        const Contact contact = pair.state.contacts.get(0);
        double energy = 0.0;
        for (const PointHistory& p : contact.point)
            energy += p.shear_force * p.shear_force / contact.last_length;
        return energy;
    };
    pair.place(pair.b, {0.0, 0.2 - 1e-3}, 0.0);
    pair.search();
    pair.evaluate();
    Contact contact = pair.state.contacts.get(0);
    for (PointHistory& p : contact.point)
        p.shear_force = 1e5;
    pair.state.contacts.put(0, contact);
    const double energy = slide_to(0.0);
    EXPECT_NEAR(pair.state.contacts.get(0).last_length, 0.5, 1e-12);
    EXPECT_NEAR(slide_to(1.2), energy, 1e-9 * energy) << "three tenths over the face";
    EXPECT_NEAR(pair.state.contacts.get(0).last_length, 0.15, 1e-12);
    EXPECT_NEAR(slide_to(0.0), energy, 1e-9 * energy) << "and back";
    EXPECT_NEAR(pair.state.contacts.get(0).point[0].shear_force, 1e5, 1e-3);
}

/// A corner of a needle passes from its end, 0.03 m over the face, to its side, 0.5 m.
TEST(SpringEnergy, OfNewFeaturesIsThatOfTheOldOnes)
{
    BlockPair pair = BlockPair(
        pair_scene(scenes::rectangle({-1.0, -1.0}, {1.0, 0.0}), scenes::rectangle({-0.5, -0.02}, {0.5, 0.02})));
    pair.place(pair.a, {0.0, -0.5}, 0.0);
    const auto turn_to = [&](double angle)
    {
        // About its lower corner, 1 mm deep.
        pair.place(pair.b, Vec2(0.0, -1e-3) + Eigen::Rotation2D<double>(angle) * Vec2(0.5, 0.02), angle);
        pair.search();
        pair.evaluate();
        return pair.state.contacts.get(0);
    };
    const auto energy = [](const Contact& contact)
    { return (std::pow(contact.point[0].normal_force, 2) + std::pow(contact.point[1].normal_force, 2)) / contact.last_length; };
    constexpr double quarter = std::numbers::pi / 4.0;
    const Contact end = turn_to(quarter + 1e-3);
    const Contact side = turn_to(quarter - 1e-3);
    ASSERT_NE(end.inc_edge, side.inc_edge);
    EXPECT_GT(side.last_length, 10.0 * end.last_length);
    EXPECT_GT(energy(end), 0.0);
    EXPECT_NEAR(energy(side), energy(end), 0.01 * energy(end));
    EXPECT_GT(side.point[0].rest_overlap + side.point[1].rest_overlap, 0.5e-3);
    const Contact back = turn_to(quarter + 1e-3);
    EXPECT_EQ(back.inc_edge, end.inc_edge);
    EXPECT_NEAR(energy(back), energy(end), 0.01 * energy(end)) << "nothing is lost on the way back";
}
}  // namespace
}  // namespace hdem::test
