#include "core/motion/integrator.h"

#include "core/kernels.h"

namespace hdem
{
void VelocityWorks::add_to(EnergyLedger& ledger) const
{
    ledger.gravity_work += sum(gravity);
    ledger.load_work -= sum(holding);
    ledger.local_damping += sum(local);
    ledger.global_damping += sum(global);
    ledger.contact_changes += sum(changes);
    ledger.coasting += sum(coasting);
}

void update_velocities(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& works)
{
    kernels().advance_velocities(range, model, rule, blocks, works);
}

Travel update_positions(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo)
{
    return kernels().advance_positions(range, model, blocks, pseudo);
}
}  // namespace hdem
