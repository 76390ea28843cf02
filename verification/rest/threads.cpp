/// The same bits on any number of threads: scenes large enough for three.

#include "core/check.h"
#include "verification/rest/families.h"
#include "verification/rest/judge.h"

#include <fmt/format.h>

#include <limits>

namespace hdem::verification::rest
{
namespace
{
constexpr std::int64_t cycles = 200;
constexpr std::size_t blocks = 1200;
constexpr Index least_contacts = 3 * 256;  // three threads take part from there on, see parallel/cycle.cpp

/// The scene, `count` times in a row.
void repeat(Scene& scene, std::size_t count)
{
    Box box = bounding_box(scene.def.blocks.front().polygon);
    for (const BlockDef& block : scene.def.blocks)
    {
        const Box own = bounding_box(block.polygon);
        box.low = box.low.cwiseMin(own.low);
        box.high = box.high.cwiseMax(own.high);
    }
    const Vec2 period((box.high - box.low).x(), 0.0);
    const std::vector<BlockDef> once = scene.def.blocks;
    for (std::size_t i = 1; i < count; ++i)
        for (BlockDef block : once)
        {
            block.name += fmt::format("_{}", i);
            for (Vec2& v : block.polygon)
                v += static_cast<double>(i) * period;
            scene.def.blocks.push_back(std::move(block));
        }
}
}  // namespace

Scene threads_scene(int number)
{
    Scene (*const of[])(int) = {rubble_scene, arch_scene};
    Scene scene = of[static_cast<std::size_t>(number) / 3 % 2](number);
    const std::size_t count = blocks / scene.def.blocks.size();
    repeat(scene, count);
    scene.what = fmt::format("{} times {}: {}", count, scene.name(), scene.what);
    scene.family = "threads";
    scene.number = number;
    return scene;
}

Findings judge_threads(const Scene& scene)
{
    Findings findings;
    const auto add = [&](bool wrong, const std::string& text) {
        findings.push_back({Judged::threads, wrong ? std::numeric_limits<double>::infinity() : 0.0, text});
    };
    try
    {
        const Trace one = trace(scene, scene.placement, cycles, 1);
        add(one.contacts < least_contacts, fmt::format("{} contacts: too few for three threads", one.contacts));
        for (const int threads : {2, 3})
            add(trace(scene, scene.placement, cycles, threads).hash != one.hash,
                fmt::format("other bits on {} threads after {} cycles", threads, cycles));
    }
    catch (const std::runtime_error& error)
    {
        findings.push_back({Judged::finished, std::numeric_limits<double>::infinity(), error.what()});
    }
    return findings;
}
}  // namespace hdem::verification::rest
