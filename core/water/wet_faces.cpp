#include "core/water/wet_faces.h"

#include "core/water/pore_pressure.h"

#include <algorithm>
#include <iterator>

namespace hdem
{
namespace
{
/// Way of a block over its size up to which cracks, and joints without ponded water, press on it, and faces of an opening stay dry [-]
constexpr double faces_follow = 0.25;

/// How far a block has moved from where it is drawn [m].
Vec2 way_of(const Model& model, const State& state, Index block)
{
    const BlockMotion& motion = state.blocks.motion[block];
    return Vec2(motion.x, motion.y) - model.water.drawn[model.user_number[block]];
}

/// Of shares that are ascending and may overlap.
double sum_of(const Shares& shares)
{
    double sum = 0.0, covered = 0.0;
    for (const auto& [low, high] : shares)
    {
        sum += std::max(0.0, high - std::max(low, covered));
        covered = std::max(covered, high);
    }
    return sum;
}

}  // namespace

bool has_joint_water(const Model& model, const State& state, Index contact)
{
    const Index ref = state.contacts.ref[contact], inc = state.contacts.inc[contact];
    const double apart = (way_of(model, state, ref) - way_of(model, state, inc)).norm();
    return model.water.wet_law[state.contacts.law[contact]] != 0 &&
           (model.water.ponded || apart <= faces_follow * std::min(model.size(ref), model.size(inc)));
}

bool do_cracks_act(const Model& model, const State& state, Index block)
{
    return !model.water.cracks.empty() && way_of(model, state, block).norm() <= faces_follow * model.size(block);
}

Shares dry_as_drawn(const Model& model, const State& state, const DryOpenings& openings, Index block, Index edge, double from,
                    double to)
{
    if (way_of(model, state, block).norm() > faces_follow * model.size(block))
        return {};
    const Vec2 tangent = model.shapes.edge_tangent[edge];
    const Vec2 beside = model.water.drawn[model.user_number[block]] + model.shapes.vertex[edge] -
                        model.water.tolerance * turned_left(tangent);
    return openings.inside_as_drawn(beside + from * tangent, beside + to * tangent);
}

Shares dry_beside(const DryOpenings& openings, const Vec2& a, const Vec2& b, const Vec2& out)
{
    Shares dry = openings.inside(a + out, b + out);
    std::ranges::move(openings.inside(a - out, b - out), std::back_inserter(dry));
    std::ranges::sort(dry);
    return dry;
}

bool was_beside_opening(const Model& model, const State& state, const DryOpenings& openings, Index block, Index edge, double from,
                        double to)
{
    return sum_of(dry_as_drawn(model, state, openings, block, edge, from, to)) > 0.5;
}

bool JointPressure::was_beside_opening(Index block, Index edge, const Vec2& from, const Vec2& to) const
{
    const auto way = [&](const Vec2& p)
    { return (to_body(state_.blocks.motion[block], p) - model_.shapes.vertex[edge]).dot(model_.shapes.edge_tangent[edge]); };
    const auto [low, high] = std::minmax({way(from), way(to)});
    return hdem::was_beside_opening(model_, state_, openings_, block, edge, low, high);
}

double JointPressure::mean(Index contact, const Vec2& from, const Vec2& to) const
{
    if (!model_.water.given)
        return 0.0;
    const Contacts& contacts = state_.contacts;
    const Index block = contacts.ref[contact];
    const bool wet = has_joint_water(model_, state_, contact) && !was_beside_opening(block, contacts.ref_edge[contact], from, to) &&
                     !was_beside_opening(contacts.inc[contact], contacts.inc_edge[contact], from, to);
    const double length = (to - from).norm();
    if (length == 0.0)
        return wet ? pressure_at(model_.water, state_.stage, from) : 0.0;
    const Vec2 drawn = model_.water.drawn[model_.user_number[block]], along = (to - from) / length;
    const auto force = [&](double a, double b)
    {
        const Vec2 begin = from + a * (to - from), end = from + b * (to - from);
        return pressure_along(model_.water, state_.stage,
                              FaceStretch{.from = begin,
                                          .to = end,
                                          .drawn_from = drawn + to_body(state_.blocks.motion[block], begin),
                                          .drawn_to = drawn + to_body(state_.blocks.motion[block], end),
                                          .table_acts = wet,
                                          .cracks_act = do_cracks_act(model_, state_, block)})
            .force;
    };
    double sum = 0.0, covered = 0.0;
    for (const auto& [low, high] : dry_beside(openings_, from, to, model_.water.tolerance * turned_left(along)))
    {
        sum += low > covered ? force(covered, low) : 0.0;
        covered = std::max(covered, high);
    }
    return (sum + (covered < 1.0 ? force(covered, 1.0) : 0.0)) / length;
}
}  // namespace hdem
