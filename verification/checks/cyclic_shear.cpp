/// One joint, sheared to and fro at a prescribed velocity: closed form A8.

#include "verification/checks/checks.h"
#include "verification/checks/variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr const char* case_file = "shear/cyclic.toml";
constexpr double strength = 1e6 / std::numbers::sqrt3;  ///< σ tan φ [Pa]
constexpr double reach = 5e-3;                          ///< [m]
constexpr double speed = 0.1;                           ///< [m/s]
constexpr double time_step = 5e-5;                      ///< [s]
constexpr std::size_t loaded = 1000;                    ///< cycles before the joint is sheared
constexpr std::size_t begin = 2000;                     ///< at +5 mm
constexpr std::size_t loop = 4000;                      ///< cycles

/// ∮ F dx over samples first, ..., last [J]. A prescribed velocity holds before the contacts are evaluated, so the shear force of
/// cycle c belongs to the position after cycle c.
double loop_work(const std::vector<double>& force, const std::vector<double>& x, std::size_t first, std::size_t last)
{
    double work = 0.0;
    for (std::size_t c = first; c < last; ++c)
        work += 0.5 * (force[c] + force[c + 1]) * (x[c + 1] - x[c]);
    return std::abs(work);
}

/// What holds for every method: the strength, and loops that stay as they are.
void check_loops(Report& report, const std::string& name, const CaseRun& run, double area)
{
    const std::vector<double>& force = run.column("joint.shear_force");
    const std::vector<double>& x = run.column("block.position_x");
    report.require({name + "greatest shear stress [Pa]", "σ tan φ", strength, std::abs(*std::ranges::max_element(force))},
                   relative(1e-6));
    report.require({name + "shear stress after the last loop [Pa]", "σ tan φ", strength, force.back()}, relative(1e-6));
    report.require({name + "work of the first loop [J/m²]", "4 τ (u − τ/k_s)", area, loop_work(force, x, begin, begin + loop)},
                   relative(1e-3));
    report.require({name + "drift of the shear force over ten loops [of the strength]", "closed loop", 0.0,
                    (force[begin + 10 * loop] - force[begin + loop]) / strength},
                   absolute(1e-6));
    report.require(
        {name + "drift of the loop's work", "closed loop", 0.0,
         (loop_work(force, x, begin + 9 * loop, begin + 10 * loop) - loop_work(force, x, begin + loop, begin + 2 * loop)) / area},
        absolute(1e-6));
}

/// Way from the start of shearing until the joint carries its strength [m].
double slips_from(const CaseRun& run, double stiffness)
{
    const std::vector<double>& force = run.column("joint.shear_force");
    const std::vector<double>& x = run.column("block.position_x");
    std::size_t c = loaded;
    while (c + 1 < force.size() && std::abs(force[c + 1]) < strength * (1.0 - 1e-9))
        ++c;
    return x[c] - x[0] + (strength - std::abs(force[c])) / stiffness;
}

/// Springs carry the weight before the hybrid method takes over: without gravity its threshold velocity is that of the springs alone, and an
/// impulse has none.
Overrides hybrid_after_loading()
{
    return {set("stage[1].method", std::string("hybrid"))};
}

/// Force-based, and hybrid below its threshold, 0.69 m/s: the same springs.
void check_springs(Report& report)
{
    for (const double factor : {1.0, 10.0})
    {
        const double stiffness = factor * 1e9;
        const double elastic = strength / stiffness;
        const double area = 4.0 * strength * (reach - elastic);
        const std::string k = factor == 1.0 ? "" : ", 10 K";
        const Override shear_stiffness = set("joint.default.shear_stiffness", stiffness);
        const CaseRun force(report, case_file, {shear_stiffness});
        const CaseRun hybrid(report, case_file, hybrid_after_loading() + Overrides{shear_stiffness});
        for (const CaseRun* run : {&force, &hybrid})
        {
            const std::string name = (run == &force ? "force" : "hybrid") + k + ": ";
            check_loops(report, name, *run, area);
            report.require({name + "slip from [mm]", "τ / k_s", 1e3 * elastic, 1e3 * slips_from(*run, stiffness)}, relative(1e-6));
        }
        double off = 0.0;
        const std::vector<double>& forces = force.column("joint.shear_force");
        const std::vector<double>& others = hybrid.column("joint.shear_force");
        for (std::size_t c = 0; c < forces.size(); ++c)
            off = std::max(off, std::abs(others[c] - forces[c]));
        report.require({"hybrid" + k + ": greatest difference from the force-based shear stress [of the strength]",
                        "below the threshold velocity", 0.0, off / strength},
                       absolute(1e-12));
    }
}

/// Impulses have no elastic part: the joint carries its strength from the first cycle in which it is sheared.
void check_impulses(Report& report)
{
    const Override threshold = set("contact.threshold_velocity", 0.5 * speed);
    const std::vector<std::pair<std::string, Overrides>> variants{
        {"impulse: ", {set("contact.method", std::string("impulse"))}},
        {"hybrid, above its threshold: ", hybrid_after_loading() + Overrides{threshold}}};
    for (const auto& [name, overrides] : variants)
    {
        const CaseRun run(report, case_file, overrides);
        check_loops(report, name, run, 4.0 * strength * reach);
        report.require({name + "slip from [mm]", "at once, within a cycle's way", 0.0, 1e3 * slips_from(run, 1e300)},
                       absolute(1e3 * speed * time_step));
    }
}
}  // namespace

std::vector<Check> cyclic_shear_checks()
{
    return {{"closed_form.A8.springs", "cyclic shear of one joint", check_springs},
            {"closed_form.A8.impulses", "the same above the threshold velocity", check_impulses}};
}
}  // namespace hdem::verification
