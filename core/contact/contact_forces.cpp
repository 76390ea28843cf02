#include "core/contact/contact_forces.h"

#include "core/contact/contact_lanes.h"
#include "core/contact/force_law.h"
#include "core/contact/regime.h"
#include "core/energy_ledger.h"

namespace hdem
{
namespace
{
/// What the threshold velocity needs of a cycle.
struct Threshold
{
    double scale;
    double gravity_velocity;  ///< dt |g| [m/s]
    double fixed;             ///< given velocity, or negative [m/s]
    bool rock_keeps_springs;  ///< RegimeRule
    [[nodiscard]] double least() const { return fixed >= 0.0 ? fixed : scale * gravity_velocity; }
};

/// Four contacts and what is known of them in this cycle.
struct Group
{
    Group(const BasicEdgeTouch<Pack>& edge_touch, Pack w_ref, Pack w_inc)
        : touch(edge_touch),
          turning{{edge_touch.point[0], edge_touch.slope, w_ref, w_inc}, {edge_touch.point[1], edge_touch.slope, w_ref, w_inc}},
          w(w_inc - w_ref)
    {
    }

    const BasicEdgeTouch<Pack>& touch;
    TurningRate<Pack> turning[2];
    Pack w;  ///< of inc relative to ref
    // Set later: to fill them with zeros here, or to copy the touch, cost a tenth of the law's time.
    const Index* ref;
    const Index* inc;
    const JointLanes* joint;
    Pack length;  ///< each point's share of the contact length
    Pack last_length, length_inverse;
    Pack shear_share;  ///< of the shear forces that stays as the contact length changes (force_law.h)
    Mask closed[2];
    Mask was_impulse[2];
    Pack last_normal[2], last_shear[2];
};

/// Masses of blocks in the threshold velocity. A fixed block may keep its mass, but never turns: where the paper's ground counts,
/// m_c = m/2 without levers.
BasicInertia<Pack> threshold_inertias(const Model& model, const Blocks& blocks, const Index* at)
{
    BasicInertia<Pack> inertia = load_inertias(blocks.inertia, at);
    if (model.contact.fixed_mass_counts)
    {
        const BasicInertia<Pack> full = load_inertias(model.full_inertia, at);
        inertia.inverse_mass_x = full.inverse_mass_x;
        inertia.inverse_mass_y = full.inverse_mass_y;
    }
    return inertia;
}

/// Regime under the hybrid method, Eq. (24): impulse as soon as one of a contact's closed points is faster than the threshold.
Mask are_fast(const Group& g, Pack speed_squared, const Model& model, const Blocks& blocks, const Threshold& threshold)
{
    // A block that gravity has pulled for one cycle has just dt |g|: rounding must not decide that tie.
    const Pack margin = 1.0 + 1e-9;
    if (threshold.fixed >= 0.0)
        return speed_squared > Pack(threshold.fixed * threshold.fixed) * margin;
    const BasicInertia<Pack> ref = threshold_inertias(model, blocks, g.ref);
    const BasicInertia<Pack> inc = threshold_inertias(model, blocks, g.inc);
    Pack elastic = 0.0;
    for (int k = 0; k < 2; ++k)
    {
        const BasicTouchPoint<Pack>& p = g.touch.point[k];
        const Pack mass_n = inverse_collision_mass(ref, p.ref_t, inc, p.inc_t, -g.touch.ey, g.touch.ex);
        const Pack mass_s = inverse_collision_mass(ref, p.ref_m, inc, p.inc_m, g.touch.ex, g.touch.ey);
        // Springs that an impulse has emptied have stored nothing.
        const Pack normal = select(g.was_impulse[k], 0.0, g.last_normal[k]);
        const Pack shear = select(g.was_impulse[k], 0.0, g.last_shear[k]);
        elastic += elastic_velocity_squared(normal, g.joint->law.normal_stiffness * g.length, mass_n, shear,
                                            g.joint->law.shear_stiffness * g.length, mass_s);
    }
    const Pack u_th = threshold_velocity(Pack(threshold.scale), Pack(threshold.gravity_velocity), elastic);
    return speed_squared > u_th * u_th * margin;
}

/// Standing rock keeps its springs, see RegimeRule.
Mask leave_to_springs(Mask fast, const Group& g, Pack speed_squared, const Model& model, const Blocks& blocks)
{
    const double distance = model.convergence.loose_distance;
    const auto keeps = [&](Index a, Index b, double squared)
    {
        const bool loose_a = blocks.is_loose(a, distance), loose_b = blocks.is_loose(b, distance);
        const bool standing = (blocks.is_free(a) && !loose_a) || (blocks.is_free(b) && !loose_b);
        const double size = loose_a ? model.size(a) : loose_b ? model.size(b) : 0.0;
        return standing && squared > gentle_impact * gentle_impact * model.gravity.norm() * size;
    };
    for (int j = 0; j < lanes; ++j)
        if (fast.v[j] != 0 && keeps(g.ref[j], g.inc[j], speed_squared.v[j]))
            fast.v[j] = 0;
    return fast;
}

template <Method method>
Mask are_impulsive(const Group& g, const Model& model, const Blocks& blocks, const Threshold& threshold)
{
    const Mask none{};
    if constexpr (method != Method::hybrid)
        return method == Method::impulse ? !none : none;
    Pack speed = 0.0;
    for (int k = 0; k < 2; ++k)
    {
        const BasicTouchPoint<Pack>& p = g.touch.point[k];
        speed = max(speed, select(g.closed[k], p.v_t * p.v_t + p.v_m * p.v_m, 0.0));
    }
    // The elastic part only adds: at rest nothing more needs to be known.
    const double least = threshold.least();
    if (!any(speed > Pack(least * least)))
        return none;
    const Mask fast = are_fast(g, speed, model, blocks, threshold);
    return threshold.rock_keeps_springs && any(fast) ? leave_to_springs(fast, g, speed, model, blocks) : fast;
}

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
};

/// Do impulses play a part at four contacts, in this cycle or the last?
enum class Impulses
{
    none,  ///< springs only, none with a rest overlap: so rests most rock under the hybrid method, at the price of the force method
    maybe
};

/// Share of the last impulse's force that its spring begins with, from the stretch it was left with.
inline Pack kept_share(const Group& g, int k, Pack stretch)
{
    const Pack zero = 0.0;
    const Pack kept = max(stretch, zero) * g.joint->law.normal_stiffness * g.last_length;
    return select(g.last_normal[k] > zero, min(kept / g.last_normal[k], Pack(1.0)), zero);
}

template <Impulses impulses>
[[gnu::always_inline]] inline void evaluate_point(const Group& g, int k, Mask impulsive, Pack dt, ContactLanes& l,
                                                  std::uint8_t* regime, Sums& sums)
{
    constexpr bool none = impulses == Impulses::none;
    const Pack zero = 0.0;
    const BasicTouchPoint<Pack>& p = g.touch.point[k];
    const Pack spring_normal = none ? g.last_normal[k] : select(g.was_impulse[k], zero, g.last_normal[k]);
    const Pack spring_shear = none ? g.last_shear[k] : select(g.was_impulse[k], zero, g.last_shear[k]);
    const Pack last_rest = none ? zero : load_lane(l.rest_overlap[k]);
    const Pack rest = none ? zero : rest_overlap(p.overlap, last_rest);
    // A spring handed over from impulses begins with the same share of their shear force as of their normal force.
    const Pack start = spring_shear * g.shear_share;
    const Pack handed = none ? start
                             : select(g.was_impulse[k], g.last_shear[k] * kept_share(g, k, load_lane(l.overlap[k]) - last_rest),
                                      start);
    const Pack curved = Pack(0.5) * dt * g.turning[k].t;
    const Pack v_t = p.v_t - curved;  // amid the last step, where the shear displacement is of second order
    const BasicPointForce<Pack> f = spring_force(g.joint->law, g.length, none ? p.overlap : p.overlap - rest, v_t, dt, handed);
    const Mask spring = none ? g.closed[k] : g.closed[k] & !impulsive;
    const Pack normal = select(spring, f.normal, zero);
    const Pack shear = select(spring, f.shear, zero);
    const Mask slips = spring & !(f.excess == zero);
    // The history of an impulse point stays until its impulses of this cycle are known.
    const Mask held = g.closed[k] & impulsive;
    store_bytes((spring.v & 1) + (slips.v & 1) + (none ? Mask::V{} : held.v & 3), regime);

    // Energies of this step; u is the stretch of the normal spring.
    const Pack u = none ? p.overlap : p.overlap - select(g.was_impulse[k], rest, last_rest);
    // Way of the point after the last force, along the reference edge's normal of then, beyond what the overlap gained.
    const Pack strayed = (p.v_m - g.turning[k].m * dt) * dt - (p.overlap - load_lane(l.overlap[k]));
    const Pack plastic = -v_t * dt - (shear - start) * (g.joint->shear_compliance * g.length_inverse);
    const Pack slipped = Pack(0.5) * (start + shear) * plastic;
    const Mask stays = spring & (spring_normal + abs(spring_shear) > zero);
    sums.friction += select(stays, slipped, zero);
    sums.changes += select(stays, zero, slipped) + change_energy(spring_normal, u, normal, u - p.v_m * dt) +
                    Pack(0.5) * (spring_normal * strayed + dt * ((spring_shear - shear) * curved + (start - spring_shear) * v_t));
    store_lane(l.overlap[k], p.overlap);
    if constexpr (!none)
        if (!none)
            store_lane(l.rest_overlap[k], select(spring, rest, zero));
    store_lane(l.normal_force[k], none ? normal : select(held, g.last_normal[k], normal));
    store_lane(l.shear_force[k], none ? shear : select(held, g.last_shear[k], shear));

    sums.normal[k] = normal;
    sums.work += normal * (none ? p.overlap : p.overlap - rest);
    sums.used += abs(shear);
    sums.strength += select(spring, f.strength, zero);
    sums.f_t += shear;
    sums.f_m -= normal;
    sums.moment_inc -= p.inc_t * normal + p.inc_m * shear;
    sums.moment_ref += p.ref_t * normal + p.ref_m * shear;
}

/// Tilt forces of both points, and their work: half a step under those of the last cycle, half under those of now.
inline void add_tilt_forces(const Group& g, Pack floor, Pack dt, ContactLanes& l, Sums& sums)
{
    Pack work = 0.0;
    const Pack pull = select(g.touch.length > floor, length_pull(sums.work, g.length_inverse), Pack(0.0));
    for (int k = 0; k < 2; ++k)
    {
        const BasicTouchPoint<Pack>& p = g.touch.point[k];
        const Pack tilt = tilt_force(sums.normal[k], g.touch.slope, k == 0 ? pull : -pull, p.inside, p.overlap);
        // It acts on the surface of inc, half of the overlap beyond the point.
        const Pack beyond = Pack(0.5) * p.overlap;
        const Pack v_t = p.v_t - g.w * beyond;
        const Pack last = load_lane(l.tilt_force[k]);
        work += (tilt + last) * v_t - last * g.turning[k].surface * dt;
        store_lane(l.tilt_force[k], tilt);
        sums.f_t += tilt;
        sums.moment_inc -= (p.inc_m + beyond) * tilt;
        sums.moment_ref += (p.ref_m + beyond) * tilt;
    }
    sums.changes -= Pack(0.5) * dt * work;
}

template <Method method>
ContactTally evaluate(IndexRange range, const Model& model, bool rock_keeps_springs, const Blocks& blocks, Contacts& contacts,
                      ContactLoads& loads)
{
    const double dt = model.time_step;
    const Threshold threshold{model.threshold_scale, dt * model.gravity.norm(), model.contact.threshold_velocity.value_or(-1.0),
                              rock_keeps_springs};
    LawLanes laws(model.joints.laws);
    Pack friction = 0.0, changes = 0.0;
    Mask::V closed{}, impulses{}, stale{};
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
        Group g(touch, ref.w, inc.w);
        g.ref = at_ref;
        g.inc = at_inc;
        g.joint = &laws.load(&contacts.law[i]);
        const Pack floor = load_lane(l.length_floor);
        g.length = point_length(g.touch.length, floor);
        const Mask::V moved = have_moved(l, view);
        store_bytes(moved & 1, &contacts.stale[i]);
        stale -= moved;
        for (int k = 0; k < 2; ++k)
        {
            g.closed[k] = is_closed(g.touch.length, g.touch.point[k].overlap, floor);
            g.was_impulse[k] = {load_regimes(&contacts.regime[k][i]) == static_cast<std::int64_t>(Regime::impulse)};
            g.last_normal[k] = load_lane(l.normal_force[k]);
            g.last_shear[k] = load_lane(l.shear_force[k]);
            closed -= g.closed[k].v;
        }
        const Mask impulsive = are_impulsive<method>(g, model, blocks, threshold);
        impulses -= (g.closed[0].v & impulsive.v) + (g.closed[1].v & impulsive.v);

        const Pack last_length = load_lane(l.last_length);
        g.last_length = last_length;
        g.length_inverse = Pack(1.0) / g.length;
        g.shear_share = shear_share(g.length / last_length);
        Sums sums;
        const Mask past = g.was_impulse[0] | g.was_impulse[1] |
                          load_lane(l.rest_overlap[0]) + load_lane(l.rest_overlap[1]) > Pack(0.0);
        if (!any(past | impulsive))
            for (int k = 0; k < 2; ++k)
                evaluate_point<Impulses::none>(g, k, impulsive, dt, l, &contacts.regime[k][i], sums);
        else
            for (int k = 0; k < 2; ++k)
                evaluate_point<Impulses::maybe>(g, k, impulsive, dt, l, &contacts.regime[k][i], sums);
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
        const Mask springs = (g.closed[0] | g.closed[1]) & !impulsive;
        const Pack mobilised = select(sums.strength > Pack(0.0), sums.used / sums.strength, 1.0);
        const Mask::V bits = (springs.v & std::int64_t{contact_force}) +
                             ((g.closed[0].v | g.closed[1].v) & impulsive.v & std::int64_t{contact_impulse});
        store_use(select(springs, mobilised, -1.0), g.touch.ex, g.touch.ey, bits, &loads.use[i]);
    }
    const auto count = [](Mask::V v) { return static_cast<Index>(v[0] + v[1] + v[2] + v[3]); };
    return {sum(friction), sum(changes), count(closed), count(impulses), count(stale)};
}
}  // namespace

