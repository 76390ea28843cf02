#include "core/motion/integrator.h"

#include "core/contact/contact_forces_wide.h"
#include "core/kernels.h"
#include "core/motion/integrator_wide.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// Blocks of `range` that are taken eight at a time end here.
Index end_of_eights(IndexRange range)
{
    static const bool has_wide = has_wide_packs();
    constexpr Index wide = 2 * lanes;
    return has_wide ? range.end - range.size() % wide : range.begin;
}
}  // namespace

void VelocityWorks::add_to(EnergyLedger& ledger) const
{
    ledger.gravity_work += sum(gravity);
    ledger.load_work -= sum(holding);
    ledger.local_damping += sum(local);
    ledger.global_damping += sum(global);
    ledger.contact_changes += sum(changes);
    ledger.coasting += sum(coasting);
}

void Travel::take(const Travel& other)
{
    speed_share = std::max(speed_share, other.speed_share);
    rim_share = std::max(rim_share, other.rim_share);
    speed_squared = std::max(speed_squared, other.speed_squared);
}

double Travel::way(double dt) const
{
    return (std::sqrt(speed_share) + rim_share) * dt;
}

void update_velocities(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& works)
{
    const Index end = end_of_eights(range);
    if (range.begin < end)
        update_velocities_by_eight({range.begin, end}, model, rule, blocks, works);
    if (end < range.end)
        kernels().advance_velocities({end, range.end}, model, rule, blocks, works);
}

Travel update_positions(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo)
{
    const Index end = end_of_eights(range);
    Travel travel;
    if (range.begin < end)
        travel = update_positions_by_eight({range.begin, end}, model, blocks, pseudo);
    if (end < range.end)
        travel.take(kernels().advance_positions({end, range.end}, model, blocks, pseudo));
    return travel;
}
}  // namespace hdem
