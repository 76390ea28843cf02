// Compiled for several kinds of processors: core/kernels.h.
#include "core/kernels_here.h"
#include "core/motion/integrator_pass.h"

namespace hdem
{
inline namespace HDEM_LANES
{
void advance_velocities(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& works)
{
    change_velocities<Pack>(range, model, rule, blocks, works);
}

Travel advance_positions(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo)
{
    return change_positions<Pack>(range, model, blocks, pseudo);
}
}  // namespace HDEM_LANES
}  // namespace hdem
