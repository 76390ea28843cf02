#pragma once
/// Four contacts at once: from the arrays to Packs and back.

#include "core/detection/edge_touch.h"
#include "core/joint/coulomb_slip.h"
#include "core/model/model.h"
#include "core/state/workspace.h"

#include <algorithm>

namespace hdem
{
[[nodiscard]] inline Pack load_lane(const ContactLanes::Lane& lane)
{
    return Pack::load(lane.data());
}

inline void store_lane(ContactLanes::Lane& lane, Pack value)
{
    value.store(lane.data());
}

[[nodiscard]] inline BasicEdgePair<Pack> load_edges(const ContactLanes& l)
{
    return {load_lane(l.tx),  load_lane(l.ty),  load_lane(l.start_t), load_lane(l.start_m), load_lane(l.length),
            load_lane(l.p0x), load_lane(l.p0y), load_lane(l.p1x),     load_lane(l.p1y)};
}

/// Motions of four blocks: eight rows to columns.
[[nodiscard]] inline BasicMotion<Pack> load_motions(const std::vector<BlockMotion>& motion, const Index* at)
{
    BasicMotion<Pack> m;
    m.x = Pack::load(&motion[at[0]].x);
    m.y = Pack::load(&motion[at[1]].x);
    m.c = Pack::load(&motion[at[2]].x);
    m.s = Pack::load(&motion[at[3]].x);
    transpose(m.x, m.y, m.c, m.s);
    m.vx = Pack::load(&motion[at[0]].vx);
    m.vy = Pack::load(&motion[at[1]].vx);
    m.w = Pack::load(&motion[at[2]].vx);
    m.angle = Pack::load(&motion[at[3]].vx);
    transpose(m.vx, m.vy, m.w, m.angle);
    return m;
}

[[nodiscard]] inline BasicInertia<Pack> load_inertias(const std::vector<BlockInertia>& inertia, const Index* at)
{
    BasicInertia<Pack> i;
    i.inverse_mass_x = Pack::load(&inertia[at[0]].inverse_mass_x);
    i.inverse_mass_y = Pack::load(&inertia[at[1]].inverse_mass_x);
    i.inverse_inertia = Pack::load(&inertia[at[2]].inverse_mass_x);
    i.unused = Pack::load(&inertia[at[3]].inverse_mass_x);
    transpose(i.inverse_mass_x, i.inverse_mass_y, i.inverse_inertia, i.unused);
    return i;
}

/// Net forces and moments on four blocks in the last cycle.
struct ForceLanes
{
    Pack x, y, moment;
};
[[nodiscard]] inline ForceLanes load_forces(const std::vector<BlockForce>& force, const Index* at)
{
    Pack x = Pack::load(&force[at[0]].x);
    Pack y = Pack::load(&force[at[1]].x);
    Pack moment = Pack::load(&force[at[2]].x);
    Pack reserve = Pack::load(&force[at[3]].x);
    transpose(x, y, moment, reserve);
    return {x, y, moment};
}

/// Joint laws of four contacts.
struct JointLanes
{
    BasicCoulombSlip<Pack> law;
    Pack normal_compliance, shear_compliance;  ///< 1/K_N, 1/K_S [m/Pa]
};

/// Neighbours mostly have the same laws: what was loaded last is kept.
class LawLanes
{
  public:
    explicit LawLanes(const std::vector<CoulombSlip>& laws) : laws_(laws) {}

    const JointLanes& load(const Index* law)
    {
        if (!std::equal(law, law + lanes, last_.begin()))
            reload(law);
        return joint_;
    }

  private:
    void reload(const Index* law)
    {
        std::copy(law, law + lanes, last_.begin());
        for (int i = 0; i < lanes; ++i)
        {
            const CoulombSlip& joint = laws_[law[i]];
            joint_.law.normal_stiffness.v[i] = joint.normal_stiffness;
            joint_.law.shear_stiffness.v[i] = joint.shear_stiffness;
            joint_.law.friction_coefficient.v[i] = joint.friction_coefficient;
            joint_.law.cohesion.v[i] = joint.cohesion;
        }
        joint_.normal_compliance = Pack(1.0) / joint_.law.normal_stiffness;
        joint_.shear_compliance = Pack(1.0) / joint_.law.shear_stiffness;
    }

    const std::vector<CoulombSlip>& laws_;
    std::array<Index, lanes> last_{no_index, no_index, no_index, no_index};
    JointLanes joint_;
};

using ByteLanes = std::uint8_t __attribute__((vector_size(4)));

/// Regimes of four contact points.
[[nodiscard]] inline Mask::V load_regimes(const std::uint8_t* from)
{
    ByteLanes bytes;
    std::memcpy(&bytes, from, sizeof bytes);
    return __builtin_convertvector(bytes, Mask::V);
}

inline void store_bytes(Mask::V values, std::uint8_t* to)
{
    const ByteLanes bytes = __builtin_convertvector(values, ByteLanes);
    std::memcpy(to, &bytes, sizeof bytes);
}

[[nodiscard]] inline FloatLanes to_float(Pack value)
{
    return __builtin_convertvector(value.v, FloatLanes);
}

/// Loads of four contacts on one of their two blocks; `side`: 0 if that is the block of part_a.
inline void store_loads(Pack x, Pack y, Pack moment, Pack reserve, const std::array<Index, lanes>& side, BlockLoad* to)
{
    transpose(x, y, moment, reserve);
    x.store(&to[side[0]].x);
    y.store(&to[2 + side[1]].x);
    moment.store(&to[4 + side[2]].x);
    reserve.store(&to[6 + side[3]].x);
}

inline void store_use(Pack mobilised, Pack t_x, Pack t_y, Mask::V contacts, JointUse* to)
{
    const FloatLanes m = to_float(mobilised), x = to_float(t_x), y = to_float(t_y);
    for (int i = 0; i < lanes; ++i)
        to[i] = {m[i], x[i], y[i], static_cast<std::uint32_t>(contacts[i])};
}
}  // namespace hdem
