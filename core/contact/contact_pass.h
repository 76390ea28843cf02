#pragma once
/// One pass of the laws over contacts, as many at a time as a pack P holds.

#include "core/contact/joint_points.h"
#include "core/contact/pass_rule.h"
#include "core/contact/spring_points.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>

namespace hdem
{
/// Choose the law that the points of a pack obey. Fills the members of `g` that belong to points.
template <ContactLaw law, Joints joints, typename P>
[[gnu::always_inline]] inline MaskOf<P> choose_laws(BasicContactGroup<P>& g, const Model& model, const PassRule<P>& rule,
                                                    const Contacts& contacts, Index i,
                                                    [[maybe_unused]] const BasicRowLanes<P>& rows, P floor, PassSums<P>& sums)
{
    const ContactLanes& l = contacts.lane[i / lanes];
#pragma GCC unroll 2
    for (int k = 0; k < 2; ++k)
    {
        if constexpr (joints != Joints::plain)
            g.preload[k] = load_lane<P>(contacts.preload_lane[i / lanes], contacts.preload_lane[i / lanes].preload[k]);
        P reach = pressed_by<joints>(g, k);
        if constexpr (joints == Joints::laws)
            if (rows.any)
                reach += reach_of(rows, contacts.memory_lane[i / lanes], k) +
                         climb_of<P>(contacts.memory_lane[i / lanes], k, did_slip(&contacts.regime[k][i], MaskOf<P>{}),
                                     g.touch.point[k].v_t * rule.blocks.step.last);
        g.was_impulse[k] = were_impulses(&contacts.regime[k][i], MaskOf<P>{});
        if constexpr (law == ContactLaw::impulses)
            reach += select(g.was_impulse[k], rule.lifted, P(0.0));
        g.closed[k] = is_closed(g.touch.length, reach, floor);
        g.last_normal[k] = load_lane<P>(l, l.normal_force[k]);
        g.last_shear[k] = load_lane<P>(l, l.shear_force[k]);
        sums.closed.add(g.closed[k]);
    }
    P speed = motion_squared(g);
    if constexpr (joints == Joints::laws)
        if (rows.any)  // impulses know neither roughness nor the work of dilation: springs act until the blocks approach fast
            speed = select(rows.is_rough, approach_squared(g), speed);
    MaskOf<P> impulsive = are_impulsive<law>(g, speed, model, rule.blocks, rule.threshold);
    if constexpr (joints == Joints::laws && law == ContactLaw::by_speed)
        if (rows.any && any(impulsive))
            impulsive = impulsive & !(keep_springs(rows, contacts.memory_lane[i / lanes], 0) |
                                      keep_springs(rows, contacts.memory_lane[i / lanes], 1));
    if constexpr (law != ContactLaw::springs)
    {
        sums.impulses.add(g.closed[0] & impulsive);
        sums.impulses.add(g.closed[1] & impulsive);
    }
    return impulsive;
}

template <Joints joints, typename P>
[[nodiscard, gnu::always_inline]] inline ClosingTouch<P> closing_touch(const BasicContactGroup<P>& g)
{
    const BasicTouchPoint<P>&a = g.touch.point[0], &b = g.touch.point[1];
    return {g.touch.ex,     g.touch.ey,         {pressed_by<joints>(g, 0), pressed_by<joints>(g, 1)},
            {a.v_m, b.v_m}, {a.ref_t, b.ref_t}, {a.inc_t, b.inc_t}};
}

/// Forces of the points of a pack.
/// @return  whether they were pressed by springs before and are now, and nothing else: then they have no rest overlap
template <Joints joints, typename P>
[[gnu::always_inline]] inline bool evaluate_points(BasicContactGroup<P>& g, MaskOf<P> touching, MaskOf<P> impulsive,
                                                   const PassRule<P>& rule, Contacts& contacts, Index i,
                                                   [[maybe_unused]] const BasicRowLanes<P>& rows, P floor, BasicSums<P>& sums)
{
    ContactLanes& l = contacts.lane[i / lanes];
    MaskOf<P> act = g.was_impulse[0] | g.was_impulse[1] | impulsive;
    if (rule.needs.rests)
        act = act | (load_lane<P>(l, l.rest_overlap[0]) + load_lane<P>(l, l.rest_overlap[1]) > P(0.0));
    MaskOf<P> shared{};
    if (rule.closing != Closing::whole_cycles)
    {
        shared = rule.closing == Closing::fast_points ? may_close_or_open(closing_touch<joints>(g), rule.ways) : touching;
        if (rule.closing_speed > 0.0)
            shared = shared & are_faster(g.touch, rule.closing_speed);
        act = act | shared;
    }
    const bool remembers = joints == Joints::laws && rows.any;
    if (!any(act) && !remembers)
    {
#pragma GCC unroll 2
        for (int k = 0; k < 2; ++k)
            evaluate_point<Contact4::rests, joints>(g, k, impulsive, P(1.0), rule.dt, l, &contacts.regime[k][i], sums);
        return true;
    }
    g.recovery = rule.recovery * floor;
    std::array<P, 2> share{1.0, 1.0};
    if (rule.closing != Closing::whole_cycles && (!remembers || any(shared)))
        share = closing_shares<P>(rule.blocks, l, g.ref, g.inc, closing_touch<joints>(g), g.joint->law.normal_stiffness * g.length,
                                  g.recovery);
    for (P& s : share)  // a slow contact must not depend on the others in its pack
        s = select(shared, s, 1.0);
    if constexpr (joints == Joints::laws)
        if (remembers)
        {
            const BasicJointPlace<P> place{
                l, contacts.memory_lane[i / lanes], {&contacts.regime[0][i], &contacts.regime[1][i]}, rows};
            evaluate_joint_points(g, impulsive, share, rule.dt, place, sums);
            return false;
        }
#pragma GCC unroll 2
    for (int k = 0; k < 2; ++k)
        evaluate_point<Contact4::any, joints>(g, k, impulsive, share[k], rule.dt, l, &contacts.regime[k][i], sums);
    return false;
}

/// Direction in which the blocks of a contact slide along each other, for damping: along the joint. Where slip opens the joint, the direction is tilted by
/// that opening.
/// Else damping across the joint would brake the opening, and a block above its friction limit would creep: each swing of its normal springs would press
/// the joint more than it relieves it. Contacts that do not slip or do not dilate keep the direction of their edge.
template <typename P>
struct SlideDirection
{
    P x, y;

