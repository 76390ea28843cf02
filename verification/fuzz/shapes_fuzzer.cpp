/// libFuzzer target: any bytes as a file of blocks or traces, WKT or CSV by the first byte. Traces that can be read also cut a domain.

#include "core/geometry/polygon.h"
#include "io/polygons.h"
#include "io/traces.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>

namespace hdem
{
namespace
{
void demand(bool holds)
{
    if (!holds)
        std::abort();
}

/// Whatever the traces, the cells fill the domain, or it is said why not.
void cut(const std::vector<Polygon>& traces)
{
    const Polygon square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
    try
    {
        double sum = 0.0;
        for (const std::vector<Polygon>& cell : cut_into_cells(square, traces, 0.01).cells)
            for (const Polygon& piece : cell)
                sum += signed_area(piece);
        demand(std::abs(sum - 100.0) < 1e-6);
    }
    catch (const InputError& error)
    {
        demand(!error.problems().empty());
    }
}
}  // namespace
}  // namespace hdem

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size == 0)
        return 0;
    std::istringstream in(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
    const std::string name = data[0] % 2 == 0 ? "fuzz.wkt" : "fuzz.csv";
    if (data[0] % 4 < 2)
    {
        const hdem::PolygonFile file = hdem::read_polygons(in, name);
        hdem::demand(!file.blocks.empty() || !file.problems.empty());
        return 0;
    }
    const hdem::TraceFile file = hdem::read_traces(in, name);
    hdem::demand(!file.traces.empty() || !file.problems.empty());
    if (!file.traces.empty() && file.traces.size() < 30)
        hdem::cut(file.traces);
    return 0;
}
