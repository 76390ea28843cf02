#include "core/stress/insitu_stress.h"

#include "core/boundary/side_forces.h"
#include "core/detection/edge_touch.h"
#include "core/geometry/convex_part.h"
#include "core/joint/normal_closure.h"
#include "core/stress/drawn_joints.h"
#include "core/water/water_forces.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace hdem
{
StressDef stress_at(const InsituField& field, double y)
{
    constexpr double same_height =
        1e-3;  // [m] the ground and the rock's upper side are typed with a few digits, and the horizontal part may end there with a jump
    double way = y - field.reference;
    if (field.ends_at_reference && way > same_height)
        return {};
    if (field.ends_at_reference)
        way = std::min(way, 0.0);
    return {field.stress.xx + field.gradient.xx * way, field.stress.yy + field.gradient.yy * way,
            field.stress.xy + field.gradient.xy * way};
}

InsituField make_field(const InsituDef& def, double density, const Vec2& gravity, const Vec2& origin)
{
    InsituField field{.given = def.given, .density = density};
    if (def.surface)
    {
        const double weight = -density * gravity.y();
        field.reference = *def.surface - origin.y();
        field.gradient = {def.ratio.value_or(0.0) * weight, weight, 0.0};
        field.stress.xx = -def.ratio_offset;
        field.ends_at_reference = true;
        return field;
    }
    field.stress = def.stress.value_or(StressDef{});
    field.gradient = def.gradient;
    field.reference = def.reference - origin.y();
    return field;
}

double field_unbalance(const InsituField& field, double density, const Vec2& gravity)
{
    const Vec2 weight = density * gravity;
    const Vec2 lacking = Vec2(field.gradient.xy, field.gradient.yy) + weight;
    const double scale = std::max(weight.norm(), std::hypot(field.gradient.xy, field.gradient.yy));
    return scale > 0.0 ? lacking.norm() / scale : 0.0;
}

namespace
{
/// A contact where the blocks are drawn.
struct DrawnContact
{
    EdgeTouch touch;
    double floor = 0.0;
    std::array<Vec2, 2> force;  ///< of the points on inc: along t, pressing [N]
};

DrawnContact drawn_contact(const Model& model, const State& state, Index i)
{
    const Contacts& contacts = state.contacts;
    const BlockMotion& ref = state.blocks.motion[contacts.ref[i]];
    const BlockMotion& inc = state.blocks.motion[contacts.inc[i]];
    DrawnContact drawn{.touch = touch_edges(contacts.edges(i), ref, inc), .floor = contacts.length_floor(i), .force = {}};
    const Vec2 t(drawn.touch.ex, drawn.touch.ey), m = turned_left(t);
    std::array<Vec2, 2> traction;
    for (int k = 0; k < 2; ++k)
    {
        const TouchPoint& p = drawn.touch.point[k];
        const StressDef s = stress_at(model.insitu, ref.y + p.ref_t * t.y() + p.ref_m * m.y());
        const Vec2 on_inc(s.xx * m.x() + s.xy * m.y(), s.xy * m.x() + s.yy * m.y());
        traction[k] = {on_inc.dot(t), -on_inc.dot(m)};
    }
    const double sixth = std::max(drawn.touch.length, 0.0) / 6.0;
    drawn.force = {sixth * (2.0 * traction[0] + traction[1]), sixth * (traction[0] + 2.0 * traction[1])};
    if (drawn.touch.length > 0.0)
    {
        const auto place = [&](int k) -> Vec2
        { return Vec2(ref.x, ref.y) + drawn.touch.point[k].ref_t * t + drawn.touch.point[k].ref_m * m; };
        const std::array<double, 2> water = water_share(model, state.stage, contacts.law[i], place(0), place(1));
        drawn.force[0].y() -= water[0];
        drawn.force[1].y() -= water[1];
    }
    return drawn;
}

std::string name_of(const Model& model, std::int32_t source)
{
    if (source < 0)
        return source == edge_wall ? "walls of sides" : (source == edge_outline ? "outlines" : "other edges");
    const auto set = static_cast<std::size_t>(source);
    return set < model.joint_set_names.size()    ? model.joint_set_names[set]
           : set == model.joint_set_names.size() ? "traces"
                                                 : "voronoi";
}

/// Greatest shear and tension that a point bears where the blocks are drawn [N].
struct Strengths
{
    double shear, tension;
};

Strengths strengths(const JointTable& joints, Index law, double normal, double length)
{
    const double pressed = std::max(normal, 0.0);
    if (!joints.has_memory(law))
        return {shear_strength(joints.laws[law], pressed, length), 0.0};
    const JointRow& row = joints.rows[law];
    if (row.begins_broken)
        return {row.residual_friction * pressed + row.residual_cohesion * length, 0.0};
    return {peak_strength(row, pressed / length) * length, row.tension * length};
}

/// What acts on each block: net force and moment, and the sum of all that does.
struct Acting
{
    Vec2 net = {0.0, 0.0};
    double moment = 0.0, all = 0.0;

    void add(const Vec2& force, double force_moment)
    {
        net += force;
        moment += force_moment;
        all += force.norm();
    }
};

void find_worst(const Model& model, const State& state, const std::vector<Acting>& acting, InsituSummary& summary)
{
    for (Index b = 0; b < model.blocks(); ++b)
    {
        if (!state.blocks.is_free(b) || acting[b].all == 0.0)
            continue;
        const double unbalance = (acting[b].net.norm() + std::abs(acting[b].moment) / model.radius[b]) / acting[b].all;
        if (unbalance > summary.unbalance || summary.worst == no_index)
        {
            summary.unbalance = unbalance;
            summary.worst = b;
        }
    }
}
}  // namespace

namespace
{
/// What a point with a memory holds under its force; it bears tension as far as it is intact.
void lock_in_memory(const JointRow& row, double length, double overlap, const Vec2& force, PointHistory& point)
{
    const bool pulls = force.y() < 0.0 && !row.begins_broken && row.tension > 0.0;
    const double normal = pulls || force.y() > 0.0 ? force.y() / length : 0.0;
    const double closure = normal != 0.0 ? closure_under(row, normal) : std::max(overlap, 0.0);
    const NormalState state = normal_state(row, closure);
    point.memory = drawn_memory(row, normal, force.x() / length);
    point.normal_force = normal * length;
    point.shear_force = normal != 0.0 ? force.x() : 0.0;
    if (normal != 0.0)
        point.preload = closure - overlap;
    point.energy = normal != 0.0 ? state.energy * length : 0.0;
    point.stiffness = state.stiffness;
    point.regime = normal != 0.0 ? Regime::stick : Regime::open;
}
}  // namespace

void lock_in_stress(const Model& model, State& state, Index i)
{
    Contacts& contacts = state.contacts;
    const DrawnContact drawn = drawn_contact(model, state, i);
    Contact contact = contacts.get(i);
    const double length = point_length(drawn.touch.length, drawn.floor);
    const double stiffness = model.joints.laws[contact.law].normal_stiffness * length;
    contact.last_length = length;
    for (int k = 0; k < 2; ++k)
    {
        PointHistory& point = contact.point[k];
        const double overlap = drawn.touch.point[k].overlap;
        if (model.joints.has_memory(contact.law))
        {
            lock_in_memory(model.joints.rows[contact.law], length, overlap, drawn.force[k], point);
            point.energy += 0.5 * point.shear_force * point.shear_force / (model.joints.laws[contact.law].shear_stiffness * length);
        }
        else
        {
            point.normal_force = std::max(drawn.force[k].y(), 0.0);
            point.shear_force = point.normal_force > 0.0 ? drawn.force[k].x() : 0.0;
            point.preload = std::max(point.normal_force / stiffness - overlap, 0.0);
            point.regime = point.normal_force > 0.0 ? Regime::stick : Regime::open;
        }
        point.overlap = overlap + point.preload;
    }
    contacts.put(i, contact);
}

namespace
{
/// On a joint as drawn [Pa].
double greatest_traction(const Model& model, const State& state)
{
    double greatest = 0.0;
    for (Index i = 0; i < state.contacts.size(); ++i)
        if (const DrawnContact drawn = drawn_contact(model, state, i); lie_on_each_other(drawn.touch, drawn.floor))
            for (const Vec2& force : drawn.force)
                greatest = std::max(greatest, 2.0 * force.norm() / drawn.touch.length);
    return greatest;
}
}  // namespace

InsituSummary summarise_insitu(const Model& model, const State& state)
{
    const double rounding = 1e-9 * greatest_traction(model, state);
    InsituSummary summary{.field = field_unbalance(model.insitu, model.insitu.density, model.gravity), .sets = {}};
    std::vector<Acting> acting(static_cast<std::size_t>(model.blocks()));
    std::map<std::int32_t, StressedSet> sets;
    for (Index b = 0; b < model.blocks(); ++b)
        acting[b].add(model.mass[b] * model.gravity, 0.0);
    const std::vector<Triple> tractions = constant_forces(model, state);
    for (std::size_t b = 0; b < tractions.size(); ++b)
        acting[b].add({tractions[b].x, tractions[b].y}, tractions[b].w);
    const Contacts& contacts = state.contacts;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const DrawnContact drawn = drawn_contact(model, state, i);
        if (!lie_on_each_other(drawn.touch, drawn.floor))
            continue;
        const std::int32_t one = model.shapes.edge_source[contacts.ref_edge[i]];
        const std::int32_t other = model.shapes.edge_source[contacts.inc_edge[i]];
        const std::int32_t source = std::min(one, other) == edge_wall ? edge_wall : std::max(one, other);
        StressedSet& set = sets[source];
        const Vec2 t(drawn.touch.ex, drawn.touch.ey), m = turned_left(t);
        const double length = 0.5 * drawn.touch.length;
        bool above = false;
        for (int k = 0; k < 2; ++k)
        {
            const TouchPoint& p = drawn.touch.point[k];
            const double normal = contacts.normal_force(k, i), shear = contacts.shear_force(k, i);
            const Vec2 on_inc = shear * t - normal * m;
            acting[contacts.inc[i]].add(on_inc, -p.inc_t * normal - p.inc_m * shear);
            acting[contacts.ref[i]].add(-on_inc, p.ref_t * normal + p.ref_m * shear);
            const auto [strength, tension] = strengths(model.joints, contacts.law[i], drawn.force[k].y(), length);
            const double used = std::abs(drawn.force[k].x());
            above = above || used > strength + rounding * length || drawn.force[k].y() < -tension - rounding * length;
            if (strength > 0.0)
                set.most_used = std::max(set.most_used, used / strength);
        }
        ++set.joints;
        set.length += drawn.touch.length;
        set.above += above ? 1 : 0;
        set.length_above += above ? drawn.touch.length : 0.0;
    }
    for (auto& [source, set] : sets)
    {
        set.name = name_of(model, source);
        summary.sets.push_back(std::move(set));
    }
    find_worst(model, state, acting, summary);
    return summary;
}
}  // namespace hdem
