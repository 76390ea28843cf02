#include "core/support/liner_rest.h"

#include "core/support/liner_memory.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
double fastest_node(const Liner& liner, const std::vector<double>& history)
{
    const LinerNodes nodes = liner_nodes_of(liner, history);
    double fastest = 0.0;
    for (std::size_t n = 0; n < liner.nodes.size(); ++n)
        fastest = std::max(fastest, std::hypot(nodes.velocity[3 * n], nodes.velocity[3 * n + 1]));
    return fastest;
}
}  // namespace

bool has_come_off(const Liner& liner, const LinerRecord& record, const Blocks& blocks)
{
    double length = 0.0;  // with rock behind it
    for (const LinerSegment& segment : liner.segments)
        if (segment.block != no_index && blocks.present[segment.block] != 0)
            length += segment.length;
    return record.installed != 0 && record.parted >= length * (1.0 - 1e-9);
}

bool liners_move(const Model& model, const State& state, double speed)
{
    for (std::size_t i = 0; i < model.support.liners.size(); ++i)
    {
        const LinerRecord& record = state.support.liners[i];
        const Liner& liner = model.support.liners[i];
        if (record.installed != 0 && !has_come_off(liner, record, state.blocks) &&
            fastest_node(liner, state.support.history) > speed)
            return true;
    }
    return false;
}
}  // namespace hdem
