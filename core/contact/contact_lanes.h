#pragma once
/// Four contacts at once: from the arrays to Packs and back.

#include "core/detection/edge_touch.h"
#include "core/joint/coulomb_slip.h"
#include "core/model/model.h"
#include "core/state/workspace.h"

#include <algorithm>
#include <bit>
#include <limits>

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

/// Load four doubles of each block in `at`, `offset` doubles after the beginning of its row, as columns.
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

/// Joint laws of a pack. Neighbours mostly have the same laws, so the last ones are kept.
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
        BasicCoulombSlip<P>& joint = joint_.law;
        load_rows(laws_.data(), law, 0, joint.normal_stiffness, joint.shear_stiffness, joint.friction_coefficient, joint.cohesion);
        joint_.normal_compliance = P(1.0) / joint_.law.normal_stiffness;
        joint_.shear_compliance = P(1.0) / joint_.law.shear_stiffness;
    }

    const std::vector<CoulombSlip>& laws_;
    std::array<Index, P::width> last_;
    BasicJointLanes<P> joint_;
};

/// Four bytes, each in a word of its own and at its place among the four. So all are loaded and stored as one number, and compared as words.
inline constexpr WordLanes byte_places{0xffU, 0xff00U, 0xff0000U, 0xff000000U};
inline constexpr WordLanes byte_ones{1U, 1U << 8, 1U << 16, 1U << 24};
static_assert(std::endian::native == std::endian::little);

[[nodiscard, gnu::always_inline]] inline WordLanes load_bytes(const std::uint8_t* from)
{
    std::uint32_t bytes;
    std::memcpy(&bytes, from, sizeof bytes);
    return WordLanes{bytes, bytes, bytes, bytes} & byte_places;
}

[[gnu::always_inline]] inline void store_bytes(WordLanes placed, std::uint8_t* to)
{
    const WordLanes two = placed | __builtin_shufflevector(placed, placed, 2, 3, 0, 1);
    const WordLanes all = two | __builtin_shufflevector(two, two, 1, 0, 3, 2);
    const std::uint32_t bytes = all[0];
    std::memcpy(to, &bytes, sizeof bytes);
}

/// Points that bore a spring's force.
[[nodiscard]] inline Mask are_springs(const std::uint8_t* regime, Mask)
{
    const WordLanes now = load_bytes(regime);
    const auto is = [&](Regime one) { return now == byte_ones * static_cast<std::uint32_t>(one); };
    return mask_of(WordLanes(is(Regime::stick) | is(Regime::slip)));
}

/// Points that were in the impulse regime.
[[nodiscard]] inline Mask were_impulses(const std::uint8_t* regime, Mask)
{
    return mask_of(WordLanes(load_bytes(regime) == byte_ones * static_cast<std::uint32_t>(Regime::impulse)));
}

/// Regimes of four contact points, as load_bytes gives them. `slips` is a part of `spring`; `held` and `spring` have no lane in common.
[[nodiscard, gnu::always_inline]] inline WordLanes regimes_of(Mask spring, Mask slips, Mask held)
{
    return (words_of(spring) & byte_ones) + (words_of(slips) & byte_ones) + (words_of(held) & (byte_ones * 3U));
}

[[gnu::always_inline]] inline void store_regimes(Mask spring, Mask slips, Mask held, std::uint8_t* regime)
{
    store_bytes(regimes_of(spring, slips, held), regime);
}

/// The same for lanes of `own` alone.
[[gnu::always_inline]] inline void store_regimes_of(Mask own, Mask spring, Mask slips, Mask held, std::uint8_t* regime)
{
    const WordLanes here = words_of(own);
    store_bytes((here & regimes_of(spring, slips, held)) + (~here & load_bytes(regime)), regime);
}

inline void store_flags(Mask m, std::uint8_t* to)
{
    store_bytes(words_of(m) & byte_ones, to);
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

/// Incident vertices that have left the place at which the features were found. `slack`: least distance that any vertex may still move before it has left
/// its place [m].
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

/// Change the sign in lanes of `m`.
[[nodiscard, gnu::always_inline]] inline Pack turned(Mask m, Pack value)
{
    constexpr std::int64_t sign = std::numeric_limits<std::int64_t>::min();
    return Pack(std::bit_cast<Pack::V>(std::bit_cast<Mask::V>(value.v) ^ (m.v & sign)));
}

/// Loads of four contacts on their two blocks; `swapped`: ref is the block of part_b.
[[gnu::always_inline]] inline void store_loads(Pack x, Pack y, Pack moment_ref, Pack moment_inc, Pack reserve,
                                               const std::uint8_t* swapped, BlockLoad* to)
{
    const Mask ref_first = mask_of(WordLanes(load_bytes(swapped) == WordLanes{})), inc_first = !ref_first;
    const auto put = [to](Pack a, Pack b, Pack c, Pack d, int side)
    {
        transpose(a, b, c, d);
        a.store(&to[side].x);
        b.store(&to[2 + side].x);
        c.store(&to[4 + side].x);
        d.store(&to[6 + side].x);
    };
    put(turned(ref_first, x), turned(ref_first, y), select(inc_first, moment_inc, moment_ref), reserve, 0);
    put(turned(inc_first, x), turned(inc_first, y), select(inc_first, moment_ref, moment_inc), reserve, 1);
}

/// Store the joint use of four contacts. `touching` have a closed point; `springs` are those of them without an impulse.
[[gnu::always_inline]] inline void store_use(Pack mobilised, Pack t_x, Pack t_y, Mask touching, Mask springs, JointUse* to)
{
    const WordLanes by_springs = words_of(springs), others = words_of(touching) & ~by_springs;
    const FloatLanes bits = std::bit_cast<FloatLanes>((by_springs & std::uint32_t{contact_force}) |
                                                      (others & std::uint32_t{contact_impulse}));
    const FloatLanes m = to_float(mobilised), x = to_float(t_x), y = to_float(t_y);
    const FloatLanes bm_01 = __builtin_shufflevector(bits, m, 0, 4, 1, 5), bm_23 = __builtin_shufflevector(bits, m, 2, 6, 3, 7);
    const FloatLanes xy_01 = __builtin_shufflevector(x, y, 0, 4, 1, 5), xy_23 = __builtin_shufflevector(x, y, 2, 6, 3, 7);
    const auto put = [to](FloatLanes row, int i) { std::memcpy(static_cast<void*>(&to[i]), &row, sizeof row); };
    put(__builtin_shufflevector(bm_01, xy_01, 0, 1, 4, 5), 0);
    put(__builtin_shufflevector(bm_01, xy_01, 2, 3, 6, 7), 1);
    put(__builtin_shufflevector(bm_23, xy_23, 0, 1, 4, 5), 2);
    put(__builtin_shufflevector(bm_23, xy_23, 2, 3, 6, 7), 3);
}
}  // namespace hdem
