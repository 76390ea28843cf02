/// Four contacts at a time, as this processor does it and as any does, and eight at a time give the same bits.
#include "core/contact/contact_forces_wide.h"
#include "core/kernels.h"
#include "verification/scenes/sample_joints.h"
#include "verification/unit/case_run.h"

#include <cmath>
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

/// Contacts that bear nothing put nothing on their blocks. What a pass leaves in their overlaps, in the sign of a zero and in a direction of nothing means nothing:
/// packs of them are passed over.
void clear_idle(Pass& pass)
{
    for (Index i = 0; i < static_cast<Index>(pass.contacts.stale.size()); ++i)
    {
        if (pass.contacts.may_bear(i))
            continue;
        Contact contact = pass.contacts.get(i);
        for (PointHistory& point : contact.point)
            point.overlap = point.tilt_force = 0.0;
        const std::uint8_t stale = pass.contacts.stale[i];
        pass.contacts.put(i, contact);
        pass.contacts.stale[i] = stale;
        for (BlockLoad* load : {&pass.loads.load[2 * i], &pass.loads.load[2 * i + 1]})
        {
            EXPECT_EQ(std::abs(load->x) + std::abs(load->y) + std::abs(load->moment) + std::abs(load->reserve), 0.0);
            *load = {};
        }
        EXPECT_EQ(pass.loads.use[i].mobilised, -1.0F);
        EXPECT_EQ(pass.loads.use[i].contacts, 0U);
        pass.loads.use[i] = {};
    }
}

template <typename Evaluate>
Pass pass_of(const CaseRun& run, const RegimeRule& rule, const PassNeeds& needs, const Evaluate& evaluate)
{
    Pass pass{run.state().contacts, {}, {}};
    const auto all = static_cast<Index>(pass.contacts.stale.size()) / 8 * 8;
    pass.loads.resize(pass.contacts.stale.size());
    pass.tally = evaluate({0, all}, run.model(), rule, run.state().blocks, pass.contacts, pass.loads, ContactTally{}, needs);
    clear_idle(pass);
    return pass;
}

template <typename Array>
bool are_same(const Array& a, const Array& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0);
}

void expect_same(const Pass& a, const Pass& b, const std::string& what)
{
    EXPECT_TRUE(are_same(a.contacts.lane, b.contacts.lane)) << what;
    EXPECT_TRUE(are_same(a.contacts.memory_lane, b.contacts.memory_lane)) << what;
    EXPECT_TRUE(are_same(a.contacts.regime[0], b.contacts.regime[0])) << what;
    EXPECT_TRUE(are_same(a.contacts.regime[1], b.contacts.regime[1])) << what;
    EXPECT_TRUE(are_same(a.contacts.stale, b.contacts.stale)) << what;
    EXPECT_TRUE(are_same(a.loads.load, b.loads.load)) << what;
    EXPECT_TRUE(are_same(a.loads.use, b.loads.use)) << what;
    for (const auto sums : {&ContactTally::friction, &ContactTally::changes, &ContactTally::dilation, &ContactTally::broken})
        EXPECT_EQ(std::memcmp(&(a.tally.*sums), &(b.tally.*sums), sizeof(LaneSums)), 0) << what;
    EXPECT_EQ(a.tally.closed, b.tally.closed) << what;
    EXPECT_EQ(a.tally.impulses, b.tally.impulses) << what;
    EXPECT_EQ(a.tally.stale, b.tally.stale) << what;
    EXPECT_EQ(a.tally.deep, b.tally.deep) << what;
    EXPECT_EQ(a.tally.unrested, b.tally.unrested) << what;
    EXPECT_EQ(a.tally.slack, b.tally.slack) << what;
}

/// What blocks are given and do in one cycle.
struct Moved
{
    Blocks blocks;
    VelocityWorks works;
    Travel travel;
};

void expect_same(const Moved& a, const Moved& b, const std::string& what)
{
    EXPECT_TRUE(are_same(a.blocks.force, b.blocks.force)) << what;
    EXPECT_TRUE(are_same(a.blocks.motion, b.blocks.motion)) << what;
    EXPECT_EQ(std::memcmp(&a.works, &b.works, sizeof a.works), 0) << what;
    EXPECT_EQ(std::memcmp(&a.travel, &b.travel, sizeof a.travel), 0) << what;
}

/// Damping in all its forms.
std::vector<DampingRule> damping_rules()
{
    return {{.local = 0.7},
            {.local = 0.8, .global = 3.0, .form = LocalDamping::along_joint, .settling = 1e-3, .turning = 4e-2},
            {.local = 0.8, .form = LocalDamping::along_joint, .follows_support = true, .support = {1.0, 2.0, 1e-2, -2e-3, 1e-3}},
            {.local = 0.5, .form = LocalDamping::along_joint, .turning = 1e-6, .frees_sliding = false}};
}

