/// Says in the output which hdem is measured and how it was built; perf/gate and perf/nightly never compare different builds.

#include "core/version.h"

#include <benchmark/benchmark.h>

#include <string>

namespace hdem::perf
{
namespace
{
[[maybe_unused]] const bool added = []
{
    benchmark::AddCustomContext("hdem_commit", std::string(version().commit) + (version().dirty ? ", changed" : ""));
    benchmark::AddCustomContext("hdem_compiler", std::string(version().compiler));
    benchmark::AddCustomContext("hdem_flags", std::string(version().flags));
    return true;
}();
}  // namespace
}  // namespace hdem::perf
