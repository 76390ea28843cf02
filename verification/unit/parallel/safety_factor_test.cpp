#include "core/contact/contact_report.h"
#include "core/model/liner_growth.h"
#include "core/rock/build_model.h"
#include "io/case_reader.h"
#include "parallel/reference_state.h"
#include "parallel/safety_factor.h"
#include "verification/runs/remembered_trials.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hdem
{
namespace
{
constexpr double degree = 3.14159265358979323846 / 180.0;

/// A slab on a slope of 20 degrees, and a small block beside it on a joint of its own.
std::string slope(const std::string& more = "", double friction = 30.0)
{
    return R"(
[material.rock]
density = 2700.0
[material.pebble]
density = 2700.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 1e9
friction_angle_deg = )" +
           std::to_string(friction) + R"(
[joint.smooth]
normal_stiffness = 1e10
shear_stiffness = 1e9
friction_angle_deg = 22.0
materials = ["rock", "pebble"]
[gravity]
tilt_deg = 20.0
[contact]
method = "force"
[[block]]
name = "ground"
polygon = [[-6, -1], [20, -1], [20, 0], [-6, 0]]
fixed = true
[[block]]
name = "slab"
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
[[block]]
name = "small"
material = "pebble"
polygon = [[8, 0], [8.5, 0], [8.5, 0.2], [8, 0.2]]
[[stage]]
until = "converged"
max_cycles = 50000
)" + more;
}

struct Case
{
    CaseDef def;
    Reference reference;
};

Case started(const std::string& text)
{
    Case c{.def = read_case_text(text, "case.toml").def, .reference = {}};
    Setup setup = build_model(c.def);
    Simulation simulation(std::move(setup.model), std::move(setup.state), 1);
    BeforeLastStage before;
    Observer* const observers[] = {&before};
    const std::vector<StageResult> stages = run_stages(simulation, observers);
    const Moment last{simulation.model(), simulation.state()};
    c.reference = find_reference(last,
                                 {.found_rest = stages.back().at_rest,
                                  .least_area = c.def.factor_of_safety.least_size,
                                  .before = [&] { return before.moment(); }},
                                 1);
    return c;
}

SafetyFactor factor_of(const Case& c, int threads = 1, TrialStore* store = nullptr)
{
    return find_safety_factor(c.reference.moment, {.def = c.def.factor_of_safety, .bound = {}, .threads = threads, .store = store});
}

double slides_at(double friction)
{
    return std::tan(friction * degree) / std::tan(20.0 * degree);
}

const std::string once = "[factor_of_safety]\ncheck_stiffness = 1\n";

TEST(SafetyFactor, IsThatOfTheFirstBlockToFail)
{
    const Case c = started(slope(once));
    const SafetyFactor found = factor_of(c);
    EXPECT_NEAR(found.as_given.middle(), slides_at(22.0), 0.005);
    ASSERT_NE(found.first_failure(), nullptr);
    EXPECT_EQ(found.first_failure()->failing, std::vector<Index>{2});
    EXPECT_LE(found.last_stable()->factor, *found.as_given.stands);
    ASSERT_TRUE(found.failure);
    EXPECT_GT(rim_displacement(found.failure->model.slot_of_user[2], found.failure->model, found.failure->state.blocks), 1e-3);
}

TEST(SafetyFactor, BlocksBelowTheLeastSizeMayFall)
{
    const SafetyFactor found = factor_of(started(slope(once + "least_size = 0.5\n")));
    EXPECT_NEAR(found.as_given.middle(), slides_at(30.0), 0.01);
    EXPECT_EQ(found.last_stable()->let_fall, std::vector<Index>{2});
}

TEST(SafetyFactor, JointsMayBeNamed)
{
    const SafetyFactor found = factor_of(started(slope(once + "reduce = [\"default\"]\n")));
    EXPECT_NEAR(found.as_given.middle(), slides_at(30.0), 0.01);
}

TEST(SafetyFactor, BelowOneWhereTheRockDoesNotStand)
{
    const Case c = started(slope(once + "least_size = 0.5\n", 15.0));
    EXPECT_EQ(c.reference.gave_way, std::vector<Index>{1});
    EXPECT_NEAR(factor_of(c).as_given.middle(), slides_at(15.0), 0.005);
}

