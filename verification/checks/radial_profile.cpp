#include "verification/checks/radial_profile.h"

#include "core/contact/contact_report.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace hdem::verification
{
namespace
{
Vec2 direction(double angle_deg)
{
    const double angle = radians(angle_deg);
    return {std::cos(angle), std::sin(angle)};
}

/// Where the ray meets the segment p-q, from its start [m].
std::optional<double> crossing(const Vec2& from, const Vec2& along, const Vec2& p, const Vec2& q)
{
    const Vec2 across = turned_left(along);
    const double side_p = across.dot(p - from);
    const double side_q = across.dot(q - from);
    if ((side_p > 0.0) == (side_q > 0.0))
        return {};
    const double distance = along.dot(p + (q - p) * (side_p / (side_p - side_q)) - from);
    return distance > 0.0 ? std::optional(distance) : std::nullopt;
}
}  // namespace

std::vector<StressPoint> stress_along(const Ray& ray, const Model& model, const State& state)
{
    const Vec2 along = direction(ray.angle_deg);
    const auto is_detached = [&](Index block)
    { return state.blocks.displacement(block).norm() > model.convergence.detached_distance; };
    std::vector<StressPoint> points;
    for (Index i = 0; i < state.contacts.size(); ++i)
    {
        if (!is_closed_contact(state, i))
            continue;
        const ContactReport contact = report_contact(state, i);
        const std::optional<double> at = crossing(ray.from, along, contact.point[0], contact.point[1]);
        if (!at || *at < ray.begins_at || *at > ray.reaches_to || is_detached(contact.first) || is_detached(contact.second))
            continue;
        points.push_back({.distance = *at,
                          .traction = std::hypot(contact.normal_force, contact.shear_force) / contact.bearing_length,
                          .normal = contact.normal_force / contact.bearing_length});
    }
    std::ranges::sort(points, {}, &StressPoint::distance);
    return points;
}

double distance_to_outline(const Vec2& from, double angle_deg, const Polygon& outline)
{
    double farthest = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        farthest = std::max(farthest,
                            crossing(from, direction(angle_deg), outline[i], outline[(i + 1) % outline.size()]).value_or(0.0));
    return farthest;
}
}  // namespace hdem::verification
