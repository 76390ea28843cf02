#pragma once
/// Pressure of standing or seeping water.
///
///   p = rho_w g max(h - y, 0)      below a water table; h and y against gravity
///   p = linear in length           from the foot of a water-filled crack to its outlet, where it is 0
///   p = linear in triangles        of a field from elsewhere
///
/// On the line of a crack, where the blocks are drawn, its own pressure counts, elsewhere that of the field if there is one, else that of the table.

#include "core/model/water.h"

namespace hdem
{
/// Pressure over a straight stretch.
struct PressureSum
{
    double force = 0.0;   ///< integral of p ds [N]
    double moment = 0.0;  ///< integral of p s ds, s from the first end [N m]
};

/// A straight stretch of a face, in local coordinates.
struct FaceStretch
{
    Vec2 from, to;              ///< now [m]
    Vec2 drawn_from, drawn_to;  ///< where its block is drawn [m]
    bool table_acts = true;     ///< else cracks alone
    bool cracks_act = true;
};

/// @param stage  whose table acts
[[nodiscard]] PressureSum pressure_along(const Water& water, Index stage, const FaceStretch& face);

/// The same of a face of a block that is where it was drawn.
[[nodiscard]] inline PressureSum pressure_along(const Water& water, Index stage, const Vec2& from, const Vec2& to)
{
    return pressure_along(water, stage, FaceStretch{.from = from, .to = to, .drawn_from = from, .drawn_to = to});
}

/// Pressure of the water in a joint at a place [Pa], local coordinates; where blocks are drawn for the line of a crack.
[[nodiscard]] double pressure_at(const Water& water, Index stage, const Vec2& at);

/// Triangles of the field, by Delaunay. @return false where all points lie on a line
[[nodiscard]] bool make_triangles(PressureField& field);
}  // namespace hdem
