#include "verification/scenes/shear_box.h"

#include <cmath>

namespace hdem::scenes
{
std::string top_name(int i)
{
    return "top" + std::to_string(i);
}

CaseDef shear_box(const JointDef& joint, Cut cut, int pieces, double step, const std::vector<Move>& moves)
{
    CaseDef scene = empty_scene();
    const int below = cut == Cut::base ? pieces : 1, above = cut == Cut::top ? pieces : 1;
    for (int i = 0; i < below; ++i)
    {
        const double from = i == 0 ? -1.0 : box_width * i / below,
                     to = i == below - 1 ? box_width + 1.0 : box_width * (i + 1) / below;
        add_fixed_block(scene, "base" + std::to_string(i), rectangle({from, -1.0}, {to, 0.0}));
    }
    std::vector<std::string> tops;
    for (int i = 0; i < above; ++i)
    {
        tops.push_back(top_name(i));
        add_block(scene, tops.back(), rectangle({box_width * i / above, 0.0}, {box_width * (i + 1) / above, 0.5}));
        scene.blocks.back().fix_x = scene.blocks.back().fix_rotation = true;
    }
    scene.loads.push_back({.blocks = tops, .force = {0.0, -box_pressure * box_width / above}});
    std::int64_t from = 0;
    for (const Move& move : moves)
    {
        const std::int64_t until = from + move.cycles;
        if (move.cycles > 0)
            scene.loads.push_back({.blocks = tops,
                                   .velocity_x = move.way / (step * static_cast<double>(move.cycles)),
                                   .interval = {.from_cycle = from, .until_cycle = until}});
        from = until + move.rest;
    }
    scene.joints = {joint};
    scene.gravity = {0.0, 0.0};
    scene.time.step = step;
    scene.contact.method = Method::force;
    scene.stages = {{.name = "shear", .cycles = 1}};
    return scene;
}

std::vector<Move> slow_moves()
{
    const double slow = 20e-6, slower = 0.1e-6;
    std::vector<Move> moves{{0.0, 0, 2000}};
    double last = 0.0;
    for (const double to : {2e-3, 5e-3, 0.0, -5e-3})
    {
        const double sign = to > last ? 1.0 : -1.0, way = std::abs(to - last) - slow - slower;
        moves.push_back({sign * way, static_cast<std::int64_t>(way / 5e-7), 1000});
        moves.push_back({sign * slow, 5000, 1000});
        moves.push_back({sign * slower, 2000, 0});
        last = to;
    }
    return moves;
}

std::vector<Move> ten_fast_reversals()
{
    std::vector<Move> moves{{5e-3, 2500, 0}};
    for (int i = 0; i < 20; ++i)
        moves.push_back({i % 2 == 0 ? -1e-2 : 1e-2, 5000, 0});
    return moves;
}
}  // namespace hdem::scenes
