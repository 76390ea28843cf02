#include "core/motion/step_control.h"

#include "core/detection/contact_tracking.h"
#include "core/geometry/convex_part.h"
#include "core/motion/contact_springs.h"
#include "core/motion/equilibrium.h"
#include "core/motion/rest.h"
#include "core/support/bolt_springs.h"
#include "core/water/water_motion.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
/// 2^(n/8): steps between twice as long ones. (By std::exp2 they would be those of the machine's libm.)
constexpr std::array<double, 8> part_of_octave = {0x1p+0,
                                                  0x1.172b83c7d517bp+0,
                                                  0x1.306fe0a31b715p+0,
                                                  0x1.4bfdad5362a27p+0,
                                                  0x1.6a09e667f3bcdp+0,
                                                  0x1.8ace5422aa0dbp+0,
                                                  0x1.ae89f995ad3adp+0,
                                                  0x1.d5818dcfba487p+0};
constexpr double longest = 4096.0;       // times the case's step
constexpr double slide_share = 1.5e-3;   // of the block's size a cycle
constexpr double approach_share = 0.02;  // the same where it touches nothing
constexpr double swing_share = 0.03;     // of 1 / omega of a block that water may carry
constexpr double fall_share = 1e-7;      // of its size, see StepRule::falls_by
constexpr double not_looked_at = 0.0;    // a stable step that is not known
constexpr double narrow_share = 0.5;     // of the stable step of a block that is held by narrow contacts
constexpr double narrow_step = 64.0;     // step^2 K size / m from which on it is: 2 to 4 on a face as long as the block
constexpr double settled_share = 0.01;   // of its size: a block that moved less in its stage keeps its contact lengths

bool is_settled(Index block, const Model& model, const Blocks& blocks)
{
    return !blocks.is_free(block) || blocks.displacement(block).norm() < settled_share * model.size(block);
}

double longest_side(const Shapes& shapes, Index part)
{
    double side = 0.0;
    for (Index e = shapes.vertex_begin[part]; e < shapes.vertex_begin[part + 1]; ++e)
        if (shapes.edge_source[e] != edge_internal)
            side = std::max(side, shapes.edge_length[e]);
    return side;
}

Vec3 mobility(Index block, const Blocks& blocks)
{
    const BlockInertia& inertia = blocks.inertia[block];
    return {inertia.inverse_mass_x, inertia.inverse_mass_y, inertia.inverse_inertia};
}

/// What a unit force moves a block, at its rim, at most [1/kg].
double rim_mobility(Index block, const Model& model, const Blocks& blocks)
{
    const Vec3 m = mobility(block, blocks);
    return std::max(m[0], m[1]) + model.radius[block] * model.radius[block] * m[2];
}

/// Adds up the springs that a block may feel, in coordinates in which its mass matrix is the unit matrix.
class SpringSum
{
  public:
    SpringSum(Index block, const Model& model, const Contacts& contacts, const Blocks& blocks)
        : block_(block),
          model_(model),
          contacts_(contacts),
          blocks_(blocks)
    {
    }

    void add_bolts()
    {
        const auto mobile = [&](Index b) { return mobility(b, blocks_); };
        add_bolt_rows(model_, blocks_, block_, mobile(block_), mobile, sum_);
    }

    void add(Index contact)
    {
        const Index ref = contacts_.ref[contact], inc = contacts_.inc[contact];
        if (is_settled(ref, model_, blocks_) && is_settled(inc, model_, blocks_))
            add_present(contact, ref, inc);
        else
            add_possible(contact, ref == block_ ? inc : ref);
    }

    [[nodiscard]] double greatest_eigenvalue() const
    {
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
        solver.computeDirect(sum_, Eigen::EigenvaluesOnly);
        return solver.eigenvalues()[2] + everywhere_;
    }

  private:
    void add_present(Index contact, Index ref, Index inc)
    {
        const Vec3 by_ref = mobility(ref, blocks_).cwiseSqrt(), by_inc = mobility(inc, blocks_).cwiseSqrt();
        const auto add_spring = [&](const ContactSpring& spring)
        {
            const Vec3 on_ref = by_ref.cwiseProduct(spring.ref), on_inc = by_inc.cwiseProduct(spring.inc);
            const Vec3& row = block_ == ref ? on_ref : on_inc;
            const double own = row.squaredNorm(), other = (block_ == ref ? on_inc : on_ref).squaredNorm();
            if (own > 0.0)
                sum_ += spring.stiffness * (1.0 + other / own) * row * row.transpose();
        };
        for_springs(model_, blocks_, contacts_, contact,
                    [&](const EdgeTouch& touch, int, const ContactSpring& normal, const ContactSpring& shear)
                    {
                        if (touch.length <= 0.0)
                            return;
                        add_spring(normal);
                        add_spring(shear);
                    });
    }

    /// Closed along the longest side that both parts have, at the rim of both blocks.
    void add_possible(Index contact, Index other)
    {
        const CoulombSlip& joint = model_.joints.laws[contacts_.law[contact]];
        const double side = std::min(longest_side(model_.shapes, contacts_.part_a[contact]),
                                     longest_side(model_.shapes, contacts_.part_b[contact]));
        const double stiffness = std::max({present_stiffness(model_, contacts_, contact, 0),
                                           present_stiffness(model_, contacts_, contact, 1), joint.shear_stiffness});
        everywhere_ += stiffness * std::max(side, contacts_.length_floor(contact)) *
                       (rim_mobility(block_, model_, blocks_) + rim_mobility(other, model_, blocks_));
    }

