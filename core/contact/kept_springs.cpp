#include "core/contact/kept_springs.h"

#include "core/contact/regime.h"

#include <algorithm>

namespace hdem
{
namespace
{
/// Share of the size of the smaller block: rock keeps its springs only if an impact presses them by less (not where a block hits a stone of a thousandth of its mass).
constexpr double bearable_share = 0.05;
}  // namespace

bool does_rock_keep_springs(const PressedPair& pair, const Model& model, const Blocks& blocks)
{
    const double distance = model.convergence.loose_distance;
    const bool loose_ref = blocks.is_loose(pair.ref, distance), loose_inc = blocks.is_loose(pair.inc, distance);
    const bool stands = (blocks.is_free(pair.ref) && !loose_ref) || (blocks.is_free(pair.inc) && !loose_inc);
    if (!stands)
        return false;
    const double gravity = model.gravity.norm(), smaller = std::min(model.size(pair.ref), model.size(pair.inc));
    if (!loose_ref && !loose_inc)
    {
        const double weight = gravity > 0.0 ? gravity : 9.81;
        return pair.speed_squared > 0.0 && pair.speed_squared < 2.0 * weight * smaller;
    }
    const Index loose = loose_ref ? pair.ref : pair.inc;
    const double most = bearable_share * smaller;
    return pair.speed_squared > gentle_impact * gentle_impact * gravity * model.size(loose) &&
           pair.speed_squared * model.mass[loose] < pair.stiffness * most * most;
}

bool do_corners_keep_springs(const PressedPair& pair, const Model& model, const Blocks& blocks)
{
    const auto lies = [&](Index block) { return !blocks.is_loose(block, drawn_share * model.size(block)); };
    return lies(pair.ref) && lies(pair.inc);
}
}  // namespace hdem
