#pragma once
/// What a pass over contacts takes from its cycle, and the sums that it forms.

#include "core/contact/closing.h"
#include "core/contact/contact_forces.h"
#include "core/contact/contact_group.h"

namespace hdem
{
/// What is the same for all contacts of a cycle.
template <typename P>
struct PassRule
{
    PassRule(const Model& model, const RegimeRule& rule, const Blocks& of, const PassNeeds& needed)
        : blocks(of),
          needs(needed),
          threshold{model.threshold_scale,
                    of.step.kick() * model.gravity.norm(),
                    model.gravity.isZero(0.0) ? of.step.kick() : 0.0,
                    model.contact.threshold_velocity.value_or(-1.0),
                    rule.rock_keeps_springs,
                    rule.corners_keep_springs},
          closing(rule.closing),
          closing_speed(rule.closing_speed),
          dt(of.step.last),
          ways(closing_ways(of.step)),
          lifted(rule.lifted_stay_closed ? model.gravity.norm() * of.step.kick() * of.step.kick() : 0.0),
          floors_deep(model.contact.overlap_limit / model.contact.length_floor),
          recovery(model.contact.correction_rate * dt / model.contact.length_floor)
    {
    }

    const Blocks& blocks;
    PassNeeds needs;
    Threshold threshold;
    Closing closing;
    double closing_speed;
    P dt, ways;
    P lifted;       ///< opening at which a point that has borne an impulse is still closed [m]
    P floors_deep;  ///< contact.overlap_limit; it and the length floor are shares of the smaller block's size
    P recovery;     ///< of a rest overlap in a cycle, in length floors
};

/// ContactTally while it is formed.
template <typename P>
struct PassSums
{
    using Count = decltype(count_of(MaskOf<P>{}));
    Pack friction, changes, dilation, broken;
    Count closed{}, impulses{}, stale{}, deep{};
    bool unrested = false;
    FloatsOf<P> slack;

    explicit PassSums(const ContactTally& before)
        : friction(before.friction),
          changes(before.changes),
          dilation(before.dilation),
          broken(before.broken),
          unrested(before.unrested),
          slack(all_floats<P>(before.slack))
    {
    }
    [[nodiscard]] ContactTally added_to(const ContactTally& before) const
    {
        return {friction.lane_sums(),
                changes.lane_sums(),
                before.closed + static_cast<Index>(closed.total()),
                before.impulses + static_cast<Index>(impulses.total()),
                before.stale + static_cast<Index>(stale.total()),
                before.deep + static_cast<Index>(deep.total()),
                dilation.lane_sums(),
                broken.lane_sums(),
                unrested,
                least(slack)};
    }
};
}  // namespace hdem
