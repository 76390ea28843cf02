/// Blocks at rest that are left out of cycles.

#include "core/motion/rest.h"
#include "core/state/state_hash.h"
#include "parallel/cycle.h"
#include "verification/scenes/scenes.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hdem
{
namespace
{
using test::CaseRun;

/// Rock around a tunnel from which blocks fall: they wake what they hit.
CaseDef tunnel(Method method)
{
    CaseDef rock = scenes::joints(24.0, 24.0, 1.0, 3.0);
    rock.contact.method = method;
    rock.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {12.0, 12.0}, .diameter = 6.0}};
    rock.stages = {{.name = "dig", .until_converged = true, .max_cycles = 100'000, .excavate = {"tunnel"}}};
    return rock;
}

/// As a look at the ends of a stage may do between two calls of run.
void wake_some(Blocks& blocks, int piece, bool& changed)
{
    for (Index b = piece % 10; b < blocks.size(); b += 10)
        if (blocks.rest[b] == left_out)
        {
            blocks.rest[b] = 0;
            changed = true;
        }
}

/// A call of run looks at all blocks in its first cycle and then every 16 cycles. A new runner begins with all contacts.
TEST(LeftOut, GiveTheSameBitsHoweverOftenTheyAreLookedFor)
{
    for (const Method method : {Method::force, Method::hybrid})
    {
        const CaseRun start(tunnel(method));
        State seldom = start.state(), always = start.state(), anew = start.state();
        CycleRunner in_pieces, by_cycles;
        std::int64_t left = 0, woken = 0;
        for (int piece = 0; piece < 60; ++piece)
        {
            ASSERT_EQ(in_pieces.run(start.model(), seldom, 100, 1), no_index);
            CycleRunner fresh;
            ASSERT_EQ(fresh.run(start.model(), anew, 100, 1), no_index);
            for (int cycle = 0; cycle < 100; ++cycle)
            {
                const std::vector<std::uint8_t> before = always.blocks.rest;
                ASSERT_EQ(by_cycles.run(start.model(), always, 1, 1), no_index);
                for (std::size_t b = 0; b < before.size(); ++b)
                    woken += before[b] == left_out && always.blocks.rest[b] == 0 ? 1 : 0;
            }
            ASSERT_EQ(state_hash(start.model(), seldom), state_hash(start.model(), always)) << "cycle " << always.cycle;
            ASSERT_EQ(state_hash(start.model(), seldom), state_hash(start.model(), anew)) << "cycle " << always.cycle;
            left += std::ranges::count(always.blocks.rest, left_out);
            for (State* state : {&seldom, &always, &anew})
                wake_some(state->blocks, piece, state->rest_changed);
        }
        EXPECT_GT(left, 500);
        EXPECT_GT(woken, 10);
    }
}
}  // namespace
}  // namespace hdem
