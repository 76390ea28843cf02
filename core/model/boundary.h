#pragma once
/// Sides of the domain with names resolved to blocks: what holds or presses them, and in which stages. Constant during a run.
/// What acts follows from the number of the stage alone, so that a checkpoint holds nothing of it but the blocks' own state.

#include "core/model/boundary_def.h"
#include "core/model/factor.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace hdem
{
/// An edge of a block on a side, as drawn. It runs anticlockwise around the domain.
struct BoundaryFace
{
    Index block = no_index;
    Vec2 from = {0.0, 0.0};  ///< local coordinates [m]
    Vec2 to = {0.0, 0.0};
    Vec2 body_from = {0.0, 0.0};  ///< the same in the block's frame [m]
    Vec2 body_to = {0.0, 0.0};
};

/// A wall behind one edge of the domain.
struct BoundaryWall
{
    Index block = no_index;
    Vec2 start = {0.0, 0.0};   ///< of the edge, local coordinates [m]
    Vec2 along = {1.0, 0.0};   ///< the edge's direction, anticlockwise around the domain [-]
    double length = 0.0;       ///< of the edge [m]
    Vec2 centre = {0.0, 0.0};  ///< centroid of the wall as drawn, local coordinates [m]

    /// Unit vector into the domain [-].
    [[nodiscard]] Vec2 inward() const { return {-along.y(), along.x()}; }
    /// Does a face lie on this edge of the domain?
    [[nodiscard]] bool is_behind(const BoundaryFace& face) const
    {
        const auto is_on = [&](const Vec2& at) { return std::abs((at - start).dot(inward())) < 1e-6 * length; };
        return is_on(face.from) && is_on(face.to);
    }
};

/// Constant force of a traction on a block, at its centroid.
struct BoundaryForce
{
    Index block = no_index;
    double x = 0.0;  ///< [N]
    double y = 0.0;
    double moment = 0.0;                  ///< [N m]
    double xx = 0.0, yy = 0.0, xy = 0.0;  ///< integral of arm (x) traction, made symmetric; the arm is seen from the centroid [N m]
};

/// Does this kind have walls that move?
[[nodiscard]] inline bool moves_walls(BoundaryKind kind)
{
    return kind == BoundaryKind::velocity || kind == BoundaryKind::servo;
}

struct Boundary
{
    std::string name;
    BoundaryKind kind = BoundaryKind::fixed;
    Vec2 velocity = {0.0, 0.0};          ///< kind velocity [m/s]
    double target = 0.0;                 ///< kind servo: compression [Pa]
    double max_velocity = 0.0;           ///< kind servo [m/s]
    std::vector<std::uint8_t> in_stage;  ///< per stage: does it act?
    std::vector<BoundaryFace> faces;     ///< of blocks on the side
    std::vector<BoundaryWall> walls;     ///< of roller, velocity and servo
    std::vector<BoundaryForce> forces;   ///< of stress, one a block
    std::vector<Index> holds;            ///< of fixed: blocks that nothing else in the case holds
    Factor factor;                       ///< of velocity, target, forces

    [[nodiscard]] bool acts(Index stage) const
    {
        return stage >= 0 && static_cast<std::size_t>(stage) < in_stage.size() && in_stage[static_cast<std::size_t>(stage)] != 0;
    }
};
}  // namespace hdem
