#pragma once
/// Points of plain joints: linear springs and Coulomb slip, four contacts at a time; and what all points of a contact give together.

#include "core/contact/contact_group.h"
#include "core/contact/force_law.h"
#include "core/energy_ledger.h"

namespace hdem
{
/// Sums of what the points of a contact give, and of their energies.
struct Sums
{
    Pack f_t = 0.0, f_m = 0.0, moment_ref = 0.0,
         moment_inc = 0.0;            ///< on inc, along and across the edge; moments about the centroids
    Pack used = 0.0, strength = 0.0;  ///< shear force and shear strength of force points
    Pack friction = 0.0, changes = 0.0, dilation = 0.0, broken = 0.0;
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
template <Joints joints>
[[gnu::always_inline]] inline void add_tilt_forces(const ContactGroup& g, Pack floor, Pack dt, ContactLanes& l, Sums& sums)
{
    Pack work = 0.0;
    const Pack pull = length_pull(sums.work, g.length_inverse) * length_growth(g.touch.length, floor);
    for (int k = 0; k < 2; ++k)
    {
        const BasicTouchPoint<Pack>& p = g.touch.point[k];
        const Pack inwards = k == 0 ? pull : -pull;
        const Pack tilt = joints == Joints::plain ? tilt_force(sums.normal[k], g.touch.slope, inwards, p.inside, p.overlap)
                                                  : preloaded_tilt_force(sums.normal[k], g.touch.slope, inwards, p.inside,
                                                                         p.overlap, max(g.preload[k], Pack(0.0)));
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
}  // namespace hdem
