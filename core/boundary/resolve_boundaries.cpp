#include "core/boundary/resolve_boundaries.h"

#include "core/boundary/mean_hold.h"
#include "core/boundary/side_forces.h"
#include "core/stress/insitu_stress.h"

#include <algorithm>
#include <map>

namespace hdem
{
namespace
{
class BoundaryResolver
{
  public:
    BoundaryResolver(const CaseDef& def, const RockMass& rock, const Vec2& origin, Model& model, Blocks& blocks)
        : def_(def),
          rock_(rock),
          origin_(origin),
          model_(model),
          blocks_(blocks)
    {
    }

    std::vector<Problem> run()
    {
        for (const BoundaryDef& boundary : def_.boundaries)
            add(boundary);
        add_faces();
        add_walls();
        for (std::size_t i = 0; i < model_.boundaries.size(); ++i)
        {
            Boundary& boundary = model_.boundaries[i];
            if (boundary.kind == BoundaryKind::stress)
                add_forces(def_.boundaries[i], boundary);
            if (boundary.kind == BoundaryKind::fixed)
                add_held(boundary);
        }
        start();
        check_names();
        if (model_.holds_mean)
            std::ranges::move(find_hold_problems(def_, model_, blocks_), std::back_inserter(problems_));
        else
            check_held();
        return std::move(problems_);
    }

  private:
    void add(const BoundaryDef& from)
    {
        Boundary boundary{.name = from.name,
                          .kind = from.kind,
                          .velocity = from.velocity,
                          .target = from.target,
                          .max_velocity = from.max_velocity.value_or(def_.convergence.mean_speed),
                          .in_stage = {},
                          .faces = {},
                          .walls = {},
                          .forces = {},
                          .holds = {},
                          .factor = factor_of(from.factor, def_.stages)};
        for (const StageDef& stage : def_.stages)
            boundary.in_stage.push_back(acts_in(from, stage.name) ? 1 : 0);
        if (def_.stages.empty())
            boundary.in_stage.push_back(1);
        model_.boundaries.push_back(std::move(boundary));
    }

    void add_faces()
    {
        for (std::size_t user = 0; user < rock_.blocks.size(); ++user)
            for (const SideEdge& side : rock_.blocks[user].sides)
            {
                const Index block = model_.slot_of_user[user];
                const Vec2 from = side.from - origin_, to = side.to - origin_;
                const Vec2 centroid(blocks_.motion[block].x, blocks_.motion[block].y);
                model_.boundaries[side.boundary].faces.push_back({block, from, to, from - centroid, to - centroid});
            }
    }

    void add_walls()
    {
        for (const RockWall& wall : rock_.walls)
        {
            const Index block = model_.slot_of_user[wall.block];
            const Vec2 edge = wall.edge.to - wall.edge.from;
            model_.boundaries[wall.edge.boundary].walls.push_back({.block = block,
                                                                   .start = wall.edge.from - origin_,
                                                                   .along = edge.normalized(),
                                                                   .length = edge.norm(),
                                                                   .centre = {blocks_.motion[block].x, blocks_.motion[block].y}});
        }
    }

    void add_forces(const BoundaryDef& from, Boundary& boundary) const
    {
        std::map<Index, BoundaryForce> sums;
        for (const BoundaryFace& face : boundary.faces)
        {
            const Vec2 along = (face.to - face.from).normalized(), out = -turned_left(along);
            const auto traction = [&](const Vec2& at) -> Vec2
            {
                if (!from.is_insitu)
                {
                    const Vec2 stress = *from.stress + (at.y() + model_.origin.y() - from.stress_height) * from.stress_gradient;
                    return stress.y() * along - stress.x() * out;
                }
                const StressDef s = stress_at(model_.insitu, at.y());
                return {s.xx * out.x() + s.xy * out.y(), s.xy * out.x() + s.yy * out.y()};
            };
            const BoundaryForce force = force_of_traction(face, traction(face.from), traction(face.to));
            BoundaryForce& sum = sums[face.block];
            sum = {.block = face.block,
                   .x = sum.x + force.x,
                   .y = sum.y + force.y,
                   .moment = sum.moment + force.moment,
                   .xx = sum.xx + force.xx,
                   .yy = sum.yy + force.yy,
                   .xy = sum.xy + force.xy};
        }
        for (const auto& [block, force] : sums)
            boundary.forces.push_back(force);
    }

    /// As domain.fixed. What the case fixes otherwise stays fixed when the side ends.
    void add_held(Boundary& boundary) const
    {
        for (const BoundaryFace& face : boundary.faces)
            if (blocks_.is_free(face.block) && std::ranges::find(boundary.holds, face.block) == boundary.holds.end())
                boundary.holds.push_back(face.block);
    }

