#pragma once
/// A set of parallel planes in space, seen in a vertical section.

#include "core/model/rock_def.h"

#include <optional>

namespace hdem
{
struct SectionTrace
{
    double dip_deg = 0.0;  ///< as of a joint set: from +x, positive anticlockwise, -90 to 90 [deg]
    double stretch = 1.0;  ///< distance of the traces over that of the planes, at least 1 [-]
};

/// Traces of planes of dip delta and dip direction alpha in a section of azimuth zeta. With the upward normal of the planes,
/// n = (sin delta cos(alpha - zeta), cos delta) in the axes x, y of the section,
///
///   tan(dip) = -n_x / n_y,   tan |dip| = tan delta |cos(alpha - zeta)|  (apparent dip),   stretch = 1 / |n|
///
/// Nothing where the planes are parallel to the section.
[[nodiscard]] std::optional<SectionTrace> trace_in_section(const OrientationDef& plane);

/// The orientation of a set becomes its dip_deg, and its spacing that in the section. False where it is parallel to the section.
bool resolve_orientation(JointSetDef& set);
}  // namespace hdem
