/// Each number of a state is in the checkpoint, and each that decides the future in the hash.

#include "core/rock/build_model.h"
#include "core/state/state_hash.h"
#include "core/state/state_tables.h"
#include "io/checkpoint.h"
#include "verification/unit/io/full_state.h"
#include "verification/unit/small_run.h"

#include <bit>
#include <cmath>
#include <optional>

namespace hdem
{
namespace
{
using test::ScratchFolder;
using test::with_everything;

/// The last bit of a number, or the next value.
template <typename T>
T changed(T value)
{
    if constexpr (std::is_same_v<T, double>)
        return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) ^ 1u);
    else if constexpr (std::is_same_v<T, float>)
        return std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) ^ 1u);
    else if constexpr (std::is_same_v<T, bool>)
        return !value;
    else
        return static_cast<T>(static_cast<std::int64_t>(value) ^ 1);
}

/// One number of a state by its place among all of them: first it is changed, later it is read.
struct Pick
{
    int wanted = 0;
    bool change = false;
    int at = 0;
    std::string name = {};
    double value = 0.0;

    template <typename T>
    void look(const std::string& where, T& number)
    {
        if (at++ != wanted)
            return;
        name = where;
        if (change)
            number = changed(number);
        value = static_cast<double>(number);
    }
};

/// Goes through all numbers of one row of each table: of the row after the first, where there is one.
/// @param told  also those that decide nothing, behind the others
void pick_from(State& state, bool told, Pick& pick)
{
    const auto value = [&](const char* name, auto& number) { pick.look(name, number); };
    const auto row = [&](auto, const char* name, auto& rows, const auto& list)
    {
        ASSERT_FALSE(rows.empty()) << name;
        fields::for_each(list, rows[rows.size() / 2], [&](auto& number) { pick.look(name, number); });
    };
    tables::for_each_of_run(state, value);
    tables::for_each_of_ends(state, row);
    tables::for_each_of_blocks(state, row);
    tables::for_each_of_excavations(state, row);
    tables::for_each_of_groups(state, row);
    tables::for_each_of_support(state.support, row);
    const Index middle = state.contacts.size() / 2;
    Contact contact = state.contacts.get(middle);
    std::uint8_t stale = state.contacts.stale[middle];
    tables::for_each_of_contact(state.contacts.has_preload, state.contacts.has_memory,
                                [&](auto, const char* name, const auto& list)
                                { fields::for_each(list, contact, [&](auto& number) { pick.look(name, number); }); });
    pick.look("/contacts/stale", stale);
    if (pick.change)
    {
        state.contacts.put(middle, contact);
        state.contacts.stale[middle] = stale;
    }
    if (!told)
        return;
    tables::for_each_derived(state, row);
    tables::for_each_counter(state, value);
    tables::for_each_told(state, row);
    for (const LedgerTerm& term : ledger_terms)
        pick.look(term.name, state.ledger.*term.value);
}

class StateTables : public test::FullState
{
  protected:
    /// The state with one number changed.
    static State with_change(Pick& pick, bool told)
    {
        State state = *state_;
        pick.change = true;
        pick_from(state, told, pick);
        return state;
    }
    static int count(bool told)
    {
        Pick none{.wanted = -1};
        State state = *state_;
        pick_from(state, told, none);
        return none.at;
    }
};

/// What a checkpoint gives back; nothing where it refuses the state as damaged, which it does only because it has read the change.
std::optional<State> saved_and_loaded(const State& state, const Model& model, const ScratchFolder& folder)
{
    RunRecord record;
    record.history_axes.resize(model.histories.size(), Vec2(0.0, 0.0));
    write_checkpoint(folder.path(), record, model, state);
    hdem::Setup setup = build_model(with_everything());
    try
    {
        return CheckpointReader(checkpoint_file(folder.path())).state(setup.model);
    }
    catch (const InputError&)
    {
        return std::nullopt;
    }
}

/// The lists hold each field of a record (assertions of core/state/fields.h); here each list stands in a table.
TEST_F(StateTables, HoldEachFieldOnce)
{
    State state = *state_;
    std::size_t blocks = 0, support = 0, ends = 0, told = 0, contact = 0;
    const auto counter = [](std::size_t& sum)
    {
        return [&sum](auto, const char*, auto& rows, const auto& list)
        { fields::for_each(list, rows.front(), [&](auto&) { ++sum; }); };
    };
    tables::for_each_of_blocks(state, counter(blocks));
    tables::for_each_derived(state, counter(blocks));
    tables::for_each_of_support(state.support, counter(support));
    tables::for_each_of_ends(state, counter(ends));
    tables::for_each_told(state, counter(told));
    Contact one = state.contacts.get(0);
    tables::for_each_of_contact(
        true, true, [&](auto, const char*, const auto& list) { fields::for_each(list, one, [&](auto&) { ++contact; }); });
    const std::size_t other_arrays = 5 + 2 + 1;  // steps, bearing forces, margins, rest, presence; reference place and angle
    EXPECT_EQ(blocks, 2 * field_count<BlockMotion>() + field_count<BlockForce>() - 2 + field_count<BlockInertia>() - 1 +
                          other_arrays + field_count<Triple>());
    EXPECT_EQ(support, field_count<BoltRecord>() + field_count<LinerRecord>() + 1);
    EXPECT_EQ(ends, field_count<EndWatch>());
    EXPECT_EQ(told, field_count<StageOutcome>() + 2 * field_count<StageBlock>() + field_count<StaticSolution>());
    const std::size_t point = field_count<PointHistory>() - 1 + field_count<JointMemory>();
    const std::size_t seen = 4;
    EXPECT_EQ(contact, field_count<Contact>() - 3 + seen + field_count<EdgePair>() + 2 * point);
}

TEST_F(StateTables, AreAllInTheCheckpoint)
{
    const ScratchFolder folder("state_tables");
    ASSERT_TRUE(saved_and_loaded(*state_, *model_, folder).has_value());
    const int numbers = count(true);
    EXPECT_GT(numbers, 150);
    int refused = 0;
    for (int i = 0; i < numbers; ++i)
    {
        Pick pick{.wanted = i};
        const State state = with_change(pick, true);
        std::optional<State> loaded = saved_and_loaded(state, *model_, folder);
        if (!loaded)
        {
            ++refused;
            continue;
        }
        Pick read{.wanted = i};
        pick_from(*loaded, true, read);
        EXPECT_EQ(read.value, pick.value) << pick.name << ", number " << i;
    }
    EXPECT_LT(refused, numbers / 4);
}

TEST_F(StateTables, WhatDecidesTheFutureIsInTheHash)
{
    const std::uint64_t hash = state_hash(*model_, *state_);
    const int numbers = count(false);
    EXPECT_GT(numbers, 120);
    for (int i = 0; i < numbers; ++i)
    {
        Pick pick{.wanted = i};
        const State state = with_change(pick, false);
        EXPECT_NE(state_hash(*model_, state), hash) << pick.name << ", number " << i;
    }
}

TEST_F(StateTables, WhatIsOnlyToldIsNotInTheHash)
{
    const std::uint64_t hash = state_hash(*model_, *state_);
    for (int i = count(false); i < count(true); ++i)
    {
        Pick pick{.wanted = i};
        const State state = with_change(pick, true);
        EXPECT_EQ(state_hash(*model_, state), hash) << pick.name << ", number " << i;
    }
}
}  // namespace
}  // namespace hdem
