#include "core/motion/pace.h"

#include "core/detection/contact_tracking.h"
#include "core/detection/edge_touch.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double most = 64.0;
constexpr double slide_share = 7.5e-4;  // of the block's size a cycle
constexpr double flight_share = 0.05;   // of the way to what is near, a cycle
constexpr double gentle_share = 0.1;    // of sqrt(g size): impacts below are those of rocking and sliding

void set_pace(double pace, Index block, Blocks& blocks)
{
    const double n = pace / blocks.pace[block];
    blocks.pace[block] = pace;
    BlockMotion& motion = blocks.motion[block];
    motion.vx *= n;
    motion.vy *= n;
    motion.w *= n;
    BlockInertia& inertia = blocks.inertia[block];
    inertia.inverse_mass_x *= n * n;
    inertia.inverse_mass_y *= n * n;
    inertia.inverse_inertia *= n * n;
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
        const EdgeTouch touch = touch_edges(contact.edges, view_edges(contact.edges, ref, inc), ref, inc);
        for (int k = 0; k < 2; ++k)
        {
            const TouchPoint& p = touch.point[k];
            s.frequency_squared += frequency_squared(contact, model.joints.laws[contact.law], p, block, model.full_inertia[block]);
            const double closing = p.v_m / pace;
            if (contact.point[k].regime == Regime::open && touch.length > 0.0 && closing > gentle)
                s.time_to_hit = std::min(s.time_to_hit, std::max(0.0, -p.overlap) / closing);
        }
    }
    return s;
}

bool is_loose(Index block, const Model& model, const Blocks& blocks)
{
    const BlockInertia& inertia = blocks.inertia[block];
    const double distance = model.convergence.loose_distance;
    return blocks.present[block] != 0 && inertia.inverse_mass_x > 0.0 && inertia.inverse_mass_y > 0.0 &&
           inertia.inverse_inertia > 0.0 && blocks.displacement(block).squaredNorm() > distance * distance;
}

/// Greatest pace that a loose block by itself may have now.
double bound_of(Index block, const Model& model, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks)
{
    const BlockMotion& motion = blocks.motion[block];
    const double speed = (std::hypot(motion.vx, motion.vy) + std::abs(motion.w) * model.radius[block]) / blocks.pace[block];
    const double step = std::max(speed * model.time_step, 1e-300);
    if (list.begin[block] == list.begin[block + 1])
        return flight_share * skin_width(model) / step;
    const Surroundings around = look_around(block, model, list, contacts, blocks);
    return std::min({slide_share * model.size(block) / step, flight_share * around.time_to_hit / model.time_step,
                     1.0 / (std::sqrt(around.frequency_squared) * model.time_step)});
}

/// The least bound of a block and the loose ones it touches: blocks that touch keep the same time, or they would slip on each other for no reason. Nor
/// can a block that sticks to standing rock run ahead.
double common_bound(Index block, const BlockContacts& list, const Contacts& contacts, const std::vector<double>& bounds)
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

void bound_paces(IndexRange range, const Model& model, const BlockContacts& list, const Contacts& contacts, const Blocks& blocks,
                 std::vector<double>& bounds)
{
    for (Index b = range.begin; b < range.end; ++b)
        bounds[b] = is_loose(b, model, blocks) ? std::max(bound_of(b, model, list, contacts, blocks), 1.0) : 0.0;
}

void update_paces(IndexRange range, const BlockContacts& list, const Contacts& contacts, const std::vector<double>& bounds,
                  bool may_grow, Blocks& blocks)
{
    for (Index b = range.begin; b < range.end; ++b)
    {
        if (bounds[b] == 0.0)
            continue;
        const double bound = common_bound(b, list, contacts, bounds);
        const double old = blocks.pace[b];
        double pace = may_grow ? std::min(2.0 * old, most) : old;
        while (pace > 1.0 && pace > bound)
            pace *= 0.5;
        if (pace != old)
            set_pace(pace, b, blocks);
    }
}

bool is_pace(double pace)
{
    int exponent = 0;
    return pace >= 1.0 && pace <= most && std::frexp(pace, &exponent) == 0.5;
}

void reset_paces(Blocks& blocks)
{
    for (Index b = 0; b < blocks.size(); ++b)
        if (blocks.pace[b] != 1.0)
            set_pace(1.0, b, blocks);
}
}  // namespace hdem