/// It lies 0.25 m farther down, against a stop, and stands there whatever its friction; or by less than what counts as detached.
TEST(SafetyFactor, BelowOneWhereABlockSlidToAStop)
{
    for (const char* x : {"4.25", "4.07"})
    {
        const std::string stop = std::string("[[block]]\nname = \"stop\"\npolygon = [[") + x + ", 0], [5.5, 0], [5.5, 1], [" + x +
                                 ", 1]]\nfixed = true\n";
        const Case c = started(slope(once + "least_size = 0.5\n" + stop, 15.0));
        EXPECT_EQ(c.reference.gave_way, std::vector<Index>{1}) << x;
        EXPECT_NEAR(factor_of(c).as_given.middle(), slides_at(15.0), 0.005) << x;
    }
}

/// Soft joints: the slab sinks by 0.15 m, more than 0.02 of its size and than what counts as detached.
TEST(SafetyFactor, WhatSettlesDidNotGiveWay)
{
    std::string soft = slope(once + "least_size = 0.5\n");
    for (std::size_t at = 0; (at = soft.find("1e10", at)) != std::string::npos;)
        soft.replace(at, 4, "3e5");
    for (std::size_t at = 0; (at = soft.find("1e9", at)) != std::string::npos;)
        soft.replace(at, 3, "3e5");
    const Case c = started(soft);
    EXPECT_TRUE(c.reference.gave_way.empty());
    EXPECT_FALSE(c.reference.is_anew);
}

TEST(SafetyFactor, IsTheSameWithStifferJoints)
{
    const SafetyFactor found = factor_of(started(slope()));
    ASSERT_TRUE(found.stiffer && found.stiffer->is_closed());
    EXPECT_NEAR(found.stiffer->middle(), found.as_given.middle(), 0.01);
}

/// A wall between two waters, with a table that falls through it: as it slides it comes below the lower part of the table.
TEST(SafetyFactor, WaterPushesAsItDoesAtTheStart)
{
    const Case c = started(once + R"(
[material.rock]
density = 2400.0
[joint.default]
normal_stiffness = 5e9
shear_stiffness = 2e9
friction_angle_deg = 35.0
[contact]
method = "force"
[water]
table = [[-30, 7], [0, 7], [9, 2], [40, 2]]
[[block]]
name = "ground"
polygon = [[-30, -3], [40, -3], [40, 0], [-30, 0]]
fixed = true
[[block]]
name = "wall"
polygon = [[0, 0], [9, 0], [9, 10], [0, 10]]
[[stage]]
until = "converged"
max_cycles = 50000
)");
    const SafetyFactor found = factor_of(c);
    const double weight = 2400.0 * 9.81 * 90.0, uplift = 9810.0 * 4.5 * 9.0, push = 9810.0 * 0.5 * (49.0 - 4.0);
    EXPECT_NEAR(found.as_given.middle(), (weight - uplift) * std::tan(35.0 * degree) / push, 0.01);
    ASSERT_TRUE(found.failure);
    EXPECT_TRUE(found.failure->model.water.given) << "for its pictures";
}

/// Blocks do not move when their joints are made stiffer: forces and places are those of before.
TEST(SafetyFactor, StiffeningKeepsForces)
{
    const Case c = started(slope());
    const Moment& soft = c.reference.moment;
    const Moment stiff = stiffened_state(soft, 3.0);
    Simulation simulation(trial_model(stiff, {.stiffness = 3.0}), stiff.state, 1);
    simulation.begin_stage(0);
    simulation.advance(100);
    for (Index b = 0; b < soft.model.blocks(); ++b)
        EXPECT_LT(simulation.state().blocks.displacement(b).norm(), 1e-9);
    const ContactReport before = report_contact(soft.state, 0), after = report_contact(simulation.state(), 0);
    EXPECT_NEAR(after.normal_force, before.normal_force, 1e-4 * before.normal_force);
}

/// Rock of four blocks under stress, with a side that is pressed more and more and a lining that hardens.
const std::string pressed_rock = R"(
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e10
shear_stiffness = 1e9
friction_angle_deg = 30.0
[contact]
method = "force"
[domain]
width = 4.0
height = 4.0
fixed = ["bottom"]
[[joint_set]]
dip_deg = 0.0
spacing = 2.0
[[joint_set]]
dip_deg = 90.0
spacing = 2.0
[insitu]
surface = 4.0
ratio = 0.5
)";

