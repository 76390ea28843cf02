#include "core/contact/joint_forces.h"

#include "core/joint/barton_bandis.h"
#include "core/joint/continuously_yielding.h"
#include "core/joint/coulomb_residual.h"
#include "core/joint/patton.h"
#include "core/joint/plesha.h"
#include "core/joint/saeb_amadei.h"

namespace hdem
{
namespace
{
using Numbers = BasicJointNumbers<Pack>;
using Step = BasicJointStep<Pack>;
using Memory = BasicJointMemory<Pack>;
using Stress = BasicJointStress<Pack>;

template <typename Law>
Stress react_on(CurveKind curve, const Numbers& numbers, const Step& step, Memory& memory)
{
    switch (curve)
    {
    case CurveKind::hyperbolic:
        return Law::template react<Hyperbolic>(numbers, step, memory);
    case CurveKind::power_law:
        return Law::template react<PowerLaw>(numbers, step, memory);
    case CurveKind::linear:
        break;
    }
    return Law::template react<Linear>(numbers, step, memory);
}

/// All four lanes as if they had this law.
Stress react_as(JointKind kind, CurveKind curve, const Numbers& numbers, const Step& step, Memory& memory)
{
    switch (kind)
    {
    case JointKind::barton_bandis:
        return react_on<BartonBandis>(curve, numbers, step, memory);
    case JointKind::patton:
        return react_on<Patton>(curve, numbers, step, memory);
    case JointKind::continuously_yielding:
        return react_on<ContinuouslyYielding>(curve, numbers, step, memory);
    case JointKind::plesha:
        return react_on<Plesha>(curve, numbers, step, memory);
    case JointKind::saeb_amadei:
        return react_on<SaebAmadei>(curve, numbers, step, memory);
    case JointKind::plain:
    case JointKind::coulomb:
        break;
    }
    return react_on<CoulombResidual>(curve, numbers, step, memory);
}

void take(Mask lanes_of, const Memory& from, Memory& to)
{
    to.slip = select(lanes_of, from.slip, to.slip);
    to.state = select(lanes_of, from.state, to.state);
    to.turn = select(lanes_of, from.turn, to.turn);
    to.opening = select(lanes_of, from.opening, to.opening);
    to.broken = select(lanes_of, from.broken, to.broken);
}

void take(Mask lanes_of, const Stress& from, Stress& to)
{
    const auto one = [&](Pack Stress::*field) { to.*field = select(lanes_of, from.*field, to.*field); };
    for (Pack Stress::*const field : {&Stress::normal, &Stress::shear, &Stress::strength, &Stress::slid, &Stress::opening,
                                      &Stress::energy, &Stress::heat, &Stress::normal_stiffness, &Stress::shear_stiffness})
        one(field);
}

/// The law of each lane; a lane does not depend on the laws of the others.
Stress react(const RowLanes& rows, const Step& step, Memory& memory)
{
    if (rows.is_uniform)
    {
        Stress stress = react_as(rows.kind[0], rows.curve[0], rows.numbers, step, memory);
        memory.opening = stress.opening;
        return stress;
    }
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
        const Stress answer = react_as(rows.kind[j], rows.curve[j], rows.numbers, step, next);
        next.opening = answer.opening;
        take(same, answer, stress);
        take(same, next, memory);
        left = left & !same;
    }
    return stress;
}

Memory load(const MemoryLanes::Point& m)
{
    return {load_lane(m.slip), load_lane(m.state), load_lane(m.turn), load_lane(m.opening), load_lane(m.broken)};
}

void store(const Memory& from, MemoryLanes::Point& m)
{
    store_lane(m.slip, from.slip);
    store_lane(m.state, from.state);
    store_lane(m.turn, from.turn);
    store_lane(m.opening, from.opening);
    store_lane(m.broken, from.broken);
}
}  // namespace

void RowLanes::reload(const Index* law)
{
    std::copy(law, law + lanes, last_.begin());
    any = false;
    for (int i = 0; i < lanes; ++i)
    {
        const JointRow& row = rows_[law[i]];
        kind[i] = row.kind;
        curve[i] = row.curve;
        has_memory.v[i] = row.has_memory() ? -1 : 0;
        is_linear.v[i] = row.curve == CurveKind::linear ? -1 : 0;
        is_bonded.v[i] = row.is_bonded ? -1 : 0;
        any = any || row.has_memory();
        is_uniform = (i == 0 || is_uniform) && row.has_memory() && kind[i] == kind[0] && curve[i] == curve[0];
        reach.v[i] = row.reach;
        torn_reach.v[i] = row.torn_reach;
        for (int k = 0; k < joint_numbers; ++k)
            numbers[k].v[i] = row.numbers[k];
    }
}

JointForces react_joints(const RowLanes& rows, const JointPoint& point, MemoryLanes::Point& lanes_of_memory)
{
    const Pack zero = 0.0;
    const Mask spring = point.spring & rows.has_memory;
    const Memory before = load(lanes_of_memory);
    Memory after = before;
    JointForces forces;
    const Pack last_energy = load_lane(lanes_of_memory.energy);
    Pack energy = 0.0, stiffness = load_lane(lanes_of_memory.stiffness);
    if (any(spring))
    {
        const Pack inverse = Pack(1.0) / point.length;
        const Step step{point.closure, point.slide, point.start * inverse, point.last_normal * inverse};
        const Stress now = react(rows, step, after);
        const auto force = [&](Pack stress) { return select(spring, stress * point.length, zero); };
        forces.normal = force(now.normal);
        forces.shear = force(now.shear);
        forces.strength = force(now.strength);
        forces.friction = select(point.stays, force(now.heat), zero);
        forces.slips = spring & !(now.slid == zero);
        energy = force(now.energy + shear_energy(now.shear, now.shear_stiffness));
        stiffness = select(spring, now.normal_stiffness, stiffness);
    }
    // What a joint slides by impulses is slip too.
    const Mask pushed = point.held & rows.has_memory;
    after.slip = select(pushed, before.slip - point.slide, after.slip);
    Memory kept = before;
    take(spring | pushed, after, kept);
    store(kept, lanes_of_memory);
    store_lane(lanes_of_memory.energy, select(rows.has_memory, energy, last_energy));
    store_lane(lanes_of_memory.stiffness, stiffness);
    forces.opening = kept.opening;
    forces.lost = select(rows.has_memory, last_energy - energy, zero);
    forces.bears = !(forces.normal == zero);
    return forces;
}
}  // namespace hdem
