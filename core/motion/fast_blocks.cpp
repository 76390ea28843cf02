#include "core/motion/fast_blocks.h"

namespace hdem
{
namespace
{
[[gnu::always_inline]] inline bool is_faster(double speed, Index block, const Model& model, const Blocks& blocks)
{
    const BlockMotion& m = blocks.motion[block];
    const double rim = model.radius[block] * m.w;
    return m.vx * m.vx + m.vy * m.vy + rim * rim > speed * speed;
}
}  // namespace

bool is_unbound(const BlockInertia& inertia)
{
    return inertia.inverse_mass_x > 0.0 && inertia.inverse_mass_y > 0.0 && inertia.inverse_inertia > 0.0;
}

bool is_fast(Index block, const Model& model, const GroupRule& rule, const Blocks& blocks)
{
    return is_faster(rule.speed, block, model, blocks);
}

bool may_group(Index block, const Model& model, const GroupRule& rule, const Blocks& blocks)
{
    return is_faster(rule.speed, block, model, blocks) && blocks.present[block] != 0 && is_unbound(blocks.inertia[block]);
}

void find_fast(IndexRange range, const Model& model, const GroupRule& rule, const Blocks& blocks, std::vector<Index>& fast)
{
    for (Index b = range.begin; b < range.end; ++b)
        if (may_group(b, model, rule, blocks))
            fast.push_back(b);
}
}  // namespace hdem
