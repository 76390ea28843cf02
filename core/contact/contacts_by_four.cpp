// Compiled for several kinds of processors: core/kernels.h.
#include "core/contact/contact_pass.h"
#include "core/kernels_here.h"

namespace hdem
{
inline namespace HDEM_LANES
{
ContactTally evaluate_by_four(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                              Contacts& contacts, ContactLoads& loads, const ContactTally& sums, const PassNeeds& needs)
{
    return evaluate_by<Pack>(range, model, rule, blocks, contacts, loads, sums, needs);
}
}  // namespace HDEM_LANES
}  // namespace hdem