ContactTally evaluate_contacts(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                               Contacts& contacts, ContactLoads& loads)
{
    switch (rule.method)
    {
    case Method::force:
        return evaluate<Method::force>(range, model, rule.rock_keeps_springs, blocks, contacts, loads);
    case Method::impulse:
        return evaluate<Method::impulse>(range, model, rule.rock_keeps_springs, blocks, contacts, loads);
    case Method::hybrid:
        return evaluate<Method::hybrid>(range, model, rule.rock_keeps_springs, blocks, contacts, loads);
    }
    return {};
}

void list_block_contacts(const Contacts& contacts, Index blocks, BlockContacts& list)
{
    list.begin.assign(static_cast<std::size_t>(blocks) + 1, 0);
    list.entry.resize(2 * static_cast<std::size_t>(contacts.size()));
    for (Index i = 0; i < contacts.size(); ++i)
    {
        ++list.begin[contacts.ref[i] + 1];
        ++list.begin[contacts.inc[i] + 1];
    }
    for (Index b = 0; b < blocks; ++b)
        list.begin[b + 1] += list.begin[b];
    std::vector<Index> at(list.begin.begin(), list.begin.end() - 1);
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const Index swapped = contacts.swapped[i];
        list.entry[at[contacts.ref[i]]++] = 2 * i + swapped;
        list.entry[at[contacts.inc[i]]++] = 2 * i + 1 - swapped;
    }
}

