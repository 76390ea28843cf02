#include "core/support/resolve_liner.h"

#include "core/geometry/tangent.h"
#include "core/support/bolt_path.h"
#include "core/support/liner_memory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
constexpr double behind = 1e-3;       // of the mean block size: so far in the rock its block is looked for
constexpr double least_share = 0.02;  // of the longest segment: no shorter ones
constexpr double thicknesses = 2.0;   // the longest segment, when it is not given
constexpr double lengths = 0.15;      // or this share of the length over which a point load bends it

/// Where along a straight piece segments begin, with the block behind each; the last has none.
struct Cut
{
    double at = 0.0;  ///< [m]
    Index block = no_index;
};

class LinerMaker
{
  public:
    LinerMaker(const LinerPlan& plan, const Blocks& blocks, const Model& model) : plan_(plan), blocks_(blocks), model_(model)
    {
        longest_ = longest_segment(*plan.def);
    }

    std::optional<Liner> make()
    {
        set_numbers();
        for (const Polygon& stretch : plan_.stretches)
            if (const Polygon path = without_short_pieces(stretch); path.size() > 1)
                add_stretch(path);
        if (std::ranges::none_of(liner_.segments, [](const LinerSegment& s) { return s.block != no_index; }))
            return std::nullopt;
        liner_.history_size = liner_history_size(liner_);
        return std::move(liner_);
    }

  private:
    void set_numbers()
    {
        const LinerDef& def = *plan_.def;
        const double t = def.thickness;
        const auto limit = [&](const std::optional<double>& strength, double factor)
        { return strength ? factor * *strength : Liner::none; };
        liner_.name = def.name;
        liner_.stage = plan_.stage;
        liner_.mass = def.density * t;
        liner_.axial_stiffness = def.modulus * t;
        liner_.bending_stiffness = def.modulus * def.inertia.value_or(t * t * t / 12.0);
        liner_.compressive_strength = limit(def.compressive_strength, t);
        liner_.tensile_strength = limit(def.tensile_strength, t);
        liner_.moment_strength = limit(def.moment_strength, 1.0);
        liner_.normal_stiffness = def.normal_stiffness;
        liner_.shear_stiffness = def.shear_stiffness.value_or(def.normal_stiffness);
        liner_.friction = tangent(radians(def.friction_angle_deg));
        liner_.cohesion = def.cohesion;
        liner_.bond_strength = def.bond_strength;
        liner_.hardening = def.hardening;
        liner_.pressure = def.pressure;
        liner_.pressure_cycles = def.pressure_cycles;
    }

    /// An arc that begins at a corner leaves a piece of round-off before it. Its beam would be so much stiffer than all others that nothing is left of their forces.
    [[nodiscard]] Polygon without_short_pieces(const Polygon& stretch) const
    {
        double length = 0.0;
        for (std::size_t i = 1; i < stretch.size(); ++i)
            length += (stretch[i] - stretch[i - 1]).norm();
        const double least = least_share *
                             std::min(longest_, length / static_cast<double>(std::max<std::size_t>(stretch.size(), 2) - 1));
        Polygon kept{stretch.front()};
        for (const Vec2& point : stretch)
            if ((point - kept.back()).norm() >= least)
                kept.push_back(point);
        if (kept.size() > 1)
            kept.back() = stretch.back();
        return kept;
    }

    void add_stretch(const Polygon& stretch)
    {
        const auto first = static_cast<Index>(liner_.nodes.size());
        const bool closed = stretch.front() == stretch.back();
        liner_.nodes.push_back(stretch.front() - model_.origin);
        for (std::size_t i = 1; i < stretch.size(); ++i)
        {
            const Vec2 from = stretch[i - 1] - model_.origin, to = stretch[i] - model_.origin;
            const Vec2 along = (to - from).normalized();
            const std::vector<Cut> cuts = cuts_of(from, to);
            for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
            {
                const bool last = closed && i + 1 == stretch.size() && k + 2 == cuts.size();
                if (!last)
                    liner_.nodes.push_back(k + 2 == cuts.size() ? to : Vec2(from + cuts[k + 1].at * along));
                const auto node = static_cast<Index>(liner_.nodes.size()) - 1;
                add_segment(last ? node : node - 1, last ? first : node, cuts[k].block);
            }
        }
    }

    void add_segment(Index first, Index second, Index block)
    {
        LinerSegment segment;
        segment.node[0] = first;
        segment.node[1] = second;
        segment.block = block;
        const Vec2 across = liner_.nodes[second] - liner_.nodes[first];
        segment.length = across.norm();
        segment.along = across / segment.length;
        for (int end = 0; end < 2; ++end)
            segment.arm[end] = block == no_index
                                   ? Vec2(0.0, 0.0)
                                   : Vec2(liner_.nodes[segment.node[end]] - Vec2(blocks_.motion[block].x, blocks_.motion[block].y));
        liner_.segments.push_back(segment);
    }

    [[nodiscard]] std::vector<Cut> cuts_of(const Vec2& from, const Vec2& to) const
    {
        const double length = (to - from).norm();
        const Vec2 along = (to - from) / length, into = behind * model_.mean_size * Vec2(along.y(), -along.x());
        std::vector<Cut> changes;
        double reached = 0.0;
        const double least = least_share * longest_;
        const auto change = [&](double at, Index block)
        {
            if (changes.empty())
                changes.push_back({0.0, block});
            else if (at - changes.back().at < least)
                changes.back().block = block;
            else if (length - at >= least)
                changes.push_back({at, block});
        };
        for (const PathPiece& piece : pieces_along(from + into, to + into, model_, blocks_, *plan_.gone))
        {
            if (piece.from - reached > least)
                change(reached, no_index);
            change(piece.from, piece.block);
            reached = piece.to;
        }
        if (length - reached > least)
            change(reached, no_index);
        changes.push_back({length, no_index});
        std::vector<Cut> cuts;
        for (std::size_t k = 0; k + 1 < changes.size(); ++k)
        {
            const double begin = changes[k].at, size = changes[k + 1].at - begin;
            const int number = static_cast<int>(std::max(1.0, std::ceil(size / longest_ - 1e-9)));
            for (int n = 0; n < number; ++n)
                cuts.push_back({begin + size * n / number, changes[k].block});
        }
        cuts.push_back({length, no_index});
        return cuts;
    }

    const LinerPlan& plan_;
    const Blocks& blocks_;
    const Model& model_;
    double longest_ = 0.0;
    Liner liner_;
};
}  // namespace

double longest_segment(const LinerDef& def)
{
    if (def.segment)
        return *def.segment;
    const double t = def.thickness, bending = def.modulus * def.inertia.value_or(t * t * t / 12.0);
    return std::min(thicknesses * t, lengths * std::sqrt(std::sqrt(4.0 * bending / def.normal_stiffness)));
}

std::optional<Liner> resolve_liner(const LinerPlan& plan, const Blocks& blocks, const Model& model)
{
    return LinerMaker(plan, blocks, model).make();
}
}  // namespace hdem
