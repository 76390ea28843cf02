/// Four contacts at a time and eight at a time give the same bits.
#include "core/contact/contact_forces_wide.h"
#include "verification/unit/case_run.h"

#include <cstring>

namespace hdem
{
namespace
{
using test::CaseRun;

/// Everything that a pass writes.
struct Pass
{
    Contacts contacts;
    ContactLoads loads;
    ContactTally tally;
};

template <typename Evaluate>
Pass pass_of(const CaseRun& run, const RegimeRule& rule, const PassNeeds& needs, const Evaluate& evaluate)
{
    Pass pass{run.state().contacts, {}, {}};
    const auto all = static_cast<Index>(pass.contacts.stale.size()) / 8 * 8;
    pass.loads.resize(pass.contacts.stale.size());
    pass.tally = evaluate({0, all}, run.model(), rule, run.state().blocks, pass.contacts, pass.loads, ContactTally{}, needs);
    return pass;
}

template <typename Array>
bool are_same(const Array& a, const Array& b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
}

Index expect_same_bits(const CaseRun& run, const std::string& what)
{
    Index impulses = 0;
    for (const ContactLaw law : {ContactLaw::springs, ContactLaw::impulses, ContactLaw::by_speed})
        for (const Closing closing : {Closing::whole_cycles, Closing::fast_points, Closing::all_points})
            for (const bool keeps : {false, true})
            {
                const RegimeRule rule{
                    .law = law, .rock_keeps_springs = keeps, .closing = closing, .closing_speed = keeps ? 1e-3 : 0.0};
                const PassNeeds needs{.views = keeps, .rests = true, .tilts = !keeps};
                const Pass four = pass_of(run, rule, needs, evaluate_by_four);
                const Pass eight = pass_of(run, rule, needs, evaluate_by_eight);
                EXPECT_TRUE(are_same(four.contacts.lane, eight.contacts.lane)) << what;
                EXPECT_TRUE(are_same(four.contacts.regime[0], eight.contacts.regime[0])) << what;
                EXPECT_TRUE(are_same(four.contacts.regime[1], eight.contacts.regime[1])) << what;
                EXPECT_TRUE(are_same(four.contacts.stale, eight.contacts.stale)) << what;
                EXPECT_TRUE(are_same(four.loads.load, eight.loads.load)) << what;
                EXPECT_TRUE(are_same(four.loads.use, eight.loads.use)) << what;
                EXPECT_EQ(std::memcmp(&four.tally.friction, &eight.tally.friction, sizeof(Pack)), 0) << what;
                EXPECT_EQ(std::memcmp(&four.tally.changes, &eight.tally.changes, sizeof(Pack)), 0) << what;
                EXPECT_EQ(four.tally.closed, eight.tally.closed) << what;
                EXPECT_EQ(four.tally.impulses, eight.tally.impulses) << what;
                EXPECT_EQ(four.tally.stale, eight.tally.stale) << what;
                EXPECT_EQ(four.tally.deep, eight.tally.deep) << what;
                EXPECT_EQ(four.tally.unrested, eight.tally.unrested) << what;
                EXPECT_EQ(four.tally.slack, eight.tally.slack) << what;
                impulses += law == ContactLaw::by_speed ? four.tally.impulses : 0;
            }
    return impulses;
}

class ContactWidths : public testing::Test
{
  protected:
    void SetUp() override
    {
        if (!has_wide_packs())
            GTEST_SKIP() << "this processor has no AVX-512, or this build does not use it";
    }
};

TEST_F(ContactWidths, FallingRubbleGivesTheSameBits)
{
    CaseRun run(scenes::turned(scenes::pile(60, 6), 23.0));
    Index impulses = 0;
    for (int i = 0; i < 40; ++i)
    {
        run.advance(400);
        impulses += expect_same_bits(run, "pile after " + std::to_string(run.state().cycle));
    }
    EXPECT_GT(impulses, 0);
}

TEST_F(ContactWidths, JointedRockGivesTheSameBits)
{
    CaseDef scene = scenes::joints(12.0, 12.0, 1.3, 10.0);
    CaseRun run(scene);
    for (int i = 0; i < 10; ++i)
    {
        expect_same_bits(run, "joints");
        run.advance(50);
    }
}

TEST_F(ContactWidths, PreloadedRockGivesTheSameBits)
{
    CaseDef scene = scenes::joints(12.0, 12.0, 1.3, 10.0);
    scene.insitu.given = true;
    scene.insitu.stress = {-2e6, -1e6, 3e5};
    CaseRun run(scene);
    ASSERT_TRUE(run.state().contacts.has_preload);
    for (int i = 0; i < 10; ++i)
    {
        expect_same_bits(run, "preloaded");
        run.advance(20);
    }
}
}  // namespace
}  // namespace hdem
