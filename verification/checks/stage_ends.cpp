/// Ends of stages: times at which a sliding block reaches a displacement or a speed, or stands still: closed form A20.

#include "verification/checks/checks.h"
#include "verification/checks/turned_case.h"
#include "verification/checks/variants.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr double turn = 23.0 * std::numbers::pi / 180.0;  ///< by which models are turned

/// The case's first stage as it is, then one that ends by `until`. Looks in every cycle.
Overrides with_end(const Variant& variant, const std::string& first, const std::string& until)
{
    return variant.overrides() +
           Overrides{{"stage", fmt::format("[{{name = \"{}\", damping = \"paper\", cycles = 5000}}, {{name = \"end\", damping = "
                                           "\"{}\", until = [\"{}\"]}}]",
                                           first, variant.damping, until)},
                     {"convergence.check_every", "1"}};
}

/// How long the last stage took; nan where it has not come to its end.
double time_of_end(const CaseRun& run)
{
    const std::vector<StageResult>& stages = run.stages();
    return stages.back().ended_by == 0 ? stages.back().time - stages.front().time : std::nan("");
}

struct EndProblem
{
    std::string file, first, until, formula;
    double time = 0.0;
    Overrides overrides = {};
    double bar = 1e-3;
};

void check_end(Report& report, const EndProblem& p)
{
    for (const Variant& variant : all_variants("dynamic"))
    {
        if (variant.factor != 1.0)
            continue;
        const Overrides drawn = with_end(variant, p.first, p.until) + p.overrides;
        const std::string name = fmt::format("\"{}\", {}", p.until, variant.name());
        const CaseRun run(report, p.file, drawn);
        report.require({name + ": time [s]", p.formula, p.time, time_of_end(run)}, relative(p.bar));
        const CaseRun other(report, p.file, drawn + turned_case(p.file, drawn, turn));
        report.require({name + ", turned by 23°: time [s]", p.formula, p.time, time_of_end(other)}, relative(p.bar));
    }
}

void check_a20(Report& report)
{
    const double driving = g * std::sin(radians(30.0)), strength = g * std::cos(radians(30.0)) * std::tan(radians(20.0));
    const double a = driving - strength;
    const std::string incline = "sliding/incline.toml", stop = "sliding/stop.toml";
    const Overrides loaded{set("load[0].acceleration", Vec2(0.9 * strength - driving, 0.0))};
    // The spring of the joint takes up the last tenth of its strength while the block starts.
    check_end(report, {incline, "hold", "displacement:block1 > 10", "sqrt(2 s / a)", std::sqrt(20.0 / a), loaded});
    check_end(report, {incline, "hold", "displacement > 2.5", "sqrt(2 s / a)", std::sqrt(5.0 / a), loaded});
    check_end(report, {incline, "hold", "speed > 4", "v / a", 4.0 / a, loaded});
    // The block has 2 m/s after the first cycle, mu = 0.5. Undamped springs swing on at up to 0.012 m/s when it stands.
    const double decelerates = 0.5 * g, stands = 2.0 / decelerates;
    const Overrides kicked{set("load[0].acceleration", Vec2(2.0 / 5e-5, 0.0)), {"convergence.least_cycles", "1"}};
    check_end(report, {stop, "rest", "speed < 2e-2 for 0.1 s", "(v - 0.02) / (μ g) + 0.1 s", stands + 0.1 - 2e-2 / decelerates,
                       kicked, 5e-3});
    // A band begins anew with the first value outside of the last one: somewhere on the last millimetre.
    const double band = std::sqrt(2e-3 / decelerates);
    check_end(report, {stop, "rest", "displacement within 1e-3 for 0.3 s", "v / (μ g) + 0.3 s, less a part of the last mm",
                       stands + 0.3 - 0.5 * band, kicked, 0.5 * band / (stands + 0.3 - 0.5 * band)});
}
}  // namespace

std::vector<Check> stage_end_checks()
{
    return {{"closed_form.A20", "stages that end at a displacement, a speed, or when a block stands", check_a20}};
}
}  // namespace hdem::verification
