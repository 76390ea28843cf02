/// Sums that form part by part have the bits of sums over lists, however contacts are shared out.
#include "core/contact/contact_forces.h"
#include "core/contact/running_sums.h"
#include "verification/unit/case_run.h"

#include <algorithm>
#include <tuple>

namespace hdem
{
namespace
{
using test::CaseRun;

auto fields(const BlockForce& f)
{
    return std::tie(f.x, f.y, f.moment, f.reserve, f.mobilised, f.t_x, f.t_y, f.contacts);
}

/// As many ranges, one after another; the first is empty.
std::vector<IndexRange> cut(Index size, Index ranges)
{
    std::vector<IndexRange> cuts{{0, 0}};
    for (Index i = 1; i <= ranges; ++i)
        cuts.push_back({cuts.back().end, size * i / ranges});
    return cuts;
}

std::vector<IndexRange> parts_of(Index contacts, Index each)
{
    std::vector<IndexRange> parts;
    for (Index i = 0; i < contacts; i += each)
        parts.push_back({i, std::min(i + each, contacts)});
    return parts;
}

class RunningSumsTest : public testing::Test
{
  protected:
    RunningSumsTest() : run_(scenes::turned(scenes::pile(60, 6), 23.0)) {}

    /// @return  blocks that needed sum_forces
    Index expect_same(Index shares, bool find_joint)
    {
        const Model& model = run_.model();
        State now = run_.state();
        std::vector<Triple> external(static_cast<std::size_t>(now.blocks.size()));
        for (Index b = 0; b < now.blocks.size(); ++b)
            external[b] = {0.1 * b, 1.0 / (1.0 + b), 3.0 * b};
        BlockContacts list;
        list_block_contacts(now.contacts, now.blocks.size(), list);
        ContactLoads all, kept;
        all.resize(now.contacts.stale.size());
        kept.resize(now.contacts.stale.size());
        const RegimeRule rule{.law = ContactLaw::by_speed};
        State other = now;
        static_cast<void>(evaluate_contacts({0, now.contacts.size()}, model, rule, now.blocks, now.contacts, all));
        sum_forces({0, now.blocks.size()}, model, list, all, external, find_joint, now.blocks);

        RunningSums running;
        const std::vector<IndexRange> parts = parts_of(other.contacts.size(), 8);
        running.prepare(parts, cut(static_cast<Index>(parts.size()), shares), other.contacts, list);
        for (std::size_t i = 0; i < parts.size(); ++i)
        {
            ContactLoads loads;
            loads.resize(static_cast<std::size_t>(parts[i].size()) + 8);
            loads.first = parts[i].begin;
            static_cast<void>(evaluate_contacts(parts[i], model, rule, other.blocks, other.contacts, loads));
            running.add(static_cast<Index>(i), model, other.blocks.present, external, loads, find_joint, kept);
        }
        std::swap(other.blocks.force, running.sums);
        const std::vector<Index> others = running.others({0, other.blocks.size()});
        for (const Index b : others)
            sum_forces({b, b + 1}, model, list, kept, external, find_joint, other.blocks);
        for (Index b = 0; b < now.blocks.size(); ++b)
            EXPECT_EQ(fields(now.blocks.force[b]), fields(other.blocks.force[b])) << "block " << b << " of " << shares << " shares";
        return static_cast<Index>(others.size());
    }

    CaseRun run_;
};

TEST_F(RunningSumsTest, HaveTheBitsOfSumsOverLists)
{
    Index cut_through = 0;
    for (int i = 0; i < 10; ++i)
    {
        run_.advance(1500);
        const Index of_one = expect_same(1, true);
        EXPECT_EQ(expect_same(1, false), of_one);
        EXPECT_GE(expect_same(2, true), of_one);
        cut_through += expect_same(5, true) - of_one;
        expect_same(5, false);
    }
    EXPECT_GT(cut_through, 20) << "blocks with contacts in several shares";
}

/// Two contacts of a block with the ground: the first bears `share` of its weight and has all of its strength in use, the second bears all of it.
BlockForce sum_of_two(double share, double other_share, bool running)
{
    const CaseRun run(scenes::block_on_ground());
    const Model& model = run.model();
    Blocks blocks = run.state().blocks;
    const Index block = run.slot("block"), ground = run.slot("ground");
    const double weight = model.mass[block] * 9.81;
    BlockContacts list;
    list.begin = {0, 2, 4};
    list.entry = block < ground ? std::vector<Index>{0, 2, 1, 3} : std::vector<Index>{1, 3, 0, 2};
    ContactLoads loads;
    loads.resize(8);
    loads.load[0].x = share * weight;
    loads.use[0] = {.contacts = contact_force, .mobilised = 1.0F, .t_x = 0.0F, .t_y = 1.0F};
    loads.load[2].y = other_share * weight;
    loads.use[1] = {.contacts = contact_force, .mobilised = 0.25F, .t_x = 1.0F, .t_y = 0.0F};
    if (!running)
    {
        sum_forces({0, 2}, model, list, loads, {}, true, blocks);
        return blocks.force[block];
    }
    Contacts contacts;
    contacts.ref = {block, block};
    contacts.inc = {ground, ground};
    contacts.swapped = {0, 0};  // the block's side is 0
    RunningSums sums;
    sums.prepare({{0, 2}}, {{0, 1}}, contacts, list);
    ContactLoads kept;
    sums.add(0, model, blocks.present, {}, loads, true, kept);
    return sums.sums[block];
}

TEST(JointInUseMost, BearsMoreThanRoundOff)
{
    for (const bool running : {false, true})
    {
        const BlockForce pressed = sum_of_two(1e-3, 1.0, running), touched = sum_of_two(1e-8, 1.0, running);
        EXPECT_EQ(std::tuple(pressed.mobilised, pressed.t_x, pressed.t_y), std::tuple(1.0F, 0.0F, 1.0F)) << running;
        EXPECT_EQ(std::tuple(touched.mobilised, touched.t_x, touched.t_y), std::tuple(0.25F, 1.0F, 0.0F)) << running;
        EXPECT_EQ(sum_of_two(1e-8, 1e-8, running).mobilised, -1.0F) << running;
    }
}
}  // namespace
}  // namespace hdem
