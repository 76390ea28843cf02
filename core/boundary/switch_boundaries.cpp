#include "core/boundary/switch_boundaries.h"

#include "core/boundary/side_forces.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace hdem
{
namespace
{
std::set<Index> held_in(const Model& model, Index stage)
{
    std::set<Index> held;
    for (const Boundary& boundary : model.boundaries)
        if (boundary.acts(stage))
            held.insert(boundary.holds.begin(), boundary.holds.end());
    return held;
}

/// Does `fix` of a stage up to this one hold the block? The last stage that names it decides.
bool is_fixed_by_stages(const Model& model, Index block, Index stage)
{
    bool is_fixed = false;
    for (Index i = 0; i <= stage; ++i)
    {
        const StageDef& def = model.stages[i];
        is_fixed = is_fixed || std::ranges::count(def.fix, model.name[block]) > 0;
        is_fixed = is_fixed && std::ranges::count(def.free, model.name[block]) == 0;
    }
    return is_fixed;
}

/// Greatest distance by which present blocks of the side, in front of a wall, stand out of the edge as drawn; 0 if there are none [m].
double outermost(const Boundary& boundary, const BoundaryWall& wall, const Blocks& blocks)
{
    double most = -std::numeric_limits<double>::infinity();
    for (const BoundaryFace& face : boundary.faces)
    {
        if (!wall.is_behind(face) || blocks.present[face.block] == 0)
            continue;
        const BlockMotion& m = blocks.motion[face.block];
        for (const Vec2& at : {face.body_from, face.body_to})
        {
            const Vec2 place(m.x + m.c * at.x() - m.s * at.y(), m.y + m.s * at.x() + m.c * at.y());
            most = std::max(most, -(place - wall.start).dot(wall.inward()));
        }
    }
    return std::isfinite(most) ? most : 0.0;
}
}  // namespace

BoundaryChange boundary_change(const Model& model, Index from, Index to)
{
    BoundaryChange change;
    if (model.boundaries.empty() || from == to)
        return change;
    for (const Boundary& boundary : model.boundaries)
    {
        const bool before = boundary.acts(from), after = boundary.acts(to);
        for (const BoundaryWall& wall : boundary.walls)
        {
            if (after && !before)
                change.begins.push_back(wall.block);
            if (before && !after)
            {
                change.ends.resize(static_cast<std::size_t>(model.blocks()), 0);
                change.ends[wall.block] = 1;
            }
        }
    }
    const std::set<Index> before = held_in(model, from), after = held_in(model, to);
    std::ranges::set_difference(before, after, std::back_inserter(change.freed));
    std::erase_if(change.freed, [&](Index block) { return is_fixed_by_stages(model, block, to); });
    std::ranges::set_difference(after, before, std::back_inserter(change.held));
    return change;
}

void release_tractions(const Model& model, Index from, Index to, State& state)
{
    std::map<Index, ReleasedForce> sums;
    for (const ReleasedForce& force : state.released)
        sums[force.block] = force;
    for (const Boundary& boundary : model.boundaries)
        for (const BoundaryForce& force : boundary.forces)
            if (boundary.acts(from) && !boundary.acts(to) && state.blocks.present[force.block] != 0)
            {
                ReleasedForce& sum = sums[force.block];
                const double factor = factor_of(boundary, model, state);
                sum = {force.block, sum.x + factor * force.x, sum.y + factor * force.y, sum.moment + factor * force.moment};
            }
    state.released.clear();
    for (const auto& [block, force] : sums)
        state.released.push_back(force);
}

void remove_walls(const std::vector<std::uint8_t>& walls, State& state)
{
    for (std::size_t b = 0; b < walls.size(); ++b)
        if (walls[b] != 0)
            state.blocks.present[b] = 0;
    state.contacts_outdated = state.contacts_outdated || !walls.empty();
}

void place_walls(const Model& model, State& state)
{
    for (const Boundary& boundary : model.boundaries)
        for (const BoundaryWall& wall : boundary.walls)
        {
            if (!boundary.acts(state.stage) || state.blocks.present[wall.block] != 0)
                continue;
            const Vec2 at = wall.centre - outermost(boundary, wall, state.blocks) * wall.inward();
            state.blocks.present[wall.block] = 1;
            state.blocks.motion[wall.block].x = at.x();
            state.blocks.motion[wall.block].y = at.y();
            state.contacts_outdated = true;
        }
}

void start_walls(const Model& model, State& state)
{
    for (const Boundary& boundary : model.boundaries)
        for (const BoundaryWall& wall : boundary.walls)
        {
            const bool moves = boundary.kind == BoundaryKind::velocity && boundary.acts(state.stage);
            const Vec2 velocity = moves ? Vec2(factor_of(boundary, model, state) * boundary.velocity) : Vec2(0.0, 0.0);
            state.blocks.motion[wall.block].vx = velocity.x();
            state.blocks.motion[wall.block].vy = velocity.y();
        }
}
}  // namespace hdem
