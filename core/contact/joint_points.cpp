#include "core/contact/joint_points.h"

#include "core/joint/all_laws.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
using Numbers = BasicJointNumbers<Pack>;
using Step = BasicJointStep<Pack>;
using Memory = BasicJointMemory<Pack>;
using Stress = BasicJointStress<Pack>;

/// Four lanes of one law.
template <typename Law, typename Curve>
struct OneLaw
{
    static constexpr bool has_all_lanes = true;

    [[gnu::always_inline]] static Stress react(const RowLanes& rows, const Step& step, Memory& memory)
    {
        const Stress stress = Law::template react<Curve>(rows.numbers, step, memory);
        memory.opening = stress.opening;
        return stress;
    }
};

void take(Mask lanes_of, const Memory& from, Memory& to)
{
    for (Pack Memory::*const field : {&Memory::slip, &Memory::state, &Memory::turn, &Memory::opening, &Memory::broken})
        to.*field = select(lanes_of, from.*field, to.*field);
}

void take(Mask lanes_of, const Stress& from, Stress& to)
{
    for (Pack Stress::*const field :
         {&Stress::normal, &Stress::shear, &Stress::strength, &Stress::slid, &Stress::opening, &Stress::energy, &Stress::heat,
          &Stress::freed, &Stress::normal_stiffness, &Stress::shear_compliance})
        to.*field = select(lanes_of, from.*field, to.*field);
}

/// Lanes with different laws, some of which may be plain. Each law is asked once, for all its lanes: no lane depends on the laws of the others.
struct MixedLaws
{
    static constexpr bool has_all_lanes = false;

    [[gnu::noinline]] static Stress react(const RowLanes& rows, const Step& step, Memory& memory)
    {
        const Pack zero = 0.0;
        Stress stress{zero, zero, zero, zero, zero, zero, zero, zero, zero, zero};
        Mask left = rows.has_memory;
        for (int j = 0; j < lanes; ++j)
        {
            if (left.v[j] == 0)
                continue;
            Mask same{};
            for (int i = j; i < lanes; ++i)
                same.v[i] = rows.has_memory.v[i] != 0 && rows.kind[i] == rows.kind[j] && rows.curve[i] == rows.curve[j] ? -1 : 0;
            Memory next = memory;
            const Stress answer = with_law(
                rows.kind[j], [&](auto law)
                { return with_curve(rows.curve[j], [&](auto curve) { return ask(law, curve, rows.numbers, step, next); }); });
            next.opening = answer.opening;
            take(same, answer, stress);
            take(same, next, memory);
            left = left & !same;
        }
        return stress;
    }

    template <typename Law, typename Curve>
    [[gnu::noinline]] static Stress ask(Law, Curve, const Numbers& numbers, const Step& step, Memory& memory)
    {
        return Law::template react<Curve>(numbers, step, memory);
    }
};

Memory load(const MemoryLanes::Point& m)
{
    return {load_lane(m.slip), load_lane(m.state), load_lane(m.turn), load_lane(m.opening), load_lane(m.broken)};
}

/// Forces of a point that nothing moves may differ by so much of their size: round-off.
constexpr double round_off = 1e-13;

/// How many pieces of a cycle a law is asked for, one after another. Blocks that slide on a dilatant joint part by as much as slip opens it. Asked once a cycle, the law sees
/// all of that gap before slip fills it: a joint would let go from the speed on at which it opens by its closure in a cycle, 0.1 m/s where 4 MN/m2 press 2e-6 m.
/// @param gaps     by which the faces part in this cycle [m]
/// @param stretch  closure before it [m]
Pack pieces_of(Mask climbs, Pack gaps, Pack stretch)
{
    constexpr double most = 1024.0, largest = 0.5;  // of the closure
    Pack pieces = 1.0;
    for (int i = 0; i < lanes; ++i)
        if (climbs.has(i))
            pieces.v[i] = std::min(std::ceil(gaps.v[i] / (largest * stretch.v[i])), most);
    return pieces;
}

