/// Columns, chains and pairs of blocks: closed forms A3, A4, A13, A14.

#include "verification/checks/checks.h"
#include "verification/checks/fit.h"
#include "verification/checks/variants.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr double weight = density * g;

void check_a3(Report& report)
{
    for (const Variant& variant : all_variants("paper"))
    {
        const CaseRun run(report, "column/column.toml", variant.overrides());
        for (const int joint : {1, 2, 5, 10})
            report.require({fmt::format("{}: normal force in joint {} from below [N]", variant.name(), joint), "weight above",
                            weight * (11 - joint), run.column(fmt::format("joint{}.normal_force", joint)).back()},
                           relative(1e-6));
    }
}

/// First frequency of n equal masses on equal springs, the lowest one on a fixed base [Hz].
double column_frequency(int n, double stiffness)
{
    return 2.0 * std::sqrt(stiffness / density) * std::sin(std::numbers::pi / (2.0 * (2.0 * n + 1.0))) / (2.0 * std::numbers::pi);
}

void check_a4(Report& report)
{
    for (const char* method : {"force", "hybrid"})
        for (const double factor : {1.0, 10.0})
        {
            const Variant variant{method, "dynamic", factor};
            for (const int n : {1, 2, 5, 10, 20})
            {
                const CaseRun run(report, "column/swing.toml",
                                  variant.overrides() + Overrides{set("damping.preset", std::string("paper")),
                                                                  set("domain.height", n + 1.0),
                                                                  set("history[0].block", fmt::format("b{}", n + 1))});
                const std::vector<double>& y = run.column("top.position_y");
                const double period = mean_period({y.begin() + 60000, y.end()}) * run.step();
                report.require({fmt::format("{}: first frequency of {} blocks [Hz]", variant.name(), n),
                                "2 √(k/m) sin(π/(2(2N+1)))", column_frequency(n, factor * normal_stiffness), 1.0 / period},
                               relative(2e-3));
            }
            const CaseRun run(report, "paper_static/static.toml",
                              variant.overrides() + Overrides{set("damping.preset", std::string("paper")),
                                                              set("contact.threshold_scale", std::string("model")),
                                                              set("load[0].acceleration", Vec2(0.5, 0.0)),
                                                              set("stage[1].damping", std::string("dynamic")),
                                                              set("stage[1].cycles", 8000.0)});
            const std::vector<double>& x = run.column("block.displacement_x");
            report.require({fmt::format("{}: frequency of one block in shear [Hz]", variant.name()), "√(K_S / m)",
                            std::sqrt(factor * shear_stiffness / density) / (2.0 * std::numbers::pi),
                            1.0 / (mean_period({x.begin() + 5001, x.end()}) * run.step())},
                           relative(2e-3));
        }
}

double velocity(const CaseRun& run, int block)
{
    return run.state().blocks.motion[run.block(fmt::format("b{}", block))].vx;
}

void check_a13(Report& report)
{
    for (const Variant& variant : all_variants("dynamic"))
    {
        const CaseRun run(report, "chain/pair.toml",
                          Overrides{set("contact.method", variant.method), set("time.step", 1e-5 * variant.step() / 5e-5),
                                    set("joint.default.normal_stiffness", variant.factor * normal_stiffness)});
        const double first = velocity(run, 1);
        const double second = velocity(run, 2);
        report.require({variant.name() + ": momentum [v of one block, m/s]", "conservation", 1.0, first + second}, relative(1e-13));
        // An impulse exchanges velocities to round-off; a spring that opens between two cycles keeps a share of about ω dt of its last force.
        report.require({variant.name() + ": velocity of the struck block [m/s]", "exchange", 1.0, second},
                       relative(variant.method == "force" ? 1e-2 : 1e-12));
        report.require({variant.name() + ": velocity of the striking block [m/s]", "exchange", 0.0, first},
                       absolute(variant.method == "force" ? 1e-2 : 1e-12));
    }
}

/// Above the speeds of the chain, so that the hybrid method leaves all contacts to the springs [m/s].
constexpr double threshold_beyond = 10.0;

enum class Answer
{
    springs,  ///< the closed form
    impulses  ///< one pair after another: shown for comparison
};

void check_chain(Report& report, const std::vector<double>& exact, const Variant& variant, Answer answer,
                 const Overrides& overrides)
{
    const std::string file = fmt::format("chain/chain{}.toml", exact.size());
    const CaseRun run(report, file,
                      overrides + Overrides{set("contact.method", variant.method), set("time.step", 1e-5 * variant.step() / 5e-5),
                                            set("joint.default.normal_stiffness", variant.factor * normal_stiffness)});
    const std::string name = variant.name() + (overrides.empty() ? "" : ", below its threshold");
    for (std::size_t i = 0; i < exact.size(); ++i)
    {
        const Quantity quantity{fmt::format("{}, {} bodies: velocity of body {} [m/s]", name, exact.size(), i + 1),
                                "linear springs", exact[i], velocity(run, static_cast<int>(i) + 1)};
        answer == Answer::springs ? report.require(quantity, absolute(1e-3)) : report.inform(quantity);
    }
}

void check_a14(Report& report)
{
    const std::vector<std::vector<double>> chains{{-0.1303, 0.1502, 0.9800}, {-0.1323, -0.0753, -0.0310, 0.2962, 0.9424}};
    for (const Variant& variant : all_variants("dynamic"))
        for (const std::vector<double>& exact : chains)
        {
            if (variant.method == "force")
                check_chain(report, exact, variant, Answer::springs, {});
            else if (variant.factor == 1.0)  // impulses know no stiffness
                check_chain(report, exact, variant, Answer::impulses, {});
            if (variant.method == "hybrid")
                check_chain(report, exact, variant, Answer::springs, {set("contact.threshold_velocity", threshold_beyond)});
        }
}
}  // namespace

std::vector<Check> column_checks()
{
    return {{"closed_form.A3", "forces in a stack of ten blocks", check_a3},
            {"closed_form.A4", "frequencies of columns of blocks", check_a4},
            {"closed_form.A13", "head-on collision of equal blocks", check_a13},
            {"closed_form.A14", "chain of touching springs, struck at one end", check_a14}};
}
}  // namespace hdem::verification
