#include "core/contact/contact_forces.h"

#include "core/contact/closing.h"
#include "core/contact/contact_group.h"
#include "core/contact/force_law.h"
#include "core/contact/joint_forces.h"
#include "core/energy_ledger.h"

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

/// Sums of what the points of a contact give, and of their energies.
struct Sums
{
    Pack f_t = 0.0, f_m = 0.0, moment_ref = 0.0,
         moment_inc = 0.0;            ///< on inc, along and across the edge; moments about the centroids
    Pack used = 0.0, strength = 0.0;  ///< shear force and shear strength of force points
    Pack friction = 0.0, changes = 0.0;
    Pack normal[2], work = 0.0;  ///< normal forces, and the sum of normal force times stretch

    void take(Mask lanes_of, const Sums& from)
    {
        for (Pack Sums::*const sum : {&Sums::f_t, &Sums::f_m, &Sums::moment_ref, &Sums::moment_inc, &Sums::used, &Sums::strength,
                                      &Sums::friction, &Sums::changes, &Sums::work})
            this->*sum = select(lanes_of, from.*sum, this->*sum);
        for (int k = 0; k < 2; ++k)
            normal[k] = select(lanes_of, from.normal[k], normal[k]);
    }
};

/// What four contacts need of the laws.
enum class Contact4
{
    rests,  ///< springs only, none with a rest overlap, none that closes or opens: so is most rock, at the price of the force method under the hybrid one too
    any
};

/// What the contacts of a model carry besides springs and Coulomb slip: a loop of its own for each, so that none pays for the others.
enum class Joints
{
    plain,
    preloaded,  ///< by in-situ stress
    laws        ///< some with a memory; all may be preloaded
};

/// Share of the last impulse's force that its spring begins with, from the stretch it was left with.
inline Pack kept_share(const ContactGroup& g, int k, Pack stretch)
{
    const Pack zero = 0.0;
    const Pack kept = max(stretch, zero) * g.joint->law.normal_stiffness * g.last_length;
    return select(g.last_normal[k] > zero, min(kept / g.last_normal[k], Pack(1.0)), zero);
}

/// Overlap of a point, and what it is pressed by where the blocks are drawn [m].
template <Joints joints>
[[gnu::always_inline]] inline Pack pressed_by(const ContactGroup& g, int k)
{
    if constexpr (joints != Joints::plain)
        return g.touch.point[k].overlap + g.preload[k];
    else
        return g.touch.point[k].overlap;
}

/// The touch with overlaps as pressed_by has them.
template <Joints joints>
[[gnu::always_inline]] inline decltype(auto) pressed_touch(const ContactGroup& g)
{
    if constexpr (joints != Joints::plain)
    {
        BasicEdgeTouch<Pack> touch = g.touch;
        for (int k = 0; k < 2; ++k)
            touch.point[k].overlap += g.preload[k];
        return touch;
    }
    else
        return (g.touch);
}

