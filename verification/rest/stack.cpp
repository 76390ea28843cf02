/// Blocks on each other on level ground, whose centres of gravity lie above what carries them: stacks, dropped stacks, beams on two pillars, and bricks
/// that reach over an edge up to, or beyond, the sum of 1/(2k) of their length.

#include "verification/rest/families.h"
#include "verification/rest/springs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hdem::verification::rest
{
namespace
{
struct Brick
{
    double x = 0.0;  ///< of its middle [m]
    double width = 0.0;
    double height = 0.0;
    double density = rock;
    [[nodiscard]] double weight() const { return density * width * height * g; }
    [[nodiscard]] double left() const { return x - 0.5 * width; }
    [[nodiscard]] double right() const { return x + 0.5 * width; }
};
using Bricks = std::vector<Brick>;

double weight_above(const Bricks& bricks, std::size_t k)
{
    double weight = 0.0;
    for (std::size_t i = k; i < bricks.size(); ++i)
        weight += bricks[i].weight();
    return weight;
}

/// How far from the middle of what carries it the weight of bricks k and above acts, as a share of half of that length.
double eccentricity(const Bricks& bricks, std::size_t k)
{
    double moment = 0.0;
    for (std::size_t i = k; i < bricks.size(); ++i)
        moment += bricks[i].weight() * bricks[i].x;
    const double left = k == 0 ? bricks[0].left() : std::max(bricks[k].left(), bricks[k - 1].left());
    const double right = k == 0 ? bricks[0].right() : std::min(bricks[k].right(), bricks[k - 1].right());
    if (right <= left)
        return 1e9;
    return std::abs(moment / weight_above(bricks, k) - 0.5 * (left + right)) / (0.5 * (right - left));
}

double greatest_eccentricity(const Bricks& bricks)
{
    double greatest = 0.0;
    for (std::size_t k = 0; k < bricks.size(); ++k)
        greatest = std::max(greatest, eccentricity(bricks, k));
    return greatest;
}

Bricks draw_bricks(Draw& draw, bool centred)
{
    Bricks bricks(static_cast<std::size_t>(draw.chance(0.1) ? 20 : draw.count(1, 8)));
    const double size = draw.scale(0.1, 5.0);
    const bool odd_one = draw.chance(0.3);
    const auto odd = static_cast<std::size_t>(draw.count(0, static_cast<int>(bricks.size()) - 1));
    const double odd_density = rock * draw.scale(0.01, 10.0);
    for (std::size_t i = 0; i < bricks.size(); ++i)
    {
        bricks[i] = {draw.between(-0.3, 0.3) * size, size * draw.between(0.6, 1.6), size * draw.between(0.2, 0.8),
                     odd_one && i == odd ? odd_density : rock};
        bricks[i].x = centred ? 0.0 : bricks[i].x;
    }
    while (greatest_eccentricity(bricks) > 0.7)
        for (Brick& brick : bricks)
            brick.x *= 0.8;
    return bricks;
}

/// Forces between neighbours are the weight above, each block lies where it was, or where it falls.
Scene stack(int number, Draw& draw, bool dropped)
{
    Scene scene = new_scene("stack", number);
    draw_stiffness(scene, draw);
    joint(scene).friction_angle_deg = draw.between(15.0, 45.0);
    const Bricks bricks = draw_bricks(draw, dropped);
    const double half = 20.0 * bricks[0].width;
    add_fixed(scene, "ground", rectangle(-half, -bricks[0].width, half, 0.0));
    double top = 0.0, gaps = 0.0;
    for (std::size_t i = 0; i < bricks.size(); ++i)
    {
        const Brick& b = bricks[i];
        const std::size_t block = add_block(scene, fmt::format("b{}", i + 1), rectangle(b.left(), top, b.right(), top + b.height),
                                            Fate::stays, b.density);
        scene.supports.push_back({block - 1, block, weight_above(bricks, i), 1e-2 * weight_above(bricks, i)});
        top += b.height;
    }
    scene.settle = elastic_settle(scene);
    scene.stay = 20.0 * scene.settle;
    const double limit = stable_limit(scene, 2.0);
    for (std::size_t i = 0; dropped && i < bricks.size(); ++i)
    {
        gaps += draw.chance(0.5) ? draw.scale(1e-3, 1e-2) : 0.0;
        Polygon& polygon = scene.def.blocks[i + 1].polygon;
        scene.places.push_back({i + 1, area_moments(polygon).centroid, 1e-3 * bricks[i].width + 20.0 * scene.settle});
        scene.fate[i + 1] = Fate::open;
        for (Vec2& v : polygon)
            v.y() += gaps;
    }
    scene.same_in_twin = !dropped;  // where each corner hits, round-off decides
    draw_step(scene, draw, limit);
    // A tower of 20 blocks sways for ten seconds.
    scene.def.stages[0].max_cycles = 200000 + static_cast<std::int64_t>(10.0 * std::sqrt(gaps / g) / least_step(scene, limit));
    scene.what = fmt::format("{} blocks{}, eccentricity {:.2g}", bricks.size(),
                             dropped ? fmt::format(", dropped {:.2g} m", gaps) : "", greatest_eccentricity(bricks));
    return scene;
}

/// Loads of the pillars by the lever of the beam's centroid.
Scene beam(int number, Draw& draw)
{
    Scene scene = new_scene("stack", number);
    draw_stiffness(scene, draw);
    joint(scene).friction_angle_deg = draw.between(15.0, 45.0);
    const double size = draw.scale(0.1, 5.0);
    const double height = size * draw.between(0.5, 2.0), width = size * draw.between(0.3, 0.8),
                 span = size * draw.between(0.2, 3.0);
    const double left_end = draw.between(0.0, 0.4) * size, right_end = draw.between(0.0, 0.4) * size,
                 thick = size * draw.between(0.3, 1.0);
    add_fixed(scene, "ground", rectangle(-20.0 * size, -size, 20.0 * size, 0.0));
    const std::size_t left = add_block(scene, "left", rectangle(0.0, 0.0, width, height), Fate::stays);
    const std::size_t right = add_block(scene, "right", rectangle(width + span, 0.0, 2.0 * width + span, height), Fate::stays);
    const Polygon polygon = rectangle(-left_end, height, 2.0 * width + span + right_end, height + thick);
    const std::size_t over = add_block(scene, "beam", polygon, Fate::stays);
    const double weight = rock * g * area_moments(polygon).area;
    // The load of each lies somewhere on its pillar: only their sum is certain, and that each carries what its far side allows.
    const double centre = area_moments(polygon).centroid.x();
    const double most = weight * (2.0 * width + span - centre) / (width + span),
                 least = weight * (width + span - centre) / (width + span);
    scene.supports.push_back(
        {left, over, 0.5 * (most + std::max(least, 0.0)), 0.5 * (most - std::max(least, 0.0)) + 1e-2 * weight});
    scene.supports.push_back(
        {0, left, scene.supports[0].force + rock * g * width * height, scene.supports[0].tolerance + 1e-2 * weight});
    scene.supports.push_back({right, over, weight - scene.supports[0].force, scene.supports[0].tolerance});
    scene.settle = elastic_settle(scene);
    scene.stay = 20.0 * scene.settle;
    draw_step(scene, draw, stable_limit(scene));
    scene.def.stages[0].max_cycles = 60000;
    scene.what = fmt::format("beam over {:.3g} m on pillars of {:.3g} x {:.3g} m", span, width, height);
    return scene;
}

/// n bricks of length 1 reach farthest, share 1, with the offsets 1/2, 1/4, 1/6, ... from the top down.
Scene overhang(int number, Draw& draw)
{
    Scene scene = new_scene("stack", number);
    draw_stiffness(scene, draw);
    joint(scene).friction_angle_deg = draw.between(20.0, 45.0);
    constexpr std::array<double, 6> shares{0.8, 0.9, 0.95, 1.05, 1.1, 1.3};
    const double share = draw.one_of(shares);
    const int count = draw.count(1, 5);
    const double length = draw.scale(0.1, 5.0), height = length * draw.between(0.2, 0.7);
    const double table = 3.0 * length;
    add_fixed(scene, "ground", rectangle(-20.0 * length, -table - length, 20.0 * length, -table));
    add_fixed(scene, "table", rectangle(-4.0 * length, -table, 0.0, 0.0));
    double end = 0.0, y = 0.0;
    for (int k = count; k >= 1; --k)
    {
        end += share * length / (2.0 * k);
        add_block(scene, fmt::format("b{}", count - k + 1), rectangle(end - length, y, end, y + height),
                  share < 1.0 ? Fate::stays : Fate::open);
        y += height;
    }
    scene.settle = elastic_settle(scene);
    const double limit = stable_limit(scene, 2.0);
    draw_step(scene, draw, limit);
    scene.what = fmt::format("{} bricks of {:.3g} x {:.3g} m at {} of their farthest overhang", count, length, height, share);
    if (share < 1.0)
    {
        scene.stay = 20.0 * scene.settle / (1.0 - share);
        scene.def.stages[0].max_cycles = 60000;
        return scene;
    }
    scene.settle = rock * g * height * count / joint(scene).normal_stiffness;
    scene.fate.back() = Fate::moves;
    scene.least_way = 0.3 * height;
    scene.end = End::open;
    scene.same_in_twin = false;
    scene.def.stages[0].max_cycles = 20000 + static_cast<std::int64_t>(20.0 * std::sqrt(length / g) / least_step(scene, limit));
    return scene;
}
}  // namespace

Scene stack_scene(int number)
{
    Draw draw("stack", number);
    const double kind = draw.between(0.0, 1.0);
    Scene scene = kind < 0.4    ? stack(number, draw, false)
                  : kind < 0.6  ? stack(number, draw, true)
                  : kind < 0.75 ? beam(number, draw)
                                : overhang(number, draw);
    draw_placements(scene, draw);
    return scene;
}
}  // namespace hdem::verification::rest