    void start()
    {
        for (const Boundary& boundary : model_.boundaries)
            if (boundary.acts(0))
                for (const Index block : boundary.holds)
                    blocks_.inertia[block] = {};
            else
                for (const BoundaryWall& wall : boundary.walls)
                    blocks_.present[wall.block] = 0;
    }

    /// Walls are the business of their [[boundary]] alone.
    void check_names()
    {
        const auto check = [&](const std::vector<std::string>& names, const std::string& key, const std::string& what)
        {
            for (const Boundary& boundary : model_.boundaries)
                for (const BoundaryWall& wall : boundary.walls)
                    if (std::ranges::find(names, model_.name[wall.block]) != names.end())
                        problems_.push_back({.key = key,
                                             .text = what + " = \"" + model_.name[wall.block] +
                                                     "\" (it is the wall of a [[boundary]], which says what it does). Use the "
                                                     "keys of the boundary, e.g. stages."});
        };
        for (std::size_t i = 0; i < def_.loads.size(); ++i)
            check(def_.loads[i].blocks, "load[" + std::to_string(i) + "].blocks", "load: blocks");
        for (std::size_t i = 0; i < def_.stages.size(); ++i)
        {
            const StageDef& stage = def_.stages[i];
            const std::string key = "stage[" + std::to_string(i) + "].", object = "stage \"" + stage.name + "\": ";
            check(stage.excavate, key + "excavate", object + "excavate");
            check(stage.fix, key + "fix", object + "fix");
            check(stage.free, key + "free", object + "free");
        }
    }

    /// Is anything fixed in a stage, by the case or by a side or a wall?
    void check_held()
    {
        bool is_fixed = false;
        for (Index b = 0; b < model_.blocks(); ++b)
        {
            const bool is_wall = model_.mass[b] == 0.0;
            const BlockInertia& i = blocks_.inertia[b];
            is_fixed = is_fixed || (!is_wall && (i.inverse_mass_x == 0.0 || i.inverse_mass_y == 0.0 || i.inverse_inertia == 0.0) &&
                                    !is_held_by_side(b));
        }
        for (std::size_t s = 0; s < def_.stages.size(); ++s)
        {
            is_fixed = is_fixed || !def_.stages[s].fix.empty();
            bool pressed = false, held = is_fixed;
            for (const Boundary& boundary : model_.boundaries)
            {
                const bool acts = boundary.acts(static_cast<Index>(s));
                pressed = pressed || (acts && boundary.kind == BoundaryKind::stress);
                held = held || (acts && boundary.kind != BoundaryKind::stress);
            }
            if (pressed && !held)
            {
                problems_.push_back({.key = "boundary[0].kind",
                                     .text = "stage \"" + def_.stages[s].name +
                                             "\": tractions act on the rock, and nothing holds it (it would move and turn as a "
                                             "whole). Fix a block, e.g. with fix = [\"b1\"] in the stage, give hold = "
                                             "\"mean\" in [domain], or give a side of another kind."});
                return;
            }
        }
    }

    [[nodiscard]] bool is_held_by_side(Index block) const
    {
        return std::ranges::any_of(model_.boundaries, [&](const Boundary& boundary)
                                   { return std::ranges::find(boundary.holds, block) != boundary.holds.end(); });
    }

    const CaseDef& def_;
    const RockMass& rock_;
    Vec2 origin_;
    Model& model_;
    Blocks& blocks_;
    std::vector<Problem> problems_;
};
}  // namespace

std::vector<Problem> resolve_boundaries(const CaseDef& def, const RockMass& rock, const Vec2& origin, Model& model, Blocks& blocks)
{
    return BoundaryResolver(def, rock, origin, model, blocks).run();
}

Blocks with_freed_sides(const Model& model, Blocks blocks)
{
    for (const Boundary& boundary : model.boundaries)
        if (std::ranges::count(boundary.in_stage, std::uint8_t{0}) > 0)
            for (const Index block : boundary.holds)
                blocks.inertia[block] = model.full_inertia[block];
    return blocks;
}

bool acts_in(const BoundaryDef& def, const std::string& stage)
{
    return def.stages.empty() || std::ranges::find(def.stages, stage) != def.stages.end();
}

CoulombSlip law_of_walls(const CoulombSlip& standard)
{
    return {.normal_stiffness = standard.normal_stiffness,
            .shear_stiffness = standard.shear_stiffness,
            .friction_coefficient = 0.0,
            .cohesion = 0.0,
            .restitution = standard.restitution};
}
}  // namespace hdem
