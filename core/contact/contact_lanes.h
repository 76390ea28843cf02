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

/// A lane of `owner`, one of an array of such; wider packs (wide_lanes.h) go on in the next of them.
template <typename P, typename Owner>
[[nodiscard, gnu::always_inline]] inline P load_lane(const Owner&, const ContactLanes::Lane& lane)
{
    return load_lane(lane);
}

template <typename Owner>
[[gnu::always_inline]] inline void store_lane(Owner&, ContactLanes::Lane& lane, Pack value)
{
    store_lane(lane, value);
}

template <typename P>
[[nodiscard]] inline BasicEdgePair<P> load_edges(const ContactLanes& l)
{
    const auto load = [&l](const ContactLanes::Lane& lane) { return load_lane<P>(l, lane); };
    return {load(l.tx),  load(l.ty),  load(l.start_t), load(l.start_m), load(l.length),
            load(l.p0x), load(l.p0y), load(l.p1x),     load(l.p1y)};
}

/// Rows of four doubles of the blocks at `at`, `offset` doubles after their beginning: columns of them.
template <typename Row>
[[gnu::always_inline]] inline void load_rows(const Row* rows, const Index* at, std::ptrdiff_t offset, Pack& a, Pack& b, Pack& c,
                                             Pack& d)
{
    const auto row = [=](int i) { return Pack::load(reinterpret_cast<const double*>(rows + at[i]) + offset); };
    a = row(0);
    b = row(1);
    c = row(2);
    d = row(3);
    transpose(a, b, c, d);
}

/// Motions of the blocks of a pack.
template <typename P>
[[nodiscard]] inline BasicMotion<P> load_motions(const std::vector<BlockMotion>& motion, const Index* at)
{
    BasicMotion<P> m;
    load_rows(motion.data(), at, 0, m.x, m.y, m.c, m.s);
    load_rows(motion.data(), at, 4, m.vx, m.vy, m.w, m.angle);
    return m;
}
template <typename P>
[[nodiscard]] inline BasicInertia<P> load_inertias(const std::vector<BlockInertia>& inertia, const Index* at)
{
    BasicInertia<P> i;
    load_rows(inertia.data(), at, 0, i.inverse_mass_x, i.inverse_mass_y, i.inverse_inertia, i.unused);
    return i;
}

/// Net forces and moments on the blocks of a pack in the last cycle.
template <typename P>
struct BasicForceLanes
{
    P x, y, moment;
};
template <typename P>
[[nodiscard]] inline BasicForceLanes<P> load_forces(const std::vector<BlockForce>& force, const Index* at)
{
    BasicForceLanes<P> f;
    P reserve;
    load_rows(force.data(), at, 0, f.x, f.y, f.moment, reserve);
    return f;
}

/// Joint laws of the contacts of a pack.
template <typename P>
struct BasicJointLanes
{
    BasicCoulombSlip<P> law;
    P normal_compliance, shear_compliance;  ///< 1/K_N, 1/K_S [m/Pa]
};

/// Neighbours mostly have the same laws: what was loaded last is kept.
template <typename P>
class LawLanes
{
  public:
    explicit LawLanes(const std::vector<CoulombSlip>& laws) : laws_(laws) { last_.fill(no_index); }

    const BasicJointLanes<P>& load(const Index* law)
    {
        if (std::memcmp(law, last_.data(), sizeof last_) != 0)
            reload(law);
        return joint_;
    }

  private:
    [[gnu::noinline]] void reload(const Index* law)
    {
        std::memcpy(last_.data(), law, sizeof last_);
        for (int i = 0; i < P::width; ++i)
        {
            const CoulombSlip& joint = laws_[law[i]];
            joint_.law.normal_stiffness.v[i] = joint.normal_stiffness;
            joint_.law.shear_stiffness.v[i] = joint.shear_stiffness;
            joint_.law.friction_coefficient.v[i] = joint.friction_coefficient;
            joint_.law.cohesion.v[i] = joint.cohesion;
        }
        joint_.normal_compliance = P(1.0) / joint_.law.normal_stiffness;
        joint_.shear_compliance = P(1.0) / joint_.law.shear_stiffness;
    }

    const std::vector<CoulombSlip>& laws_;
    std::array<Index, P::width> last_;
    BasicJointLanes<P> joint_;
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

/// Points that were in the impulse regime.
[[nodiscard]] inline Mask were_impulses(const std::uint8_t* regime, Mask)
{
    return {load_regimes(regime) == static_cast<std::int64_t>(Regime::impulse)};
}

/// `slips` are among `spring`, and none of `held` is.
inline void store_regimes(Mask spring, Mask slips, Mask held, std::uint8_t* regime)
{
    store_bytes((spring.v & 1) + (slips.v & 1) + (held.v & 3), regime);
}

inline void store_flags(Mask m, std::uint8_t* to)
{
    store_bytes(m.v & 1, to);
}

[[nodiscard]] inline FloatLanes to_float(Pack value)
{
    return __builtin_convertvector(value.v, FloatLanes);
}

/// Floats beside the doubles of a pack.
template <typename P>
struct Floats
{
    using Type = FloatLanes;
};
template <typename P>
using FloatsOf = typename Floats<P>::Type;

template <typename P>
[[nodiscard]] inline FloatsOf<P> all_floats(float value)
{
    return FloatsOf<P>{} + value;
}

template <typename F>
[[nodiscard]] inline float least(F values)
{
    float found = values[0];
    for (std::size_t i = 1; i < sizeof values / sizeof found; ++i)
        found = std::min(found, values[i]);
    return found;
}

/// Incident vertices that have left the place at which the features were found. `slack`: by how much any of the others may move before it has.
[[nodiscard]] inline Mask have_moved(const ContactLanes& l, const BasicEdgeView<Pack>& v, FloatLanes& slack)
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
    const FloatLanes left = limit - (a > b ? a : b);
    slack = left < slack ? left : slack;
    return {__builtin_convertvector(!((a <= limit) & (b <= limit)), Mask::V)};
}

inline void add_pack(Pack a, Pack& sum)
{
    sum += a;
}

/// Loads of four contacts on their two blocks; `swapped`: ref is the block of part_b.
inline void store_loads(Pack x, Pack y, Pack moment_ref, Pack moment_inc, Pack reserve, const std::uint8_t* swapped, BlockLoad* to)
{
    Pack a = -x, b = -y, c = moment_ref, d = reserve;
    transpose(a, b, c, d);
    a.store(&to[swapped[0]].x);
    b.store(&to[2 + swapped[1]].x);
    c.store(&to[4 + swapped[2]].x);
    d.store(&to[6 + swapped[3]].x);
    transpose(x, y, moment_inc, reserve);
    x.store(&to[1 - swapped[0]].x);
    y.store(&to[3 - swapped[1]].x);
    moment_inc.store(&to[5 - swapped[2]].x);
    reserve.store(&to[7 - swapped[3]].x);
}

/// `touching` contacts, of which `springs` have no impulse.
inline void store_use(Pack mobilised, Pack t_x, Pack t_y, Mask touching, Mask springs, JointUse* to)
{
    const FloatLanes m = to_float(mobilised), x = to_float(t_x), y = to_float(t_y);
    for (int i = 0; i < lanes; ++i)
        to[i] = {m[i], x[i], y[i],
                 springs.has(i)    ? std::uint32_t{contact_force}
                 : touching.has(i) ? std::uint32_t{contact_impulse}
                                   : 0};
}
}  // namespace hdem
