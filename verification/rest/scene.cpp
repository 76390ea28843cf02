#include "verification/rest/scene.h"

#include "io/case_reader.h"
#include "verification/checks/case_run.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem::verification::rest
{
Scene new_scene(const std::string& family, int number)
{
    Scene scene{.family = family, .number = number};
    scene.def = read_case(case_folder() / "rest/block.toml");
    scene.def.title = "rest." + scene.name();
    scene.def.blocks.clear();
    constexpr std::array<Method, 3> methods{Method::force, Method::impulse, Method::hybrid};
    scene.def.contact.method = methods[static_cast<std::size_t>(number) % 3];
    return scene;
}

std::size_t add_block(Scene& scene, const std::string& name, Polygon polygon, Fate fate, double density)
{
    BlockDef block{.name = name, .polygon = std::move(polygon)};
    if (density != rock)
    {
        block.material = "of_" + name;
        scene.def.materials.push_back({.name = block.material, .density = density});
    }
    scene.def.blocks.push_back(std::move(block));
    scene.fate.push_back(fate);
    return scene.def.blocks.size() - 1;
}

std::size_t add_fixed(Scene& scene, const std::string& name, Polygon polygon)
{
    const std::size_t number = add_block(scene, name, std::move(polygon), Fate::open);
    BlockDef& block = scene.def.blocks.back();
    block.fix_x = block.fix_y = block.fix_rotation = true;
    return number;
}

JointDef& joint(Scene& scene)
{
    return scene.def.joints.front();
}

void draw_stiffness(Scene& scene, Draw& draw)
{
    joint(scene).normal_stiffness = draw.scale(2e9, 2e10);
    joint(scene).shear_stiffness = joint(scene).normal_stiffness * draw.scale(1.0 / 14.0, 1.0);
}

void draw_step(Scene& scene, Draw& draw, double limit)
{
    const double share = draw.between(0.1, 0.95);
    if (draw.chance(0.5))
        scene.def.time.step = share * limit;
}

double least_step(const Scene& scene, double limit)
{
    return scene.def.time.step.value_or(0.1 * limit);
}

void draw_placements(Scene& scene, Draw& draw)
{
    scene.placement = draw_placement(draw);
    scene.twin = draw_placement(draw);
}

Polygon rectangle(double x0, double y0, double x1, double y1)
{
    return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Polygon rectangle_along(const Vec2& corner, const Vec2& along, double length, double height)
{
    const Vec2 up = height * turned_left(along);
    return {corner, corner + length * along, corner + length * along + up, corner + up};
}

Vec2 direction(double angle_deg)
{
    return {std::cos(radians(angle_deg)), std::sin(radians(angle_deg))};
}

double size_of(const Polygon& polygon)
{
    return std::sqrt(area_moments(polygon).area);
}

double density_of(const Scene& scene, std::size_t block)
{
    const auto material = std::ranges::find(scene.def.materials, scene.def.blocks[block].material, &MaterialDef::name);
    return material->density;
}

double least_size(const Scene& scene)
{
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < scene.def.blocks.size(); ++i)
        least = scene.is_fixed(i) ? least : std::min(least, size_of(scene.def.blocks[i].polygon));
    return least;
}
}  // namespace hdem::verification::rest