/// Forces on blocks, what they move by, and energies of springs.
void expect_same_motion(const CaseRun& run, const Pass& pass, const std::string& what)
{
    const State& state = run.state();
    const Model& model = run.model();
    const IndexRange all{0, state.blocks.size()};
    BlockContacts list;
    list_block_contacts(state.contacts, state.blocks.size(), list);
    for (const DampingRule& rule : damping_rules())
        for (const double share : {1.0, 0.9})  // of the last step
        {
            std::vector<Triple> pseudo(state.blocks.motion.size(), {1e-3, -2e-3, 1e-3});
            const auto moved_by = [&](const Kernels& by, auto velocities, auto positions)
            {
                Moved moved{.blocks = state.blocks};
                moved.blocks.step.next *= share;
                moved.blocks.rest[0] = stopped;
                by.sum_loads(all, model, list, pass.loads, {}, true, moved.blocks);
                velocities(all, model, rule, moved.blocks, moved.works);
                std::vector<Triple> also = pseudo;
                moved.travel = positions(all, model, moved.blocks, share < 1.0 ? &also : nullptr);
                return moved;
            };
            const auto by_four = [&](const Kernels& by) { return moved_by(by, by.advance_velocities, by.advance_positions); };
            const Moved plain = by_four(plain_kernels());
            expect_same(plain, by_four(kernels()), what + ", four at a time");
            expect_same(plain, moved_by(kernels(), update_velocities, update_positions), what + ", eight at a time");
        }
    const Index count = state.contacts.size(), eights = (count + lanes - 1) / (2 * lanes) * 2 * lanes;
    const auto energies_by = [&](const Kernels& by, bool wide)
    {
        SpringEnergies sums;
        if (wide && eights > 0)
            add_spring_energies_by_eight({0, eights}, model, state.blocks, state.contacts, sums);
        by.add_spring_energies({wide ? eights : 0, count}, model, state.blocks, state.contacts, sums);
        return sums;
    };
    const SpringEnergies by_plain = energies_by(plain_kernels(), false), by_four = energies_by(kernels(), false);
    EXPECT_EQ(std::memcmp(&by_plain, &by_four, sizeof by_plain), 0) << what;
    const SpringEnergies by_eight = energies_by(kernels(), has_wide_packs());
    EXPECT_EQ(std::memcmp(&by_plain, &by_eight, sizeof by_plain), 0) << what;
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
                const Pass plain = pass_of(run, rule, needs, plain_kernels().evaluate_contacts);
                expect_same(plain, pass_of(run, rule, needs, kernels().evaluate_contacts), what + ", four at a time");
                if (has_wide_packs())  // as far as they can be taken so where joints have a memory
                    expect_same(plain,
                                pass_of(run, rule, needs, run.state().contacts.has_memory ? evaluate_contacts : evaluate_by_eight),
                                what + ", eight at a time");
                expect_same_motion(run, plain, what);
                impulses += law == ContactLaw::by_speed ? plain.tally.impulses : 0;
            }
    return impulses;
}

class ContactWidths : public testing::Test
{
  protected:
    void SetUp() override
    {
        if (!has_wide_packs() && &kernels() == &plain_kernels())
            GTEST_SKIP() << "this processor, or this build, has but one way";
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

void expect_same_bits_of_laws(const CaseDef& scene, const std::string& what)
{
    CaseRun run(scene);
    ASSERT_TRUE(run.state().contacts.has_memory);
    for (int i = 0; i < 10; ++i)
    {
        expect_same_bits(run, what);
        run.advance(20);
    }
}

TEST_F(ContactWidths, LawsWithMemoryGiveTheSameBits)
{
    for (const JointDef& joint : scenes::sample_joints())
    {
        CaseDef scene = scenes::joints(12.0, 12.0, 1.3, 10.0);
        scene.joints = {joint};
        expect_same_bits_of_laws(scene, "law " + std::to_string(static_cast<int>(joint.law)));
    }
}

TEST_F(ContactWidths, LawsBesideEachOtherGiveTheSameBits)
{
    CaseDef scene = scenes::joints(12.0, 12.0, 1.3, 10.0);
    scene.joint_sets.push_back({.name = "cross", .dip_deg = 50.0, .spacing = 3.0});
    const std::array<JointDef, 8> laws = scenes::sample_joints();
    for (std::size_t i : {1, 7})  // the third set stays plain
    {
        scene.joints.push_back(laws[i]);
        scene.joints.back().name = "rough" + std::to_string(i);
        scene.joint_sets[i == 1 ? 0 : 1].joint = scene.joints.back().name;
    }
    expect_same_bits_of_laws(scene, "Barton and Bandis, a shared library, and plain");
}
}  // namespace
}  // namespace hdem
