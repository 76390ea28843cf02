/// Models with so many contacts that their cycles run on as many threads as are asked for: the bits are those of one thread.

#include "verification/checks/fos_answer.h"
#include "verification/checks/same_bits.h"
#include "verification/checks/turned_case.h"

#include <fmt/format.h>

#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr double contacts_of_three_threads = 3.0 * 256.0;

/// The shipped slope in finer rock.
const Overrides fine_slope{set("joint_set[0].spacing", 2.4), set("joint_set[1].spacing", 3.2)};

void require_contacts(Report& report, double contacts)
{
    report.require({"contacts of the smallest model", "3 threads have 256 each", contacts_of_three_threads, contacts}, at_least());
}

void check_slope_in_rain(Report& report)
{
    const Overrides rain{{"stage", "[{name = \"stand\", cycles = 600}, {name = \"rain\", relax_cycles = 300, cycles = 900, "
                                   "water_table = [[0.0, 15.0], [30.0, 15.0], [42.0, 32.0], [60.0, 45.0], [95.0, 50.0]]}]"}};
    require_contacts(report, static_cast<double>(require_same_bits(report, "slope/slope.toml", fine_slope + rain)));
}

/// Bolts of each kind and a lining around the tunnel, which is made over some cycles; they yield, slip and come off.
void check_supported_tunnel(Report& report)
{
    const std::string around = "around = \"tunnel\", stage = \"excavated\"";
    const std::string pattern = around + ", length = 4.0, along = 1.0";
    const Overrides supported{
        {"bolt",
         fmt::format("[{{name = \"a\", arc = [-20, 50], area = 3.8e-4, yield = 2e4, pretension = 1e4, {0}}}, "
                     "{{name = \"g\", kind = \"grouted\", arc = [50, 130], area = 3.8e-4, yield = 1e5, bond_stiffness = 1e8, "
                     "bond_strength = 1e4, {0}}}, "
                     "{{name = \"l\", kind = \"local\", arc = [130, 200], stiffness = 5e7, yield = 2e4, shear_stiffness = 2e7, "
                     "shear_strength = 1e4, active_length = 0.05, {0}}}]",
                     pattern)},
        {"liner",
         fmt::format("[{{name = \"coat\", arc = [-20, 200], thickness = 0.1, modulus = 1e10, moment_strength = 2e3, "
                     "normal_stiffness = 1e9, cohesion = 1e4, bond_strength = 1e4, hardening = [[0, 0.1], [600, 1.0]], {}}}]",
                     around)},
        {"stage", "[{name = \"initial\", cycles = 400}, {name = \"excavated\", excavate = [\"tunnel\"], relax_cycles = 300, "
                  "cycles = 1000, damping = \"default\"}]"}};
    require_contacts(report, static_cast<double>(require_same_bits(report, "support/tunnel.toml", supported)));
}

/// Of the same slope: a search on 2 and on 3 threads, and broken off. A trial that is left alone has all of them.
void check_factor(Report& report)
{
    const Overrides given = fine_slope +
                            Overrides{set("factor_of_safety.tolerance", 0.05), set("factor_of_safety.check_stiffness", 1.0)};
    for (const char* method : {"force", "hybrid"})
        for (const double degrees : {0.0, 23.0})
        {
            const Overrides turned = turned_case("slope/slope.toml", given + Overrides{set("contact.method", std::string(method))},
                                                 degrees * std::numbers::pi / 180.0);
            const std::string file = "../slope/slope.toml";
            require_same_trials(report, fmt::format("{}, turned by {:g}°: ", method, degrees), find_factor(file, turned), file,
                                turned);
        }
}
}  // namespace

std::vector<Check> large_model_checks()
{
    return {{"water.threads", "Wet slope of so many blocks that threads share them", check_slope_in_rain, Check::Length::is_long},
            {"support.threads", "Bolts and a lining in so many blocks that threads share them", check_supported_tunnel,
             Check::Length::is_long},
            {"fos.threads", "Factor of safety of so many blocks that threads share them", check_factor, Check::Length::is_long}};
}
}  // namespace hdem::verification
