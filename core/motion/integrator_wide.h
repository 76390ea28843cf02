#pragma once
/// Velocities and poses on processors with AVX-512, eight blocks at a time.

#include "core/motion/integrator.h"

namespace hdem
{
/// update_velocities. The bits of four blocks at a time.
/// @pre  has_wide_packs() (contact/contact_forces_wide.h), `range` has a multiple of eight blocks
void update_velocities_by_eight(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks,
                                VelocityWorks& works);

/// update_positions.
/// @pre  as above
Travel update_positions_by_eight(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo);
}  // namespace hdem
