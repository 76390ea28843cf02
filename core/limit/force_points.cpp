#include "core/limit/force_points.h"

#include "core/boundary/side_forces.h"
#include "core/detection/edge_touch.h"
#include "core/joint/all_laws.h"
#include "core/motion/loads.h"
#include "core/state/workspace.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// Tangent of a strength curve at a normal stress: c and tan phi.
PointStrength tangent_of(const JointRow& row, double stress, double length)
{
    const double at = std::max(stress, 1e3), h = 1e-4 * at;
    const double slope = (peak_strength(row, at + h) - peak_strength(row, at - h)) / (2.0 * h);
    return {slope, std::max(peak_strength(row, at) - slope * at, 0.0) * length, 0.0};
}

PointStrength strength_of(const Model& model, const Contacts& contacts, Index contact, int k, double length)
{
    const Index law = contacts.law[contact];
    const CoulombSlip& slip = model.joints.laws[law];
    if (!model.joints.has_memory(law))
        return {slip.friction_coefficient, slip.cohesion * length, 0.0};
    const JointRow& row = model.joints.rows[law];
    if (row.kind != kind_of<CoulombResidual>())
        return tangent_of(row, contacts.normal_force(k, contact) / length, length);
    if (contacts.memory(k, contact).broken > 0.5)
        return {row.residual_friction, row.residual_cohesion * length, row.numbers[CoulombResidual::residual_tension] * length};
    return {slip.friction_coefficient, slip.cohesion * length, row.tension * length};
}

void add_points(const Model& model, const State& state, const std::vector<Index>& kept, bool corners_bear, Index contact,
                std::vector<ForcePoint>& points)
{
    const Contacts& contacts = state.contacts;
    const Index ref = contacts.ref[contact], inc = contacts.inc[contact];
    const EdgeTouch touch = touch_edges(contacts.edges(contact), state.blocks.motion[ref], state.blocks.motion[inc]);
    const double floor = contacts.length_floor(contact), length = point_length(touch.length, floor);
    if (!corners_bear && (touch.length <= floor || is_corner_on_side(touch)))
        return;
    for (int k = 0; k < 2; ++k)
    {
        const TouchPoint& p = touch.point[k];
        const bool is_closed = contacts.regime[k][contact] != static_cast<std::uint8_t>(Regime::open);
        if (!is_closed && (touch.length <= 0.0 || p.overlap < -floor))
            continue;
        ForcePoint point{.block = {ref, inc}, .is_open = !is_closed};
        for (int side = 0; side < 2; ++side)
        {
            const Index block = point.block[side];
            const double sign = side == 1 ? 1.0 : -1.0;  // forces are given on inc: N along -m, S along t
            const double t = side == 1 ? p.inc_t : p.ref_t, m = side == 1 ? p.inc_m : p.ref_m;
            const Vec2 along(touch.ex, touch.ey), across = turned_left(along);
            const Vec2 arm = (t * along + m * across) / model.radius[block];
            const Vec2 normal = -sign * across, shear = sign * along;
            point.normal[side] = {normal.x(), normal.y(), cross(arm, normal)};
            point.shear[side] = {shear.x(), shear.y(), cross(arm, shear)};
        }
        point.strength = strength_of(model, contacts, contact, k, length);
        point.strength.is_weakened = std::ranges::find(kept, contacts.law[contact]) == kept.end();
        points.push_back(point);
    }
}
}  // namespace

std::vector<ForcePoint> force_points(const Model& model, const State& state, const std::vector<Index>& kept, bool corners_bear)
{
    const Contacts& contacts = state.contacts;
    std::vector<std::pair<std::array<Index, 4>, Index>> order;  // by the user's numbers
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const Index ref = contacts.ref[i], inc = contacts.inc[i];
        if (ref == inc || state.blocks.present[ref] == 0 || state.blocks.present[inc] == 0 ||
            (!state.blocks.is_free(ref) && !state.blocks.is_free(inc)))
            continue;
        const Index a = model.user_number[ref], b = model.user_number[inc];
        const Index part_a = contacts.part_a[i] - model.shapes.part_begin[contacts.swapped[i] != 0 ? inc : ref];
        const Index part_b = contacts.part_b[i] - model.shapes.part_begin[contacts.swapped[i] != 0 ? ref : inc];
        order.push_back({{std::min(a, b), std::max(a, b), part_a, part_b}, i});
    }
    std::ranges::sort(order);
    std::vector<ForcePoint> points;
    for (const auto& [numbers, contact] : order)
        add_points(model, state, kept, corners_bear, contact, points);
    return points;
}

double open_share_of_cohesion(const Model& model, const State& state, const std::vector<Index>& users)
{
    const auto is_one = [&](Index block) { return std::ranges::count(users, model.user_number[block]) > 0; };
    double all = 0.0, open = 0.0;
    for (const ForcePoint& point : force_points(model, state, {}, true))
        if (is_one(point.block[0]) != is_one(point.block[1]))
        {
            all += point.strength.cohesion;
            open += point.is_open ? point.strength.cohesion : 0.0;
        }
    return all > 0.0 ? open / all : 0.0;
}

std::vector<Triple> loads_to_balance(const Model& model, const State& state)
{
    std::vector<Triple> constant = constant_forces(model, state);
    constant.resize(static_cast<std::size_t>(model.blocks()));
    std::vector<Triple> loads = constant;
    std::vector<LoadedBlock> before;
    apply_loads(model, state, constant, loads, before);
    for (Index block = 0; block < model.blocks(); ++block)
    {
        const Vec2 weight = model.mass[block] * model.gravity;
        Triple& on = loads[block];
        on = {on.x + weight.x(), on.y + weight.y(), on.w / model.radius[block]};
    }
    return loads;
}
}  // namespace hdem
