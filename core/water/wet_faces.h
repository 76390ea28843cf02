#pragma once
/// Which faces of blocks are wet.

#include "core/water/dry_openings.h"

namespace hdem
{
/// Is there water between two blocks? Without ponded water, in joints that were drawn alone: what has fallen and lies on a floor below the water table would be
/// pressed off it, fall again without a pressure on it, and be thrown about.
[[nodiscard]] bool has_joint_water(const Model& model, const State& state, Index contact);

/// Cracks press on a block until it has gone far.
[[nodiscard]] bool do_cracks_act(const Model& model, const State& state, Index block);

/// Shares of a stretch of an edge that lay beside a removed block where they are drawn, until their block has gone far.
[[nodiscard]] Shares dry_as_drawn(const Model& model, const State& state, const DryOpenings& openings, Index block, Index edge,
                                  double from, double to);

/// Shares of a joint, from `a` to `b`, on one side of which there is a dry opening.
/// @param out  across the joint, Water::tolerance long
[[nodiscard]] Shares dry_beside(const DryOpenings& openings, const Vec2& a, const Vec2& b, const Vec2& out);

/// Did most of a stretch of an edge lie beside a removed block?
[[nodiscard]] bool was_beside_opening(const Model& model, const State& state, const DryOpenings& openings, Index block, Index edge,
                                      double from, double to);

/// Mean pressure of the water in a joint.
class JointPressure
{
  public:
    JointPressure(const Model& model, const State& state) : model_(model), state_(state), openings_(model, state) {}

    /// On the stretch from `from` to `to` on which its blocks face each other, local coordinates [Pa].
    [[nodiscard]] double mean(Index contact, const Vec2& from, const Vec2& to) const;

  private:
    [[nodiscard]] bool was_beside_opening(Index block, Index edge, const Vec2& from, const Vec2& to) const;

    const Model& model_;
    const State& state_;
    DryOpenings openings_;
};
}  // namespace hdem
