#include "core/check.h"
#include "core/history_sampler.h"
#include "core/joint/all_laws.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>

#include <map>

namespace hdem
{
namespace
{
using test::SmallRun;
using testing::ElementsAre;

constexpr Index block = 2;

std::vector<std::string> column_names(const HistorySampler& sampler)
{
    std::vector<std::string> names;
    for (const Column& column : sampler.columns())
        names.push_back(column.name);
    return names;
}

std::map<std::string, double> sample(HistorySampler& sampler, const SmallRun& run)
{
    std::vector<double> values(sampler.columns().size());
    sampler.sample(run.model, run.state, values);
    std::map<std::string, double> named;
    for (std::size_t i = 0; i < values.size(); ++i)
        named[sampler.columns()[i].name] = values[i];
    return named;
}

TEST(HistorySampler, VectorsBecomeTwoColumnsAndNothingIsSampledTwice)
{
    const SmallRun run = test::small_run();
    const HistorySampler sampler(run.model, test::history("h", {"block"}, {"velocity", "speed", "velocity_x", "position_y"}));
    EXPECT_THAT(column_names(sampler), ElementsAre("velocity_x", "velocity_y", "speed", "position_y"));
    EXPECT_EQ(sampler.columns()[0].unit, "m/s");
}

TEST(HistorySampler, BlockQuantitiesAreThoseOfTheState)
{
    SmallRun run = test::small_run();
    BlockMotion& m = run.state.blocks.motion[block];
    m.x += 0.25;
    m.y -= 0.5;
    m.vx = 3.0;
    m.vy = -4.0;
    m.w = 2.0;
    m.angle = 0.75;
    run.state.blocks.reference_angle[block] = 0.5;
    run.state.blocks.force[block] = {.x = 11.0, .y = 12.0};
    HistorySampler sampler(run.model, test::history("h", {"block"}, block_history_quantities()));
    const auto v = sample(sampler, run);
    EXPECT_EQ(v.size(), 12U);
    EXPECT_DOUBLE_EQ(v.at("displacement_x"), 0.25);
    EXPECT_DOUBLE_EQ(v.at("displacement_y"), -0.5);
    EXPECT_DOUBLE_EQ(v.at("position_x"), 100.75) << "in the user's coordinates";
    EXPECT_DOUBLE_EQ(v.at("position_y"), 200.0);
    EXPECT_DOUBLE_EQ(v.at("velocity_x"), 3.0);
    EXPECT_DOUBLE_EQ(v.at("velocity_y"), -4.0);
    EXPECT_DOUBLE_EQ(v.at("speed"), 5.0);
    EXPECT_DOUBLE_EQ(v.at("rotation"), 0.25);
    EXPECT_DOUBLE_EQ(v.at("angular_velocity"), 2.0);
    EXPECT_DOUBLE_EQ(v.at("force_x"), 11.0);
    EXPECT_DOUBLE_EQ(v.at("force_y"), 12.0);
    EXPECT_DOUBLE_EQ(v.at("kinetic_energy"), 0.5 * 2700.0 * 25.0 + 0.5 * 2700.0 / 6.0 * 4.0);
}

TEST(HistorySampler, ContactQuantitiesAreSumsOverThePairWhicheverWayItIsNamed)
{
    SmallRun run = test::small_run();
    run.state.blocks.motion[block].y -= 1e-5;
    test::load_contact(run, 0, 26487.0, -100.0, Regime::impulse);
    run.state.contacts.lane[0].tilt_force[1][0] = 7.0;
    for (const std::vector<std::string>& between : {std::vector<std::string>{"ground", "block"}, {"block", "ground"}})
    {
        HistorySampler sampler(run.model, test::history("h", between, contact_history_quantities()));
        const auto v = sample(sampler, run);
        EXPECT_EQ(v.size(), 14U);
        EXPECT_DOUBLE_EQ(v.at("normal_force"), 26487.0);
        EXPECT_DOUBLE_EQ(v.at("shear_force"), -100.0);
        EXPECT_DOUBLE_EQ(v.at("tilt_force"), 7.0);
        EXPECT_NEAR(v.at("overlap"), 1e-5, 1e-15);
        EXPECT_NEAR(v.at("contact_length"), 1.0, 1e-12);
        EXPECT_DOUBLE_EQ(v.at("normal_impulse"), 2.6487);
        EXPECT_DOUBLE_EQ(v.at("shear_impulse"), -0.01);
        EXPECT_DOUBLE_EQ(v.at("impulse_points"), 2.0);
    }
}

/// A block pushed to the right is held back by a force to the left: along the shear axis, which points left above the ground.
TEST(HistorySampler, ShearDisplacementGrowsWithTheShearForceItCauses)
{
    SmallRun run = test::small_run();
    run.state.blocks.motion[block].x += 0.01;
    test::load_contact(run, 0, 26487.0, 500.0, Regime::slip);
    for (const std::vector<std::string>& between : {std::vector<std::string>{"ground", "block"}, {"block", "ground"}})
    {
        HistorySampler sampler(run.model, test::history("h", between, {"shear_displacement", "shear_force"}));
        EXPECT_NEAR(sample(sampler, run).at("shear_displacement"), 0.01, 1e-12);
        EXPECT_DOUBLE_EQ(sample(sampler, run).at("shear_force"), 500.0);
    }
}

TEST(HistorySampler, KeepsTheShearAxisWhileTheBlocksAreApart)
{
    SmallRun run = test::small_run();
    test::load_contact(run, 0, 1.0, 0.0, Regime::stick);
    HistorySampler sampler(run.model, test::history("h", {"ground", "block"}, {"shear_displacement", "normal_force", "overlap"}));
    sample(sampler, run);
    run.state.blocks.motion[block].x += 0.5;
    run.state.blocks.motion[block].y += 0.5;
    test::load_contact(run, 0, 0.0, 0.0, Regime::open);
    const auto v = sample(sampler, run);
    EXPECT_NEAR(v.at("shear_displacement"), 0.5, 1e-12);
    EXPECT_EQ(v.at("normal_force"), 0.0);
    EXPECT_EQ(v.at("overlap"), 0.0);
}

/// Contacts that bear nothing are put behind the others between two searches for contacts (state/contact_order).
TEST(HistorySampler, FollowsContactsThroughAChangeOfTheirOrder)
{
    SmallRun run = test::small_run();
    test::add_contact(run, 1, 0, 0, 2);
    Contact other = run.state.contacts.get(0), own = other;
    other.part_a = run.model.shapes.part_begin[0];
    other.part_b = run.model.shapes.part_begin[1];
    other.inc = 1;
    own.point[0].normal_force = 7.0;
    own.point[0].regime = Regime::stick;
    other.point[0].normal_force = 1000.0;
    run.state.contacts.put(0, own);
    run.state.contacts.put(1, other);
    HistorySampler sampler(run.model, test::history("h", {"ground", "block"}, {"normal_force"}));
    EXPECT_EQ(sample(sampler, run).at("normal_force"), 7.0);
    run.state.contacts.put(0, other);
    run.state.contacts.put(1, own);
    EXPECT_EQ(sample(sampler, run).at("normal_force"), 7.0);
}

/// The list is looked through again when the broad phase has run.
TEST(HistorySampler, FollowsContactsThroughABroadPhase)
{
    SmallRun run = test::small_run();
    test::load_contact(run, 0, 7.0, 0.0, Regime::stick);
    HistorySampler sampler(run.model, test::history("h", {"ground", "block"}, {"normal_force"}));
    EXPECT_EQ(sample(sampler, run).at("normal_force"), 7.0);
    test::add_contact(run, 1, 0, 0, 2);  // another pair comes first now
    run.state.contacts.put(1, run.state.contacts.get(0));
    Contact other = run.state.contacts.get(0);
    other.part_a = run.model.shapes.part_begin[0];
    other.part_b = run.model.shapes.part_begin[1];
    other.inc = 1;
    other.point[0].normal_force = 1000.0;
    run.state.contacts.put(0, other);
    EXPECT_EQ(sample(sampler, run).at("normal_force"), 7.0);
}

TEST(HistorySampler, RefusesUnknownNames)
{
    const SmallRun run = test::small_run();
    EXPECT_THROW(HistorySampler(run.model, test::history("h", {"blok"}, {"speed"})), InputError);
    EXPECT_THROW(HistorySampler(run.model, test::history("h", {"block"}, {"normal_force"})), InputError);
    EXPECT_THROW(HistorySampler(run.model, test::history("h", {"ground", "block"}, {"speed"})), InputError);
}

TEST(HistorySampler, IsDueAtMultiplesOfItsInterval)
{
    const SmallRun run = test::small_run();
    const HistorySampler sampler(run.model, test::history("h", {"block"}, {"speed"}, 10));
    EXPECT_TRUE(sampler.is_due(0) && sampler.is_due(20));
    EXPECT_FALSE(sampler.is_due(21));
    EXPECT_EQ(sampler.next_after(0), 10);
    EXPECT_EQ(sampler.next_after(19), 20);
    EXPECT_EQ(sampler.next_after(20), 30);
}

/// Means over both points of the one contact; friction angle from the forces.
TEST(HistorySampler, TellsWhatJointsRemember)
{
    SmallRun run = test::small_run();
    run.model.joints.names = {"default"};
    run.model.joints.rows = {{.kind = kind_of<CoulombResidual>()}};
    Contact contact = run.state.contacts.get(0);
    run.state.contacts = {};
    run.state.contacts.has_memory = run.state.contacts.has_preload = true;
    run.state.contacts.resize(1);
    contact.point[0].memory = {.slip = 2e-3, .opening = 1e-4, .broken = 1.0};
    contact.point[1].memory = {.slip = 4e-3, .opening = 3e-4};
    run.state.contacts.put(0, contact);
    test::load_contact(run, 0, 1000.0, -1000.0, Regime::slip);
    HistorySampler sampler(
        run.model, test::history("h", {"ground", "block"}, {"plastic_slip", "opening", "damage", "broken", "mobilised_friction"}));
    const auto closed = sample(sampler, run);
    EXPECT_NEAR(closed.at("plastic_slip"), 3e-3, 1e-15);
    EXPECT_NEAR(closed.at("opening"), 2e-4, 1e-15);
    EXPECT_NEAR(closed.at("broken"), 0.5, 1e-15);
    EXPECT_NEAR(closed.at("damage"), 0.5, 1e-15);
    EXPECT_NEAR(closed.at("mobilised_friction"), 45.0, 1e-12);
    test::load_contact(run, 0, 0.0, 0.0, Regime::open);
    const auto open = sample(sampler, run);
    EXPECT_NEAR(open.at("broken"), 0.5, 1e-15) << "of a joint that is open too";
    EXPECT_EQ(open.at("mobilised_friction"), 0.0);
    run.state.contacts.law[0] = static_cast<Index>(run.model.joints.names.size());
    EXPECT_EQ(sample(sampler, run).at("broken"), 0.0) << "of blocks that have met and do not touch";
    test::load_contact(run, 0, 1000.0, 0.0, Regime::stick);
    const auto met = sample(sampler, run);
    EXPECT_EQ(met.at("broken"), 1.0);
    EXPECT_EQ(met.at("damage"), 1.0);
    run.state.contacts.law[0] = 0;
    run.model.joints.rows.clear();
    run.state.contacts.has_memory = false;
    EXPECT_EQ(sample(sampler, run).at("plastic_slip"), 0.0) << "no memory";
}
}  // namespace
}  // namespace hdem
