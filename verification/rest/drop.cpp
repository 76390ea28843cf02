/// A block falls 1 cm to 5 m beside or on another one that stands: it lies where it falls, the other one stays.

#include "verification/rest/families.h"
#include "verification/rest/springs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hdem::verification::rest
{
namespace
{
struct Drop
{
    double width = 0.0;   ///< of what falls [m]
    double height = 0.0;  ///< [m]
    double fall = 0.0;    ///< [m]
    double beside = 0.0;  ///< width of what stands [m]
    double beside_height = 0.0;
};

double settle_of(Scene& scene, double load, double length)
{
    return load / (joint(scene).normal_stiffness * length);
}

/// Cycles that the fall takes, and then its rest.
std::int64_t cycles_to_rest(const Scene& scene, double fall, double limit)
{
    return 30000 + static_cast<std::int64_t>(5.0 * std::sqrt(2.0 * fall / g) / least_step(scene, limit));
}

Polygon turned_about_centroid(const Polygon& polygon, double angle_deg)
{
    const Vec2 centre = area_moments(polygon).centroid;
    const Placement turn = turned_by(angle_deg);
    Polygon turned;
    for (const Vec2& v : polygon)
        turned.push_back(centre + turn.turned(v - centre));
    return turned;
}

/// Flat on the ground, or turned: then it may roll, and hit what stands.
void fall_beside(Scene& scene, const Drop& drop, Draw& draw)
{
    const bool flat = draw.chance(0.6);
    const double angle = draw.between(0.0, 90.0);
    const double reach = std::hypot(drop.width, drop.height);
    const double gap = draw.scale(0.1, 2.0) * std::min(drop.width, drop.beside);
    Polygon polygon = rectangle(0.0, 0.0, drop.width, drop.height);
    if (!flat)
        polygon = turned_about_centroid(polygon, angle);
    const double lift = drop.fall - bounding_box(polygon).low.y();
    const double shift = 0.5 * drop.beside + gap - bounding_box(polygon).low.x();
    for (Vec2& v : polygon)
        v += Vec2(shift, lift);
    add_block(scene, "stands", rectangle(-0.5 * drop.beside, 0.0, 0.5 * drop.beside, drop.beside_height), Fate::stays);
    add_block(scene, "falls", polygon, Fate::moves);
    scene.least_way = 0.9 * drop.fall;
    const double light_part = drop.width * drop.height / (drop.beside * drop.beside_height);
    const double slide = flat ? 0.0 : light_part * (drop.fall + reach) / std::tan(radians(joint(scene).friction_angle_deg));
    scene.stay = 20.0 * scene.settle + slide;
    scene.same_in_twin = flat;
    scene.what += flat ? ", flat" : fmt::format(", turned by {:.3g}°", angle);
    if (flat)
        scene.places.push_back({2, area_moments(polygon).centroid - Vec2(0.0, drop.fall), 1e-3 * reach + 10.0 * scene.settle});
    else if (light_part * drop.fall > 0.05 * drop.beside)
        scene.fate[1] = Fate::open;  // heavy enough to throw it over
}

/// In the middle of what stands; a heavier one from a few centimetres only.
void fall_on(Scene& scene, Drop drop)
{
    if (drop.width > drop.beside)
        drop.fall = std::min(drop.fall, 0.05 * drop.beside);
    const double top = drop.beside_height;
    add_block(scene, "stands", rectangle(-0.5 * drop.beside, 0.0, 0.5 * drop.beside, top), Fate::stays);
    const Polygon polygon = rectangle(-0.5 * drop.width, top + drop.fall, 0.5 * drop.width, top + drop.fall + drop.height);
    add_block(scene, "falls", polygon, Fate::moves);
    scene.least_way = 0.9 * drop.fall;
    const double load = rock * g * (drop.width * drop.height + drop.beside * drop.beside_height);
    scene.settle = settle_of(scene, load, drop.beside) +
                   settle_of(scene, rock * g * drop.width * drop.height, std::min(drop.width, drop.beside));
    scene.stay = 1e-3 * std::min(drop.width, drop.beside) + 20.0 * scene.settle;
    scene.places.push_back({2, area_moments(polygon).centroid - Vec2(0.0, drop.fall), scene.stay});
    scene.same_in_twin = false;  // which corner hits first, round-off decides; where it lies is judged above
    scene.what += ", on it";
}
}  // namespace

Scene drop_scene(int number)
{
    Draw draw("drop", number);
    Scene scene = new_scene("drop", number);
    draw_stiffness(scene, draw);
    joint(scene).friction_angle_deg = draw.between(20.0, 45.0);
    Drop drop{.width = draw.scale(0.1, 10.0), .fall = draw.scale(0.01, 5.0), .beside = draw.scale(0.1, 10.0)};
    drop.height = drop.width * draw.between(0.5, 1.5);
    drop.beside_height = drop.beside * draw.between(0.5, 1.5);
    const bool on = draw.chance(0.2);
    if (on)
        drop.width = std::min(drop.width, 3.0 * drop.beside);
    drop.height = std::min(drop.height, 1.5 * drop.width);
    const double widest = std::max(drop.width, drop.beside);
    add_fixed(scene, "ground", rectangle(-60.0 * widest, -2.0 * widest, 60.0 * widest, 0.0));
    scene.settle = std::max(settle_of(scene, rock * g * drop.width * drop.height, drop.width),
                            settle_of(scene, rock * g * drop.beside * drop.beside_height, drop.beside));
    scene.what = fmt::format("{:.3g} x {:.3g} m falls {:.3g} m, {:.3g} x {:.3g} m stands", drop.width, drop.height, drop.fall,
                             drop.beside, drop.beside_height);
    if (on)
        fall_on(scene, drop);
    else
        fall_beside(scene, drop, draw);
    const double limit = on ? stable_limit(scene, 2.0) : stable_limit(scene);
    draw_step(scene, draw, limit);
    scene.def.stages[0].max_cycles = cycles_to_rest(scene, drop.fall, limit);
    draw_placements(scene, draw);
    return scene;
}
}  // namespace hdem::verification::rest