template <bool find_joint>
void sum_forces(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                const std::vector<Triple>& external, Blocks& blocks)
{
    const Vec2 g = model.gravity;
    for (Index b = range.begin; b < range.end; ++b)
    {
        const double mass = blocks.present[b] != 0 ? model.mass[b] : 0.0;
        Pack sum(Pack::V{mass * g.x(), mass * g.y(), 0.0, 0.0});
        if (!external.empty())
            sum += Pack(Pack::V{external[b].x, external[b].y, external[b].w, 0.0});
        BlockForce force;
        Index most = no_index;
        for (Index e = list.begin[b]; e < list.begin[b + 1]; ++e)
        {
            const Index entry = list.entry[e];
            sum += Pack::load(&loads.load[entry].x);
            const JointUse& use = loads.use[entry / 2];
            force.contacts |= use.contacts;
            if constexpr (find_joint)
            {
                most = use.mobilised > force.mobilised ? entry / 2 : most;
                force.mobilised = std::max(force.mobilised, use.mobilised);
            }
        }
        sum.store(&force.x);
        if (most != no_index)
        {
            force.t_x = loads.use[most].t_x;
            force.t_y = loads.use[most].t_y;
        }
        blocks.force[b] = force;
    }
}

void sum_forces(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                const std::vector<Triple>& external, bool find_joint, Blocks& blocks)
{
    if (find_joint)
        sum_forces<true>(range, model, list, loads, external, blocks);
    else
        sum_forces<false>(range, model, list, loads, external, blocks);
}
}  // namespace hdem
