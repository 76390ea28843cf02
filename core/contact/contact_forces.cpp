#include "core/contact/contact_forces.h"

#include "core/contact/closing.h"
#include "core/contact/joint_points.h"
#include "core/contact/spring_points.h"

namespace hdem
{
namespace
{
/// Incident vertices that have left the place at which the features were found.
Mask::V have_moved(const ContactLanes& l, const BasicEdgeView<Pack>& v)
{
    const auto off = [](Pack now, const std::array<float, lanes>& seen)
    {
        FloatLanes then;
        std::memcpy(&then, seen.data(), sizeof then);
        const FloatLanes d = to_float(now) - then;
        return d > -d ? d : -d;
    };
    const FloatLanes o0 = off(v.t0, l.seen[0]), o1 = off(v.m0, l.seen[1]), o2 = off(v.t1, l.seen[2]), o3 = off(v.m1, l.seen[3]);
    const FloatLanes a = o0 > o1 ? o0 : o1, b = o2 > o3 ? o2 : o3;
    FloatLanes limit;
    std::memcpy(&limit, l.moved_limit.data(), sizeof limit);
    return __builtin_convertvector(!((a <= limit) & (b <= limit)), Mask::V);
}

template <ContactLaw law, Joints joints>
ContactTally evaluate(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks, Contacts& contacts,
                      ContactLoads& loads, const ContactTally& before)
{
    const Steps& step = blocks.step;
    const Pack dt = step.last;
    const Threshold threshold{model.threshold_scale, step.kick() * model.gravity.norm(),
                              model.contact.threshold_velocity.value_or(-1.0), rule.rock_keeps_springs};
    const Closing closing = rule.closing;
    const double closing_speed = rule.closing_speed;
    const Pack ways = closing_ways(step);
    LawLanes laws(model.joints.laws);
    RowLanes rows(model.joints.rows);
    Pack friction = before.friction, changes = before.changes;
    [[maybe_unused]] Pack dilation = before.dilation, broken = before.broken;
    Mask::V closed{}, impulses{}, stale{}, deep{};
    const Pack floors_deep = model.contact.overlap_limit /
                             model.contact.length_floor;  // both are shares of the smaller block's size
    // Of the smaller block's size, of which the floor is a share (detection/manifold).
    const Pack recovery = model.contact.correction_rate * dt / model.contact.length_floor;
    for (Index i = range.begin; i < range.end; i += lanes)
    {
        ContactLanes& l = contacts.lane[i / lanes];
        const Index* const at_ref = &contacts.ref[i];
        const Index* const at_inc = &contacts.inc[i];
        const BasicEdgePair<Pack> edges = load_edges(l);
        const BasicMotion<Pack> ref = load_motions(blocks.motion, at_ref);
        const BasicMotion<Pack> inc = load_motions(blocks.motion, at_inc);
        const BasicEdgeView<Pack> view = view_edges(edges, ref, inc);
        const BasicEdgeTouch<Pack> touch = touch_edges(edges, view, ref, inc);
        ContactGroup g(touch, ref.w, inc.w);
        g.ref = at_ref;
        g.inc = at_inc;
        g.joint = &laws.load(&contacts.law[i]);
        if constexpr (joints == Joints::laws)
            rows.load(&contacts.law[i]);
        const Pack floor = load_lane(l.length_floor);
        g.length = point_length(g.touch.length, floor);
        const Mask::V moved = have_moved(l, view);
        store_bytes(moved & 1, &contacts.stale[i]);
        stale -= moved;
        for (int k = 0; k < 2; ++k)
        {
            if constexpr (joints != Joints::plain)
                g.preload[k] = load_lane(contacts.preload_lane[i / lanes].preload[k]);
            Pack reach = pressed_by<joints>(g, k);
            if constexpr (joints == Joints::laws)
                if (rows.any)
                    reach += reach_of(rows, contacts.memory_lane[i / lanes].point[k]);
            g.closed[k] = is_closed(g.touch.length, reach, floor);
            g.was_impulse[k] = {load_regimes(&contacts.regime[k][i]) == static_cast<std::int64_t>(Regime::impulse)};
            g.last_normal[k] = load_lane(l.normal_force[k]);
            g.last_shear[k] = load_lane(l.shear_force[k]);
            closed -= g.closed[k].v;
        }
        const Mask touching = g.closed[0] | g.closed[1];
        const Mask is_deep = touching & (max(touch.point[0].overlap, touch.point[1].overlap) > floors_deep * floor);
        deep -= is_deep.v;
        Mask impulsive = are_impulsive<law>(g, model, blocks, threshold);
        if constexpr (joints == Joints::laws && law == ContactLaw::by_speed)
            if (rows.any && any(impulsive))
                impulsive = impulsive & !(keep_springs(rows, contacts.memory_lane[i / lanes].point[0]) |
                                          keep_springs(rows, contacts.memory_lane[i / lanes].point[1]));
        impulses -= (g.closed[0].v & impulsive.v) + (g.closed[1].v & impulsive.v);

        const Pack last_length = load_lane(l.last_length);
        g.last_length = last_length;
        g.length_inverse = Pack(1.0) / g.length;
        g.shear_share = shear_share(g.length / last_length);
        Sums sums;
        const Mask past = g.was_impulse[0] | g.was_impulse[1] |
                          load_lane(l.rest_overlap[0]) + load_lane(l.rest_overlap[1]) > Pack(0.0);
        Mask act = past | impulsive;
        Mask shared{};
        if (closing != Closing::whole_cycles)
        {
            shared = closing == Closing::fast_points ? may_close_or_open(pressed_touch<joints>(g).point, ways) : touching;
            if (closing_speed > 0.0)
                shared = shared & are_faster(touch.point, closing_speed);
            act = act | shared;
        }
        const bool remembers = joints == Joints::laws && rows.any;
        if (!any(act) && !remembers)
            for (int k = 0; k < 2; ++k)
                evaluate_point<Contact4::rests, joints>(g, k, impulsive, 1.0, dt, l, &contacts.regime[k][i], sums);
        else
        {
            g.recovery = recovery * floor;
            std::array<Pack, 2> share{1.0, 1.0};
            if (closing != Closing::whole_cycles && (!remembers || any(shared)))
                share = closing_shares(blocks, l, at_ref, at_inc, pressed_touch<joints>(g),
                                       g.joint->law.normal_stiffness * g.length, g.recovery);
            for (Pack& s : share)  // what is slow must not depend on which contacts it is handled with
                s = select(shared, s, 1.0);
            if (remembers)
                evaluate_joint_points(g, impulsive, share, dt,
                                      {l, contacts.memory_lane[i / lanes], {&contacts.regime[0][i], &contacts.regime[1][i]}, rows},
                                      sums);
            else
                for (int k = 0; k < 2; ++k)
                    evaluate_point<Contact4::any, joints>(g, k, impulsive, share[k], dt, l, &contacts.regime[k][i], sums);
        }
        add_tilt_forces<joints>(g, floor, dt, l, sums);
        store_lane(l.last_length, g.length);
        friction += sums.friction;
        changes += sums.changes;
        if constexpr (joints == Joints::laws)
        {
            dilation += sums.dilation;
            broken += sums.broken;
        }
        const Pack x = g.touch.ex * sums.f_t - g.touch.ey * sums.f_m;
        const Pack y = g.touch.ey * sums.f_t + g.touch.ex * sums.f_m;
        const Pack reserve = sums.strength - sums.used;
        std::array<Index, lanes> side_ref, side_inc;
        for (int j = 0; j < lanes; ++j)
        {
            side_ref[j] = contacts.swapped[i + j];
            side_inc[j] = 1 - side_ref[j];
        }
        store_loads(-x, -y, sums.moment_ref, reserve, side_ref, &loads.load[2 * i]);
        store_loads(x, y, sums.moment_inc, reserve, side_inc, &loads.load[2 * i]);
        const Mask springs = touching & !impulsive;
        const Pack mobilised = select(sums.strength > Pack(0.0), sums.used / sums.strength, 1.0);
        const Mask::V bits = (springs.v & std::int64_t{contact_force}) + (touching.v & impulsive.v & std::int64_t{contact_impulse});
        store_use(select(springs, mobilised, -1.0), g.touch.ex, g.touch.ey, bits, &loads.use[i]);
    }
    const auto count = [](Mask::V v) { return static_cast<Index>(v[0] + v[1] + v[2] + v[3]); };
    return {friction,
            changes,
            before.closed + count(closed),
            before.impulses + count(impulses),
            before.stale + count(stale),
            before.deep + count(deep),
            dilation,
            broken};
}
template <Joints joints>
ContactTally evaluate_by_law(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks, Contacts& contacts,
                             ContactLoads& loads, const ContactTally& sums)
{
    switch (rule.law)
    {
    case ContactLaw::springs:
        return evaluate<ContactLaw::springs, joints>(range, model, rule, blocks, contacts, loads, sums);
    case ContactLaw::impulses:
        return evaluate<ContactLaw::impulses, joints>(range, model, rule, blocks, contacts, loads, sums);
    case ContactLaw::by_speed:
        return evaluate<ContactLaw::by_speed, joints>(range, model, rule, blocks, contacts, loads, sums);
    }
    return {};
}
}  // namespace

ContactTally evaluate_contacts(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                               Contacts& contacts, ContactLoads& loads, const ContactTally& sums)
{
    const auto evaluate_all = contacts.has_memory    ? evaluate_by_law<Joints::laws>
                              : contacts.has_preload ? evaluate_by_law<Joints::preloaded>
                                                     : evaluate_by_law<Joints::plain>;
    return evaluate_all(range, model, rule, blocks, contacts, loads, sums);
}
}  // namespace hdem