TEST(SafetyFactor, StiffeningKeepsForcesOfRockUnderStress)
{
    const Case c = started(pressed_rock + "[[stage]]\nuntil = \"converged\"\n");
    const Moment stiff = stiffened_state(c.reference.moment, 3.0);
    ASSERT_TRUE(stiff.state.contacts.has_preload);
    Simulation simulation(trial_model(stiff, {.stiffness = 3.0}), stiff.state, 1);
    simulation.begin_stage(0);
    simulation.advance(100);
    for (Index b = 0; b < stiff.model.blocks(); ++b)
        EXPECT_LT((simulation.state().blocks.displacement(b) - c.reference.moment.state.blocks.displacement(b)).norm(), 1e-9);
    const double before = report_contact(c.reference.moment.state, 0).normal_force;
    EXPECT_GT(before, 1e3);
    EXPECT_NEAR(report_contact(simulation.state(), 0).normal_force, before, 1e-4 * before);
}

/// Trials begin the stage anew, but what grows with time stays at what it has come to.
TEST(SafetyFactor, TrialsKeepLoadsAsTheyHaveBecome)
{
    const CaseDef def = read_case_text(pressed_rock + R"(
[[boundary]]
side = "top"
kind = "stress"
stress = [1e6, 0.0]
table = [[0, 0], [1000, 1]]
[[liner]]
path = [[4.0, 3.5], [4.0, 0.5]]
thickness = 0.1
modulus = 25e9
normal_stiffness = 1e9
pressure = 2e4
pressure_cycles = 1200
hardening = [[0, 0.1], [1200, 1.0]]
[[stage]]
cycles = 600
)",
                                       "case.toml")
                            .def;
    hdem::Setup setup = build_model(def);
    Simulation simulation(std::move(setup.model), std::move(setup.state), 1);
    run_stages(simulation, {});
    ASSERT_EQ(simulation.state().cycle, 600);
    const Model trial = trial_model({simulation.model(), simulation.state()}, {});
    for (const std::int64_t cycles : {0, 1, 600, 5000})
        EXPECT_DOUBLE_EQ(trial.boundaries[0].factor.at(cycles, trial.time_step), 0.6) << cycles;
    const Liner& liner = trial.support.liners[0];
    EXPECT_DOUBLE_EQ(liner.pressure, 1e4);
    for (const std::int64_t age : {0, 600, 5000})
    {
        EXPECT_DOUBLE_EQ(grown_share(liner.pressure_cycles, age), 1.0);
        EXPECT_DOUBLE_EQ(hardening_at(liner, age), 0.55) << age;
    }
    EXPECT_EQ(liner.stage, no_index) << "it is not installed once more";
}

TEST(SafetyFactor, TrialsThatHaveEndedAreNotRunAgain)
{
    const Case c = started(slope(once));
    runs::RememberedTrials store;
    const SafetyFactor first = factor_of(c, 1, &store);
    const int runs = store.added();
    EXPECT_GT(runs, 3);
    store.forget_one();
    const SafetyFactor again = factor_of(c, 2, &store);
    EXPECT_GT(store.added(), runs) << "that one, and the second of a pair where it ends before the first has failed";
    EXPECT_EQ(store.repeated(), 0);
    EXPECT_EQ(again.as_given.middle(), first.as_given.middle());
    EXPECT_EQ(again.trials.size(), first.trials.size());
}

TEST(SafetyFactor, ASearchThatIsAskedToStopStops)
{
    const Case c = started(slope(once));
    std::stop_source source;
    source.request_stop();
    EXPECT_THROW(static_cast<void>(find_safety_factor(
                     c.reference.moment, {.def = c.def.factor_of_safety, .bound = {}, .threads = 2, .stop = source.get_token()})),
                 SearchStopped);
}

/// Strength is lost by breaking: without its cohesion the slab stands at the factor of its friction, with it at more.
TEST(SafetyFactor, PeakStrengthBesideTheResidualOne)
{
    std::string text = slope(once + "least_size = 0.5\n");
    text.replace(text.find("[joint.smooth]"), 0, "cohesion = 4e3\nresidual_cohesion = 0.0\n");
    const SafetyFactor found = factor_of(started(text));
    ASSERT_TRUE(found.peak && found.peak->is_closed());
    const double with_cohesion = slides_at(30.0) + 4e3 / (2700.0 * 9.81 * std::sin(20.0 * degree));
    EXPECT_NEAR(found.peak->middle(), with_cohesion, 0.01 * with_cohesion);
    EXPECT_LT(found.as_given.middle(), found.peak->middle());
    EXPECT_GT(found.as_given.middle(), slides_at(30.0) - 0.01);
}
}  // namespace
}  // namespace hdem
