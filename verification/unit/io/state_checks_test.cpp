#include "io/state_checks.h"
#include "verification/unit/io/full_state.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

namespace hdem
{
namespace
{
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// One thing that no run leaves behind, and what is said of it.
struct Harm
{
    std::function<void(State&)> make;
    std::string object, reason;
};

/// A state from a file is looked through before the cycle trusts it.
class StateChecks : public test::FullState
{
  protected:
    static void expect_found(const std::vector<Harm>& harms)
    {
        ASSERT_FALSE(find_damage(*model_, *state_).has_value());
        for (const Harm& harm : harms)
        {
            State state = *state_;
            harm.make(state);
            const std::optional<Damage> damage = find_damage(*model_, state);
            ASSERT_TRUE(damage.has_value()) << harm.object << ": " << harm.reason;
            EXPECT_EQ(damage->object, harm.object) << harm.reason;
            EXPECT_EQ(damage->reason, harm.reason) << harm.object;
        }
    }
};

TEST_F(StateChecks, TellOfStagesThatDoNotFit)
{
    expect_found({
        {[](State& s) { s.stage = 2; }, "/state@stage", "not a stage of the case"},
        {[](State& s) { s.stages_done.clear(); }, "/state@stage", "not a stage of the case"},
        {[](State& s) { s.stage_begun = false; }, "/state@stage_begun", "no stage has begun"},
        {[](State& s) { s.stages_done[0].cycles = s.cycle + 1; }, "/state/stages_done", "cycles do not add up"},
        {[](State& s) { s.stage_begin_cycle += 1; }, "/state@stage_begin_cycle", "cycles do not add up"},
        {[](State& s) { s.stages_done[0].time = s.time + 1.0; }, "/state/stages_done", "not ends of stages"},
        {[](State& s) { s.blocks.step.next = 0.0; }, "/state@last_step, next_step", "not a time step"},
        {[](State& s) { s.time = -1.0; }, "/state@time, quiet_since", "not a time"},
        {[](State& s) { s.quiet_since = s.time + 1.0; }, "/state@time, quiet_since", "not a time"},
        {[](State& s) { s.method = static_cast<Method>(9); }, "/state@method", "unknown method or damping"},
        {[](State& s) { s.excavation_cycle = s.cycle + 1; }, "/state", "counters that no run leaves behind"},
        {[](State& s) { s.broad_phase_runs = 0; }, "/state", "counters that no run leaves behind"},
        {[](State& s) { s.not_at_rest = {{.stage = 1, .block = 0}}; }, "/state/not_at_rest",
         "not blocks of stages that are over, ascending"},
        {[](State& s) {
             s.came_loose = {{.stage = 1, .block = 4}, {.stage = 1, .block = 3}};
         },
         "/state/came_loose", "not blocks of stages, ascending"},
        {[](State& s) { s.statics[0].stage = 2; }, "/state/statics", "not static solutions of stages, ascending"},
        {[](State& s) { s.ends.clear(); }, "/state/ends", "not the ends of the stage"},
        {[](State& s) { s.ends[0].since_cycle = s.cycle + 1; }, "/state/ends", "not what a look leaves behind"},
        {[](State& s) { s.ledger.friction = no_number; }, "/state/ledger", "not a finite number"},
    });
}

TEST_F(StateChecks, TellOfBlocksThatDoNotFit)
{
    expect_found({
        {[](State& s) { s.rebuilt_at.pop_back(); }, "/blocks/rebuilt_at", "not one row for each block"},
        {[](State& s) { s.blocks.motion[3].x = no_number; }, "/blocks/motion", "not a place and a rotation"},
        {[](State& s) { s.blocks.motion[3].c = 2.0; }, "/blocks/motion", "not a place and a rotation"},
        {[](State& s) { s.rebuilt_at[3].s = 2.0; }, "/blocks/rebuilt_at", "not a place and a rotation"},
        {[](State& s) { s.blocks.force[3].y = no_number; }, "/blocks/force", "not a force"},
        {[](State& s) { s.blocks.stable_step[3] = -1.0; }, "/blocks/stable_step", "not a time step"},
        {[](State& s) { s.blocks.bearing_force[3] = -1.0; }, "/blocks/bearing_force", "a force below 0"},
        {[](State& s) { s.blocks.margin[3] = -1.0; }, "/blocks/margin", "not a length"},
        {[](State& s)
         {
             s.blocks.motion[3].vx = 1.0;
             s.blocks.rest[3] = left_out;
         },
         "/blocks/rest", "does not belong to the velocity"},
        {[](State& s) { s.blocks.inertia[3].inverse_inertia += 1e-3; }, "/blocks/inverse_inertia", "not that of the block"},
        {[](State& s) { s.blocks.reference_angle[3] = no_number; }, "/blocks/reference_position", "not a finite number"},
        {[](State& s) {
             s.next_to_excavation = {4, 4};
         },
         "/blocks/next_to_excavation", "not ascending numbers of blocks"},
        {[](State& s) { s.released[0].block = s.blocks.size(); }, "/blocks/released", "not ascending numbers of blocks"},
        {[](State& s) { s.released[0].x = no_number; }, "/blocks/released_force", "not a force"},
        {[](State& s) { s.cycle += 1000; }, "/blocks/released", "not of the running stage"},
        {[](State& s) { s.moving[1].block = 2; }, "/blocks/moving", "not ascending numbers of blocks"},
        {[](State& s) { s.moving[1].how = static_cast<FreeMotion>(4); }, "/blocks/moving", "an unknown motion"},
        {[](State& s) { s.moving[1].t_x = std::numeric_limits<float>::infinity(); }, "/blocks/moving_along", "not a direction"},
        {[](State& s) { s.creeping[1].block = 1; }, "/blocks/creeping", "not ascending numbers of blocks"},
        {[](State& s) { s.creeping[1].block = s.blocks.size(); }, "/blocks/creeping", "not ascending numbers of blocks"},
        {[](State& s) { s.creeping[1].looks = -1; }, "/blocks/creeping", "a negative number of looks"},
        {[](State& s) { s.creeping[1].by_x = no_number; }, "/blocks/creeping_way", "not a finite number"},
        {[](State& s) { s.water.pop_back(); }, "/blocks/water", "not one force a block"},
        {[](State& s) { s.water[3].w = no_number; }, "/blocks/water", "not a force"},
    });
}

TEST_F(StateChecks, TellOfSupportThatDoesNotFit)
{
    expect_found({
        {[](State& s) { s.support.bolts[0].status = static_cast<BoltStatus>(bolt_states); }, "/bolts/record",
         "not the record of a bolt"},
        {[](State& s) { s.support.liners[0].since = s.cycle + 1; }, "/liners/record", "not the record of a liner"},
        {[](State& s) { s.support.history[0] = no_number; }, "/bolts/history", "not a finite number"},
    });
}

/// Changes one contact in the middle.
Harm harm_to_contact(const std::function<void(Contact&)>& change, const std::string& object, const std::string& reason)
{
    const auto make = [change](State& state)
    {
        const Index middle = state.contacts.size() / 2;
        Contact contact = state.contacts.get(middle);
        change(contact);
        state.contacts.put(middle, contact);
    };
    return {make, object, reason};
}

TEST_F(StateChecks, TellOfContactsThatDoNotFit)
{
    const std::string unknown = "not a finite number, or an unknown regime";
    expect_found({
        harm_to_contact([](Contact& c) { std::swap(c.part_a, c.part_b); }, "/contacts/features", "not pairs of parts, each once"),
        {[](State& s) { s.contacts.put(1, s.contacts.get(0)); }, "/contacts/features", "not pairs of parts, each once"},
        harm_to_contact([](Contact& c) { c.ref = c.inc; }, "/contacts/features", "not those of its parts"),
        harm_to_contact([](Contact& c) { c.ref_edge = -1; }, "/contacts/features", "not those of its parts"),
        harm_to_contact([](Contact& c) { c.law = 1000; }, "/contacts/features", "not those of its parts"),
        harm_to_contact([](Contact& c) { c.length_floor = 0.0; }, "/contacts", unknown),
        harm_to_contact([](Contact& c) { c.point[1].normal_force = no_number; }, "/contacts", unknown),
        harm_to_contact([](Contact& c) { c.point[0].regime = static_cast<Regime>(4); }, "/contacts", unknown),
        {[](State& s) { s.contacts.stale[2] = 2; }, "/contacts", unknown},
    });
}

TEST(Permutation, HasEachNumberOnce)
{
    EXPECT_TRUE(is_permutation({2, 0, 1}));
    EXPECT_FALSE(is_permutation({2, 0, 2}));
    EXPECT_FALSE(is_permutation({0, 1, 3}));
    EXPECT_FALSE(is_permutation({-1, 0, 1}));
}
}  // namespace
}  // namespace hdem
