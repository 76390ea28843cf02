#include "core/water/water_forces.h"

#include "core/detection/edge_touch.h"
#include "core/geometry/convex_part.h"
#include "core/water/pore_pressure.h"
#include "core/water/water_motion.h"
#include "core/water/wet_faces.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>

namespace hdem
{
namespace
{
constexpr double steepest = 0.5;  ///< of an edge against the one it faces [-]
/// Part of an edge, from its first vertex.
struct Stretch
{
    Index edge = no_index;  ///< position in Shapes::vertex
    double from = 0.0, to = 0.0;
    bool is_wet = false;
};

/// Stretches of edges that face another block.
void add_facing(const Model& model, const State& state, const DryOpenings& openings, Index i, std::vector<Stretch>& faces)
{
    const Contacts& contacts = state.contacts;
    const Index ref = contacts.ref[i], inc = contacts.inc[i];
    if (ref == inc || contacts.ref_edge[i] == no_index || state.blocks.present[ref] == 0 || state.blocks.present[inc] == 0)
        return;
    const EdgePair edges = contacts.edges(i);
    const BlockMotion &on_ref = state.blocks.motion[ref], &on_inc = state.blocks.motion[inc];
    const EdgeTouch touch = touch_edges(edges, on_ref, on_inc);
    if (!(touch.length > contacts.length_floor(i)) || std::abs(touch.slope) > steepest)
        return;
    bool wet = has_joint_water(model, state, i);
    const auto add = [&](Index block, Index edge, double a, double b)
    {
        const double length = model.shapes.edge_length[edge];
        const Stretch face{edge, std::clamp(std::min(a, b), 0.0, length), std::clamp(std::max(a, b), 0.0, length)};
        wet = wet && !was_beside_opening(model, state, openings, block, edge, face.from, face.to);
        faces.push_back(face);
    };
    add(ref, contacts.ref_edge[i], touch.point[0].ref_t - edges.start_t, touch.point[1].ref_t - edges.start_t);
    const Vec2 t(touch.ex, touch.ey), m = turned_left(t), first(edges.p0x, edges.p0y);
    const Vec2 along = (Vec2(edges.p1x, edges.p1y) - first).normalized();
    const auto way = [&](const TouchPoint& p)
    { return (to_body(on_inc, Vec2(on_inc.x, on_inc.y) + p.inc_t * t + p.inc_m * m) - first).dot(along); };
    add(inc, contacts.inc_edge[i], way(touch.point[0]), way(touch.point[1]));
    faces.back().is_wet = faces[faces.size() - 2]
                              .is_wet = wet;  // the same on both: what a joint bears on one block, it bears on the other
}

class WaterForces
{
  public:
    /// @param ahead  of the poses for which they are found [s]
    WaterForces(const Model& model, const State& state, double ahead)
        : model_(model),
          state_(state),
          ahead_(ahead),
          openings_(model, state)
    {
        for (Index i = 0; i < state.contacts.size(); ++i)
            add_facing(model, state, openings_, i, faces_);
        std::ranges::sort(faces_, [](const Stretch& a, const Stretch& b)
                          { return std::tie(a.edge, a.from, a.to, a.is_wet) < std::tie(b.edge, b.from, b.to, b.is_wet); });
    }

    [[nodiscard]] Triple on(Index block)
    {
        sum_ = {};
        block_ = block;
        pose_ = moved_on(state_.blocks.motion[block], ahead_);
        drawn_ = model_.water.drawn[model_.user_number[block]];
        cracks_act_ = do_cracks_act(model_, state_, block);
        const Shapes& shapes = model_.shapes;
        for (Index part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part)
            for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
                if (shapes.edge_source[v] != edge_internal)
                    add_edge(v);
        return sum_;
    }

  private:
    void add_edge(Index edge)
    {
        double covered = 0.0;
        const bool is_ponded = model_.water.ponded && !has_given_stress(edge);
        for (auto face = std::ranges::lower_bound(faces_, edge, {}, &Stretch::edge); face != faces_.end() && face->edge == edge;
             ++face)
        {
            if (face->from > covered)
                add_free(edge, covered, face->from, is_ponded);
            if (face->to > covered)
                add_joint(edge, std::max(face->from, covered), face->to, face->is_wet);
            covered = std::max(covered, face->to);
        }
        if (covered < model_.shapes.edge_length[edge])
            add_free(edge, covered, model_.shapes.edge_length[edge], is_ponded);
    }

    void add_free(Index edge, double from, double to, bool is_ponded)
    {
        const Vec2 out = model_.water.tolerance * -turned_left(direction(edge));
        Shares dry = openings_.inside(place(edge, from) + out, place(edge, to) + out);
        std::ranges::move(dry_as_drawn(model_, state_, openings_, block_, edge, from, to), std::back_inserter(dry));
        std::ranges::sort(dry);
        add_wet(edge, from, to, is_ponded, dry);
    }