/// React::react in so many pieces, along a straight way from `from` to the closure of `step`.
template <typename React>
[[gnu::noinline]] Stress react_in_pieces(const RowLanes& rows, const Step& step, Pack from, Pack pieces, Memory& memory)
{
    const Pack share = Pack(1.0) / pieces, way = (step.closure - from) * share;
    Stress sum{};
    for (Pack at = 1.0; any(at <= pieces); at += Pack(1.0))
    {
        const Mask asked = at <= pieces;
        Memory next = memory;
        const Stress now = React::react(rows,
                                        {select(at < pieces, from + at * way, step.closure), step.slide * share,
                                         select(at > Pack(1.0), sum.shear, step.last_shear),
                                         select(at > Pack(1.0), sum.normal, step.last_normal)},
                                        next);
        const Pack slid = sum.slid, heat = sum.heat, freed = sum.freed;
        take(asked, next, memory);
        take(asked, now, sum);
        sum.slid = select(asked, slid + now.slid, slid);
        sum.heat = select(asked, heat + now.heat, heat);
        sum.freed = select(asked, freed + now.freed, freed);
    }
    return sum;
}

/// Impulses know no stress normal to the joint: of dilation they give what follows from slip alone.
Mask dilating_by_slip(const RowLanes& rows, Mask held)
{
    for (int i = 0; i < lanes; ++i)
        held.v[i] = rows.kind[i] == kind_of<CoulombResidual>() ? held.v[i] : 0;
    return held;
}

/// What remains of the state before: lanes that this cycle changes are stored, the others stay as they were.
template <bool has_all_lanes>
[[gnu::always_inline]] inline void put(Mask changed, ContactLanes::Lane& lane, Pack value)
{
    if constexpr (has_all_lanes)
        store_lane(lane, value);
    else
        store_lane(lane, select(changed, value, load_lane(lane)));
}

