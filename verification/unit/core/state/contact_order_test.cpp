#include "core/contact/contact_forces.h"
#include "core/stage/rules.h"
#include "core/state/contact_order.h"
#include "core/state/state_hash.h"
#include "verification/scenes/sample_joints.h"
#include "verification/unit/case_run.h"

#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace hdem
{
namespace
{
/// Two laws with a memory, the second of them twice, and a plain one.
JointTable four_joints()
{
    JointTable table;
    table.rows.resize(4);
    table.rows[0].kind = JointKind{1};
    table.rows[1].kind = JointKind{2};
    table.rows[2].kind = JointKind{2};
    table.laws.resize(4);
    return table;
}

/// Contacts sorted by parts, whose laws repeat the given ones.
Contacts contacts_of(const std::vector<Index>& laws, Index size)
{
    Contacts contacts;
    contacts.has_memory = contacts.has_preload = true;
    contacts.resize(size);
    for (Index i = 0; i < size; ++i)
    {
        Contact contact{.part_a = i / 3, .part_b = i / 3 + 1 + i % 3, .ref = 0, .inc = 1, .edges = {}, .point = {}};
        contact.law = laws[static_cast<std::size_t>(i) % laws.size()];
        contact.point[1].memory.slip = i;
        contacts.put(i, contact);
    }
    return contacts;
}

std::vector<double> slips(const Contacts& contacts)
{
    std::vector<double> all;
    for (Index i = 0; i < contacts.size(); ++i)
        all.push_back(contacts.memory(1, i).slip);
    return all;
}

TEST(ContactOrder, BringsLawsTogetherWithinEachStretch)
{
    const Index size = 2 * contacts_a_stretch + 50;
    Contacts contacts = contacts_of({0, 1, 3, 2, 1}, size);
    const JointTable joints = four_joints();
    group_alike(joints, contacts);
    for (Index begin = 0; begin < size; begin += contacts_a_stretch)
    {
        const Index end = std::min(size, begin + contacts_a_stretch);
        std::set<JointKind> seen;
        double last_slip = -1.0;
        for (Index i = begin; i < end; ++i)
        {
            const JointKind kind = joints.rows[static_cast<std::size_t>(contacts.law[i])].kind;
            const double slip = contacts.memory(1, i).slip;
            EXPECT_TRUE(slip >= begin && slip < end) << "left its stretch";
            const bool begins = i == begin || kind != joints.rows[static_cast<std::size_t>(contacts.law[i - 1])].kind;
            if (begins)
                EXPECT_TRUE(seen.insert(kind).second) << "contact " << i << ": this law stands in two places";
            else
                EXPECT_GT(slip, last_slip) << "contacts of one law keep their order";
            last_slip = slip;
        }
    }
    const std::vector<double> all = slips(contacts);
    EXPECT_EQ(std::set<double>(all.begin(), all.end()).size(), static_cast<std::size_t>(size));
}

TEST(ContactOrder, IsThatOfThePartsWhereAllHaveOneLaw)
{
    for (const std::vector<Index>& laws : {std::vector<Index>{1, 2, 1}, std::vector<Index>{3}})
    {
        Contacts contacts = contacts_of(laws, 300);
        const std::vector<double> before = slips(contacts);
        group_alike(four_joints(), contacts);
        EXPECT_EQ(slips(contacts), before);
    }
}

TEST(ContactOrder, ByPartsFindsTheOrderBeforeTheGrouping)
{
    Contacts contacts = contacts_of({0, 1, 3, 2, 1}, 301);
    const std::vector<double> before = slips(contacts);
    group_alike(four_joints(), contacts);
    EXPECT_NE(slips(contacts), before);
    std::vector<double> sorted;
    for (const Index i : order_by_parts(contacts))
        sorted.push_back(contacts.memory(1, i).slip);
    EXPECT_EQ(sorted, before);
}

/// Contacts sorted by parts, of which every third bears nothing and every fifth is stale.
std::vector<Contact> some_idle(Index size)
{
    std::vector<Contact> contacts;
    for (Index i = 0; i < size; ++i)
    {
        Contact contact{.part_a = i / 3, .part_b = i / 3 + 1 + i % 3, .ref = 0, .inc = 1, .edges = {}, .point = {}};
        contact.edges.length = i % 3 == 1 ? no_length : 1.0;
        contacts.push_back(contact);
    }
    return contacts;
}

/// Numbers that some_idle gave them.
std::vector<Index> numbers(const Contacts& contacts)
{
    std::vector<Index> all;
    for (Index i = 0; i < contacts.size(); ++i)
        all.push_back(3 * contacts.part_a[i] + contacts.part_b[i] - contacts.part_a[i] - 1);
    return all;
}

void expect_bearing_first(const Contacts& contacts)
{
    EXPECT_EQ(count_misplaced(contacts), 0);
    const std::vector<Index> all = numbers(contacts);
    for (Index i = 0; i < contacts.size(); ++i)
    {
        EXPECT_EQ(all[i] / contacts_a_stretch, i / contacts_a_stretch) << "left its stretch";
        EXPECT_EQ(contacts.may_bear(i), all[i] % 3 != 1);
        if (i % contacts_a_stretch != 0 && contacts.may_bear(i) == contacts.may_bear(i - 1))
        {
            EXPECT_GT(all[i], all[i - 1]) << "contacts of one kind keep their order";
        }
    }
}

TEST(ContactOrder, BringsWhatMayBearToTheFront)
{
    const std::vector<Contact> some = some_idle(2 * contacts_a_stretch + 50);
    Contacts contacts;
    contacts.resize(static_cast<Index>(some.size()));
    for (Index i = 0; i < contacts.size(); ++i)
    {
        contacts.put(i, some[static_cast<std::size_t>(i)]);
        contacts.stale[i] = i % 5 == 0 ? 1 : 0;
    }
    EXPECT_GT(count_misplaced(contacts), contacts.size() / 2);
    group_alike(four_joints(), contacts);
    expect_bearing_first(contacts);
    const std::vector<Index> all = numbers(contacts);
    for (Index i = 0; i < contacts.size(); ++i)
        EXPECT_EQ(contacts.stale[i], all[i] % 5 == 0 ? 1 : 0);
}

TEST(ContactOrder, PutsPiecesOfAListByStretches)
{
    const std::vector<Contact> some = some_idle(3 * contacts_a_stretch + 50);
    Contacts contacts;
    contacts.resize(static_cast<Index>(some.size()));
    const auto cut = some.begin() + 2 * contacts_a_stretch;  // pieces begin anywhere in a stretch; this one at its begin
    put_bearing_first({some.begin(), cut}, 0, contacts);
    put_bearing_first({cut, some.end()}, 2 * contacts_a_stretch, contacts);
    expect_bearing_first(contacts);

    const auto elsewhere = some.begin() + contacts_a_stretch + 37;
    put_bearing_first({some.begin(), elsewhere}, 0, contacts);
    put_bearing_first({elsewhere, some.end()}, contacts_a_stretch + 37, contacts);
    const std::vector<Index> all = numbers(contacts);
    for (Index i = 0; i < contacts.size(); ++i)
        EXPECT_EQ(all[i] / contacts_a_stretch, i / contacts_a_stretch) << "left its stretch";
    EXPECT_LT(count_misplaced(contacts), contacts_a_stretch);
}

/// Rock whose corners meet: many contacts bear nothing, in whole packs.
CaseDef rock_with_corners()
{
    return scenes::joints(24.0, 24.0, 1.0, 3.0);
}

TEST(ContactOrder, ChangesNothingOfWhatContactsDo)
{
    test::CaseRun run(rock_with_corners());
    run.advance(300);
    State grouped = run.state();
    group_alike(run.model().joints, grouped.contacts);
    State by_parts = grouped;
    const std::vector<Index> order = order_by_parts(grouped.contacts);
    for (Index i = 0; i < grouped.contacts.size(); ++i)
        by_parts.contacts.put(i, grouped.contacts.get(order[static_cast<std::size_t>(i)]));
    ASSERT_GT(count_misplaced(by_parts.contacts), grouped.contacts.size() / 4);
    const RegimeRule rule = resolve_rules(run.model(), grouped).contact;
    const IndexRange all{0, grouped.contacts.size()};
    ContactLoads loads, loads_by_parts;
    for (ContactLoads* of : {&loads, &loads_by_parts})
    {
        of->resize(grouped.contacts.stale.size());
        std::ranges::fill(of->load, BlockLoad{1.0, 1.0, 1.0, 1.0});
    }
    for (State* state : {&grouped, &by_parts})
        for (BlockMotion& m : state->blocks.motion)
            m.x += 1e-4 * std::sin(3.0 * m.x + 2.0 * m.y);
    const ContactTally tally = evaluate_contacts(all, run.model(), rule, grouped.blocks, grouped.contacts, loads);
    EXPECT_GT(tally.stale, all.size() / 4);
    EXPECT_LT(tally.stale, all.size());
    EXPECT_EQ(evaluate_contacts(all, run.model(), rule, by_parts.blocks, by_parts.contacts, loads_by_parts).stale, tally.stale);
    for (Index i = 0; i < all.size(); ++i)
    {
        const Index other = order[static_cast<std::size_t>(i)];
        EXPECT_EQ(by_parts.contacts.stale[i], grouped.contacts.stale[other]);
        EXPECT_EQ(loads_by_parts.use[i].mobilised, loads.use[other].mobilised);
        EXPECT_EQ(loads_by_parts.use[i].contacts, loads.use[other].contacts);
        for (int side = 0; side < 2; ++side)
        {
            EXPECT_EQ(loads_by_parts.load[2 * i + side].x, loads.load[2 * other + side].x);
            EXPECT_EQ(loads_by_parts.load[2 * i + side].moment, loads.load[2 * other + side].moment);
        }
    }
    EXPECT_EQ(state_hash(run.model(), by_parts), state_hash(run.model(), grouped));
}

TEST(ContactOrder, IsRenewedInCyclesThatDoNotDependOnCallsOrThreads)
{
    test::CaseRun run(rock_with_corners());
    run.advance(200);
    State by_parts = run.state();
    const std::vector<Index> order = order_by_parts(run.state().contacts);
    for (Index i = 0; i < by_parts.contacts.size(); ++i)
        by_parts.contacts.put(i, run.state().contacts.get(order[static_cast<std::size_t>(i)]));
    run.advance(100);  // in another order: the same forces, but for round-off
    const auto hash_of = [&](const std::vector<std::int64_t>& pieces, int threads, Index& misplaced)
    {
        Simulation simulation(run.model(), by_parts, threads);
        for (const std::int64_t cycles : pieces)
            simulation.advance(cycles);
        EXPECT_EQ(simulation.state().broad_phase_runs, by_parts.broad_phase_runs);
        misplaced = count_misplaced(simulation.state().contacts);
        for (Index b = 0; b < run.model().blocks() && simulation.state().cycle == run.state().cycle; ++b)
            EXPECT_NEAR(simulation.state().blocks.motion[b].vy, run.state().blocks.motion[b].vy, 1e-6);
        return state_hash(simulation.model(), simulation.state());
    };
    Index before = 0, after = 0;
    static_cast<void>(hash_of({56}, 1, before));
    EXPECT_GT(before, by_parts.contacts.size() / 4);
    const std::uint64_t expected = hash_of({100}, 1, after);
    EXPECT_LT(after, before / 4);
    EXPECT_EQ(hash_of({100}, 2, after), expected);
    EXPECT_EQ(hash_of({30, 26, 1, 43}, 1, after), expected);
}

using Features = std::tuple<Index, Index, Index, Index>;

std::map<Features, double> forces_of(const Contacts& contacts)
{
    std::map<Features, double> forces;
    for (Index i = 0; i < contacts.size(); ++i)
        forces[{contacts.part_a[i], contacts.part_b[i], contacts.ref_edge[i], contacts.inc_edge[i]}] = contacts.normal_force(0, i);
    return forces;
}

TEST(ContactOrder, KeepsHistoriesWhenContactsAreFoundAnew)
{
    CaseDef scene = scenes::joints(16.0, 16.0, 1.0, 3.0);
    scene.insitu = {.given = true, .surface = 20.0, .ratio = 1.5};
    scene.joints = {scenes::sample_joints()[0], scenes::sample_joints()[1]};
    scene.joints[1].name = "rough";
    scene.joint_sets[0].joint = "rough";
    test::CaseRun run(scene);
    run.advance(50);
    EXPECT_FALSE(std::ranges::is_sorted(order_by_parts(run.state().contacts)));
    const std::map<Features, double> before = forces_of(run.state().contacts);
    ASSERT_GT(before.size(), 400U);
    run.simulation.change_motion([](std::vector<BlockMotion>&) {});
    std::size_t kept = 0;
    for (const auto& [features, force] : forces_of(run.state().contacts))
        if (const auto at = before.find(features); at != before.end())
        {
            EXPECT_EQ(force, at->second);
            ++kept;
        }
    EXPECT_GT(kept, before.size() * 9 / 10);
}
}  // namespace
}  // namespace hdem