    /// A stretch that faces another block. Where it or that one lies in a dry opening, as what has fallen on its floor, there is no water between them: it would lift a
    /// block that touches, and not one that does not, and throw it about.
    void add_joint(Index edge, double from, double to, bool is_wet)
    {
        const Vec2 out = model_.water.tolerance * -turned_left(direction(edge)), a = place(edge, from), b = place(edge, to);
        add_wet(edge, from, to, is_wet, dry_beside(openings_, a, b, out));
    }

    /// @param dry  shares of the stretch without water, ascending
    void add_wet(Index edge, double from, double to, bool table_acts, const Shares& dry)
    {
        double wet_from = from;
        for (const auto& [low, high] : dry)
        {
            if (const double until = from + low * (to - from); until > wet_from)
                add_pressure(edge, wet_from, until, table_acts);
            wet_from = std::max(wet_from, from + high * (to - from));
        }
        if (wet_from < to)
            add_pressure(edge, wet_from, to, table_acts);
    }

    void add_pressure(Index edge, double from, double to, bool table_acts)
    {
        if (!table_acts && !cracks_act_)
            return;
        const Vec2 a = place(edge, from), inward = turned_left(direction(edge));
        const Vec2 drawn = drawn_ + model_.shapes.vertex[edge], tangent = model_.shapes.edge_tangent[edge];
        const PressureSum p = pressure_along(model_.water, state_.stage,
                                             {.from = a,
                                              .to = place(edge, to),
                                              .drawn_from = drawn + from * tangent,
                                              .drawn_to = drawn + to * tangent,
                                              .table_acts = table_acts,
                                              .cracks_act = cracks_act_});
        const Vec2 force = p.force * inward;
        sum_.x += force.x();
        sum_.y += force.y();
        sum_.w += cross(a - Vec2(pose_.x, pose_.y), force) + p.moment;
    }

    [[nodiscard]] bool has_given_stress(Index edge) const
    {
        const Vec2 &a = model_.shapes.vertex[edge], b = a + model_.shapes.edge_length[edge] * model_.shapes.edge_tangent[edge];
        const auto lies_on = [&](const BoundaryFace& face)
        {
            const Vec2 side = face.body_to - face.body_from;
            const double slack = model_.water.tolerance * side.norm();
            const auto is_on = [&](const Vec2& p)
            {
                const Vec2 to = p - face.body_from;
                return std::abs(cross(side, to)) <= slack && to.dot(side) >= -slack && to.dot(side) <= side.squaredNorm() + slack;
            };
            return face.block == block_ && is_on(a) && is_on(b);
        };
        return std::ranges::any_of(model_.boundaries,
                                   [&](const Boundary& boundary) {
                                       return boundary.kind == BoundaryKind::stress && boundary.acts(state_.stage) &&
                                              std::ranges::any_of(boundary.faces, lies_on);
                                   });
    }

    [[nodiscard]] Vec2 direction(Index edge) const
    {
        const Vec2& t = model_.shapes.edge_tangent[edge];
        return {pose_.c * t.x() - pose_.s * t.y(), pose_.s * t.x() + pose_.c * t.y()};
    }
    [[nodiscard]] Vec2 place(Index edge, double way) const
    {
        return to_world(pose_, model_.shapes.vertex[edge]) + way * direction(edge);
    }

    const Model& model_;
    const State& state_;
    double ahead_;
    DryOpenings openings_;
    std::vector<Stretch> faces_;  ///< ascending by edge and place
    Index block_ = no_index;
    BlockMotion pose_;
    Vec2 drawn_ = {0.0, 0.0};  ///< its centroid as drawn
    bool cracks_act_ = false;  ///< on it
    Triple sum_;
};
}  // namespace

std::vector<Triple> water_forces(const Model& model, const State& state, std::int64_t until, double drag)
{
    std::vector<Triple> forces;
    if (!model.water.given)
        return forces;
    forces.resize(static_cast<std::size_t>(model.blocks()));
    WaterForces water(model, state, 0.5 * static_cast<double>(until - state.cycle) * state.blocks.step.next);
    for (Index b = 0; b < model.blocks(); ++b)
        if (state.blocks.is_free(b))
        {
            forces[b] = water.on(b);
            if (drag > 0.0 && floats(b, state))
                add_drag(b, drag, model, state, forces[b]);
        }
    return forces;
}

std::array<double, 2> water_share(const Model& model, Index stage, Index law, const Vec2& from, const Vec2& to)
{
    const double length = (to - from).norm();
    if (!model.water.given || length <= 1e-6 * model.water.tolerance)
        return {0.0, 0.0};
    const bool wet = model.water.wet_law[law] != 0;
    const PressureSum p = pressure_along(model.water, stage,
                                         {.from = from, .to = to, .drawn_from = from, .drawn_to = to, .table_acts = wet});
    return {p.force - p.moment / length, p.moment / length};
}

}  // namespace hdem
