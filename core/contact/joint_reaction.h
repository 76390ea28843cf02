#pragma once
/// A point of joints with a memory, a pack of contacts at a time: evaluates the law and updates the memory.

#include "core/contact/joint_points.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem
{
/// All lanes of one law.
template <typename Law, typename Curve>
struct OneLaw
{
    static constexpr bool has_all_lanes = true;

    template <typename P>
    [[gnu::always_inline]] static BasicJointStress<P> react(const BasicRowLanes<P>& rows, const BasicJointStep<P>& step,
                                                            BasicJointMemory<P>& memory)
    {
        const BasicJointStress<P> stress = Law::template react<Curve>(rows.numbers, step, memory);
        memory.opening = stress.opening;
        return stress;
    }
    /// Lanes that dilate under impulses. The stress normal to the joint is not known then: only dilation that follows from slip alone can be given.
    template <typename P>
    [[nodiscard]] static MaskOf<P> dilate_by_slip(const BasicRowLanes<P>&, MaskOf<P> held)
    {
        return std::is_same_v<Law, CoulombResidual> ? held : MaskOf<P>{};
    }
};

template <typename P>
void take(MaskOf<P> lanes_of, const BasicJointMemory<P>& from, BasicJointMemory<P>& to)
{
    using Memory = BasicJointMemory<P>;
    for (P Memory::*const field : {&Memory::slip, &Memory::state, &Memory::turn, &Memory::opening, &Memory::broken})
        to.*field = select(lanes_of, from.*field, to.*field);
}

template <typename P>
void take(MaskOf<P> lanes_of, const BasicJointStress<P>& from, BasicJointStress<P>& to)
{
    using Stress = BasicJointStress<P>;
    for (P Stress::*const field :
         {&Stress::normal, &Stress::shear, &Stress::strength, &Stress::slid, &Stress::opening, &Stress::energy, &Stress::heat,
          &Stress::freed, &Stress::normal_stiffness, &Stress::shear_compliance})
        to.*field = select(lanes_of, from.*field, to.*field);
}

/// Relative difference by which forces of a point that nothing moves may differ: round-off [-].
inline constexpr double memory_round_off = 1e-13;

/// Number of substeps in which a law is evaluated. Blocks that slide on a dilatant joint part by as much as slip opens it. In one step, the law would see
/// all of that gap before slip fills it. The joint would then lose contact above the speed at which it opens by its closure in a cycle: 0.1 m/s where 4 MN/m2
/// give a closure of 2e-6 m.
/// @param gaps     by which the faces part in this cycle [m]
/// @param stretch  closure before it [m]
template <typename P>
[[nodiscard]] P pieces_of(MaskOf<P> climbs, P gaps, P stretch)
{
    constexpr double most = 1024.0, largest = 0.5;  // of the closure
    P pieces = 1.0;
    for (int i = 0; i < P::width; ++i)
        if (climbs.has(i))
            pieces.v[i] = std::min(std::ceil(gaps.v[i] / (largest * stretch.v[i])), most);
    return pieces;
}

/// React::react in so many substeps, in equal parts of the way from the closure `from` to that of `step`.
template <typename React, typename P>
[[gnu::noinline]] BasicJointStress<P> react_in_pieces(const BasicRowLanes<P>& rows, const BasicJointStep<P>& step, P from, P pieces,
                                                      BasicJointMemory<P>& memory)
{
    const P share = P(1.0) / pieces, way = (step.closure - from) * share;
    BasicJointStress<P> sum{};
    for (P at = 1.0; any(at <= pieces); at += P(1.0))
    {
        const MaskOf<P> asked = at <= pieces;
        BasicJointMemory<P> next = memory;
        const BasicJointStress<P> now = React::template react<P>(
            rows,
            {select(at < pieces, from + at * way, step.closure), step.slide * share,
             select(at > P(1.0), sum.shear, step.last_shear), select(at > P(1.0), sum.normal, step.last_normal)},
            next);
        const P slid = sum.slid, heat = sum.heat, freed = sum.freed;
        take<P>(asked, next, memory);
        take<P>(asked, now, sum);
        sum.slid = select(asked, slid + now.slid, slid);
        sum.heat = select(asked, heat + now.heat, heat);
        sum.freed = select(asked, freed + now.freed, freed);
    }
    return sum;
}

/// Store the lanes that this cycle changes; the others keep their values.
template <bool has_all_lanes, typename Owner, typename P>
[[gnu::always_inline]] inline void put(MaskOf<P> changed, Owner& owner, ContactLanes::Lane& lane, P value)
{
    if constexpr (has_all_lanes)
        store_lane(owner, lane, value);
    else
        store_lane(owner, lane, select(changed, value, load_lane<P>(owner, lane)));
}

/// A point of each contact of a pack. `last`: their lanes after the last cycle.
template <typename React, typename P>
[[gnu::always_inline]] inline void evaluate_one_point(const BasicContactGroup<P>& g, int k, MaskOf<P> impulsive, P share, P dt,
                                                      const BasicJointPlace<P>& place, const ContactLanes& last, BasicSums<P>& sums)
{
    using M = MaskOf<P>;
    constexpr bool all = React::has_all_lanes;
    const P zero = 0.0, half = 0.5;
    const BasicRowLanes<P>& rows = place.rows;
    const M own = all ? !M{} : rows.has_memory;
    MemoryLanes& memory = place.memory;
    MemoryLanes::Point& m = memory.point[k];
    ContactLanes& l = place.lanes;
    const BasicTouchPoint<P>& p = g.touch.point[k];
    const auto remembered = [&memory](const ContactLanes::Lane& lane) { return load_lane<P>(memory, lane); };
    const auto seen = [&last](const ContactLanes::Lane& lane) { return load_lane<P>(last, lane); };
    const BasicJointMemory<P> before{remembered(m.slip), remembered(m.state), remembered(m.turn), remembered(m.opening),
                                     remembered(m.broken)};
    const P last_rest = seen(last.rest_overlap[k]);
    const P overlap = pressed_by<Joints::laws>(g, k);
    const P rest = rest_overlap(overlap + before.opening, last_rest, g.recovery);
    const P start = select(g.was_impulse[k], zero, g.last_shear[k]) * g.shear_share;
    const P last_stretch = seen(last.overlap[k]) + before.opening - last_rest;
    const P handed = any(g.was_impulse[k]) ? select(g.was_impulse[k], g.last_shear[k] * kept_share(g, k, last_stretch), start)
                                           : start;
    const P last_normal = select(g.was_impulse[k], zero, g.last_normal[k]);
    // A spring that closes or opens in this cycle gives a share of its force; one that pulls or dilates gives all.
    const M shares = rows.is_linear & (before.opening == zero) & (overlap - rest > zero);
    const M closed = g.closed[k] & own, spring = closed & !impulsive, held = closed & impulsive;
    const M stays = spring & (abs(last_normal) + abs(handed) > zero);

    BasicJointMemory<P> after = before;
    const P slide = (p.v_t - half * dt * g.turning[k].t) * dt;
    const P closure = select(shares, share, 1.0) * (overlap - rest);
    P normal = zero, shear = zero, strength = zero, heat = zero, dilated = zero, freed = zero, energy = zero;
    P slid = zero, opened = zero;
    M slips{};
    if (any(spring))
    {
        const BasicJointStep<P> step{closure, slide, handed * g.length_inverse, last_normal * g.length_inverse};
        const P gaps = last_stretch - before.opening - closure;
        const M climbs = spring & (before.opening > zero) & (last_normal > zero) & (last_stretch > zero) &
                         (gaps + gaps > last_stretch);
        const BasicJointStress<P> now = any(climbs) ? react_in_pieces<React, P>(rows, step, last_stretch - before.opening,
                                                                                pieces_of<P>(climbs, gaps, last_stretch), after)
                                                    : React::template react<P>(rows, step, after);
        const auto force = [&](P stress) { return select(spring, stress * g.length, zero); };
        normal = force(now.normal);
        shear = force(now.shear);
        strength = force(now.strength);
        heat = select(stays, force(now.heat), zero);
        dilated = select(stays, half * (last_normal + normal) * (now.opening - before.opening), zero);
        if (const M breaks = spring & (after.broken > before.broken); any(breaks))
            freed = select(breaks, now.freed * g.length, zero);
        slips = spring & !(now.slid == zero);
        energy = force(now.energy + shear_energy(now.shear, now.shear_compliance));
        // Where nothing moves, nothing changes, not even by round-off: results must not depend on how often a block at rest is evaluated.
        const M still = spring & (slide == zero) & (overlap == seen(last.overlap[k])) & (rest == last_rest) &
                        (abs(normal - last_normal) + abs(shear - handed) <= P(memory_round_off) * (abs(last_normal) + abs(handed)));
        if (any(still))
        {
            take<P>(still, before, after);
            normal = select(still, last_normal, normal);
            shear = select(still, handed, shear);
            energy = select(still, remembered(m.energy), energy);
            for (P* const spent : {&heat, &dilated, &freed})
                *spent = select(still, zero, *spent);
            slips = slips & !still;
        }
        slid = select(slips, now.slid, zero);
        opened = select(slips, now.opening - before.opening, zero);
        put<false>(spring & !still, memory, m.stiffness, now.normal_stiffness);
    }
    // Sliding under impulses is slip, too.
    after.slip = select(held, before.slip - slide, after.slip);
    if (any(held))
        after.opening = select(React::template dilate_by_slip<P>(rows, held), CoulombResidual::opening(rows.numbers, after),
                               after.opening);
    const M changed = spring | held;
    const P opening = select(changed, after.opening, before.opening);
    put<false>(changed, memory, m.slip, after.slip);
    put<false>(changed, memory, m.state, after.state);
    put<false>(changed, memory, m.turn, after.turn);
    put<false>(changed, memory, m.broken, after.broken);
    store_lane(memory, m.opening, opening);
    const P lost = select(own, remembered(m.energy) - energy, zero);
    put<all>(own, memory, m.energy, energy);

    const M bears = spring & ((!(normal == zero)) | (overlap + opening - rest > P(-closed_gap) * load_lane<P>(l, l.length_floor)));
    if constexpr (all)
        store_regimes(bears, bears & slips, held, place.regime[k]);
    else
        store_regimes_of(own, bears, bears & slips, held, place.regime[k]);
    const P held_rest = overlap + opening - select(g.last_normal[k] > zero, max(last_stretch, zero), zero);
    put<all>(own, l, l.rest_overlap[k], select(bears, rest, select(held, max(held_rest, zero), zero)));
    put<all>(own, l, l.overlap[k], overlap);
    put<all>(own, l, l.normal_force[k], select(held, g.last_normal[k], normal));
    put<all>(own, l, l.shear_force[k], select(held, g.last_shear[k], shear));

    const auto mine = [&](P value) { return all ? value : select(own, value, zero); };
    sums.friction += mine(heat + dilated);
    sums.dilation += mine(dilated);
    sums.broken += freed;
    sums.slid += mine(slid);
    sums.opened += mine(opened);
    sums.changes += mine(half * dt * (normal * p.v_m - shear * p.v_t) + lost - heat) - freed;
    sums.normal[k] = all ? normal : select(own, normal, sums.normal[k]);
    sums.work += mine(normal * (p.overlap + opening - rest));
    sums.used += mine(abs(shear));
    sums.strength += mine(strength);
    sums.f_t += mine(shear);
    sums.f_m -= mine(normal);
    sums.moment_inc -= mine(p.inc_t * normal + p.inc_m * shear);
    sums.moment_ref += mine(p.ref_t * normal + p.ref_m * shear);
}

/// Both points in one function: their chains of operations do not wait for each other (perf/measured.md).
template <typename React, typename P>
[[gnu::noinline, gnu::flatten]] void evaluate_points_by(const BasicContactGroup<P>& g, MaskOf<P> impulsive,
                                                        const std::array<P, 2>& share, P dt, const BasicJointPlace<P>& place,
                                                        const ContactLanes& last, BasicSums<P>& sums)
{
    BasicSums<P> own = sums;
#pragma GCC unroll 2
    for (int k = 0; k < 2; ++k)
        evaluate_one_point<React, P>(g, k, impulsive, share[k], dt, place, last, own);
    sums = own;
}

template <typename P>
using EvaluatePoints = void (*)(const BasicContactGroup<P>& g, MaskOf<P> impulsive, const std::array<P, 2>& share, P dt,
                                const BasicJointPlace<P>& place, const ContactLanes& last, BasicSums<P>& sums);

/// One for each law and curve.
template <typename P, std::size_t... at>
constexpr std::array<EvaluatePoints<P>, sizeof...(at)> evaluators(std::index_sequence<at...>)
{
    return {&evaluate_points_by<OneLaw<typename std::tuple_element_t<at / curve_count, AllLaws>::Type,
                                       typename std::tuple_element_t<at % curve_count, AllCurves>::Type>,
                                P>...};
}

/// Both points of contacts that are all of one law.
template <typename P, std::size_t laws>
[[gnu::always_inline]] inline void evaluate_by_one_law(const BasicContactGroup<P>& g, MaskOf<P> impulsive,
                                                       const std::array<P, 2>& share, P dt, const BasicJointPlace<P>& place,
                                                       BasicSums<P>& sums)
{
    static constexpr auto evaluate_each = evaluators<P>(std::make_index_sequence<laws * curve_count>{});
    const EvaluatePoints<P> evaluate = evaluate_each[static_cast<std::size_t>(place.rows.kind[0]) * curve_count +
                                                     static_cast<std::size_t>(place.rows.curve[0])];
    evaluate(g, impulsive, share, dt, place, place.lanes, sums);
}
}  // namespace hdem
