#include "core/rock/section.h"

#include "core/geometry/unit_direction.h"

#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
/// atan2 differs in the last bit from one platform to another: dips are multiples of this [deg].
constexpr double rounding = 0x1p-36;

constexpr double least_normal = 1e-6;  // planes that meet the section at less than this angle [rad] have no trace in it
}  // namespace

std::optional<SectionTrace> trace_in_section(const OrientationDef& plane)
{
    const Vec2 dip = unit_direction(plane.dip);  // cosine and sine
    const Vec2 n(dip.y() * unit_direction(plane.dip_direction - plane.section).x(), dip.x());
    const double length = n.norm();
    if (length < least_normal)
        return std::nullopt;
    if (n.y() == 0.0)
        return SectionTrace{90.0, 1.0 / length};
    const double angle = std::atan2(-n.x(), n.y()) * 180.0 / std::numbers::pi;
    return SectionTrace{rounding * std::round(angle / rounding), 1.0 / length};
}

bool resolve_orientation(JointSetDef& set)
{
    const std::optional<SectionTrace> seen = set.orientation ? trace_in_section(*set.orientation) : SectionTrace{set.dip_deg, 1.0};
    if (!seen)
        return false;
    set.dip_deg = seen->dip_deg;
    if (seen->stretch == 1.0)
        return true;
    set.spacing *= seen->stretch;
    set.spacing_law.mean *= seen->stretch;
    set.spacing_law.sd *= seen->stretch;
    for (std::optional<double>* limit : {&set.spacing_law.least, &set.spacing_law.most})
        if (*limit)
            **limit *= seen->stretch;
    return true;
}
}  // namespace hdem
