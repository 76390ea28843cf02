#pragma once
/// Openings without water: the places of blocks that were removed from drained excavations.

#include "core/model/model.h"
#include "core/state/state.h"

#include <array>
#include <vector>

namespace hdem
{
[[nodiscard]] inline Vec2 to_world(const BlockMotion& motion, const Vec2& body)
{
    return {motion.x + motion.c * body.x() - motion.s * body.y(), motion.y + motion.s * body.x() + motion.c * body.y()};
}

[[nodiscard]] inline Vec2 to_body(const BlockMotion& motion, const Vec2& world)
{
    const Vec2 d(world.x() - motion.x, world.y() - motion.y);
    return {motion.c * d.x() + motion.s * d.y(), -motion.s * d.x() + motion.c * d.y()};
}

/// Shares of a stretch, [from, until], each in [0, 1].
using Shares = std::vector<std::array<double, 2>>;

class DryOpenings
{
  public:
    DryOpenings(const Model& model, const State& state);

    /// Shares of the way from `a` to `b` that lie in a removed block where it was when it was removed; ascending.
    [[nodiscard]] Shares inside(const Vec2& a, const Vec2& b) const { return inside(a, b, Place::removed); }
    /// The same where blocks are drawn. A face that was drawn beside a removed block stays dry as it moves away from the opening.
    [[nodiscard]] Shares inside_as_drawn(const Vec2& a, const Vec2& b) const { return inside(a, b, Place::drawn); }

  private:
    enum class Place
    {
        removed,
        drawn
    };
    [[nodiscard]] Shares inside(const Vec2& a, const Vec2& b, Place place) const;
    [[nodiscard]] BlockMotion pose(Index block, Place place) const;
    void add_part(Index part);
    void cut(Index part, const Vec2& a, const Vec2& b, Shares& found) const;

    const Model& model_;
    const State& state_;
    std::vector<Index> parts_;
    Vec2 low_, high_;  ///< of a box around all of them
};
}  // namespace hdem
