// Compiled for several kinds of processors: core/kernels.h.
#include "core/contact/contact_pass.h"
#include "core/kernels_here.h"

namespace hdem
{
inline namespace HDEM_LANES
{
namespace
{
template <Joints joints>
ContactTally evaluate_by_law(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks, Contacts& contacts,
                             ContactLoads& loads, const ContactTally& sums, const PassNeeds& needs)
{
    switch (rule.law)
    {
    case ContactLaw::springs:
        return evaluate_packs<ContactLaw::springs, joints, Pack>(range, model, rule, blocks, contacts, loads, sums, needs);
    case ContactLaw::impulses:
        return evaluate_packs<ContactLaw::impulses, joints, Pack>(range, model, rule, blocks, contacts, loads, sums, needs);
    case ContactLaw::by_speed:
        return evaluate_packs<ContactLaw::by_speed, joints, Pack>(range, model, rule, blocks, contacts, loads, sums, needs);
    }
    return {};
}
}  // namespace

ContactTally evaluate_by_four(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                              Contacts& contacts, ContactLoads& loads, const ContactTally& sums, const PassNeeds& needs)
{
    const auto evaluate_all = contacts.has_memory    ? evaluate_by_law<Joints::laws>
                              : contacts.has_preload ? evaluate_by_law<Joints::preloaded>
                                                     : evaluate_by_law<Joints::plain>;
    return evaluate_all(range, model, rule, blocks, contacts, loads, sums, needs);
}
}  // namespace HDEM_LANES
}  // namespace hdem
