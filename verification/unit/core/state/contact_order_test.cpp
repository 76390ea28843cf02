#include "core/state/contact_order.h"
#include "verification/scenes/sample_joints.h"
#include "verification/unit/case_run.h"

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
    group_by_law(joints, contacts);
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
        group_by_law(four_joints(), contacts);
        EXPECT_EQ(slips(contacts), before);
    }
}

TEST(ContactOrder, ByPartsFindsTheOrderBeforeTheGrouping)
{
    Contacts contacts = contacts_of({0, 1, 3, 2, 1}, 301);
    const std::vector<double> before = slips(contacts);
    group_by_law(four_joints(), contacts);
    EXPECT_NE(slips(contacts), before);
    std::vector<double> sorted;
    for (const Index i : order_by_parts(contacts))
        sorted.push_back(contacts.memory(1, i).slip);
    EXPECT_EQ(sorted, before);
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
