#include "perf/counters.h"

#include <map>

namespace hdem::perf
{
void report_points(benchmark::State& bench, double points)
{
    bench.counters["contact_point_updates_per_second"] = benchmark::Counter(points, benchmark::Counter::kIsRate);
    bench.counters["ns_per_contact_point"] = benchmark::Counter(1e-9 * points,
                                                                benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void report_hash(benchmark::State& bench, const std::string& family, std::uint64_t hash)
{
    static std::map<std::string, std::uint64_t> first_of_family;
    const auto [first, is_new] = first_of_family.try_emplace(family, hash);
    if (first->second != hash)
        bench.SkipWithError(("its state differs from that of the first run of " + family).c_str());
    bench.counters["state_hash"] = static_cast<double>(hash >> 11);  // what a double holds
}
}  // namespace hdem::perf
