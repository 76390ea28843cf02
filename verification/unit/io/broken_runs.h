#pragma once
/// Runs that are broken off at a cycle, restarted from their checkpoint, and compared with the unbroken one.

#include "verification/runs/run_end.h"
#include "verification/scenes/scenes.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace hdem::test
{
/// Broken off at each of these cycles and restarted on each of these numbers of threads a run ends as the unbroken one did.
inline void expect_to_go_on(const CaseDef& scene, const std::filesystem::path& folder, const runs::RunEnd& unbroken,
                            const std::vector<std::int64_t>& cycles, const std::vector<int>& thread_numbers)
{
    for (const std::int64_t cycle : cycles)
    {
        runs::run_until(scene, cycle, folder);
        for (const int threads : thread_numbers)
            EXPECT_EQ(runs::restart(scene, folder, threads), unbroken) << "cycle " << cycle << ", threads " << threads;
    }
}

/// A tunnel in rock: blocks fall out after the excavation; the last stage changes method and damping.
inline CaseDef tunnel(Method method)
{
    CaseDef scene = scenes::joints(12.0, 12.0, 1.0, 3.0);
    scene.contact.method = method;
    scene.excavations = {{.name = "tunnel", .shape = OutlineShape::circle, .position = {6.0, 6.0}, .diameter = 4.0}};
    scene.stages = {{.name = "gravity", .until_converged = true, .max_cycles = 300},
                    {.name = "dig", .cycles = 900, .excavate = {"tunnel"}},
                    {.name = "other", .cycles = 200, .method = Method::hybrid, .damping = DampingPreset::dynamic}};
    scene.convergence.least_cycles = 100;
    scene.convergence.mean_speed = 1.0;
    return scene;
}
}  // namespace hdem::test
