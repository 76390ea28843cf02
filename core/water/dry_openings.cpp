#include "core/water/dry_openings.h"

#include <algorithm>
#include <limits>

namespace hdem
{
DryOpenings::DryOpenings(const Model& model, const State& state)
    : model_(model),
      state_(state),
      low_(Vec2::Constant(std::numeric_limits<double>::infinity())),
      high_(-low_)
{
    for (Index part = 0; part < model.shapes.parts(); ++part)
    {
        const Index block = model.shapes.part_block[part], excavation = model.excavation[block];
        const bool flooded = excavation != no_index && model.water.wet_opening[excavation] != 0;
        if (state.blocks.present[block] == 0 && model.mass[block] > 0.0 && !flooded)
            add_part(part);
    }
}

Shares DryOpenings::inside(const Vec2& a, const Vec2& b, Place place) const
{
    Shares found;
    if ((a.cwiseMin(b) - high_).maxCoeff() > 0.0 || (low_ - a.cwiseMax(b)).maxCoeff() > 0.0)
        return found;
    for (const Index part : parts_)
    {
        const BlockMotion motion = pose(model_.shapes.part_block[part], place);
        const Vec2 centre = to_world(motion, model_.shapes.part_centre[part]);
        const double reach = model_.shapes.part_radius[part] + 0.5 * (b - a).norm();
        if ((centre - 0.5 * (a + b)).squaredNorm() <= reach * reach)
            cut(part, to_body(motion, a), to_body(motion, b), found);
    }
    std::ranges::sort(found);
    return found;
}

BlockMotion DryOpenings::pose(Index block, Place place) const
{
    if (place == Place::removed)
        return state_.blocks.motion[block];
    const Vec2& drawn = model_.water.drawn[model_.user_number[block]];
    BlockMotion as_drawn;
    as_drawn.x = drawn.x();
    as_drawn.y = drawn.y();
    as_drawn.c = 1.0;
    as_drawn.s = 0.0;
    return as_drawn;
}

void DryOpenings::add_part(Index part)
{
    parts_.push_back(part);
    const Vec2 reach = Vec2::Constant(model_.shapes.part_radius[part]);
    for (const Place place : {Place::removed, Place::drawn})
    {
        const Vec2 centre = to_world(pose(model_.shapes.part_block[part], place), model_.shapes.part_centre[part]);
        low_ = low_.cwiseMin(centre - reach);
        high_ = high_.cwiseMax(centre + reach);
    }
}

/// Cut the way by the part's edges.
void DryOpenings::cut(Index part, const Vec2& a, const Vec2& b, Shares& found) const
{
    double low = 0.0, high = 1.0;
    for (Index v = model_.shapes.vertex_begin[part]; v < model_.shapes.vertex_begin[part + 1]; ++v)
    {
        const double at_a = cross(model_.shapes.edge_tangent[v], a - model_.shapes.vertex[v]);
        const double at_b = cross(model_.shapes.edge_tangent[v], b - model_.shapes.vertex[v]);
        if (at_a < 0.0 && at_b < 0.0)
            return;
        if (at_a < 0.0)
            low = std::max(low, at_a / (at_a - at_b));
        else if (at_b < 0.0)
            high = std::min(high, at_a / (at_a - at_b));
    }
    if (low < high)
        found.push_back({low, high});
}
}  // namespace hdem
