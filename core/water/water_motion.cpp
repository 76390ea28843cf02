#include "core/water/water_motion.h"

#include "core/observer.h"
#include "core/state/turning.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr std::int64_t longest = 500;  // cycles that forces hold. Blocks in rock hardly move in between.
constexpr double swing_share = 0.3;    // of 1 / omega
constexpr double noticed_way = 1e-5;   // of a block's size: shorter ways in `longest` cycles change nothing

bool is_noticed(Index block, const Model& model, const State& state)
{
    const BlockMotion& m = state.blocks.motion[block];
    const double speed = std::sqrt(m.vx * m.vx + m.vy * m.vy) + std::abs(m.w) * model.radius[block];
    return speed * static_cast<double>(longest) * state.blocks.step.next > noticed_way * model.size(block);
}
}  // namespace

double swing_rate(Index block, const Model& model)
{
    if (!model.water.given || !(model.mass[block] > 0.0))
        return 0.0;
    const double width = 2.0 * model.radius[block];
    return std::sqrt(model.water.unit_weight * (width / model.mass[block] + width * width * width / (12.0 * model.inertia[block])));
}

bool floats(Index block, const State& state)
{
    const Triple& on = state.water[block];
    if (on.x == 0.0 && on.y == 0.0)
        return false;
    if (state.blocks.force[block].contacts == 0)
        return true;
    const auto found = std::ranges::lower_bound(state.moving, block, {}, &MovingBlock::block);
    return found != state.moving.end() && found->block == block && found->how == FreeMotion::flies;
}

void add_drag(Index block, double share, const Model& model, const State& state, Triple& force)
{
    const BlockMotion& m = state.blocks.motion[block];
    const double rate = 2.0 * share * swing_rate(block, model);
    force.x -= rate * model.mass[block] * m.vx;
    force.y -= rate * model.mass[block] * m.vy;
    force.w -= rate * model.inertia[block] * m.w;
}

std::int64_t water_holds_until(const Model& model, const State& state, const WaterRule& rule)
{
    double fastest = 0.0;
    std::int64_t most = longest;
    for (Index b = 0; b < model.blocks(); ++b)
    {
        if (!state.blocks.is_free(b))
            continue;
        const bool does_float = floats(b, state);
        if (does_float)
            most = std::min(most, rule.while_floating);
        if (does_float || is_noticed(b, model, state))
            fastest = std::max(fastest, swing_rate(b, model));
    }
    const double in_time = swing_share / (fastest * state.blocks.step.next);  // infinite where nothing moves
    const auto cycles = static_cast<std::int64_t>(std::clamp(std::floor(in_time), 1.0, static_cast<double>(most)));
    return std::min(next_multiple(state.cycle, longest), state.cycle + cycles);
}

BlockMotion moved_on(BlockMotion pose, double time)
{
    pose.x += time * pose.vx;
    pose.y += time * pose.vy;
    if (pose.w != 0.0)
        turn_by(time * pose.w, pose);
    return pose;
}
}  // namespace hdem
