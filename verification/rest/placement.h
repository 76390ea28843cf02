#pragma once
/// Where and which way round a scene stands: turned, mirrored, shifted. What happens in it does not depend on that.

#include "core/model/case_def.h"
#include "verification/rest/draw.h"

#include <string>

namespace hdem::verification::rest
{
/// x -> shift + R M x, with M the mirror x -> -x or nothing, and R the turn.
struct Placement
{
    double angle_deg = 0.0;
    double c = 1.0;  ///< cosine and sine of the angle; exact for quarter turns [-]
    double s = 0.0;
    bool mirrored = false;
    Vec2 shift = {0.0, 0.0};  ///< [m]

    [[nodiscard]] Vec2 turned(const Vec2& direction) const;
    [[nodiscard]] Vec2 turned_back(const Vec2& direction) const;
    [[nodiscard]] Vec2 placed(const Vec2& point) const { return shift + turned(point); }
    /// Sign of an angle, an angular velocity or a moment in this placement.
    [[nodiscard]] double sense() const { return mirrored ? -1.0 : 1.0; }
    /// "turned 213.4°, mirrored, at (1e5, 3e4) m"
    [[nodiscard]] std::string name() const;
};

[[nodiscard]] Placement turned_by(double angle_deg);

/// Quarter turns and other angles, mirrored or not, at the origin or up to 1e5 m away.
[[nodiscard]] Placement draw_placement(Draw& draw);

/// The same case with all its blocks, velocities, loads and gravity in that place. Only for cases of explicit blocks.
[[nodiscard]] CaseDef placed(CaseDef def, const Placement& placement);
}  // namespace hdem::verification::rest
