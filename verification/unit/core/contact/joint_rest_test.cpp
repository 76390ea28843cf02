/// Where nothing moves nothing changes: contacts of blocks at rest are left out, and a restart looks at them once more.

#include "core/contact/contact_forces.h"
#include "verification/scenes/sample_joints.h"
#include "verification/unit/case_run.h"

#include <cstring>
#include <utility>

namespace hdem
{
namespace
{
using test::CaseRun;

/// Contacts and what they give, after one look at them.
struct Look
{
    Contacts contacts;
    ContactLoads loads;
    ContactTally tally;
};

Look look_at(const Model& model, const Blocks& blocks, const Contacts& contacts)
{
    Look look{contacts, {}, {}};
    const auto all = static_cast<Index>(contacts.stale.size());
    look.loads.resize(contacts.stale.size());
    const RegimeRule rule{.law = ContactLaw::springs, .closing = Closing::fast_points};
    look.tally = evaluate_contacts({0, all}, model, rule, blocks, look.contacts, look.loads, ContactTally{});
    return look;
}

template <typename Rows>
bool are_same(const Rows& a, const Rows& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

bool is_same(const Look& a, const Look& b)
{
    return are_same(a.contacts.lane, b.contacts.lane) && are_same(a.contacts.memory_lane, b.contacts.memory_lane) &&
           are_same(a.contacts.regime[0], b.contacts.regime[0]) && are_same(a.contacts.regime[1], b.contacts.regime[1]) &&
           are_same(a.loads.load, b.loads.load) && are_same(a.loads.use, b.loads.use);
}

TEST(JointRest, LeavesEveryLawAsItIs)
{
    for (const JointDef& joint : scenes::sample_joints())
    {
        SCOPED_TRACE("law " + std::to_string(static_cast<int>(joint.law)));
        CaseDef scene = scenes::joints(8.0, 8.0, 1.0, 7.0);
        scene.contact.method = Method::force;
        scene.joints = {joint};
        scene.insitu = {.given = true, .surface = 30.0, .ratio = 1.7};
        scene.loads = {{.blocks = {"*"}, .acceleration = {3.0, 0.0}}};
        CaseRun run(scene);
        const bool settles = joint.law == JointLaw::plesha || joint.law == JointLaw::saeb_amadei || joint.law == JointLaw::library;
        const int most_looks = settles ? 40 : 2;
        Index slipping = 0;
        for (int i = 0; i < 6; ++i)
        {
            run.advance(60);
            Blocks blocks = run.state().blocks;
            for (BlockMotion& m : blocks.motion)
                m.vx = m.vy = m.w = 0.0;
            Contacts contacts = run.state().contacts;
            for (Index c = 0; c < contacts.size(); ++c)
                contacts.rest_overlap(0, c) = contacts.rest_overlap(1, c) = 0.0;  // which falls in each cycle
            const Look stopped = look_at(run.model(), blocks, contacts);          // poses have changed since the last cycle's
            // Some laws take the strength from the last stress or way: they need some looks to settle, the others one.
            int looks = 1;
            Look now = look_at(run.model(), blocks, stopped.contacts), next = look_at(run.model(), blocks, now.contacts);
            for (; looks < most_looks && !is_same(now, next); ++looks)
                now = std::exchange(next, look_at(run.model(), blocks, next.contacts));
            EXPECT_LT(looks, most_looks) << "look " << i;
            EXPECT_EQ(sum(next.tally.friction), 0.0);
            EXPECT_EQ(sum(next.tally.broken), 0.0);
            for (Index c = 0; c < now.contacts.size(); ++c)
                slipping += stopped.contacts.regime[0][c] == static_cast<std::uint8_t>(Regime::slip) ? 1 : 0;
        }
        EXPECT_GT(slipping, 0);
    }
}
}  // namespace
}  // namespace hdem
