/// Hard scenes: nothing passes through anything, no energy comes from nowhere, nothing explodes.

#include "verification/checks/checks.h"
#include "verification/checks/robust_run.h"
#include "verification/checks/robust_scenes.h"

#include <fmt/format.h>

#include <cmath>

namespace hdem::verification
{
namespace
{
constexpr int seeds = 8;
constexpr int informing_seeds = 2;

/// The worst value of one quantity, and where it was.
struct Worst
{
    double value = 0.0;
    std::string scene;

    void add_greatest(double next, const std::string& name)
    {
        if (scene.empty() || !(next <= value))
            *this = {next, name};
    }
    void add_least(double next, const std::string& name)
    {
        if (scene.empty() || !(next >= value))
            *this = {next, name};
    }
};

/// The worst of all scenes under one variant.
struct Summary
{
    Worst overlap, lowest, gain, speed, late_speed, carried;
    int failed = 0;
    std::string failures;

    void add(const Scene& scene, const RobustVariant& variant, const RobustOutcome& outcome)
    {
        overlap.add_greatest(outcome.watch.worst_overlap(), scene.name);
        lowest.add_least(outcome.watch.lowest_centroid(), scene.name);
        gain.add_greatest(outcome.watch.energy_gain(), scene.name);
        if (scene.greatest_speed > 0.0)
            speed.add_greatest(outcome.watch.greatest_speed() / scene.greatest_speed, scene.name);
        if (!outcome.failure.empty() || !outcome.watch.is_finite())
        {
            ++failed;
            failures += "; " + scene.name + ": " + outcome.failure;
        }
        else if (variant.comes_to_rest && scene.comes_to_rest)
        {
            late_speed.add_greatest(outcome.watch.late_speed(), scene.name);
            carried.add_greatest(std::abs(outcome.watch.carried() - 1.0), scene.name);
        }
    }
};

void report_summary(Report& report, const RobustVariant& variant, const Summary& all)
{
    const auto row = [&](const Worst& worst, const char* what, const char* source, double reference, Bar bar, bool is_judged)
    {
        if (worst.scene.empty())
            return;
        const Quantity quantity{fmt::format("{}: {} ({})", variant.name, what, worst.scene), source, reference, worst.value};
        is_judged ? report.require(quantity, bar) : report.inform(quantity);
    };
    report.require(
        {fmt::format("{}: runs that stop with an error{}", variant.name, all.failures), "-", 0.0, static_cast<double>(all.failed)},
        absolute(0.0));
    row(all.overlap, "overlap / width [-]", "1/2: may come out behind", robust_bars.overlap, at_most(), variant.has_bars);
    row(all.lowest, "lowest centroid [m]", "surface of the rock", 0.0, at_least(), variant.has_bars);
    row(all.gain, "energy gain [-]", "energy balance", robust_bars.energy_gain, at_most(), true);
    row(all.speed, "speed / what energy allows [-]", "√(v² + 2 g h + ω² I/m)", robust_bars.speed, at_most(), variant.has_bars);
    row(all.late_speed, "speed at the end [m/s]", "rest", robust_bars.late_speed, at_most(), variant.has_bars);
    row(all.carried, "weight on the ground, off by [-]", "equilibrium", robust_bars.carried, at_most(), variant.has_bars);
}

template <std::vector<Scene> (*scenes)(int)>
void check_family(Report& report)
{
    for (const RobustVariant& variant : robust_variants())
    {
        Summary all;
        for (const Scene& scene : scenes(variant.has_bars ? seeds : informing_seeds))
            all.add(scene, variant, run_scene(scene, variant, variant.has_bars ? &report : nullptr));
        report_summary(report, variant, all);
    }
}
}  // namespace

std::vector<Check> robust_checks()
{
    constexpr auto length = Check::Length::is_long;
    return {{"robust.mass", "masses 1 to 1e6, at rest and falling on each other", check_family<mass_scenes>, length},
            {"robust.stiffness", "joint stiffnesses 1 to 1e3 in one stack", check_family<stiffness_scenes>, length},
            {"robust.sliver", "slivers between blocks and in a rock mass", check_family<sliver_scenes>, length},
            {"robust.needle", "needles of 1:100, standing, lying, falling", check_family<needle_scenes>, length},
            {"robust.throw", "a block thrown at 50 m/s at rock, plates and joints", check_family<throw_scenes>, length},
            {"robust.fall", "one block and ten blocks fall 20 m", check_family<fall_scenes>, length}};
}
}  // namespace hdem::verification
