#pragma once
/// Points of plain joints: linear springs and Coulomb slip, four contacts at a time; and what all points of a contact give together.

#include "core/contact/contact_group.h"
#include "core/contact/force_law.h"
#include "core/energy_ledger.h"

namespace hdem
{
/// Sums of what the points of a contact give, and of their energies.
template <typename P>
struct BasicSums
{
    P f_t = 0.0, f_m = 0.0, moment_ref = 0.0,
      moment_inc = 0.0;            ///< on inc, along and across the edge; moments about the centroids
    P used = 0.0, strength = 0.0;  ///< shear force and shear strength of force points
    P friction = 0.0, changes = 0.0, dilation = 0.0, broken = 0.0;
    P slid = 0.0, opened = 0.0;  ///< plastic slip and dilation of this cycle, of laws with a memory only
    P normal[2], work = 0.0;     ///< normal forces, and the sum of normal force times stretch

    void take(MaskOf<P> lanes_of, const BasicSums& from)
    {
        for (P BasicSums::*const sum :
             {&BasicSums::f_t, &BasicSums::f_m, &BasicSums::moment_ref, &BasicSums::moment_inc, &BasicSums::used,
              &BasicSums::strength, &BasicSums::friction, &BasicSums::changes, &BasicSums::work})
            this->*sum = select(lanes_of, from.*sum, this->*sum);
#pragma GCC unroll 2
        for (int k = 0; k < 2; ++k)
            normal[k] = select(lanes_of, from.normal[k], normal[k]);
    }
};
using Sums = BasicSums<Pack>;

/// What the contacts of a pack need of the laws.
enum class Contact4
{
    rests,  ///< springs only, none with a rest overlap, none that closes or opens. Most rock is so: then the hybrid method costs no more than the force method
    any
};

/// What the contacts of a model carry besides springs and Coulomb slip. Each kind has its own loop, so that none pays for the others.
enum class Joints
{
    plain,
    preloaded,  ///< by in-situ stress
    laws        ///< some with a memory; all may be preloaded
};

/// Share of the last impulse's force that its spring begins with, from the stretch it was left with.
template <typename P>
inline P kept_share(const BasicContactGroup<P>& g, int k, P stretch)
{
    const P zero = 0.0;
    const P kept = max(stretch, zero) * g.joint->law.normal_stiffness * g.last_length;
    return select(g.last_normal[k] > zero, min(kept / g.last_normal[k], P(1.0)), zero);
}

/// Overlap of a point, with its preload: that at which the blocks are pressed as drawn [m].
template <Joints joints, typename P>
[[gnu::always_inline]] inline P pressed_by(const BasicContactGroup<P>& g, int k)
{
    if constexpr (joints != Joints::plain)
        return g.touch.point[k].overlap + g.preload[k];
    else
        return g.touch.point[k].overlap;
}

template <Contact4 contact, Joints joints, typename P>
[[gnu::always_inline]] inline void evaluate_point(const BasicContactGroup<P>& g, int k, MaskOf<P> impulsive, P share, P dt,
                                                  ContactLanes& l, std::uint8_t* regime, BasicSums<P>& sums)
{
    constexpr bool rests = contact == Contact4::rests;
    const P zero = 0.0;
    const BasicTouchPoint<P>& p = g.touch.point[k];
    const P spring_normal = rests ? g.last_normal[k] : select(g.was_impulse[k], zero, g.last_normal[k]);
    const P spring_shear = rests ? g.last_shear[k] : select(g.was_impulse[k], zero, g.last_shear[k]);
    const P last_rest = rests ? zero : load_lane<P>(l, l.rest_overlap[k]);
    const P overlap = pressed_by<joints>(g, k);
    const P rest = rests ? zero : rest_overlap(overlap, last_rest, g.recovery);
    // A spring handed over from impulses begins with the same share of their shear force as of their normal force.
    const P start = spring_shear * g.shear_share;
    const P handed = rests ? start
                           : select(g.was_impulse[k], g.last_shear[k] * kept_share(g, k, load_lane<P>(l, l.overlap[k]) - last_rest),
                                    start);
    const P curved = P(0.5) * dt * g.turning[k].t;
    const P v_t = p.v_t - curved;  // amid the last step, where the shear displacement is of second order
    const BasicPointForce<P> f = spring_force(g.joint->law, g.length, rests ? overlap : share * (overlap - rest), v_t, dt, handed);
    const MaskOf<P> spring = rests ? g.closed[k] : g.closed[k] & !impulsive;
    const P normal = select(spring, f.normal, zero);
    const P shear = select(spring, f.shear, zero);
    const MaskOf<P> slips = spring & !(f.excess == zero);
    // The history of an impulse point stays until its impulses of this cycle are known.
    const MaskOf<P> held = rests ? MaskOf<P>{} : g.closed[k] & impulsive;
    store_regimes(spring, slips, held, regime);

    // Energies of this step; u is the stretch of the normal spring.
    const P u = rests ? overlap : overlap - select(g.was_impulse[k], rest, last_rest);
    const P last_u = rests ? load_lane<P>(l, l.overlap[k]) : load_lane<P>(l, l.overlap[k]) - last_rest;
    const P plastic = -v_t * dt - (shear - start) * (g.joint->shear_compliance * g.length_inverse);
    const P slipped = P(0.5) * (start + shear) * plastic;
    const MaskOf<P> stays = spring & (spring_normal + abs(spring_shear) > zero);
    sums.friction += select(stays, slipped, zero);
    sums.changes += select(stays, zero, slipped) + change_energy(spring_normal, last_u, normal, u - p.v_m * dt) +
                    P(0.5) * dt * (start * v_t - shear * curved);
    if constexpr (!rests)
    {
        // The rest overlap has become shorter under the force of now.
        sums.changes -= P(0.5) * normal * select(g.was_impulse[k], zero, last_rest - rest);
        // An impulse point keeps its stretch until its impulses are known: where they would leave its spring empty.
        const P last_stretch = select(g.last_normal[k] > zero, max(load_lane<P>(l, l.overlap[k]) - last_rest, zero), zero);
        store_lane(l, l.rest_overlap[k], select(spring, rest, select(held, overlap - last_stretch, zero)));
    }
    store_lane(l, l.overlap[k], overlap);
    store_lane(l, l.normal_force[k], rests ? normal : select(held, g.last_normal[k], normal));
    store_lane(l, l.shear_force[k], rests ? shear : select(held, g.last_shear[k], shear));

    sums.normal[k] = normal;
    // A preload is no stretch that a change of the contact length could give back: blocks as drawn must not begin to move.
    sums.work += normal * (rests ? p.overlap : p.overlap - rest);
    sums.used += abs(shear);
    sums.strength += select(spring, f.strength, zero);
    sums.f_t += shear;
    sums.f_m -= normal;
    sums.moment_inc -= p.inc_t * normal + p.inc_m * shear;
    sums.moment_ref += p.ref_t * normal + p.ref_m * shear;
}

/// Tilt forces of both points, and their work in the half step before them.
template <Joints joints, typename P>
[[gnu::always_inline]] inline void add_tilt_forces(const BasicContactGroup<P>& g, P dt, bool stores, ContactLanes& l,
                                                   BasicSums<P>& sums)
{
    P work = 0.0;
    const P pull = length_pull(sums.work, g.length_inverse) * g.growth;
#pragma GCC unroll 2
    for (int k = 0; k < 2; ++k)
    {
        const BasicTouchPoint<P>& p = g.touch.point[k];
        const P inwards = k == 0 ? pull : -pull;
        const P tilt = joints == Joints::plain ? tilt_force(sums.normal[k], g.touch.slope, inwards, p.inside, p.overlap)
                                               : preloaded_tilt_force(sums.normal[k], g.touch.slope, inwards, p.inside, p.overlap,
                                                                      max(g.preload[k], P(0.0)));
        // The tilt force acts on the surface of inc, half of the overlap beyond the point.
        const P beyond = P(0.5) * p.overlap;
        const P v_t = p.v_t - g.w * beyond;
        work += tilt * v_t;
        if (stores)
            store_lane(l, l.tilt_force[k], tilt);
        sums.f_t += tilt;
        sums.moment_inc -= (p.inc_m + beyond) * tilt;
        sums.moment_ref += (p.ref_m + beyond) * tilt;
    }
    sums.changes -= P(0.5) * dt * work;
}
}  // namespace hdem
