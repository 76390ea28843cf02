#include "core/boundary/mean_hold.h"
#include "core/rock/problem_text.h"
#include "core/stage/rules.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hdem
{
namespace
{
constexpr double greatest_rest = 1e-3;  // of tractions and weight

/// Sums of tractions and weight in a stage, with all blocks as drawn.
struct Resultant
{
    Vec2 force = {0.0, 0.0};  ///< [N]
    double moment = 0.0;      ///< about the middle of the model [N m]
    double size = 0.0;        ///< sum of the sizes of the forces [N]
    double arms = 0.0;        ///< sum of these sizes times their arms [N m]

    void add(const Vec2& on, double own_moment, const Vec2& arm)
    {
        force += on;
        moment += cross(arm, on) + own_moment;
        size += on.norm();
        arms += on.norm() * arm.norm() + std::abs(own_moment);
    }
};

Resultant resultant(const Model& model, const Blocks& blocks, Index stage)
{
    Resultant sum;
    const auto arm = [&](Index b) { return Vec2(Vec2(blocks.motion[b].x, blocks.motion[b].y) - model.centre); };
    for (Index b = 0; b < model.blocks(); ++b)
        sum.add(model.mass[b] * model.gravity, 0.0, arm(b));
    for (const Boundary& boundary : model.boundaries)
        if (boundary.acts(stage))
            for (const BoundaryForce& force : boundary.forces)
                sum.add({force.x, force.y}, force.moment, arm(force.block));
    return sum;
}

const char* const key = "domain.hold";
const std::string object = "domain: hold = \"mean\" (";

std::optional<Problem> find_problem(const Model& model, const Blocks& blocks, Index stage, const std::string& in_stage)
{
    bool presses = false;
    for (const Boundary& boundary : model.boundaries)
    {
        if (!boundary.acts(stage))
            continue;
        if (boundary.kind != BoundaryKind::stress)
            return Problem{.key = key,
                           .text = object + in_stage + "boundary \"" + boundary.name +
                                   "\" holds the rock already). Remove hold, or make all sides of kind stress."};
        presses = true;
    }
    if (!presses)
        return Problem{.key = key,
                       .text = object + in_stage +
                               "no side is of kind stress: there is nothing to hold). Remove hold, or give a [[boundary]] of kind "
                               "stress for all stages."};
    const Resultant rest = resultant(model, blocks, stage);
    if (rest.force.norm() > greatest_rest * rest.size)
        return Problem{.key = key,
                       .text = object + in_stage + "tractions and weight leave a force of " + text(rest.force.norm()) + " N, " +
                               text(rest.force.norm() / rest.size) +
                               " of them, which hold would carry unseen). Give tractions in equilibrium, e.g. stress = \"insitu\" "
                               "on all sides, or fix a block."};
    if (std::abs(rest.moment) > greatest_rest * rest.arms)
        return Problem{
            .key = key,
            .text = object + in_stage + "tractions and weight leave a moment of " + text(rest.moment) +
                    " N m, which hold would carry unseen). Give tractions in equilibrium: shear stresses of neighbouring "
                    "sides have opposite signs."};
    return std::nullopt;
}
}  // namespace

std::vector<Problem> find_hold_problems(const CaseDef& def, const Model& model, const Blocks& blocks)
{
    for (Index b = 0; b < model.blocks(); ++b)
    {
        const BlockInertia& i = blocks.inertia[b];
        const bool is_fixed = i.inverse_mass_x == 0.0 || i.inverse_mass_y == 0.0 || i.inverse_inertia == 0.0;
        if (model.mass[b] > 0.0 && is_fixed &&
            std::ranges::none_of(model.boundaries, [&](const Boundary& side) { return std::ranges::count(side.holds, b) > 0; }))
            return {{.key = key,
                     .text = object + "block \"" + model.name[b] +
                             "\" is fixed, and holds the rock already). Remove hold, or free the block."}};
    }
    for (std::size_t s = 0; s < def.stages.size(); ++s)
        if (!def.stages[s].fix.empty())
            return {{.key = key,
                     .text = object + "stage \"" + def.stages[s].name +
                             "\" fixes blocks, which hold the rock already). Remove one of both."}};
        else if (asks_for_statics(def.stages[s]))
            return {{.key = "stage[" + std::to_string(s) + "].solver",
                     .text = "stage \"" + def.stages[s].name +
                             "\": solver = \"static\" (a static solution needs something that stands still, and hold = \"mean\" of "
                             "[domain] fixes nothing). Use \"dynamic\", or fix a block instead of hold."}};
    for (Index s = 0; s < std::max<Index>(1, static_cast<Index>(def.stages.size())); ++s)
    {
        const std::string in_stage = def.stages.size() > 1 ? "stage \"" + def.stages[static_cast<std::size_t>(s)].name + "\": "
                                                           : "";
        if (const std::optional<Problem> problem = find_problem(model, blocks, s, in_stage))
            return {*problem};
    }
    return {};
}
}  // namespace hdem
