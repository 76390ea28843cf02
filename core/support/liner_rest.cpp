#include "core/support/liner_rest.h"

#include "core/support/liner_load.h"

namespace hdem
{
namespace
{
constexpr double balanced = 1e-3;  ///< below this share of its loads a lining is in balance
constexpr double falling = 0.1;    ///< share of its loads that moves it as a whole

bool is_parted(const Liner& liner, const LinerRecord& record, const Blocks& blocks)
{
    double length = 0.0;  // with rock behind it
    for (const LinerSegment& segment : liner.segments)
        if (segment.block != no_index && blocks.present[segment.block] != 0)
            length += segment.length;
    return record.parted >= length * (1.0 - 1e-9);
}
}  // namespace

LinerRest rest_of_liner(const Model& model, const State& state, std::size_t i)
{
    const Liner& liner = model.support.liners[i];
    const LinerRecord& record = state.support.liners[i];
    if (record.installed == 0)
        return {};
    std::vector<double> history = state.support.history;
    const LinerMemory memory = liner_memory(liner, history);
    const LinerBalance now = LinerSolver(liner).balance(last_load(liner, record, memory, model, state), memory);
    if (!(now.unbalanced > balanced))
        return {LinerMotion::rests, now.unbalanced};
    // A ring that swings is parted all around too, but what acts on it as a whole is little.
    const bool is_off = is_parted(liner, record, state.blocks) && now.whole > falling && !now.is_at_strength;
    return {is_off ? LinerMotion::has_come_off : LinerMotion::moves, now.unbalanced};
}

std::vector<std::size_t> moving_liners(const Model& model, const State& state)
{
    std::vector<std::size_t> moving;
    for (std::size_t i = 0; i < model.support.liners.size(); ++i)
        if (rest_of_liner(model, state, i).motion == LinerMotion::moves)
            moving.push_back(i);
    return moving;
}
}  // namespace hdem
