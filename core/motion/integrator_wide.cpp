#include "core/motion/integrator_wide.h"

#ifdef __AVX512F__
#include "core/motion/wide_blocks.h"
//
#include "core/motion/integrator_pass.h"

namespace hdem
{
void update_velocities_by_eight(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& works)
{
    change_velocities<WidePack>(range, model, rule, blocks, works);
}

Travel update_positions_by_eight(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo)
{
    return change_positions<WidePack>(range, model, blocks, pseudo);
}
}  // namespace hdem

#else
#include "core/kernels.h"

namespace hdem
{
void update_velocities_by_eight(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& works)
{
    kernels().advance_velocities(range, model, rule, blocks, works);
}

Travel update_positions_by_eight(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo)
{
    return kernels().advance_positions(range, model, blocks, pseudo);
}
}  // namespace hdem
#endif