/// Laws with a memory at one point of four contacts; plain lanes are left as they are. `last`: the contacts after the last cycle.
[[gnu::noinline]] void evaluate_joints(const ContactGroup& g, int k, Mask impulsive, Pack share, Pack dt, const RowLanes& rows,
                                       const ContactLanes& last, MemoryLanes::Point& memory, ContactLanes& l, std::uint8_t* regime,
                                       Sums& sums)
{
    const Pack zero = 0.0, half = 0.5;
    const Mask own = rows.has_memory;
    const BasicTouchPoint<Pack>& p = g.touch.point[k];
    const Pack last_rest = load_lane(last.rest_overlap[k]), last_opening = load_lane(memory.opening);
    const Pack overlap = pressed_by<Joints::laws>(g, k);
    const Pack rest = rest_overlap(overlap + last_opening, last_rest, g.recovery);
    const Pack start = select(g.was_impulse[k], zero, g.last_shear[k]) * g.shear_share;
    const Pack last_stretch = load_lane(last.overlap[k]) + last_opening - last_rest;
    const Pack handed = select(g.was_impulse[k], g.last_shear[k] * kept_share(g, k, last_stretch), start);
    const Pack last_normal = select(g.was_impulse[k], zero, g.last_normal[k]);
    // A spring that closes or opens in this cycle gives a share of its force; one that pulls or dilates gives all.
    const Mask shares = rows.is_linear & (last_opening == zero) & (overlap - rest > zero);
    const Mask closed = g.closed[k] & own;
    JointPoint point;
    point.length = g.length;
    point.closure = select(shares, share, 1.0) * (overlap - rest);
    point.slide = (p.v_t - half * dt * g.turning[k].t) * dt;
    point.start = handed;
    point.last_normal = last_normal;
    point.spring = closed & !impulsive;
    point.held = closed & impulsive;
    point.stays = point.spring & (abs(last_normal) + abs(start) > zero);
    const JointForces f = react_joints(rows, point, memory);
    const Mask bears = point.spring & (f.bears | (overlap + f.opening - rest > Pack(-closed_gap) * load_lane(l.length_floor)));
    store_bytes((own.v & ((bears.v & 1) + ((bears & f.slips).v & 1) + (point.held.v & 3))) + (~own.v & load_regimes(regime)),
                regime);
    sums.friction += select(own, f.friction, zero);
    sums.changes += select(own, half * dt * (f.normal * p.v_m - f.shear * p.v_t) + f.lost - f.friction, zero);
    const Pack held_rest = overlap + f.opening - select(g.last_normal[k] > zero, max(last_stretch, zero), zero);
    const auto put = [&](ContactLanes::Lane& lane, Pack value) { store_lane(lane, select(own, value, load_lane(lane))); };
    put(l.rest_overlap[k], select(bears, rest, select(point.held, max(held_rest, zero), zero)));
    put(l.overlap[k], overlap);
    put(l.normal_force[k], select(point.held, g.last_normal[k], f.normal));
    put(l.shear_force[k], select(point.held, g.last_shear[k], f.shear));
    sums.normal[k] = select(own, f.normal, sums.normal[k]);
    sums.work += select(own, f.normal * (p.overlap + f.opening - rest), zero);
    sums.used += select(own, abs(f.shear), zero);
    sums.strength += select(own, f.strength, zero);
    sums.f_t += select(own, f.shear, zero);
    sums.f_m -= select(own, f.normal, zero);
    sums.moment_inc -= select(own, p.inc_t * f.normal + p.inc_m * f.shear, zero);
    sums.moment_ref += select(own, p.ref_t * f.normal + p.ref_m * f.shear, zero);
}

template <Contact4 contact, Joints joints>
[[gnu::always_inline]] inline void evaluate_point(const ContactGroup& g, int k, Mask impulsive, Pack share, Pack dt,
                                                  ContactLanes& l, std::uint8_t* regime, Sums& sums)
{
    constexpr bool rests = contact == Contact4::rests;
    const Pack zero = 0.0;
    const BasicTouchPoint<Pack>& p = g.touch.point[k];
    const Pack spring_normal = rests ? g.last_normal[k] : select(g.was_impulse[k], zero, g.last_normal[k]);
    const Pack spring_shear = rests ? g.last_shear[k] : select(g.was_impulse[k], zero, g.last_shear[k]);
    const Pack last_rest = rests ? zero : load_lane(l.rest_overlap[k]);
    const Pack overlap = pressed_by<joints>(g, k);
    const Pack rest = rests ? zero : rest_overlap(overlap, last_rest, g.recovery);
    // A spring handed over from impulses begins with the same share of their shear force as of their normal force.
    const Pack start = spring_shear * g.shear_share;
    const Pack handed = rests ? start
                              : select(g.was_impulse[k], g.last_shear[k] * kept_share(g, k, load_lane(l.overlap[k]) - last_rest),
                                       start);
    const Pack curved = Pack(0.5) * dt * g.turning[k].t;
    const Pack v_t = p.v_t - curved;  // amid the last step, where the shear displacement is of second order
    const BasicPointForce<Pack> f = spring_force(g.joint->law, g.length, rests ? overlap : share * (overlap - rest), v_t, dt,
                                                 handed);
    const Mask spring = rests ? g.closed[k] : g.closed[k] & !impulsive;
    const Pack normal = select(spring, f.normal, zero);
    const Pack shear = select(spring, f.shear, zero);
    const Mask slips = spring & !(f.excess == zero);
    // The history of an impulse point stays until its impulses of this cycle are known.
    const Mask held = g.closed[k] & impulsive;
    store_bytes((spring.v & 1) + (slips.v & 1) + (rests ? Mask::V{} : held.v & 3), regime);

    // Energies of this step; u is the stretch of the normal spring.
    const Pack u = rests ? overlap : overlap - select(g.was_impulse[k], rest, last_rest);
    const Pack last_u = rests ? load_lane(l.overlap[k]) : load_lane(l.overlap[k]) - last_rest;
    const Pack plastic = -v_t * dt - (shear - start) * (g.joint->shear_compliance * g.length_inverse);
    const Pack slipped = Pack(0.5) * (start + shear) * plastic;
    const Mask stays = spring & (spring_normal + abs(spring_shear) > zero);
    sums.friction += select(stays, slipped, zero);
    sums.changes += select(stays, zero, slipped) + change_energy(spring_normal, last_u, normal, u - p.v_m * dt) +
                    Pack(0.5) * dt * (start * v_t - shear * curved);
    if constexpr (!rests)
    {
        // The rest overlap has become shorter under the force of now.
        sums.changes -= Pack(0.5) * normal * select(g.was_impulse[k], zero, last_rest - rest);
        // An impulse point keeps its stretch until its impulses are known: where they would leave its spring empty.
        const Pack last_stretch = select(g.last_normal[k] > zero, max(load_lane(l.overlap[k]) - last_rest, zero), zero);
        store_lane(l.rest_overlap[k], select(spring, rest, select(held, overlap - last_stretch, zero)));
    }
    store_lane(l.overlap[k], overlap);
    store_lane(l.normal_force[k], rests ? normal : select(held, g.last_normal[k], normal));
    store_lane(l.shear_force[k], rests ? shear : select(held, g.last_shear[k], shear));

    sums.normal[k] = normal;
    // A preload is no stretch that a change of the contact length could give back: nothing may move where the blocks are drawn.
    sums.work += normal * (rests ? p.overlap : p.overlap - rest);
    sums.used += abs(shear);
    sums.strength += select(spring, f.strength, zero);
    sums.f_t += shear;
    sums.f_m -= normal;
    sums.moment_inc -= p.inc_t * normal + p.inc_m * shear;
    sums.moment_ref += p.ref_t * normal + p.ref_m * shear;
}