    SlideDirection(const BasicEdgeTouch<P>& touch, const BasicSums<P>& sums) : x(touch.ex), y(touch.ey)
    {
        const MaskOf<P> dilates = (abs(sums.opened) > P(0.0)) & (abs(sums.opened) < abs(sums.slid));
        if (!any(dilates))
            return;
        // On inc the shear force acts along t, so that inc slides along -t; and it goes along -m as the joint opens.
        const P tilt = select(dilates, sums.opened / select(dilates, sums.slid, 1.0), 0.0);
        const P share = P(1.0) / sqrt(P(1.0) + tilt * tilt);
        x = select(dilates, (touch.ex - touch.ey * tilt) * share, x);
        y = select(dilates, (touch.ey + touch.ex * tilt) * share, y);
    }
};

/// Share of its strength that a joint without shear strength counts as having in use. It slides (sliding_from, core/motion/damping.h), but a sliding joint with
/// friction has precedence: a block in a row is damped along its base, not along its neighbours.
inline constexpr double used_without_strength = 0.995;

/// Store the loads of the contacts of a pack on their blocks, and the use of their joints.
template <Joints joints, typename P>
[[gnu::always_inline]] inline void store_results(const BasicEdgeTouch<P>& touch, const BasicSums<P>& sums, MaskOf<P> touching,
                                                 MaskOf<P> impulsive, const std::uint8_t* swapped, Index i, ContactLoads& loads)
{
    const P x = touch.ex * sums.f_t - touch.ey * sums.f_m;
    const P y = touch.ey * sums.f_t + touch.ex * sums.f_m;
    store_loads(x, y, sums.moment_ref, sums.moment_inc, sums.strength - sums.used, swapped, &loads.load[2 * (i - loads.first)]);
    const MaskOf<P> springs = touching & !impulsive;
    const P mobilised = select(sums.strength > P(0.0), sums.used / sums.strength, P(used_without_strength));
    JointUse* const use = &loads.use[i - loads.first];
    if constexpr (joints == Joints::laws)
    {
        const SlideDirection<P> slide(touch, sums);
        store_use(select(springs, mobilised, -1.0), slide.x, slide.y, touching, springs, use);
    }
    else
        store_use(select(springs, mobilised, -1.0), touch.ex, touch.ey, touching, springs, use);
}

/// A pack of contacts none of which may bear: they put nothing on their blocks, and nothing of their history changes.
template <typename P>
[[gnu::noinline]] void pass_over(const ContactLanes& l, const Blocks& blocks, Index i, bool looks, Contacts& contacts,
                                 ContactLoads& loads, PassSums<P>& pass)
{
    std::fill_n(&loads.load[2 * (i - loads.first)], 2 * P::width, BlockLoad{});
    std::fill_n(&loads.use[i - loads.first], P::width, JointUse{});
    if (!looks)
        return;
    const BasicEdgeView<P> view = view_edges(load_edges<P>(l), load_motions<P>(blocks.motion, &contacts.ref[i]),
                                             load_motions<P>(blocks.motion, &contacts.inc[i]));
    const MaskOf<P> moved = have_moved(l, view, pass.slack);
    store_flags(moved, &contacts.stale[i]);
    pass.stale.add(moved);
}

/// Prefetch the memory of contacts that come later. The processor's own prefetching is too late: without this, a pass over contacts that do not fit
/// a core's caches takes up to twice as long (perf/measured.md).
template <Joints joints, typename P>
[[gnu::always_inline]] inline void fetch_ahead(Contacts& contacts, Index i, const PassNeeds& needs)
{
    constexpr std::size_t always = offsetof(ContactLanes, moved_limit), group = sizeof(ContactLanes);
    // From memory, prefetch into the second cache: only few lines at a time can be on their way to the first one.
    constexpr Index near = 16, far = 32, beyond_caches = 100'000;
    const auto all = static_cast<Index>(contacts.stale.size());
    const bool is_far = all > beyond_caches;
    const Index at = std::max(i, std::min(i + (is_far ? far : near), std::min(all, needs.own_end) - P::width));
    if constexpr (joints == Joints::laws)
    {
        const char* const memory = reinterpret_cast<const char*>(&contacts.memory_lane[at / lanes]);
        for (std::size_t b = 0; b < P::width / lanes * sizeof(MemoryLanes); b += 64)
            __builtin_prefetch(memory + b, 1);
    }
    // (Not by one function for both: g++ drops a function that only fetches.)
    const char* const lane = reinterpret_cast<const char*>(&contacts.lane[at / lanes]);
    for (std::size_t g = 0; g < P::width / lanes * group; g += group)
    {
        if (is_far)
            for (std::size_t b = 0; b < always; b += 64)
                __builtin_prefetch(lane + g + b, 0, 2);
        else
            for (std::size_t b = 0; b < always; b += 64)
                __builtin_prefetch(lane + g + b, 1);
        if (needs.views)
            __builtin_prefetch(lane + g + offsetof(ContactLanes, seen) + 64);
        if (needs.rests)
            __builtin_prefetch(lane + g + offsetof(ContactLanes, rest_overlap), 1);
        if (needs.tilts)
            __builtin_prefetch(lane + g + offsetof(ContactLanes, tilt_force), 1);
    }
}

/// evaluate_contacts for packs of one width, contacts of one kind and one rule. `range` begins and ends at multiples of it, or of `lanes` with the last contact.
template <ContactLaw law, Joints joints, typename P>
[[nodiscard]] ContactTally evaluate_packs(IndexRange range, const Model& model, const RegimeRule& regimes, const Blocks& blocks,
                                          Contacts& contacts, ContactLoads& loads, const ContactTally& before,
                                          const PassNeeds& needs)
{
    const PassRule<P> rule(model, regimes, blocks, needs);
    LawLanes<P> laws(model.joints.laws);
    BasicRowLanes<P> rows(model.joints.rows);
    PassSums<P> pass(before);
    for (Index i = range.begin; i < range.end; i += P::width)
    {
        ContactLanes& l = contacts.lane[i / lanes];
        const Index* const at_ref = &contacts.ref[i];
        const Index* const at_inc = &contacts.inc[i];
        fetch_ahead<joints, P>(contacts, i, needs);
        if (joints != Joints::laws && !any(load_lane<P>(l, l.length) > P(no_length)))
        {
            pass_over(l, blocks, i, needs.views, contacts, loads, pass);
            continue;
        }
        const BasicEdgePair<P> edges = load_edges<P>(l);
        const BasicMotion<P> ref = load_motions<P>(blocks.motion, at_ref);
        const BasicMotion<P> inc = load_motions<P>(blocks.motion, at_inc);
        const BasicEdgeView<P> view = view_edges(edges, ref, inc);
        const BasicEdgeTouch<P> touch = touch_edges(edges, view, ref, inc);
        BasicContactGroup<P> g(touch, ref.w, inc.w);
        g.ref = at_ref;
        g.inc = at_inc;
        g.joint = &laws.load(&contacts.law[i]);
        if constexpr (joints == Joints::laws)
            rows.load(&contacts.law[i]);
        const P floor = load_lane<P>(l, l.length_floor);
        // Nearly all are longer than two floors: there the division is known to give 1 or more.
        g.growth = 1.0;
        g.length = P(0.5) * touch.length;
        if (any(!(P(2.0) * floor <= touch.length)))
        {
            g.growth = length_growth(touch.length, floor);
            g.length = point_length(touch.length, floor);
        }
        if (needs.views)
        {
            const MaskOf<P> moved = have_moved(l, view, pass.slack);
            store_flags(moved, &contacts.stale[i]);
            pass.stale.add(moved);
        }
        const MaskOf<P> impulsive = choose_laws<law, joints>(g, model, rule, contacts, i, rows, floor, pass);
        const MaskOf<P> touching = g.closed[0] | g.closed[1];
        pass.deep.add(touching & (max(touch.point[0].overlap, touch.point[1].overlap) > rule.floors_deep * floor));

        g.last_length = load_lane<P>(l, l.last_length);
        g.length_inverse = P(1.0) / g.length;
        g.shear_share = shear_share(g.length / g.last_length);
        BasicSums<P> sums;
        if (!evaluate_points<joints>(g, touching, impulsive, rule, contacts, i, rows, floor, sums))
            pass.unrested = true;
        add_tilt_forces<joints>(g, rule.dt, needs.tilts, l, sums);
        store_lane(l, l.last_length, g.length);
        add_pack(pass.friction, sums.friction);
        add_pack(pass.changes, sums.changes);
        if constexpr (joints == Joints::laws)
        {
            add_pack(pass.dilation, sums.dilation);
            add_pack(pass.broken, sums.broken);
        }
        store_results<joints>(touch, sums, touching, impulsive, &contacts.swapped[i], i, loads);
    }
    return pass.added_to(before);
}

template <Joints joints, typename P>
[[nodiscard]] ContactTally evaluate_by_law(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                                           Contacts& contacts, ContactLoads& loads, const ContactTally& before,
                                           const PassNeeds& needs)
{
    switch (rule.law)
    {
    case ContactLaw::springs:
        return evaluate_packs<ContactLaw::springs, joints, P>(range, model, rule, blocks, contacts, loads, before, needs);
    case ContactLaw::impulses:
        return evaluate_packs<ContactLaw::impulses, joints, P>(range, model, rule, blocks, contacts, loads, before, needs);
    case ContactLaw::by_speed:
        return evaluate_packs<ContactLaw::by_speed, joints, P>(range, model, rule, blocks, contacts, loads, before, needs);
    }
    return {};
}

/// evaluate_contacts for packs of one width, whatever the contacts carry and obey.
template <typename P>
[[nodiscard]] ContactTally evaluate_by(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                                       Contacts& contacts, ContactLoads& loads, const ContactTally& before, const PassNeeds& needs)
{
    const auto evaluate_all = contacts.has_memory    ? evaluate_by_law<Joints::laws, P>
                              : contacts.has_preload ? evaluate_by_law<Joints::preloaded, P>
                                                     : evaluate_by_law<Joints::plain, P>;
    return evaluate_all(range, model, rule, blocks, contacts, loads, before, needs);
}
}  // namespace hdem
