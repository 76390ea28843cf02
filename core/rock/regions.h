#pragma once
/// Regions of the domain: which blocks lie in them.

#include "core/check.h"
#include "core/rock/block_cutter.h"

#include <string>
#include <vector>

namespace hdem
{
/// No block lies across the boundary of a region: it is an outline that was cut, or a fault. So one point inside of a block tells.
class Regions
{
  public:
    Regions(const CaseDef& def, const Polygon& domain);

    /// Blocks that lie across the boundary of a region, because a fault ends inside the domain, and regions without a block.
    /// @param mass cut by faults and outlines only
    [[nodiscard]] std::vector<Problem> find_problems(const CutMass& mass) const;

    /// Does the set cut the block?
    [[nodiscard]] bool is_meant(const JointSetDef& set, const CutBlock& block) const;

    /// Does the set cut what is at a point?
    [[nodiscard]] bool is_meant(const JointSetDef& set, const Vec2& point) const;

    /// Adds the shares of the way from `from` to `to` at which boundaries of the set's regions are met.
    void add_boundaries(const JointSetDef& set, const Vec2& from, const Vec2& to, std::vector<double>& shares) const;

    /// Does a point lie in the region of this name?
    [[nodiscard]] bool holds(const std::string& region, const Vec2& point) const;

    /// Adds the shares of a way at which the boundary of one region is met.
    void add_boundary(const std::string& region, const Vec2& from, const Vec2& to, std::vector<double>& shares) const;

    /// Material of the first region with one around each part, else of the domain; where parts differ, that of the greatest area. (The whole inside of an excavation,
    /// and blocks that slivers were joined to, may lie across a boundary.)
    /// @pre the block's parts are those that were cut
    [[nodiscard]] const std::string& material(const CutBlock& block) const;

  private:
    /// One side of a boundary.
    struct Limit
    {
        Polygon area;
        std::vector<CutPolygon> parts;  ///< of the area, convex
        bool is_inside = true;
        std::string fault;  ///< that bounds it, "" = the region's own outline

        [[nodiscard]] bool holds(const Vec2& point) const { return contains(area, point) == is_inside; }
    };

    void add_limit(std::size_t region, Polygon area, bool is_inside, const std::string& fault);
    [[nodiscard]] bool holds(std::size_t region, const Vec2& point) const;
    static double share_within(const Limit& limit, const CutBlock& block);

    const CaseDef& def_;
    std::vector<std::vector<Limit>> limits_;  ///< of each region; it is what all of them hold
};
}  // namespace hdem
