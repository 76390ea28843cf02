#include "core/motion/pace.h"

#include "core/detection/contact_tracking.h"
#include "core/detection/edge_touch.h"
#include "core/motion/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double greatest = 64.0;                 // pace, of the rock and beyond it
constexpr double round_off = 1.0 + 1e-9;          // of products of ratios
constexpr double finest = 1.0905077326652576592;  // 2^(1/8), between two paces
constexpr double slide_share = 1.5e-3;            // of the block's size a cycle
constexpr double approach_share = 0.05;           // of the way to what is near, a cycle
constexpr double
    stable_swing = 1.4;  // w dt: sqrt(2) less than what is stable beside something immovable, for what it touches may move as well
constexpr double gentle_share = 0.03;  // of sqrt(g size): impacts below are those of rocking and sliding
constexpr double still_share = 0.5;    // of the criterion's kinetic energy: the standing rock is at rest below it
constexpr double move_speeds = 10.0;   // of the criterion's mean speed: blocks that are faster move

/// Greatest of the paces base, base 2^(1/8), base 2^(2/8), ... that is not above `bound`; base if all are.
double floor_pace(double base, double bound)
{
    double pace = base;
    const double most = std::min(bound, base * greatest * round_off);
    while (pace * finest <= most)
        pace *= finest;
    return pace;
}

void set_pace(double pace, Index block, const Model& model, Blocks& blocks)
{
    const double n = pace / blocks.pace[block];
    blocks.pace[block] = pace;
    BlockMotion& motion = blocks.motion[block];
    motion.vx *= n;
    motion.vy *= n;
    motion.w *= n;
    BlockInertia& inertia = blocks.inertia[block];
    const BlockInertia& full = model.full_inertia[block];
    const auto scale = [&](double& inverse, double own) { inverse = inverse > 0.0 ? pace * pace * own : 0.0; };
    scale(inertia.inverse_mass_x, full.inverse_mass_x);
    scale(inertia.inverse_mass_y, full.inverse_mass_y);
    scale(inertia.inverse_inertia, full.inverse_inertia);
}

/// What touches a block, or nearly does.
struct Surroundings
{
    double frequency_squared = 0.0;  ///< bound on that of its own swinging on their springs, were all of them closed [1/s2]
    double time_to_hit = infinity;   ///< until the first open one closes hard [s]
};

/// Squared frequency that one point's two springs can give a block: its share in the trace of M^-1 K.
double frequency_squared(const Contact& contact, const CoulombSlip& joint, const TouchPoint& p, Index block,
                         const BlockInertia& inertia)
{
    const double lever_n = contact.ref == block ? p.ref_t : p.inc_t;
    const double lever_s = contact.ref == block ? p.ref_m : p.inc_m;
    return contact.last_length * (joint.normal_stiffness * (inertia.inverse_mass_x + inertia.inverse_inertia * lever_n * lever_n) +
                                  joint.shear_stiffness * (inertia.inverse_mass_x + inertia.inverse_inertia * lever_s * lever_s));
}

Surroundings look_around(Index block, const Model& model, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks)
{
    Surroundings s;
    const double pace = blocks.pace[block];
    const double gentle = gentle_share * std::sqrt(model.gravity.norm() * model.size(block));
    for (Index e = list.begin[block]; e < list.begin[block + 1]; ++e)
    {
        const Contact contact = contacts.get(list.entry[e] / 2);
        const BlockMotion& ref = blocks.motion[contact.ref];
        const BlockMotion& inc = blocks.motion[contact.inc];
        const EdgeTouch touch = touch_edges(contact.edges, ref, inc);
        for (int k = 0; k < 2; ++k)
        {
            const TouchPoint& p = touch.point[k];
            const double closing = p.v_m / pace;
            if (contact.point[k].regime == Regime::open && touch.length > 0.0 && closing > gentle)
                s.time_to_hit = std::min(s.time_to_hit, std::max(0.0, -p.overlap) / closing);
            if (p.overlap < -skin_width(model))
                continue;
            s.frequency_squared += frequency_squared(contact, model.joints.laws[contact.law], p, block, model.full_inertia[block]);
        }
    }
    return s;
}

