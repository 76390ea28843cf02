#include "core/support/bolt_strength.h"

#include "core/support/bolt_link.h"
#include "core/support/bolt_memory.h"
#include "core/support/grouted_bolt.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// Tension that the bar and its bond on the weaker side of each link can bear.
std::vector<double> grouted_strengths(const Bolt& bolt, const Blocks& blocks, const GroutedMemory& memory)
{
    std::vector<double> strength(bolt.links.size(), bolt.yield);
    const auto pass = [&](std::size_t e, double grip)
    {
        const BoltSegment& segment = bolt.segments[e];
        const bool holds = blocks.present[bolt.blocks[segment.part]] != 0 && memory.segment[e].cut == 0.0;
        return holds ? grip + (segment.is_bonded ? bolt.bond_strength * segment.length : 0.0) : 0.0;
    };
    const auto limit = [&](Index link, double grip) { strength[link] = std::min(strength[link], grip); };
    double grip = bolt.plate ? Bolt::none : 0.0;
    for (std::size_t e = 0; e + 1 < bolt.segments.size(); ++e)
    {
        grip = pass(e, grip);
        if (bolt.segments[e + 1].part != bolt.segments[e].part)
            limit(bolt.segments[e].part, grip);
    }
    grip = 0.0;
    for (std::size_t e = bolt.segments.size(); e-- > 1;)
    {
        grip = pass(e, grip);
        if (bolt.segments[e].part != bolt.segments[e - 1].part)
            limit(bolt.segments[e - 1].part, grip);
    }
    return strength;
}
}  // namespace

std::vector<BoltStrength> bolt_strengths(const Model& model, const State& state)
{
    std::vector<BoltStrength> all;
    std::vector<double> history = state.support.history;
    for (std::size_t i = 0; i < model.support.bolts.size(); ++i)
    {
        const Bolt& bolt = model.support.bolts[i];
        if (!acts(bolt, state.support.bolts[i]))
            continue;
        std::vector<double> axial(bolt.links.size(), bolt.yield);
        if (bolt.kind == BoltKind::grouted)
            axial = grouted_strengths(bolt, state.blocks, grouted_memory(bolt, history));
        for (std::size_t l = 0; l < bolt.links.size(); ++l)
        {
            const BoltLink& link = bolt.links[l];
            const bool is_local = bolt.kind == BoltKind::local;
            if (!is_there(link, state.blocks) || (is_local && memory_of<LocalMemory>(bolt, history)[l].cut != 0.0))
                continue;
            const LinkPlace at = place_of(bolt, link, state.blocks);
            const double push = bolt.kind == BoltKind::anchored ? 0.0 : axial[l];
            all.push_back({link.first, link.second, at.line, at.first, at.second, -push, axial[l]});
            const Vec2 middle = 0.5 * (at.first + at.second);
            if (is_local)
                all.push_back(
                    {link.first, link.second, turned_left(at.axis), middle, middle, -bolt.shear_strength, bolt.shear_strength});
        }
    }
    return all;
}

bool bears_any_force(const Bolt& bolt)
{
    if (bolt.kind == BoltKind::grouted)
        return false;
    const bool any_shear = bolt.kind == BoltKind::local && bolt.shear_stiffness > 0.0 && std::isinf(bolt.shear_strength);
    return any_shear || (bolt.stiffness > 0.0 && std::isinf(bolt.yield));
}
}  // namespace hdem
