/// Half-circular arches of blocks with radial joints, one of them heavier: stands, or falls, by limit analysis.
///
/// Above the greatest load that has admissible forces the arch falls for certain. Below it stands where friction does not decide, as the load is the same with
/// 10 degrees less of it (hinges open only, which is motion along the normals), and where a slow run agrees.

#include "verification/rest/families.h"
#include "verification/rest/limit_analysis.h"
#include "verification/rest/springs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem::verification::rest
{
namespace
{
constexpr double friction_reserve_deg = 10.0;

/// Greatest weight on top of its own that the arch's block number `loaded` may have [N]; nothing if the arch does not stand by itself.
std::optional<double> greatest_load(const Scene& scene, std::size_t loaded, double friction_deg)
{
    const std::vector<Body> bodies = bodies_of(scene);
    Loads live(bodies.size(), Eigen::Vector3d(0.0, 0.0, 0.0));
    live[loaded][1] = -1.0;
    return load_multiplier(bodies, touching_at_start(scene, bodies), {std::tan(radians(friction_deg)), 0.0},
                           weights(bodies, scene.def.gravity), live);
}

void add_arch(Scene& scene, double radius, double thickness, int count)
{
    const double inner = radius - 0.5 * thickness, outer = radius + 0.5 * thickness;
    add_fixed(scene, "ground", rectangle(-6.0 * radius, -3.0 * radius, 6.0 * radius, -2.0 * radius));
    add_fixed(scene, "right", rectangle(inner - 0.5 * thickness, -2.0 * radius, outer + 0.5 * thickness, 0.0));
    add_fixed(scene, "left", rectangle(-outer - 0.5 * thickness, -2.0 * radius, -inner + 0.5 * thickness, 0.0));
    for (int i = 0; i < count; ++i)
    {
        const Vec2 from = direction(180.0 * i / count), to = direction(180.0 * (i + 1) / count);
        add_block(scene, fmt::format("v{}", i + 1), {inner * from, outer * from, outer * to, inner * to}, Fate::open);
    }
}
}  // namespace

Scene arch_scene(int number)
{
    Draw draw("arch", number);
    Scene scene = new_scene("arch", number);
    joint(scene).normal_stiffness = draw.scale(7e9, 3e10);
    joint(scene).shear_stiffness = joint(scene).normal_stiffness * draw.between(0.3, 1.0);
    joint(scene).friction_angle_deg = draw.between(40.0, 50.0);
    const double radius = draw.between(1.0, 6.0), thickness = radius * draw.between(0.15, 0.3);
    const int count = draw.count(7, 25);
    const auto loaded = static_cast<std::size_t>(2 + draw.count(count / 4 + 1, count - count / 4));
    constexpr std::array<double, 6> shares{0.3, 0.6, 0.85, 1.1, 1.2, 1.5};
    const double share = draw.one_of(shares);
    add_arch(scene, radius, thickness, count);
    const double friction = joint(scene).friction_angle_deg;
    const std::optional<double> most = greatest_load(scene, loaded, friction);
    const std::optional<double> with_less = greatest_load(scene, loaded, friction - friction_reserve_deg);
    const double load = most && std::isfinite(*most) ? share * *most : 0.0;
    const double own = rock * g * area_moments(scene.def.blocks[loaded].polygon).area;
    scene.def.blocks[loaded].material = "heavy";
    scene.def.materials.push_back({.name = "heavy", .density = rock * (1.0 + load / own)});
    scene.what = fmt::format("{} blocks, radius {:.3g} m, {:.3g} m thick, at {} of what block v{} may carry", count, radius,
                             thickness, share, loaded - 2);
    scene.settle = elastic_settle(scene);
    const double limit = stable_limit(scene, 2.0);
    draw_step(scene, draw, limit);
    const double fall = 30.0 * std::sqrt(radius / g);  // slow at first, near the limit
    scene.def.stages[0].max_cycles = 60000 + static_cast<std::int64_t>(fall / least_step(scene, limit));
    const bool hinges = most && with_less && *with_less > 0.999 * *most;
    if (share > 1.0 && load > 0.0)
    {
        scene.someone_moves = true;
        scene.least_way = 0.01 * radius;
    }
    else if (hinges && load > 0.0)
    {
        std::fill(scene.fate.begin() + 3, scene.fate.end(), Fate::stays);
        scene.slow_run = 3.0 * std::sqrt(radius / g);
        scene.stay = 1e-3 * radius;
    }
    scene.same_in_twin = scene.fate.back() == Fate::stays;
    scene.end = scene.same_in_twin ? End::rests : End::open;
    draw_placements(scene, draw);
    return scene;
}
}  // namespace hdem::verification::rest
