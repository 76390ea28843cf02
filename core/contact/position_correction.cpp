#include "core/contact/position_correction.h"

#include "core/contact/impulse_kick.h"
#include "core/contact/spring_power.h"

#include <algorithm>

namespace hdem
{
void sweep_correction(const Model& model, const Blocks& blocks, std::vector<ImpulsePoint>& points, std::vector<Triple>& pseudo)
{
    for (ImpulsePoint& p : points)
    {
        Triple& ref = pseudo[p.ref];
        Triple& inc = pseudo[p.inc];
        const double v_m = relative_velocity(p, inc.x - ref.x, inc.y - ref.y, ref, inc).m;
        const double last = p.correction;
        p.correction = std::max(0.0, last + p.mass_normal * (v_m + correction_velocity(model, blocks.step, p)));
        if (p.correction == last)
            continue;
        const Kick kick(p, 0.0, -(p.correction - last));
        change_velocity(blocks.inertia[p.ref], -kick.x, -kick.y, -kick.w_ref, ref.x, ref.y, ref.w);
        change_velocity(blocks.inertia[p.inc], kick.x, kick.y, kick.w_inc, inc.x, inc.y, inc.w);
    }
}

void add_correction_gravity(IndexRange range, const Model& model, const Blocks& blocks, const std::vector<Triple>& pseudo,
                            EnergyLedger& ledger)
{
    double gravity = 0.0;
    for (Index i = range.begin; i < range.end; ++i)
        if (is_moved(pseudo[i]) && blocks.present[i] != 0)
            gravity += model.mass[i] * (model.gravity.x() * pseudo[i].x + model.gravity.y() * pseudo[i].y) * blocks.step.next;
    ledger.gravity_work += gravity;
    ledger.position_correction -= gravity;
}

void add_correction_springs(IndexRange range, const Blocks& blocks, const Contacts& contacts, const std::vector<Triple>& pseudo,
                            EnergyLedger& ledger)
{
    // The contacts will find overlaps that no velocity explains, and book their work as if it had come from nowhere.
    const double work = -normal_power(range, contacts, blocks, pseudo) * blocks.step.next;
    ledger.position_correction += work;
    ledger.contact_changes += work;
}
}  // namespace hdem