/// Tilt forces of both points, and their work in the half step before them.
inline void add_tilt_forces(const ContactGroup& g, Pack floor, Pack dt, ContactLanes& l, Sums& sums)
{
    Pack work = 0.0;
    const Pack pull = length_pull(sums.work, g.length_inverse) * length_growth(g.touch.length, floor);
    for (int k = 0; k < 2; ++k)
    {
        const BasicTouchPoint<Pack>& p = g.touch.point[k];
        const Pack tilt = tilt_force(sums.normal[k], g.touch.slope, k == 0 ? pull : -pull, p.inside, p.overlap);
        // It acts on the surface of inc, half of the overlap beyond the point.
        const Pack beyond = Pack(0.5) * p.overlap;
        const Pack v_t = p.v_t - g.w * beyond;
        work += tilt * v_t;
        store_lane(l.tilt_force[k], tilt);
        sums.f_t += tilt;
        sums.moment_inc -= (p.inc_m + beyond) * tilt;
        sums.moment_ref += (p.ref_m + beyond) * tilt;
    }
    sums.changes -= Pack(0.5) * dt * work;
}

/// Both points of four contacts of which one has a law with a memory.
void evaluate_with_memory(const ContactGroup& g, Mask impulsive, const std::array<Pack, 2>& share, Pack dt, const RowLanes& rows,
                          MemoryLanes& memory, ContactLanes& l, std::array<std::uint8_t*, 2> regime, Sums& sums)
{
    if (!any(!rows.has_memory))
    {
        for (int k = 0; k < 2; ++k)
            evaluate_joints(g, k, impulsive, share[k], dt, rows, l, memory.point[k], l, regime[k], sums);
        return;
    }
    const ContactLanes last = l;
    {
        Sums plain;
        for (int k = 0; k < 2; ++k)
            evaluate_point<Contact4::any, Joints::laws>(g, k, impulsive, share[k], dt, l, regime[k], plain);
        sums.take(!rows.has_memory, plain);
    }
    for (int k = 0; k < 2; ++k)
        evaluate_joints(g, k, impulsive, share[k], dt, rows, last, memory.point[k], l, regime[k], sums);
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
            g.closed[k] = is_closed(g.touch.length, pressed_by<joints>(g, k), floor);
            if constexpr (joints == Joints::laws)
                if (rows.any)
                    g.closed[k] = is_closed(
                        g.touch.length, pressed_by<joints>(g, k) + reach_of(rows, contacts.memory_lane[i / lanes].point[k]), floor);
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
                evaluate_with_memory(g, impulsive, share, dt, rows, contacts.memory_lane[i / lanes], l,
                                     {&contacts.regime[0][i], &contacts.regime[1][i]}, sums);
            else
                for (int k = 0; k < 2; ++k)
                    evaluate_point<Contact4::any, joints>(g, k, impulsive, share[k], dt, l, &contacts.regime[k][i], sums);
        }
        add_tilt_forces(g, floor, dt, l, sums);
        store_lane(l.last_length, g.length);
        friction += sums.friction;
        changes += sums.changes;
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
            before.deep + count(deep)};
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
