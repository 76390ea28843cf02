#include "core/contact/contact_forces.h"

#include "core/contact/force_law.h"
#include "core/contact/regime.h"
#include "core/detection/edge_touch.h"
#include "core/energy_ledger.h"

namespace hdem
{
namespace
{
/// What the threshold velocity needs of a cycle.
struct Threshold
{
    double scale;
    double gravity_velocity;  ///< dt |g| [m/s]
    double fixed;             ///< given velocity, or negative [m/s]
};

/// Masses of a block in the threshold velocity. A fixed block may keep its mass, but never turns: where the paper's ground counts,
/// m_c = m/2 without levers.
inline BlockInertia threshold_inertia(const Model& model, const Blocks& blocks, Index block)
{
    BlockInertia inertia = blocks.inertia[block];
    if (model.contact.fixed_mass_counts)
    {
        inertia.inverse_mass_x = model.full_inertia[block].inverse_mass_x;
        inertia.inverse_mass_y = model.full_inertia[block].inverse_mass_y;
    }
    return inertia;
}

/// Regime of a contact under the hybrid method, Eq. (24): impulse as soon as one of its closed points is faster than the threshold.
inline bool is_fast(const EdgeTouch& touch, const CoulombSlip& joint, double length, double length_floor, const BlockInertia& ref,
                    const BlockInertia& inc, const double last_normal[2], const double last_shear[2], const Threshold& threshold)
{
    double elastic = 0.0;
    double speed = 0.0;
    for (int k = 0; k < 2; ++k)
    {
        const TouchPoint& p = touch.point[k];
        const double mass_n = inverse_collision_mass(ref, p.ref_t, inc, p.inc_t, -touch.ey, touch.ex);
        const double mass_s = inverse_collision_mass(ref, p.ref_m, inc, p.inc_m, touch.ex, touch.ey);
        elastic += elastic_velocity_squared(last_normal[k], joint.normal_stiffness * length, mass_n, last_shear[k],
                                            joint.shear_stiffness * length, mass_s);
        const double squared = p.v_t * p.v_t + p.v_m * p.v_m;
        speed = std::max(speed, is_closed(touch.length, p.overlap, length_floor) ? squared : 0.0);
    }
    const double u_th = threshold.fixed >= 0.0 ? threshold.fixed
                                               : threshold_velocity(threshold.scale, threshold.gravity_velocity, elastic);
    // A block that gravity has pulled for one cycle has just dt |g|: rounding must not decide that tie.
    return speed > u_th * u_th * (1.0 + 1e-9);
}

inline bool has_moved(const Contacts& contacts, Index i, const EdgeView& v)
{
    const auto off = [](double now, float seen) { return std::abs(static_cast<float>(now) - seen); };
    const float d0 = std::max(off(v.t0, contacts.seen0[i]), off(v.m0, contacts.seen1[i]));
    const float d1 = std::max(off(v.t1, contacts.seen2[i]), off(v.m1, contacts.seen3[i]));
    return !(std::max(d0, d1) <= contacts.moved_limit[i]);
}

template <Method method>
void evaluate(IndexRange range, const Model& model, const Blocks& blocks, Contacts& contacts, ContactLoads& loads)
{
    const double dt = model.time_step;
    const Threshold threshold{model.threshold_scale, dt * model.gravity.norm(), model.contact.threshold_velocity.value_or(-1.0)};
    for (Index i = range.begin; i < range.end; ++i)
    {
        const Index ref = contacts.ref[i];
        const Index inc = contacts.inc[i];
        const EdgePair edges = contacts.edges(i);
        const EdgeView view = view_edges(edges, blocks.motion[ref], blocks.motion[inc]);
        const EdgeTouch touch = touch_edges(edges, view, blocks.motion[ref], blocks.motion[inc]);
        const CoulombSlip& joint = model.joints.laws[contacts.law[i]];
        const double length = point_length(touch.length, contacts.length_floor[i]);
        contacts.stale[i] = has_moved(contacts, i, view) ? 1 : 0;

        bool impulsive = method == Method::impulse;
        if constexpr (method == Method::hybrid)
        {
            double last_normal[2], last_shear[2];
            for (int k = 0; k < 2; ++k)
            {
                // Springs that an impulse has emptied have stored nothing.
                const double stored = contacts.regime[k][i] == static_cast<std::uint8_t>(Regime::impulse) ? 0.0 : 1.0;
                last_normal[k] = stored * contacts.normal_force[k][i];
                last_shear[k] = stored * contacts.shear_force[k][i];
            }
            impulsive = is_fast(touch, joint, length, contacts.length_floor[i], threshold_inertia(model, blocks, ref),
                                threshold_inertia(model, blocks, inc), last_normal, last_shear, threshold);
        }

        double f_t = 0.0, f_m = 0.0, moment_ref = 0.0, moment_inc = 0.0, friction = 0.0, changes = 0.0, mobilised = -1.0,
               reserve = 0.0;
        for (int k = 0; k < 2; ++k)
        {
            const TouchPoint& p = touch.point[k];
            double& normal = contacts.normal_force[k][i];
            double& shear = contacts.shear_force[k][i];
            const bool closed = is_closed(touch.length, p.overlap, contacts.length_floor[i]);
            const bool was_impulse = contacts.regime[k][i] == static_cast<std::uint8_t>(Regime::impulse);
            const double spring_normal = was_impulse ? 0.0 : normal;
            const double spring_shear = was_impulse ? 0.0 : shear;
            double& rest = contacts.rest_overlap[k][i];
            const double last_rest = rest;
            rest = method == Method::force ? 0.0
                                           : rest_overlap(was_impulse, p.overlap, rest, normal, joint.normal_stiffness * length);
            const TurningRate turning(p, blocks.motion[ref].w, blocks.motion[inc].w);
            const double curved = 0.5 * dt * turning.t;
            const double v_t = p.v_t - curved;  // amid the last step, where the shear displacement is of second order
            const PointForce f = spring_force(joint, length, p.overlap - rest, v_t, dt, shear);
            const Regime spring_regime = f.slip > 0.0 ? Regime::slip : Regime::stick;
            contacts.regime[k][i] = static_cast<std::uint8_t>(closed ? (impulsive ? Regime::impulse : spring_regime)
                                                                     : Regime::open);
            // The history of an impulse point stays until its impulses of this cycle are known.
            const double on = closed && !impulsive ? 1.0 : 0.0;
            const double keep = closed && impulsive ? 1.0 : 0.0;
            // Energies of this step; u is the stretch of the normal spring, e of the shear spring.
            double& last_overlap = contacts.overlap[k][i];
            const double u = p.overlap - (was_impulse ? rest : last_rest);
            // Way of the point after the last force, along the reference edge's normal of then, beyond what the overlap gained.
            const double strayed = (p.v_m - turning.m * dt) * dt - (p.overlap - last_overlap);
            last_overlap = p.overlap;
            const double shear_stiffness = joint.shear_stiffness * length;
            const double plastic = -v_t * dt - (on * f.shear - spring_shear) / shear_stiffness;
            const double slipped = 0.5 * (spring_shear + on * f.shear) * plastic;
            const bool stays = closed && !impulsive && spring_normal + std::abs(spring_shear) > 0.0;
            friction += stays ? slipped : 0.0;
            changes += (stays ? 0.0 : slipped) + change_energy(spring_normal, u, on * f.normal, u - p.v_m * dt) +
                       0.5 * spring_normal * strayed + 0.5 * (spring_shear - on * f.shear) * curved * dt +
                       0.5 * spring_shear * spring_shear / joint.shear_stiffness * (1.0 / contacts.last_length[i] - 1.0 / length);
            rest *= on;
            mobilised = std::max(mobilised, on * (1.0 + f.mobilised) - 1.0);
            reserve += on * f.reserve;
            normal = on * f.normal + keep * normal;
            shear = on * f.shear + keep * shear;
            f_t += on * f.shear;
            f_m -= on * f.normal;
            moment_inc -= on * (p.inc_t * f.normal + p.inc_m * f.shear);
            moment_ref += on * (p.ref_t * f.normal + p.ref_m * f.shear);
        }
        contacts.last_length[i] = length;
        loads.x[i] = touch.ex * f_t - touch.ey * f_m;
        loads.y[i] = touch.ey * f_t + touch.ex * f_m;
        loads.moment_ref[i] = moment_ref;
        loads.moment_inc[i] = moment_inc;
        loads.friction[i] = friction;
        loads.changes[i] = changes;
        loads.mobilised[i] = static_cast<float>(mobilised);
        loads.reserve[i] = static_cast<float>(reserve);
        loads.t_x[i] = static_cast<float>(touch.ex);
        loads.t_y[i] = static_cast<float>(touch.ey);
    }
}

inline std::uint32_t contact_bits(std::uint8_t regime)
{
    constexpr std::uint32_t bits[] = {0, contact_force, contact_force, contact_impulse};
    return bits[regime];
}
}  // namespace

void evaluate_contacts(IndexRange range, const Model& model, Method method, const Blocks& blocks, Contacts& contacts,
                       ContactLoads& loads)
{
    switch (method)
    {
    case Method::force:
        return evaluate<Method::force>(range, model, blocks, contacts, loads);
    case Method::impulse:
        return evaluate<Method::impulse>(range, model, blocks, contacts, loads);
    case Method::hybrid:
        return evaluate<Method::hybrid>(range, model, blocks, contacts, loads);
    }
}

void accumulate_loads(IndexRange range, const Contacts& contacts, const ContactLoads& loads, std::vector<BlockForce>& force,
                      EnergyLedger& ledger)
{
    const auto joint_at = [&](BlockForce& block, Index i)
    {
        block.contacts |= contact_bits(contacts.regime[0][i]) | contact_bits(contacts.regime[1][i]);
        block.reserve += loads.reserve[i];
        if (loads.mobilised[i] <= block.mobilised)
            return;
        block.mobilised = loads.mobilised[i];
        block.t_x = loads.t_x[i];
        block.t_y = loads.t_y[i];
    };
    for (Index i = range.begin; i < range.end; ++i)
    {
        ledger.friction += loads.friction[i];
        ledger.contact_changes += loads.changes[i];
        if (contacts.regime[0][i] == 0 && contacts.regime[1][i] == 0)
            continue;
        BlockForce& ref = force[contacts.ref[i]];
        BlockForce& inc = force[contacts.inc[i]];
        ref.x -= loads.x[i];
        ref.y -= loads.y[i];
        ref.moment += loads.moment_ref[i];
        joint_at(ref, i);
        inc.x += loads.x[i];
        inc.y += loads.y[i];
        inc.moment += loads.moment_inc[i];
        joint_at(inc, i);
    }
}
}  // namespace hdem
