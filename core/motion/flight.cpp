#include "core/motion/flight.h"

#include "core/motion/equilibrium.h"
#include "core/motion/step_control.h"
#include "core/state/turning.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double most_steps = 4096.0;

bool is_unbound(const BlockInertia& inertia)
{
    return inertia.inverse_mass_x > 0.0 && inertia.inverse_mass_y > 0.0 && inertia.inverse_inertia > 0.0;
}

/// Time in which a block uses up its share of the margin, accelerated by g all the way [s].
double flight_time(Index block, const Model& model, const Blocks& blocks)
{
    const double speed = blocks.velocity(block).norm() + std::abs(blocks.motion[block].w) * model.radius[block];
    const double way = flight_share * blocks.margin[block];
    return 2.0 * way / (speed + std::sqrt(speed * speed + 2.0 * model.gravity.norm() * way));
}
}  // namespace

void find_flying(IndexRange range, const BlockContacts& list, const Blocks& blocks, std::vector<Index>& flying)
{
    flying.clear();
    for (Index b = range.begin; b < range.end; ++b)
        if (blocks.present[b] != 0 && list.begin[b] == list.begin[b + 1] && is_unbound(blocks.inertia[b]))
            flying.push_back(b);
}

double fly_ahead(const std::vector<Index>& flying, double loose_distance, const Model& model, Blocks& blocks, EnergyLedger& ledger)
{
    const double dt = blocks.step.next;
    double used = 0.0;
    for (const Index b : flying)
    {
        const double steps = std::floor(std::min(most_steps, flight_time(b, model, blocks) / dt));
        if (!blocks.is_loose(b, loose_distance) || blocks.rest[b] >= stopped || !(steps >= 2.0))
            continue;
        const double more = steps - 1.0, before = kinetic_energy(model, blocks, b);
        BlockMotion& m = blocks.motion[b];
        const Vec2 change = more * dt * model.gravity;
        const Vec2 way = more * dt * Vec2(m.vx, m.vy) + 0.5 * steps * dt * change;
        const double turn = more * dt * m.w;
        m.x += way.x();
        m.y += way.y();
        m.vx += change.x();
        m.vy += change.y();
        turn_by(turn, m);
        ledger.gravity_work += kinetic_energy(model, blocks, b) - before;
        used = std::max(used, (way.norm() + std::abs(turn) * model.radius[b]) / blocks.margin[b]);
    }
    return used;
}
}  // namespace hdem
