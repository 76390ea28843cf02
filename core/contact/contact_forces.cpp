#include "core/contact/contact_forces.h"

#include "core/contact/contact_forces_wide.h"
#include "core/contact/contact_pass.h"

namespace hdem
{
namespace
{
template <Joints joints>
ContactTally evaluate_by_law(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks, Contacts& contacts,
                             ContactLoads& loads, const ContactTally& sums)
{
    switch (rule.law)
    {
    case ContactLaw::springs:
        return evaluate_packs<ContactLaw::springs, joints, Pack>(range, model, rule, blocks, contacts, loads, sums);
    case ContactLaw::impulses:
        return evaluate_packs<ContactLaw::impulses, joints, Pack>(range, model, rule, blocks, contacts, loads, sums);
    case ContactLaw::by_speed:
        return evaluate_packs<ContactLaw::by_speed, joints, Pack>(range, model, rule, blocks, contacts, loads, sums);
    }
    return {};
}
}  // namespace

ContactTally evaluate_by_four(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                              Contacts& contacts, ContactLoads& loads, const ContactTally& sums)
{
    const auto evaluate_all = contacts.has_memory    ? evaluate_by_law<Joints::laws>
                              : contacts.has_preload ? evaluate_by_law<Joints::preloaded>
                                                     : evaluate_by_law<Joints::plain>;
    return evaluate_all(range, model, rule, blocks, contacts, loads, sums);
}

ContactTally evaluate_contacts(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                               Contacts& contacts, ContactLoads& loads, const ContactTally& sums)
{
    static const bool wide = has_wide_packs();
    if (!wide || contacts.has_memory)
        return evaluate_by_four(range, model, rule, blocks, contacts, loads, sums);
    const Index eights = (range.end - range.begin + lanes - 1) / (2 * lanes);
    const Index middle = range.begin + 2 * lanes * eights;
    const ContactTally most = evaluate_by_eight({range.begin, middle}, model, rule, blocks, contacts, loads, sums);
    return middle < range.end ? evaluate_by_four({middle, range.end}, model, rule, blocks, contacts, loads, most) : most;
}
}  // namespace hdem
