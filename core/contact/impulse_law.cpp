#include "core/contact/impulse_law.h"

#include "core/contact/impulse_kick.h"
#include "core/contact/impulse_pair.h"
#include "core/contact/regime.h"
#include "core/detection/edge_touch.h"
#include "core/joint/impulse_strength.h"

#include <algorithm>
#include <limits>

namespace hdem
{
namespace
{
ImpulseStrength strength_of(const Model& model, const Contacts& contacts, Index contact, int end)
{
    const Index law = contacts.law[contact];
    const CoulombSlip& slip = model.joints.laws[law];
    if (!model.joints.has_memory(law))
        return {slip.friction_coefficient, slip.cohesion, 0.0};
    return impulse_strength(slip, model.joints.rows[law], contacts.memory(end, contact));
}

/// Opening of a dilatant joint by slip in the last cycle; below 0: it has closed [m].
double opened(const Model& model, const Contacts& contacts, Index contact, int end, double slide)
{
    const Index law = contacts.law[contact];
    if (!model.joints.has_memory(law))
        return 0.0;
    JointMemory memory = contacts.memory(end, contact);
    const double now = dilation_by_slip(model.joints.rows[law], memory);
    memory.slip += slide;
    return now - dilation_by_slip(model.joints.rows[law], memory);
}

ImpulsePoint make_point(Index contact, int end, const Model& model, const Blocks& blocks, const Contacts& contacts,
                        const EdgeTouch& touch)
{
    const TouchPoint& at = touch.point[end];
    const CoulombSlip& joint = model.joints.laws[contacts.law[contact]];
    const double dt = blocks.step.kick();
    ImpulsePoint p;
    p.contact = contact;
    p.ref = contacts.ref[contact];
    p.inc = contacts.inc[contact];
    p.end = end;
    p.t_x = touch.ex;
    p.t_y = touch.ey;
    p.ref_t = at.ref_t;
    p.ref_m = at.ref_m;
    p.inc_t = at.inc_t;
    p.inc_m = at.inc_m;
    const BlockInertia& ref = blocks.inertia[p.ref];
    const BlockInertia& inc = blocks.inertia[p.inc];
    // Where neither block can be moved along an axis, no impulse can bring it to rest. Across the joint there is none then; along it friction
    // resists with all that it has.
    const auto mass = [](double inverse, double unmovable) { return inverse > 0.0 ? 1.0 / inverse : unmovable; };
    p.mass_normal = mass(inverse_collision_mass(ref, at.ref_t, inc, at.inc_t, -touch.ey, touch.ex), 0.0);
    p.mass_shear = mass(inverse_collision_mass(ref, at.ref_m, inc, at.inc_m, touch.ex, touch.ey),
                        std::numeric_limits<double>::max());
    p.approach = at.v_m;
    p.restitution = joint.restitution;
    const ImpulseStrength grip = strength_of(model, contacts, contact, end);
    p.friction = grip.friction;
    const double length = point_length(touch.length, contacts.length_floor(contact));
    const double cohesive = grip.cohesion * length * dt;
    p.pull = grip.tension * length * dt;
    const double left = cohesive - grip.friction * p.pull;
    p.cohesive_impulse = left > -1e-12 * cohesive ? std::max(left, 0.0) : left;  // c = T tan(phi) up to round-off
    const double preload = contacts.preload(end, contact);
    p.overlap = at.overlap;
    p.pressed = at.overlap + preload + contacts.opening(end, contact);
    p.stiffness = joint.normal_stiffness * length;
    p.weight_velocity = model.gravity.norm() * dt;
    const double rest = contacts.rest_overlap(end, contact);
    p.spring_force = p.stiffness * (p.pressed - rest);
    const double size = std::min(model.size(p.ref), model.size(p.inc));
    const double parting = opened(model, contacts, contact, end, at.v_t * blocks.step.last);
    const double most = std::max(at.v_m, 0.0) * blocks.step.last + std::max(parting, 0.0) +
                        model.contact.correction_rate * size * blocks.step.next;
    // Blocks follow a joint that closes, and stay in touch. A point that was lifted may close, but for a gap as small as the allowed overlap: round-off would move
    // blocks. One that bears tension is open because it is pulled.
    const double open = (parting < 0.0 ? 0.5 : -1.0) * model.contact.allowed_overlap - p.pressed;
    p.target = parting < 0.0 || p.pull == 0.0 ? std::max(open, 0.0) / blocks.step.next : 0.0;
    p.excess_overlap = std::min(rest - std::max(preload, 0.0) - model.contact.allowed_overlap,
                                most);  // what is pulled is not pushed apart
    p.impulse_normal = std::max(contacts.normal_force(end, contact) * dt + p.pull, 0.0);
    p.impulse_shear = slip_limited(contacts.shear_force(end, contact) * dt, shear_limit(p, p.impulse_normal));
    return p;
}

/// Change of the approach velocity at one point of a contact by a unit impulse at the other, the off-diagonal of the pair [1/kg].
double coupling(const ImpulsePoint& a, const ImpulsePoint& b, const Blocks& blocks)
{
    const BlockInertia& ref = blocks.inertia[a.ref];
    const BlockInertia& inc = blocks.inertia[a.inc];
    return (ref.inverse_mass_x + inc.inverse_mass_x) * a.t_y * a.t_y + (ref.inverse_mass_y + inc.inverse_mass_y) * a.t_x * a.t_x +
           ref.inverse_inertia * a.ref_t * b.ref_t + inc.inverse_inertia * a.inc_t * b.inc_t;
}

double solve_shear(ImpulsePoint& p, Blocks& blocks)
{
    const double v_t = relative_velocity(p, blocks.motion[p.ref], blocks.motion[p.inc]).t;
    const double last = p.impulse_shear;
    p.impulse_shear = slip_limited(last - p.mass_shear * v_t, shear_limit(p, p.impulse_normal));
    return push(p, p.impulse_shear - last, 0.0, blocks);
}

/// J [N s]
double pressing(const ImpulsePoint& p)
{
    return p.impulse_normal - p.pull;
}

/// Impulses times the velocities that they have still to take away [J]. With a share s of the impulses applied it is b - s c; what is left to be
/// done changes by s^2 c / 2 - s b, which is least for s = b / c and a gain of energy from s = 2 b / c on.
double demand(const std::vector<ImpulsePoint>& points, const Blocks& blocks)
{
    double sum = 0.0;
    for (const ImpulsePoint& p : points)
    {
        const PointVelocity v = relative_velocity(p, blocks.motion[p.ref], blocks.motion[p.inc]);
        sum += pressing(p) * (v.m - p.target) - p.impulse_shear * v.t;
    }
    return sum;
}

/// Energy gains from this many times what weight alone may do are those of impacts. (At 1 a wall tilted to 0.1 degrees below its friction angle moved.)
constexpr double noticeable = 20.0;

/// What weight alone may make of the demand at rest, where parts that are started one after another see the impulses of others not yet applied [J].
double weight_demand(const std::vector<ImpulsePoint>& points)
{
    double sum = 0.0;
    for (const ImpulsePoint& p : points)
        sum += (std::abs(pressing(p)) + std::abs(p.impulse_shear)) * p.weight_velocity;
    return sum;
}

/// (A point that cannot be moved across the joint has no impulse there: the axis of a block that only turns lies above or below it.)
bool are_pair(const std::vector<ImpulsePoint>& points, std::size_t i)
{
    return i + 1 < points.size() && points[i + 1].contact == points[i].contact && points[i].mass_normal > 0.0 &&
           points[i + 1].mass_normal > 0.0;
}
}  // namespace

void collect_impulse_points(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                            std::vector<ImpulsePoint>& points)
{
    constexpr auto impulse = static_cast<std::uint8_t>(Regime::impulse);
    for (Index i = range.begin; i < range.end; ++i)
    {
        if (contacts.regime[0][i] != impulse && contacts.regime[1][i] != impulse)
            continue;
        const BlockMotion& ref = blocks.motion[contacts.ref[i]];
        const BlockMotion& inc = blocks.motion[contacts.inc[i]];
        const EdgePair edges = contacts.edges(i);
        const EdgeTouch touch = touch_edges(edges, ref, inc);
        for (int k = 0; k < 2; ++k)
            if (contacts.regime[k][i] == impulse)
                points.push_back(make_point(i, k, model, blocks, contacts, touch));
        if (contacts.regime[0][i] == impulse && contacts.regime[1][i] == impulse)
            points[points.size() - 2].coupling = coupling(points[points.size() - 2], points.back(), blocks);
    }
}

/// Slower approaches do not bounce [m/s]. Weight gives g dt in a cycle; at twice of it steps cannot follow a bounce. And flights last whole cycles: a block that comes with
/// v = g dt / (1 - R), loses g dt in the bounce, and has it back one cycle later, would hop for ever.
double least_bounce(const ImpulsePoint& p)
{
    constexpr double least = 2.0, most = 20.0;
    const double lost = 1.0 - p.restitution;
    return p.weight_velocity * std::clamp(lost > 0.0 ? 1.2 / lost : most, least, most);
}

bool is_impact(const ImpulsePoint& p)
{
    return p.approach - p.target > least_bounce(p);
}

void aim_impulses(const Blocks& blocks, std::vector<ImpulsePoint>& points)
{
    for (ImpulsePoint& p : points)
    {
        const double v_m = relative_velocity(p, blocks.motion[p.ref], blocks.motion[p.inc]).m;
        const double pressed = std::max(0.0, v_m - p.approach);
        p.load_velocity = std::max(p.weight_velocity, pressed);
        const double impact = p.approach - p.target;
        if (impact <= 0.0)
            continue;
        if (is_impact(p))
            p.target += std::min(0.0, pressed - p.restitution * impact);
        if (p.target < 0.0 && p.overlap > 0.0 && p.overlap <= p.approach * blocks.step.last)
            p.excess_overlap -= p.target / p.approach * p.overlap;
    }
}

namespace
{
/// Of what the impulses by themselves would do: what rounding leaves of forces that balance.
constexpr double rounding = 1e-9;

double rounded_demand(const std::vector<ImpulsePoint>& points)
{
    double sum = 0.0;
    for (const ImpulsePoint& p : points)
        if (p.mass_normal > 0.0)
            sum += rounding * (pressing(p) * pressing(p) + p.impulse_shear * p.impulse_shear) / p.mass_normal;
    return sum;
}
}  // namespace

double start_impulses(const std::vector<std::vector<ImpulsePoint>*>& lists, bool are_stressed, Blocks& blocks)
{
    double loss = 0.0, before = 0.0, after = 0.0, allowed = 0.0;
    for (const auto* points : lists)
        before += demand(*points, blocks);
    for (auto* points : lists)
        for (ImpulsePoint& p : *points)
            loss += push(p, p.impulse_shear, -pressing(p), blocks);
    for (const auto* points : lists)
    {
        after += demand(*points, blocks);
        allowed += noticeable * weight_demand(*points) + (are_stressed ? rounded_demand(*points) : 0.0);
    }
    if (before + after >= -allowed)  // 2 b >= c
        return loss;
    const double share = before > 0.0 ? before / (before - after) : 0.0;
    for (auto* points : lists)
        for (ImpulsePoint& p : *points)
        {
            loss += push(p, (share - 1.0) * p.impulse_shear, (1.0 - share) * pressing(p), blocks);
            p.impulse_shear *= share;
            p.impulse_normal = p.pull + share * pressing(p);
        }
    return loss;
}

double sweep_impulses(std::vector<ImpulsePoint>& points, Blocks& blocks)
{
    double loss = 0.0;
    const auto change_normal = [&](ImpulsePoint& p, double impulse)
    {
        const double change = impulse - p.impulse_normal;
        p.impulse_normal = impulse;
        loss += push(p, 0.0, -change, blocks);
    };
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        ImpulsePoint& p = points[i];
        const bool pair = are_pair(points, i);
        if (pair)
        {
            const auto [first, second] = pair_normal(p, points[i + 1], blocks);
            change_normal(p, first);
            change_normal(points[i + 1], second);
            loss += solve_shear(p, blocks);
            loss += solve_shear(points[++i], blocks);
            continue;
        }
        change_normal(p, single_normal(p, blocks));
        loss += solve_shear(p, blocks);
    }
    return loss;
}

void count_from_zero(std::vector<ImpulsePoint>& points)
{
    for (ImpulsePoint& p : points)
    {
        p.impulse_normal -= p.pull;
        p.cohesive_impulse += p.friction * p.pull;
    }
}
}  // namespace hdem
