/// What a pass over contacts leaves out where it is not needed changes nothing: a run in one piece is what it is cycle by cycle, where everything is done in each.
#include "core/contact/contact_forces.h"
#include "core/stage/rules.h"
#include "parallel/cycle.h"
#include "verification/unit/case_run.h"

#include <cstring>

namespace hdem
{
namespace
{
using test::CaseRun;

/// What the contacts remember, to the bit.
bool have_same_lanes(const Contacts& a, const Contacts& b)
{
    const auto of = [](const Contact& c)
    {
        std::vector<double> values{c.last_length, c.length_floor, c.edges.start_t, c.seen[0], c.seen[1], c.seen[2], c.seen[3]};
        for (const PointHistory& p : c.point)
            values.insert(values.end(),
                          {p.normal_force, p.shear_force, p.rest_overlap, p.overlap, p.tilt_force, static_cast<double>(p.regime)});
        return values;
    };
    bool are_same = a.size() == b.size();
    for (Index i = 0; are_same && i < a.size(); ++i)
    {
        const std::vector<double> ours = of(a.get(i)), theirs = of(b.get(i));
        are_same = a.stale[i] == b.stale[i] && std::memcmp(ours.data(), theirs.data(), ours.size() * sizeof(double)) == 0;
    }
    return are_same;
}

Index count_rests(const Contacts& contacts)
{
    Index found = 0;
    for (Index i = 0; i < contacts.size(); ++i)
        found += contacts.rest_overlap(0, i) > 0.0 || contacts.rest_overlap(1, i) > 0.0 ? 1 : 0;
    return found;
}

/// `pieces` times so many cycles at once, and cycle by cycle.
/// @return  contacts with a rest overlap, after each piece
Index compare(const CaseDef& scene, int pieces, std::int64_t cycles)
{
    CaseRun whole(scene), single(scene);
    Index rests = 0;
    for (int i = 0; i < pieces; ++i)
    {
        whole.advance(cycles);
        for (std::int64_t k = 0; k < cycles; ++k)
            single.advance(1);
        EXPECT_EQ(whole.hash(), single.hash()) << whole.state().cycle;
        EXPECT_EQ(whole.state().feature_searches, single.state().feature_searches) << whole.state().cycle;
        EXPECT_TRUE(have_same_lanes(whole.state().contacts, single.state().contacts)) << whole.state().cycle;
        rests += count_rests(whole.state().contacts);
    }
    return rests;
}

TEST(PassNeeds, RubbleThatFallsIsTheSameInOnePiece)
{
    const CaseDef scene = scenes::turned(scenes::pile(40, 5, 3), 17.0);
    EXPECT_GT(compare(scene, 30, 500), 0) << "no point was handed over from an impulse";
}

TEST(PassNeeds, SlenderBlocksThatTurnAreTheSameInOnePiece)
{
    CaseDef scene = scenes::block_on_ground(0.3, 6.0);
    scene.blocks.back().angular_velocity = 0.4;
    scenes::add_block(scene, "chip", scenes::rectangle({0.5, 0.0}, {0.56, 0.06}));
    static_cast<void>(compare(scene, 40, 500));
}

TEST(PassNeeds, JointedRockIsTheSameInOnePiece)
{
    CaseDef scene = scenes::joints(10.0, 10.0, 1.3, 10.0);
    static_cast<void>(compare(scene, 10, 300));
    scene.insitu.given = true;
    scene.insitu.stress = {-2e6, -1e6, 3e5};
    static_cast<void>(compare(scene, 10, 300));
}

/// Tilt forces of a pass that stores them, and of one that has them stored later.
void expect_same_tilts(const CaseRun& run)
{
    const RegimeRule rule = resolve_rules(run.model(), run.state()).contact;
    Contacts at_once = run.state().contacts, later = at_once;
    ContactLoads loads;
    loads.resize(at_once.stale.size());
    const IndexRange all{0, at_once.size()};
    static_cast<void>(evaluate_contacts(all, run.model(), rule, run.state().blocks, at_once, loads));
    static_cast<void>(evaluate_contacts(all, run.model(), rule, run.state().blocks, later, loads, {}, {.tilts = false}));
    EXPECT_FALSE(have_same_lanes(at_once, later)) << "no tilt force was to be stored";
    store_tilt_forces(all, run.state().blocks, later);
    EXPECT_TRUE(have_same_lanes(at_once, later));
}

TEST(PassNeeds, TiltForcesCanBeStoredLater)
{
    CaseRun pile(scenes::pile(40, 5, 3));
    for (int i = 0; i < 20; ++i)
    {
        pile.advance(1000);
        if (pile.simulation.count_contacts().closed() > 0)
            expect_same_tilts(pile);
    }
    CaseDef scene = scenes::joints(10.0, 10.0, 1.3, 10.0);
    scene.insitu.given = true;
    scene.insitu.stress = {-2e6, -1e6, 3e5};
    scene.joints[0].dilation_angle_deg = 5.0;
    CaseRun rock(scene);
    ASSERT_TRUE(rock.state().contacts.has_memory);
    for (int i = 0; i < 5; ++i)
    {
        rock.advance(20);
        expect_same_tilts(rock);
    }
}

TEST(PassNeeds, ARunThatStopsEarlyHasStoredAll)
{
    CaseDef scene = scenes::block_on_ground();
    scene.joints[0].normal_stiffness = scene.joints[0].shear_stiffness = 1e5;  // the weight sinks in by 0.26 m
    scene.contact.method = Method::force;
    scene.blocks.back().angular_velocity = 0.05;
    const auto stopped = [&](std::int64_t piece)
    {
        hdem::Setup setup = build_model(scene);
        State& state = setup.state;
        CycleRunner runner;
        runner.renew_contacts(setup.model, state, 1);
        while (state.cycle < 100000 && !runner.found_deep_overlap())
            static_cast<void>(runner.run(setup.model, state, piece, 1));
        return state;
    };
    const State in_one = stopped(100000), by_cycles = stopped(1);
    EXPECT_LT(in_one.cycle, 100000);
    EXPECT_EQ(in_one.cycle, by_cycles.cycle);
    EXPECT_TRUE(have_same_lanes(in_one.contacts, by_cycles.contacts));
}
}  // namespace
}  // namespace hdem
