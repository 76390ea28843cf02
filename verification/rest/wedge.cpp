/// Plane failure of a slope: a wedge between the slope's face, its level top and a plane that comes out above the toe.
///
///   F = (W cos(psi) tan(phi) + c L) / (W sin(psi))        [Hoek and Bray 1981], dry, without tension crack
///
/// psi dip of the plane, L its length. The weight acts in the middle third of the plane, so that both ends of it bear.

#include "verification/rest/families.h"
#include "verification/rest/springs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem::verification::rest
{
Scene wedge_scene(int number)
{
    Draw draw("wedge", number);
    Scene scene = new_scene("wedge", number);
    draw_stiffness(scene, draw);
    constexpr std::array<double, 6> factors{0.8, 0.95, 0.99, 1.01, 1.05, 1.3};
    const double factor = draw.one_of(factors);
    const double height = draw.scale(1.0, 50.0), face_deg = draw.between(50.0, 80.0);
    const double dip_deg = draw.between(25.0, face_deg - 15.0);
    const double dip = radians(dip_deg);
    const double length = height / std::sin(dip);
    const Vec2 toe(0.0, 0.0), crest = length * direction(dip_deg), edge(height / std::tan(radians(face_deg)), height);
    const double below = 0.3 * height, foot = -below / std::tan(radians(face_deg));
    add_fixed(scene, "ground", rectangle(-15.0 * height, -below - height, crest.x(), -below));
    add_fixed(scene, "slope", {{foot, -below}, {crest.x(), -below}, crest, toe});
    add_block(scene, "wedge", {toe, crest, edge}, factor > 1.0 ? Fate::stays : Fate::moves);

    const double weight = rock * g * area_moments(scene.def.blocks.back().polygon).area;
    const double by_cohesion = draw.chance(0.3) ? 0.0 : draw.between(0.1, 0.9);
    joint(scene).friction_angle_deg = std::atan((1.0 - by_cohesion) * factor * std::tan(dip)) / radians(1.0);
    joint(scene).cohesion = by_cohesion * factor * weight * std::sin(dip) / length;
    scene.settle = weight / length * (std::cos(dip) / joint(scene).normal_stiffness + std::sin(dip) / joint(scene).shear_stiffness);
    scene.what = fmt::format("{:.3g} m high, face {:.3g}°, plane {:.3g}°, F = {:.4g}, {:.2g} of it cohesion", height, face_deg,
                             dip_deg, factor, by_cohesion);
    const double limit = stable_limit(scene);
    draw_step(scene, draw, limit);
    if (factor > 1.0)
    {
        scene.stay = scene.settle * (5.0 + 1.0 / (factor - 1.0));  // as on a slope, see incline.cpp
        scene.def.stages[0].max_cycles = 60000;
    }
    else
    {
        constexpr std::int64_t cycles = 60000;
        const double acceleration = (1.0 - factor) * g * std::sin(dip);
        const double slow_way = 0.5 * 0.2 * acceleration * std::pow(static_cast<double>(cycles) * least_step(scene, limit), 2);
        scene.least_way = std::min(0.1 * height, 0.25 * slow_way);
        scene.end = End::open;
        scene.same_in_twin = false;  // it tips over the edge, and falls
        scene.def.stages[0].max_cycles = cycles;
    }
    draw_placements(scene, draw);
    return scene;
}
}  // namespace hdem::verification::rest
