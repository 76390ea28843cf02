#include "core/support/liner_load.h"

#include "core/model/liner_growth.h"
#include "core/support/bolt_link.h"

namespace hdem
{
Vec2 place_of_rock(const LinerSegment& segment, int end, const Blocks& blocks)
{
    const BlockMotion& m = blocks.motion[segment.block];
    return Vec2(m.x, m.y) + turned_with(m, segment.arm[end]);
}

LinerLoad load_of(const Liner& liner, const LinerRecord& record, const LinerMemory& memory, const Model& model, const State& state)
{
    const std::int64_t age = state.cycle - record.since;
    LinerLoad load{.step = state.blocks.step.last,
                   .factor = hardening_at(liner, age),
                   .pressure = liner.pressure * grown_share(liner.pressure_cycles, age),
                   .gravity = model.gravity * grown_share(liner_weight_cycles, age),
                   .rock = {},
                   .gone = {}};
    for (std::size_t s = 0; s < liner.segments.size(); ++s)
    {
        const LinerSegment& segment = liner.segments[s];
        const bool gone = segment.block == no_index || state.blocks.present[segment.block] == 0;
        load.gone.push_back(gone ? 1 : 0);
        for (int end = 0; end < 2; ++end)
        {
            const double* then = memory.segment[s].place[end];
            load.rock.push_back(gone ? Vec2(0.0, 0.0) : Vec2(place_of_rock(segment, end, state.blocks) - Vec2(then[0], then[1])));
        }
    }
    return load;
}

LinerLoad last_load(const Liner& liner, const LinerRecord& record, const LinerMemory& memory, const Model& model,
                    const State& state)
{
    LinerLoad load = load_of(liner, record, memory, model, state);
    for (std::size_t s = 0; s < liner.segments.size(); ++s)
        for (int end = 0; load.gone[s] == 0 && end < 2; ++end)
        {
            const LinerSegment& segment = liner.segments[s];
            const BlockMotion& m = state.blocks.motion[segment.block];
            load.rock[2 * s + end] -= load.step * (Vec2(m.vx, m.vy) + m.w * turned_left(turned_with(m, segment.arm[end])));
        }
    return load;
}
}  // namespace hdem
