/// Block held between two walls by cohesion alone: closed form A9.

#include "verification/checks/checks.h"
#include "verification/checks/variants.h"

#include <fmt/format.h>

#include <cmath>

namespace hdem::verification
{
namespace
{
constexpr double critical_cohesion = density * g / 2.0;

bool falls(Report& report, const Variant& variant, int pieces, double cohesion)
{
    std::string names;
    for (int i = 1; i <= pieces; ++i)
        names += fmt::format("{}\"right{}\"", i == 1 ? "" : ", ", i);
    const CaseRun run(report, "walls/walls.toml",
                      variant.overrides() + Overrides{set("time.step", 5e-5 / std::sqrt(variant.factor)),
                                                      set("blocks_file", fmt::format("walls{}.wkt", pieces)),
                                                      {"load[0].blocks", '[' + names + ']'},
                                                      set("joint.default.cohesion", cohesion)});
    // A thousandth of the weight too little lets it fall with at least 0.2 of a thousandth of g: 1 mm/s after 0.5 s.
    return run.column("block.velocity_y").back() < -1e-4;
}

void check_a9(Report& report)
{
    for (const Variant& variant : all_variants("default"))
        for (const int pieces : {1, 2, 4, 16})
        {
            const std::string name = fmt::format("{}, walls in {}: ", variant.name(), pieces);
            report.require({name + "falls at 0.999 of the cohesion (1 = yes)", "c = W / (2 · 1 m)", 1.0,
                            falls(report, variant, pieces, 0.999 * critical_cohesion) ? 1.0 : 0.0},
                           absolute(0.0));
            report.require({name + "falls at 1.001 of the cohesion", "c = W / (2 · 1 m)", 0.0,
                            falls(report, variant, pieces, 1.001 * critical_cohesion) ? 1.0 : 0.0},
                           absolute(0.0));
        }
}
}  // namespace

std::vector<Check> wall_checks()
{
    return {{"closed_form.A9", "block between two walls, held by cohesion", check_a9}};
}
}  // namespace hdem::verification
