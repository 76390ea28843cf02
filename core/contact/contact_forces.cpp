#include "core/contact/contact_forces.h"

#include "core/contact/contact_forces_wide.h"
#include "core/contact/spring_points.h"
#include "core/kernels.h"

namespace hdem
{
ContactTally evaluate_contacts(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                               Contacts& contacts, ContactLoads& loads, const ContactTally& sums, const PassNeeds& needs)
{
    const auto by_four = kernels().evaluate_contacts;
    static const bool wide = has_wide_packs();
    if (!wide || contacts.has_memory)
        return by_four(range, model, rule, blocks, contacts, loads, sums, needs);
    const Index eights = (range.end - range.begin + lanes - 1) / (2 * lanes);
    const Index middle = range.begin + 2 * lanes * eights;
    const ContactTally most = evaluate_by_eight({range.begin, middle}, model, rule, blocks, contacts, loads, sums, needs);
    return middle < range.end ? by_four({middle, range.end}, model, rule, blocks, contacts, loads, most, needs) : most;
}

void store_tilt_forces(IndexRange range, const Blocks& blocks, Contacts& contacts)
{
    for (Index i = range.begin; i < range.end; ++i)
    {
        ContactLanes& l = contacts.lane[i / lanes];
        const Index at = i % lanes;
        const EdgeTouch touch = touch_edges(contacts.edges(i), blocks.motion[contacts.ref[i]], blocks.motion[contacts.inc[i]]);
        double normal[2], work = 0.0;
        for (int k = 0; k < 2; ++k)
        {
            normal[k] = is_spring(contacts.regime[k][i]) ? l.normal_force[k][at] : 0.0;
            work += normal[k] * (touch.point[k].overlap + contacts.opening(k, i) - l.rest_overlap[k][at]);
        }
        const double pull = length_pull(work, 1.0 / l.last_length[at]) * length_growth(touch.length, l.length_floor[at]);
        for (int k = 0; k < 2; ++k)
        {
            const TouchPoint& p = touch.point[k];
            const double inwards = k == 0 ? pull : -pull;
            l.tilt_force[k][at] = contacts.has_preload || contacts.has_memory
                                      ? preloaded_tilt_force(normal[k], touch.slope, inwards, p.inside, p.overlap,
                                                             max(contacts.preload(k, i), 0.0))
                                      : tilt_force(normal[k], touch.slope, inwards, p.inside, p.overlap);
        }
    }
}
}  // namespace hdem
