/// Writing one frame of blocks and contacts to disk, flushed: frame/<scene>/<blocks>.

#include "io/frame_writer.h"
#include "perf/scene_run.h"

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>

namespace hdem::perf
{
namespace
{
void write_frames(benchmark::State& bench, const std::string& scene, Index blocks)
{
    const Simulation run = settled_run(scene, blocks, Method::hybrid, 1);
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / ("hdem_perf_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder / "frames");
    FrameWriter writer(folder, run.model());
    for (auto _ : bench)
        writer.write(run.model(), run.state());
    std::uintmax_t bytes = 0;
    for (const std::string kind : {"blocks", "contacts"})
        bytes += std::filesystem::file_size(folder / frame_file(kind, 0));
    std::filesystem::remove_all(folder);
    bench.counters["megabytes"] = 1e-6 * static_cast<double>(bytes);
    bench.counters["blocks"] = static_cast<double>(run.model().blocks());
    bench.counters["contact_points"] = static_cast<double>(run.count_contacts().closed());
}

[[maybe_unused]] const bool registered = []
{
    for (const char* scene : {"voronoi", "joints"})
        for (const Index blocks : {500, 10'000, 100'000})
            benchmark::RegisterBenchmark(("frame/" + std::string(scene) + "/" + std::to_string(blocks)).c_str(),
                                         [=](benchmark::State& bench) { write_frames(bench, scene, blocks); })
                ->UseRealTime()
                ->Unit(benchmark::kMillisecond);
    return true;
}();
}  // namespace
}  // namespace hdem::perf
