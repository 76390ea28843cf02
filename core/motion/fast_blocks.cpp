#include "core/motion/fast_blocks.h"

namespace hdem
{
bool is_unbound(const BlockInertia& inertia)
{
    return inertia.inverse_mass_x > 0.0 && inertia.inverse_mass_y > 0.0 && inertia.inverse_inertia > 0.0;
}

bool is_fast(Index block, const Model& model, const GroupRule& rule, const Blocks& blocks)
{
    const BlockMotion& m = blocks.motion[block];
    const double rim = model.radius[block] * m.w;
    return m.vx * m.vx + m.vy * m.vy + rim * rim > rule.speed * rule.speed;
}

void find_fast(IndexRange range, const Model& model, const GroupRule& rule, const Blocks& blocks, std::vector<Index>& fast)
{
    for (Index b = range.begin; b < range.end; ++b)
        if (is_fast(b, model, rule, blocks) && blocks.present[b] != 0 && is_unbound(blocks.inertia[b]))
            fast.push_back(b);
}
}  // namespace hdem