/// A point of four contacts. `last`: their lanes after the last cycle.
template <typename React>
[[gnu::noinline, gnu::flatten]] void evaluate_point_by(const ContactGroup& g, int k, Mask impulsive, Pack share, Pack dt,
                                                       const JointPlace& place, const ContactLanes& last, Sums& sums)
{
    constexpr bool all = React::has_all_lanes;
    const Pack zero = 0.0, half = 0.5;
    const RowLanes& rows = place.rows;
    const Mask own = all ? Mask{Mask::V{} - 1} : rows.has_memory;
    MemoryLanes::Point& m = place.memory.point[k];
    ContactLanes& l = place.lanes;
    const BasicTouchPoint<Pack>& p = g.touch.point[k];
    const Memory before = load(m);
    const Pack last_rest = load_lane(last.rest_overlap[k]);
    const Pack overlap = pressed_by<Joints::laws>(g, k);
    const Pack rest = rest_overlap(overlap + before.opening, last_rest, g.recovery);
    const Pack start = select(g.was_impulse[k], zero, g.last_shear[k]) * g.shear_share;
    const Pack last_stretch = load_lane(last.overlap[k]) + before.opening - last_rest;
    const Pack handed = any(g.was_impulse[k]) ? select(g.was_impulse[k], g.last_shear[k] * kept_share(g, k, last_stretch), start)
                                              : start;
    const Pack last_normal = select(g.was_impulse[k], zero, g.last_normal[k]);
    // A spring that closes or opens in this cycle gives a share of its force; one that pulls or dilates gives all.
    const Mask shares = rows.is_linear & (before.opening == zero) & (overlap - rest > zero);
    const Mask closed = g.closed[k] & own, spring = closed & !impulsive, held = closed & impulsive;
    const Mask stays = spring & (abs(last_normal) + abs(handed) > zero);

    Memory after = before;
    const Pack slide = (p.v_t - half * dt * g.turning[k].t) * dt;
    const Pack closure = select(shares, share, 1.0) * (overlap - rest);
    Pack normal = zero, shear = zero, strength = zero, heat = zero, dilated = zero, freed = zero, energy = zero;
    Pack slid = zero, opened = zero;
    Mask slips{};
    if (any(spring))
    {
        const Step step{closure, slide, handed * g.length_inverse, last_normal * g.length_inverse};
        const Pack gaps = last_stretch - before.opening - closure;
        const Mask climbs = spring & (before.opening > zero) & (last_normal > zero) & (last_stretch > zero) &
                            (gaps + gaps > last_stretch);
        const Stress now = any(climbs) ? react_in_pieces<React>(rows, step, last_stretch - before.opening,
                                                                pieces_of(climbs, gaps, last_stretch), after)
                                       : React::react(rows, step, after);
        const auto force = [&](Pack stress) { return select(spring, stress * g.length, zero); };
        normal = force(now.normal);
        shear = force(now.shear);
        strength = force(now.strength);
        heat = select(stays, force(now.heat), zero);
        dilated = select(stays, half * (last_normal + normal) * (now.opening - before.opening), zero);
        if (const Mask breaks = spring & (after.broken > before.broken); any(breaks))
            freed = select(breaks, now.freed * g.length, zero);
        slips = spring & !(now.slid == zero);
        energy = force(now.energy + shear_energy(now.shear, now.shear_compliance));
        // Where nothing moves nothing changes, not by round-off either: how often a block at rest is looked at must not matter.
        const Mask still = spring & (slide == zero) & (overlap == load_lane(last.overlap[k])) & (rest == last_rest) &
                           (abs(normal - last_normal) + abs(shear - handed) <= Pack(round_off) * (abs(last_normal) + abs(handed)));
        if (any(still))
        {
            take(still, before, after);
            normal = select(still, last_normal, normal);
            shear = select(still, handed, shear);
            energy = select(still, load_lane(m.energy), energy);
            for (Pack* const spent : {&heat, &dilated, &freed})
                *spent = select(still, zero, *spent);
            slips = slips & !still;
        }
        slid = select(slips, now.slid, zero);
        opened = select(slips, now.opening - before.opening, zero);
        put<false>(spring & !still, m.stiffness, now.normal_stiffness);
    }
    // What a joint slides by impulses is slip too.
    after.slip = select(held, before.slip - slide, after.slip);
    if (any(held))
        after.opening = select(dilating_by_slip(rows, held), CoulombResidual::opening(rows.numbers, after), after.opening);
    const Mask changed = spring | held;
    const Pack opening = select(changed, after.opening, before.opening);
    put<false>(changed, m.slip, after.slip);
    put<false>(changed, m.state, after.state);
    put<false>(changed, m.turn, after.turn);
    put<false>(changed, m.broken, after.broken);
    store_lane(m.opening, opening);
    const Pack lost = select(own, load_lane(m.energy) - energy, zero);
    put<all>(own, m.energy, energy);

    const Mask bears = spring & (!(normal == zero) | (overlap + opening - rest > Pack(-closed_gap) * load_lane(l.length_floor)));
    const WordLanes regimes = regimes_of(bears, bears & slips, held), here = words_of(own);
    store_bytes(all ? regimes : (here & regimes) + (~here & load_bytes(place.regime[k])), place.regime[k]);
    const Pack held_rest = overlap + opening - select(g.last_normal[k] > zero, max(last_stretch, zero), zero);
    put<all>(own, l.rest_overlap[k], select(bears, rest, select(held, max(held_rest, zero), zero)));
    put<all>(own, l.overlap[k], overlap);
    put<all>(own, l.normal_force[k], select(held, g.last_normal[k], normal));
    put<all>(own, l.shear_force[k], select(held, g.last_shear[k], shear));

    const auto mine = [&](Pack value) { return all ? value : select(own, value, zero); };
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

using EvaluatePoint = decltype(&evaluate_point_by<MixedLaws>);

/// One for each law and curve.
template <std::size_t... at>
constexpr std::array<EvaluatePoint, sizeof...(at)> evaluators(std::index_sequence<at...>)
{
    return {&evaluate_point_by<OneLaw<typename std::tuple_element_t<at / curve_count, AllLaws>::Type,
                                      typename std::tuple_element_t<at % curve_count, AllCurves>::Type>>...};
}
constexpr auto evaluate_one_law = evaluators(std::make_index_sequence<std::size_t{law_count} * curve_count>{});
}  // namespace

void evaluate_joint_points(const ContactGroup& g, Mask impulsive, const std::array<Pack, 2>& share, Pack dt,
                           const JointPlace& place, Sums& sums)
{
    const RowLanes& rows = place.rows;
    if (rows.is_uniform)
    {
        const EvaluatePoint evaluate = evaluate_one_law[static_cast<std::size_t>(rows.kind[0]) * curve_count +
                                                        static_cast<std::size_t>(rows.curve[0])];
        for (int k = 0; k < 2; ++k)
            evaluate(g, k, impulsive, share[k], dt, place, place.lanes, sums);
        return;
    }
    const ContactLanes last = place.lanes;
    if (any(!rows.has_memory))
    {
        Sums plain;
        for (int k = 0; k < 2; ++k)
            evaluate_point<Contact4::any, Joints::laws>(g, k, impulsive, share[k], dt, place.lanes, place.regime[k], plain);
        sums.take(!rows.has_memory, plain);
    }
    for (int k = 0; k < 2; ++k)
        evaluate_point_by<MixedLaws>(g, k, impulsive, share[k], dt, place, last, sums);
}
}  // namespace hdem
