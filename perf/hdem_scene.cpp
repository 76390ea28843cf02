/// Writes a scene of the benchmarks (bench_scenes.h) for other programs: hdem_scene <scene> <blocks> [FILE.json]. See perf/peers.md.

#include "core/check.h"
#include "io/atomic_file.h"
#include "perf/scene_run.h"

#include <nlohmann/json.hpp>

#include <charconv>
#include <cstdio>
#include <string_view>

namespace hdem::perf
{
namespace
{
nlohmann::json pair_of(double x, double y)
{
    return {x, y};
}

/// Convex parts of a block at its present pose, anticlockwise.
nlohmann::json parts_of(const Model& model, const BlockMotion& m, Index block)
{
    nlohmann::json parts = nlohmann::json::array();
    for (Index part = model.shapes.part_begin[block]; part < model.shapes.part_begin[block + 1]; ++part)
    {
        nlohmann::json polygon = nlohmann::json::array();
        for (Index v = model.shapes.vertex_begin[part]; v < model.shapes.vertex_begin[part + 1]; ++v)
        {
            const Vec2& at = model.shapes.vertex[v];
            polygon.push_back(pair_of(m.x + m.c * at.x() - m.s * at.y(), m.y + m.s * at.x() + m.c * at.y()));
        }
        parts.push_back(std::move(polygon));
    }
    return parts;
}

nlohmann::json scene_json(const std::string& scene, const Simulation& settled)
{
    const Model& model = settled.model();
    const CoulombSlip& joint = model.joints.laws.front();
    nlohmann::json blocks = nlohmann::json::array();
    for (Index i = 0; i < model.blocks(); ++i)
        blocks.push_back({{"name", model.name[i]},
                          {"fixed", !settled.state().blocks.is_free(i)},
                          {"mass", model.mass[i]},
                          {"area", model.area[i]},
                          {"parts", parts_of(model, settled.state().blocks.motion[i], i)}});
    return {{"scene", scene},
            {"gravity", pair_of(model.gravity.x(), model.gravity.y())},
            {"time_step", model.time_step},
            {"joint",
             {{"normal_stiffness", joint.normal_stiffness},
              {"shear_stiffness", joint.shear_stiffness},
              {"friction_coefficient", joint.friction_coefficient},
              {"cohesion", joint.cohesion}}},
            {"contact_points", settled.count_contacts().closed()},
            {"blocks", std::move(blocks)}};
}

int write_scene(const std::string& scene, std::string_view count, const std::string& file)
{
    Index blocks = 0;
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), blocks);
    if (error != std::errc() || end != count.data() + count.size() || blocks < 100)
        throw std::invalid_argument("blocks = " + std::string(count) + " (must be a whole number of at least 100)");
    const std::string text = scene_json(scene, settled_run(scene, blocks, Method::force, 1)).dump() + '\n';
    if (file.empty())
        std::fputs(text.c_str(), stdout);
    else
        write_atomically(file, text);
    return 0;
}
}  // namespace
}  // namespace hdem::perf

int main(int count, char** arguments)
{
    if (count < 3 || count > 4)
    {
        std::fputs("usage: hdem_scene <scene> <blocks> [FILE.json]\n", stderr);
        return 2;
    }
    try
    {
        return hdem::perf::write_scene(arguments[1], arguments[2], count == 4 ? arguments[3] : "");
    }
    catch (const std::invalid_argument& problem)
    {
        std::fprintf(stderr, "error: hdem_scene: %s\n", problem.what());
        return 2;
    }
    catch (const std::exception& problem)
    {
        std::fprintf(stderr, "error: hdem_scene: %s\n", problem.what());
        return 1;
    }
}
