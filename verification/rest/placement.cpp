#include "verification/rest/placement.h"

#include "core/check.h"

#include <fmt/format.h>

namespace hdem::verification::rest
{
Vec2 Placement::turned(const Vec2& direction) const
{
    const double x = mirrored ? -direction.x() : direction.x();
    const double y = direction.y();
    return {c * x - s * y, s * x + c * y};
}

Vec2 Placement::turned_back(const Vec2& direction) const
{
    const double x = c * direction.x() + s * direction.y();
    const double y = -s * direction.x() + c * direction.y();
    return {mirrored ? -x : x, y};
}

std::string Placement::name() const
{
    std::string text = fmt::format("turned {:.4g}°{}", angle_deg, mirrored ? ", mirrored" : "");
    if (shift.norm() > 0.0)
        text += fmt::format(", at ({:.4g}, {:.4g}) m", shift.x(), shift.y());
    return text;
}

Placement turned_by(double angle_deg)
{
    Placement placement{.angle_deg = angle_deg};
    const double quarters = angle_deg / 90.0;
    if (quarters == std::round(quarters))
    {
        constexpr std::array<double, 4> cosine{1.0, 0.0, -1.0, 0.0};
        const auto quarter = static_cast<std::size_t>(std::lround(quarters) % 4 + 4) % 4;
        placement.c = cosine[quarter];
        placement.s = cosine[(quarter + 3) % 4];
    }
    else
    {
        placement.c = std::cos(radians(angle_deg));
        placement.s = std::sin(radians(angle_deg));
    }
    return placement;
}

Placement draw_placement(Draw& draw)
{
    const bool in_quarters = draw.chance(0.4);
    const double quarter = 90.0 * draw.count(0, 3);
    const double any = draw.between(0.0, 360.0);
    Placement placement = turned_by(in_quarters ? quarter : any);
    placement.mirrored = draw.chance(0.5);
    const bool far = draw.chance(0.6);
    const double distance = draw.scale(1.0, 1e5);
    const double way = draw.between(0.0, 360.0);
    if (far)
        placement.shift = distance * Vec2(std::cos(radians(way)), std::sin(radians(way)));
    return placement;
}

CaseDef placed(CaseDef def, const Placement& placement)
{
    if (def.domain.given)
        throw InputError(Problem{.key = "domain", .text = "domain: given (only explicit blocks can be turned). Give [[block]]."});
    for (BlockDef& block : def.blocks)
    {
        for (Vec2& vertex : block.polygon)
            vertex = placement.placed(vertex);
        block.velocity = placement.turned(block.velocity);
        block.angular_velocity *= placement.sense();
    }
    for (LoadDef& load : def.loads)
    {
        load.acceleration = placement.turned(load.acceleration);
        load.force = placement.turned(load.force);
        load.moment *= placement.sense();
    }
    def.gravity = placement.turned(def.gravity);
    return def;
}
}  // namespace hdem::verification::rest