    Index block_;
    const Model& model_;
    const Contacts& contacts_;
    const Blocks& blocks_;
    Eigen::Matrix3d sum_ = Eigen::Matrix3d::Zero();
    double everywhere_ = 0.0;  ///< in each direction [1/s2]
};

/// Is it faster than slow, or will it be before the step can grow?
bool moves(Index block, const StepRule& rule, const Model& model, const Blocks& blocks)
{
    return rim_speed(block, model, blocks) + unbalance(block, model, blocks) * grow_every * model.time_step >= rule.slow;
}

/// Do only narrow contacts hold a block, as a corner beside a corner does? As it gives way by a thousandth of its size, they become many times as long and stiff. So they are looked at
/// whenever speeds are.
bool is_held_narrowly(Index block, double size, const Model& model, const Blocks& blocks)
{
    const double step = blocks.stable_step[block];
    return step * step * model.greatest_stiffness * size > narrow_step * model.mass[block];
}

bool is_alone(Index block, const BlockContacts& list)
{
    return list.begin[block] == list.begin[block + 1];
}

/// How long a block may move as it does, or longer than `least` if that is less [s].
double motion_bound(Index block, double size, double least, const Model& model, const BlockContacts& list, const Blocks& blocks)
{
    const BlockMotion& m = blocks.motion[block];
    const double shift_squared = m.vx * m.vx + m.vy * m.vy, turn = std::abs(m.w) * model.radius[block];
    const bool alone = is_alone(block, list);
    const double share = blocks.force[block].contacts == 0 ? approach_share : slide_share;
    const double way = alone ? flight_share * blocks.margin[block] : share * size;
    constexpr double at_least = 2.001;  // (a + b)^2 <= 2 (a^2 + b^2): most blocks need neither a root nor a division
    if (!alone && at_least * (shift_squared + turn * turn) * least * least < way * way)
        return infinity;
    const double speed = std::sqrt(shift_squared) + turn;
    const double rate = alone ? swing_rate(block, model) : 0.0;
    return std::min(speed > 0.0 ? way / speed : infinity, rate > 0.0 ? swing_share / rate : infinity);
}
}  // namespace

double stable_step_of(Index block, const Model& model, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks)
{
    SpringSum sum(block, model, contacts, blocks);
    for (Index e = list.begin[block]; e < list.begin[block + 1]; ++e)
        sum.add(list.entry[e] / 2);
    sum.add_bolts();
    const double greatest = sum.greatest_eigenvalue();
    return greatest > 0.0 ? 2.0 / std::sqrt(greatest) : infinity;
}

void forget_stable_steps(const StepRule& rule, State& state)
{
    if (!rule.varies || state.cycle == state.stage_begin_cycle)
        std::ranges::fill(state.blocks.stable_step, not_looked_at);
}

StepBound bound_steps(IndexRange range, const StepRule& rule, bool look_at_all, const Model& model, const BlockContacts& list,
                      const Contacts& contacts, Blocks& blocks)
{
    StepBound bound;
    for (Index b = range.begin; b < range.end; ++b)
    {
        if (!blocks.is_free(b))
            continue;
        const bool takes_part = blocks.takes_part(b);
        if (!takes_part && !is_beside_moving(b, list, contacts, blocks))
            continue;
        const double size = model.size(b);
        if (look_at_all || blocks.stable_step[b] == not_looked_at || is_held_narrowly(b, size, model, blocks))
            blocks.stable_step[b] = stable_step_of(b, model, list, contacts, blocks);
        const double share = is_held_narrowly(b, size, model, blocks) ? narrow_share * rule.stable_share : rule.stable_share;
        const double stable = share * blocks.stable_step[b];
        const double least = std::min(stable, motion_bound(b, size, std::min(stable, bound.touching), model, list, blocks));
        const double falls = rule.falls_by > 0.0 ? std::sqrt(fall_share * size / rule.falls_by) : infinity;
        const bool is_loose = blocks.is_loose(b, rule.loose_distance);
        if (is_loose && is_alone(b, list))
            bound.flying = std::min(bound.flying, least);
        else
            bound.touching = std::min({bound.touching, least, falls});
        bound.standing_moves =  // asked for only where a given step is kept
            bound.standing_moves || (rule.keeps_given && takes_part && !is_loose && moves(b, rule, model, blocks));
    }
    return bound;
}

namespace
{
/// The greatest 2^(n/8) that is no more than the ratio, up to round-off.
double in_steps(double ratio)
{
    constexpr double round_off = 1.0 + 8.7e-11;
    int octave = 0;
    const double part = 2.0 * std::frexp(ratio * round_off, &octave);
    return std::ldexp(*(std::ranges::upper_bound(part_of_octave, part) - 1), octave - 1);
}

bool keeps_base(const StepBound& bound, const StepRule& rule, double base)
{
    return rule.keeps_given && (bound.standing_moves || bound.least() < base);
}
}  // namespace

double next_step(double last, const StepBound& bound, const StepRule& rule, double base, bool may_grow)
{
    if (keeps_base(bound, rule, base) || bound.least() == infinity)
        return base;
    const double most = std::min({bound.least(), (may_grow ? 2.0 : 1.0) * std::max(last, base), longest * base});
    return base * in_steps(most / base);
}

bool flies_ahead(const StepBound& bound, const StepRule& rule, double base)
{
    return rule.flies_ahead && bound.flying < infinity &&
           (keeps_base(bound, rule, base) ? base : bound.touching) < 0.5 * bound.flying;
}
}  // namespace hdem