/// Greatest pace that a loose block by itself may have now.
double bound_of(Index block, const Model& model, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks)
{
    const double step = std::max(way_a_cycle(block, model, blocks) / blocks.pace[block], 1e-300);
    if (list.begin[block] == list.begin[block + 1])
        return flight_share * blocks.margin[block] / step;
    const Surroundings around = look_around(block, model, list, contacts, blocks);
    return std::min({slide_share * model.size(block) / step, approach_share * around.time_to_hit / model.time_step,
                     stable_swing / (std::sqrt(around.frequency_squared) * model.time_step)});
}

/// The least bound of a block and the loose ones it touches: blocks that touch keep the same time, or they would slip on each other for no reason. Nor
/// can a block that sticks to standing rock run ahead.
double joint_bound(Index block, const BlockContacts& list, const Contacts& contacts, const std::vector<double>& bounds)
{
    double bound = bounds[block];
    for (Index e = list.begin[block]; e < list.begin[block + 1]; ++e)
    {
        const Index i = list.entry[e] / 2;
        const auto has = [&](Regime regime)
        {
            return contacts.regime[0][i] == static_cast<std::uint8_t>(regime) ||
                   contacts.regime[1][i] == static_cast<std::uint8_t>(regime);
        };
        if (!has(Regime::stick) && !has(Regime::slip) && !has(Regime::impulse))
            continue;
        const Index other = contacts.ref[i] == block ? contacts.inc[i] : contacts.ref[i];
        if (bounds[other] > 0.0)
            bound = std::min(bound, bounds[other]);
        else if (has(Regime::stick))
            return 1.0;
    }
    return bound;
}
}  // namespace

StandingRock bound_paces(IndexRange range, const Model& model, const BlockContacts& list, const Contacts& contacts,
                         const Blocks& blocks, std::vector<double>& bounds)
{
    StandingRock standing;
    for (Index b = range.begin; b < range.end; ++b)
    {
        const bool loose = blocks.is_loose(b, model.convergence.loose_distance);
        bounds[b] = loose ? std::max(bound_of(b, model, list, contacts, blocks), 1.0) : 0.0;
        if (!blocks.is_free(b))
            continue;
        standing.free_mass += model.mass[b];
        standing.kinetic_energy += loose ? 0.0 : kinetic_energy(model, blocks, b);
    }
    return standing;
}

double join_bounds(IndexRange range, const Model& model, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks,
                   const std::vector<double>& bounds, std::vector<double>& joined)
{
    double least = infinity;
    const double slow = move_speeds * model.convergence.mean_speed;
    for (Index b = range.begin; b < range.end; ++b)
    {
        joined[b] = bounds[b] == 0.0 ? 0.0 : joint_bound(b, list, contacts, bounds);
        if (bounds[b] > 0.0 && kinetic_energy(model, blocks, b) > 0.5 * model.mass[b] * slow * slow)
            least = std::min(least, joined[b]);
    }
    return least;
}

double next_loose_pace(const Model& model, const Paces& last, const StandingRock& standing, double bound, bool may_grow)
{
    const double slow = model.convergence.mean_speed;
    if (bound == infinity || standing.kinetic_energy > still_share * 0.5 * standing.free_mass * slow * slow)
        return last.rock;
    const double most = std::max(may_grow ? 2.0 * last.loose : last.loose, last.rock);
    return bound < most ? floor_pace(last.rock, bound) : floor_pace(last.rock, most * round_off);
}

double rock_pace(const Model& model, double step)
{
    return floor_pace(1.0, model.stable_fraction * step / model.time_step);
}

void set_paces(IndexRange range, const Model& model, const Paces& paces, const std::vector<double>& joined, Blocks& blocks)
{
    for (Index b = range.begin; b < range.end; ++b)
    {
        if (!blocks.is_free(b))
            continue;
        const double pace = joined[b] == 0.0 ? paces.rock : floor_pace(paces.rock, std::min(joined[b], paces.loose * round_off));
        if (pace != blocks.pace[b])
            set_pace(pace, b, model, blocks);
    }
}

void reset_paces(const Model& model, State& state)
{
    state.pace = {};
    for (Index b = 0; b < state.blocks.size(); ++b)
        if (state.blocks.pace[b] != 1.0)
            set_pace(1.0, b, model, state.blocks);
}

bool is_pace(double pace)
{
    return pace >= 1.0 && pace <= greatest * greatest * round_off;
}

bool are_paces(const Paces& paces)
{
    return paces.rock >= 1.0 && paces.rock <= greatest * round_off && paces.loose >= paces.rock &&
           paces.loose <= paces.rock * greatest * round_off;
}
}  // namespace hdem
