#include "core/contact/contact_forces.h"

#include "core/contact/contact_forces_wide.h"
#include "core/contact/spring_points.h"
#include "core/joint/all_laws.h"
#include "core/kernels.h"

#include <algorithm>

namespace hdem
{
namespace
{
constexpr Index wide = 2 * lanes;

/// Are the eight contacts from `i` on all plain, or all of one law and curve?
bool suit_wide_packs(const std::vector<JointRow>& rows, const Index* law)
{
    const JointRow& first = rows[law[0]];
    if (first.kind == kind_of<UserLaw>())
        return false;
    for (Index j = 1; j < wide; ++j)
        if (law[j] != law[0] && (rows[law[j]].kind != first.kind || rows[law[j]].curve != first.curve))
            return false;
    return true;
}
}  // namespace

ContactTally evaluate_contacts(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                               Contacts& contacts, ContactLoads& loads, const ContactTally& sums, const PassNeeds& needs)
{
    const auto by_four = kernels().evaluate_contacts;
    static const bool has_wide = has_wide_packs();
    if (!has_wide)
        return by_four(range, model, rule, blocks, contacts, loads, sums, needs);
    const Index eights = (range.end - range.begin + lanes - 1) / wide;
    const Index last = range.begin + wide * eights;
    ContactTally tally = sums;
    // As many as can be handled alike, one stretch after another.
    for (Index begin = range.begin, end = begin; begin < range.end; begin = end)
    {
        const auto suits = [&](Index i)
        { return i < last && (!contacts.has_memory || suit_wide_packs(model.joints.rows, &contacts.law[i])); };
        const bool is_wide = suits(begin);
        if (!contacts.has_memory)
            end = is_wide ? last : range.end;
        else
            do
                end += wide;
            while (end < range.end && suits(end) == is_wide);
        if (!is_wide)
            end = std::min(end, range.end);
        tally = (is_wide ? evaluate_by_eight : by_four)({begin, end}, model, rule, blocks, contacts, loads, tally, needs);
    }
    return tally;
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
