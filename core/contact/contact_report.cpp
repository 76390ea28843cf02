#include "core/contact/contact_report.h"

#include "core/boundary/side_forces.h"
#include "core/detection/edge_touch.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
EdgeTouch touch_of(const State& state, Index contact)
{
    const BlockMotion& ref = state.blocks.motion[state.contacts.ref[contact]];
    const BlockMotion& inc = state.blocks.motion[state.contacts.inc[contact]];
    const EdgePair edges = state.contacts.edges(contact);
    return touch_edges(edges, ref, inc);
}

/// Subtract the part of one force on a block, at `arm` from its centroid. The xy component gets half of x f_y + y f_x.
void add(MeanStress& stress, const Vec2& arm, const Vec2& force, double area)
{
    stress.xx -= arm.x() * force.x() / area;
    stress.yy -= arm.y() * force.y() / area;
    stress.xy -= 0.5 * (arm.x() * force.y() + arm.y() * force.x()) / area;
}
}  // namespace

bool have_met(const JointTable& joints, Index law)
{
    return law >= static_cast<Index>(joints.names.size()) && law != joints.of_walls;
}

double broken_share(const JointTable& joints, Index law, const JointMemory& point)
{
    return have_met(joints, law) ? 1.0 : (joints.has_memory(law) ? point.broken : 0.0);
}

double damage_share(const JointTable& joints, Index law, const JointMemory& point)
{
    return have_met(joints, law) ? 1.0 : (joints.has_memory(law) ? damage(joints.rows[law], point) : 0.0);
}

bool is_closed_contact(const State& state, Index contact)
{
    const Contacts& contacts = state.contacts;
    return (contacts.regime[0][contact] != 0 || contacts.regime[1][contact] != 0) &&
           state.blocks.present[contacts.ref[contact]] != 0 && state.blocks.present[contacts.inc[contact]] != 0;
}

ContactReport report_contact(const State& state, Index contact)
{
    const Contacts& contacts = state.contacts;
    const EdgeTouch touch = touch_of(state, contact);
    const Vec2 along = {touch.ex, touch.ey};
    ContactReport report;
    report.first = contacts.ref[contact];
    report.second = contacts.inc[contact];
    report.normal = -turned_left(along);
    report.length = std::max(touch.length, 0.0);
    report.bearing_length = 2.0 * point_length(touch.length, contacts.length_floor(contact));
    const BlockMotion& ref = state.blocks.motion[report.first];
    double overlap = -std::numeric_limits<double>::infinity();
    for (int k = 0; k < 2; ++k)
    {
        const TouchPoint& p = touch.point[k];
        report.point[k] = Vec2(ref.x, ref.y) + p.ref_t * along + p.ref_m * turned_left(along);
        report.memory[k] = contacts.memory(k, contact);
        report.normal_force += contacts.normal_force(k, contact);
        report.shear_force += contacts.shear_force(k, contact);
        report.tilt_force += contacts.tilt_force(k, contact);
        const auto regime = static_cast<Regime>(contacts.regime[k][contact]);
        report.regime = std::max(report.regime, regime);
        report.closed_points += regime != Regime::open ? 1 : 0;
        report.impulse_points += regime == Regime::impulse ? 1 : 0;
        if (regime != Regime::open)
            overlap = std::max(overlap, p.overlap);
    }
    report.overlap = report.closed_points > 0 ? overlap : 0.0;
    return report;
}

double MeanStress::magnitude() const
{
    return std::sqrt(xx * xx + yy * yy + 2.0 * xy * xy);
}

std::vector<MeanStress> mean_stresses(const Model& model, const State& state)
{
    const Contacts& contacts = state.contacts;
    std::vector<MeanStress> stresses(static_cast<std::size_t>(model.blocks()));
    for (Index i = 0; i < contacts.size(); ++i)
    {
        if (!is_closed_contact(state, i))
            continue;
        const Index ref = contacts.ref[i];
        const Index inc = contacts.inc[i];
        const EdgeTouch touch = touch_of(state, i);
        const Vec2 t = {touch.ex, touch.ey};
        const Vec2 m = turned_left(t);
        for (int k = 0; k < 2; ++k)
        {
            const TouchPoint& p = touch.point[k];
            const Vec2 on_inc = (contacts.shear_force(k, i) + contacts.tilt_force(k, i)) * t - contacts.normal_force(k, i) * m;
            add(stresses[inc], p.inc_t * t + p.inc_m * m, on_inc, model.area[inc]);
            add(stresses[ref], p.ref_t * t + p.ref_m * m, -on_inc, model.area[ref]);
        }
    }
    for (const Boundary& boundary : model.boundaries)
    {
        const double factor = boundary.acts(state.stage) ? factor_of(boundary, model, state) : 0.0;
        for (const BoundaryForce& force : boundary.forces)
        {
            if (state.blocks.present[force.block] == 0)
                continue;
            MeanStress& stress = stresses[force.block];
            const double share = factor / model.area[force.block];
            stress = {stress.xx - share * force.xx, stress.yy - share * force.yy, stress.xy - share * force.xy};
        }
    }
    return stresses;
}
}  // namespace hdem
