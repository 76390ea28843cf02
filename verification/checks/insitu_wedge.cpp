/// A wedge in a roof: what it bears, and when it falls.

#include "verification/checks/case_run.h"
#include "verification/checks/insitu_checks.h"
#include "verification/checks/turned_case.h"

#include <fmt/format.h>

#include <cmath>

namespace hdem::verification
{
namespace
{
const std::string wedge_file = "insitu/wedge.toml";
const double height = 2.0 / std::tan(radians(25.0));  ///< [m]

/// Horizontal stress that presses the wedge with `force` [N].
Override pressed_with(double force)
{
    return {"insitu.stress", fmt::format("[{:.17g}, 0.0, 0.0]", -force / height)};
}

/// The wedge is drawn down slowly. What it is drawn with has a peak where both faces begin to slip.
void check_limit(Report& report, double degrees)
{
    const double angle = radians(degrees);
    const Overrides drawn_down{pressed_with(1e6),
                               {"gravity.vector", "[0.0, 0.0]"},
                               {"block.wedge.fixed", R"(["x", "y"])"},
                               {"load", R"([{blocks = ["wedge"], velocity_x = 0.0, velocity_y = -5e-5}])"},
                               {"stage[0].cycles", "6000"}};
    CaseRun run(wedge_file, turned_case(wedge_file, drawn_down, angle));
    double most = 0.0, drop = 0.0;
    run.run(
        [&](const Model& model, const State& state)
        {
            const Index wedge = model.find_block("wedge");
            const Vec2 force(state.blocks.force[wedge].x, state.blocks.force[wedge].y);
            const double pull = turned(force, -angle).y();
            if (pull > most)
            {
                most = pull;
                drop = -turned(state.blocks.displacement(wedge), -angle).y();
            }
        });
    report.add_run(run);
    const std::string turn = fmt::format("turned {:g}°, H_0 1 MN: ", degrees);
    report.require({turn + "greatest weight [N]", "2 H_0 (K_S cos² α + K_N sin² α) sin(φ − α) / D", 382766.2, most},
                   relative(0.01));
    report.require({turn + "drop at slip [mm]", "H_0 sin(φ − α) / D", 5.58155e-2, 1e3 * drop}, relative(0.01));
}

/// How far it moves under its weight of 227 206 N [m].
double moved(Report& report, double force, const std::string& method, double degrees)
{
    const Overrides overrides{pressed_with(force), set("contact.method", method)};
    const CaseRun run(report, wedge_file, turned_case(wedge_file, overrides, radians(degrees)));
    return run.state().blocks.displacement(run.block("wedge")).norm();
}
}  // namespace

void check_roof_wedge(Report& report)
{
    for (const double degrees : {0.0, 23.0})
    {
        check_limit(report, degrees);
        for (const char* method : {"force", "hybrid"})
        {
            const std::string name = fmt::format("turned {:g}°, {}: ", degrees, method);
            report.require({name + "H_0 1 % above 593 590 N, drop [mm]", "hangs, W / 2 (K_S cos² α + K_N sin² α)", 3.31313e-2,
                            1e3 * moved(report, 1.01 * 593590.0, method, degrees)},
                           relative(0.01));
            report.require(
                {name + "H_0 1 % below 593 590 N, drop [m]", "falls", 0.5, moved(report, 0.99 * 593590.0, method, degrees)},
                at_least());
        }
    }
}
}  // namespace hdem::verification
