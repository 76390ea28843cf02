#include "verification/rest/watch.h"

#include "core/energy_ledger.h"
#include "core/motion/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace hdem::verification::rest
{
namespace
{
constexpr double beyond_energy = 0.01;
constexpr std::int64_t energy_span = 4;  // cycles
constexpr double
    settling = 1e-3;  // of a block's size: where nothing moves farther, energies count against the weight's work along it
}  // namespace

void EnergyWatch::observe(const Model& model, const State& state)
{
    if (start_.empty())
        for (Index i = 0; i < model.blocks(); ++i)
        {
            const BlockMotion& m = state.blocks.motion[i];
            start_.emplace_back(m.x, m.y);
            initial_ += kinetic_energy(model, state.blocks, i);
            greatest_energy_ += state.blocks.is_free(i) ? settling * model.size(i) * model.mass[i] * model.gravity.norm() : 0.0;
        }
    look_at_speeds(model, state);
    look_at_energy(model, state);
}

void EnergyWatch::look_at_speeds(const Model& model, const State& state)
{
    const Blocks& blocks = state.blocks;
    double work = state.ledger.load_work + state.ledger.boundary + state.ledger.water;
    for (Index i = 0; i < model.blocks(); ++i)
        work += model.mass[i] * model.gravity.dot(Vec2(blocks.motion[i].x, blocks.motion[i].y) - start_[i]);
    const double energy = (1.0 + beyond_energy) * std::max(work + initial_, 0.0);
    const double weight = model.gravity.norm();
    for (Index i = 0; i < model.blocks(); ++i)
    {
        if (!blocks.is_free(i))
            continue;
        const double allowed = std::sqrt(2.0 * energy / model.mass[i]) + 4.0 * std::sqrt(weight * settle_) +
                               weight * blocks.step.last;
        const double speed = blocks.velocity(i).norm();
        if (!(speed <= peak_.share * allowed))
            peak_ = {speed / allowed, speed, allowed, static_cast<std::size_t>(model.user_number[i]), state.cycle};
    }
}

void EnergyWatch::look_at_energy(const Model& model, const State& state)
{
    const StoredEnergy stored = stored_energy(model, state);
    const double energy = stored.total() - stored.pending - state.ledger.gravity_work - state.ledger.load_work -
                          state.ledger.boundary - state.ledger.water;
    span_energy_ = std::max(span_energy_, energy);
    rise_ = std::max(rise_, span_energy_ - least_energy_);
    if (state.cycle % energy_span == 0)
    {
        least_energy_ = std::min(least_energy_, span_energy_);
        span_energy_ = -1e300;
    }
    greatest_energy_ = std::max({greatest_energy_, stored.total(), std::abs(state.ledger.gravity_work)});
    if (state.cycle == 0)
        return;
    const double off = std::abs(hdem::residual(state.ledger, stored));
    residual_ = std::max(residual_, off);
    if (off > 0.0)
        greatest_term_ = std::max(greatest_term_, off / std::abs(relative_residual(state.ledger, stored)));
}
}  // namespace hdem::verification::rest
