#include "core/support/make_bolt.h"

#include "core/support/grouted_bolt.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
constexpr double bridge_share = 0.01;  // of the longest segment: length of a bar's piece at a joint

BoltLink link(const PathPiece& first, const PathPiece& second, const BoltLine& line, const Blocks& blocks)
{
    const auto centre = [&](Index b) { return Vec2(blocks.motion[b].x, blocks.motion[b].y); };
    BoltLink made;
    made.first = first.block;
    made.second = second.block;
    made.first_arm = line.from - centre(first.block);
    made.second_arm = line.to - centre(second.block);
    return made;
}

void add_crossings(const std::vector<PathPiece>& path, const Vec2& head, const Blocks& blocks, Bolt& bolt)
{
    const double half = 0.5 * bolt.length;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
    {
        BoltLink made = link(path[i], path[i + 1],
                             {head + (path[i].to - half) * bolt.axis, head + (path[i + 1].from + half) * bolt.axis}, blocks);
        made.axial_stiffness = bolt.stiffness;
        made.transverse_stiffness = bolt.shear_stiffness;
        bolt.links.push_back(made);
    }
    for (const PathPiece& piece : path)
        bolt.blocks.push_back(piece.block);
}

void add_segments(const BoltDef& from, const std::vector<PathPiece>& path, Bolt& bolt)
{
    const double longest = longest_segment(from, bolt);
    const double unbonded = from.free_length.value_or(0.0);
    const auto add = [&](std::size_t part, double begin, double end, bool is_bonded)
    {
        const auto number = static_cast<int>(std::max(1.0, std::ceil((end - begin) / longest - 1e-9)));
        for (int k = 0; k < number && end > begin; ++k)
            bolt.segments.push_back({static_cast<Index>(part), (end - begin) / number, is_bonded});
    };
    for (std::size_t part = 0; part < path.size(); ++part)
    {
        const double begin = path[part].from, end = path[part].to, least = 1e-6 * longest;
        double split = std::clamp(unbonded, begin, end);
        split = split - begin < least ? begin : (end - split < least ? end : split);  // no piece of round-off
        add(part, begin, split, false);
        add(part, split, end, true);
        // What bridges the joint has no bond: its tension is that of the joint, and yields as the bar does.
        if (part + 1 < path.size())
            bolt.segments.push_back({static_cast<Index>(part), bridge_share * longest, false});
    }
    const std::vector<double> stiffness = link_stiffness(bolt);
    for (std::size_t i = 0; i < bolt.links.size(); ++i)
        bolt.links[i].axial_stiffness = stiffness[i];
}
}  // namespace

Bolt bolt_per_metre(const BoltDef& from, const std::string& name, double length)
{
    const double share = 1.0 / from.spacing;
    Bolt bolt;
    bolt.name = name;
    bolt.kind = from.kind;
    bolt.spacing = from.spacing;
    bolt.pretension = share * from.pretension;
    bolt.yield = from.yield ? share * *from.yield : Bolt::none;
    bolt.rupture = from.rupture_strain.value_or(Bolt::none);
    bolt.shear_stiffness = share * from.shear_stiffness;
    bolt.shear_strength = from.shear_strength ? share * *from.shear_strength : Bolt::none;
    bolt.section_stiffness = share * from.area * from.modulus;
    bolt.bond_stiffness = share * from.bond_stiffness;
    bolt.bond_strength = share * from.bond_strength;
    bolt.plate = from.plate;
    bolt.length = from.kind == BoltKind::local     ? from.active_length
                  : from.kind == BoltKind::grouted ? 4.0 * std::sqrt(from.area / std::numbers::pi)  // twice the diameter
                                                   : from.free_length.value_or(length);
    bolt.stiffness = from.stiffness ? share * *from.stiffness : bolt.section_stiffness / bolt.length;
    return bolt;
}

double longest_segment(const BoltDef& from, const Bolt& bolt)
{
    return from.segment.value_or(0.1 * std::sqrt(bolt.section_stiffness / bolt.bond_stiffness));
}

void tie(const BoltDef& from, const std::vector<PathPiece>& path, const BoltLine& line, const Blocks& blocks, Bolt& bolt)
{
    bolt.axis = (line.to - line.from) / (line.to - line.from).norm();
    if (from.kind == BoltKind::anchored)
    {
        bolt.links.push_back(link(path.front(), path.back(), line, blocks));
        bolt.links.front().axial_stiffness = bolt.stiffness;
        bolt.history_size = 2;
        return;
    }
    add_crossings(path, line.from, blocks, bolt);
    if (from.kind == BoltKind::grouted)
        add_segments(from, path, bolt);
    bolt.history_size = from.kind == BoltKind::local ? 5 * static_cast<Index>(bolt.links.size()) : grouted_history_size(bolt);
}
}  // namespace hdem
