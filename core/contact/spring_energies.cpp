// Compiled for several kinds of processors: core/kernels.h.
#include "core/contact/spring_energies.h"

#include "core/kernels_here.h"

namespace hdem
{
inline namespace HDEM_LANES
{
void add_spring_energies(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts, SpringEnergies& sums)
{
    add_energies<Pack>(range, model, blocks, contacts, sums);
}
}  // namespace HDEM_LANES
}  // namespace hdem
