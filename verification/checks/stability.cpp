/// What stands and what falls, and the same in a turned frame: closed forms A2, A12, A16, A19.

#include "verification/checks/checks.h"
#include "verification/checks/turned_case.h"
#include "verification/checks/variants.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
/// A block that moved farther than 0.05 m or turned by more than 0.05 rad since the last stage began.
bool falls(const CaseRun& run)
{
    const Blocks& blocks = run.state().blocks;
    for (Index i = 0; i < blocks.size(); ++i)
        if (blocks.displacement(i).norm() > 0.05 || std::abs(blocks.motion[i].angle - blocks.reference_angle[i]) > 0.05)
            return true;
    return false;
}

struct Tilt
{
    const char* name;
    const char* case_file;
    double critical_deg;
    const char* source;
};

/// Shares of the tilt, as the case files' loads have it.
constexpr std::array<double, 5> steps{0.5, 0.3, 0.12, 0.05, 0.03};

/// How the last stage of a case ends.
enum class End
{
    after_its_duration,
    at_rest  ///< until = "converged", within as many cycles as that takes
};

/// @param stage  the last one of the case
Overrides last_stage(const std::string& case_file, const Variant& variant, int stage, End end)
{
    if (end == End::after_its_duration)
        return {};
    const CaseRun as_written(case_file, variant.overrides());
    const double duration = *as_written.definition().stages.back().duration;
    return {{fmt::format("stage[{}]", stage), fmt::format("{{until = \"converged\", max_cycles = {}}}",
                                                          static_cast<std::int64_t>(std::ceil(duration / as_written.step())))}};
}

void check_tilt(Report& report, const Tilt& tilt, const Variant& variant, End end = End::after_its_duration)
{
    for (const double off : {-0.1, 0.1})
    {
        const double beta = radians(tilt.critical_deg + off);
        Overrides overrides = variant.overrides() + last_stage(tilt.case_file, variant, 1, end);
        for (std::size_t i = 0; i < steps.size(); ++i)
            overrides.push_back(set(fmt::format("load[{}].acceleration", i),
                                    Vec2(steps[i] * g * std::sin(beta), steps[i] * g * (1.0 - std::cos(beta)))));
        const CaseRun run(report, tilt.case_file, overrides);
        report.require({fmt::format("{}, {}: moves at {:.3f}° (1 = yes)", variant.name(), tilt.name, tilt.critical_deg + off),
                        tilt.source, off > 0.0 ? 1.0 : 0.0, falls(run) ? 1.0 : 0.0},
                       absolute(0.0));
    }
}

double degrees(double slope)
{
    return std::atan(slope) * 180.0 / std::numbers::pi;
}

void check_a2(Report& report)
{
    for (const Variant& variant : all_variants("default"))
    {
        check_tilt(report, {"slides", "tilt/slide.toml", 30.0, "tan β = tan φ"}, variant);
        check_tilt(report, {"topples", "tilt/topple.toml", degrees(0.5), "tan β = width / height"}, variant);
    }
}

void check_wall(Report& report, double factor)
{
    for (const char* method : all_methods)
        check_tilt(report, {"wall", "tilt/wall.toml", degrees(0.4), "tan θ = μ"}, {method, "default", factor});
}

void check_a16_wall(Report& report)
{
    check_wall(report, 1.0);
}

void check_a16_stiff_wall(Report& report)
{
    check_wall(report, 10.0);
}

void check_a16_cubes(Report& report)
{
    for (const Variant& variant : all_variants("default"))
        check_tilt(report, {"five cubes", "tilt/cubes.toml", degrees(0.2), "tan θ = 0.2"}, variant);
}

/// The upper n bricks stand `share` of their farthest overhang beyond the edge; those below are fixed and flush with it.
bool overhang_falls(Report& report, const Variant& variant, int n, double share, End stage_end)
{
    Overrides bricks = variant.overrides() + last_stage("tilt/overhang.toml", variant, 0, stage_end);
    for (int k = 1; k <= 4; ++k)
    {
        double end = 0.0;
        for (int below = k; below <= n; ++below)
            end += share / (2.0 * below);
        const double y = 0.5 * (4 - k);
        bricks.push_back(
            set(fmt::format("block[{}].polygon", k), Polygon{{end - 1.0, y}, {end, y}, {end, y + 0.5}, {end - 1.0, y + 0.5}}));
        bricks.push_back({fmt::format("block[{}].fixed", k), k > n ? "true" : "false"});
    }
    return falls(CaseRun(report, "tilt/overhang.toml", bricks));
}

void check_overhangs(Report& report, End end)
{
    for (const Variant& variant : all_variants("default"))
        for (int n = 1; n <= 4; ++n)
            for (const double share : {0.995, 1.005})
                report.require({fmt::format("{}, {} bricks: falls at {} of the overhang (1 = yes)", variant.name(), n, share),
                                "Σ 1/(2k)", share > 1.0 ? 1.0 : 0.0, overhang_falls(report, variant, n, share, end) ? 1.0 : 0.0},
                               absolute(0.0));
}

void check_a12(Report& report)
{
    check_overhangs(report, End::after_its_duration);
}

void check_a12_until(Report& report)
{
    check_overhangs(report, End::at_rest);
}

void check_a16_until(Report& report)
{
    for (const char* method : all_methods)
    {
        check_tilt(report, {"five cubes", "tilt/cubes.toml", degrees(0.2), "tan θ = 0.2"}, {method, "default", 1.0}, End::at_rest);
        check_tilt(report, {"wall", "tilt/wall.toml", degrees(0.4), "tan θ = μ"}, {method, "default", 1.0}, End::at_rest);
    }
}

/// Farthest distance between a block's last position and that in the turned run, turned back; as a share of the way the farthest block went.
double turned_difference(Report& report, const std::string& case_file, const Overrides& overrides)
{
    const double angle = radians(37.0);
    const CaseRun plain(report, case_file, overrides);
    const CaseRun turned(report, case_file, turned_case(case_file, overrides, angle));
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    double off = 0.0;
    double way = 0.0;
    for (Index i = 0; i < plain.model().blocks(); ++i)
    {
        const Index j = turned.block(plain.model().name[i]);
        const Vec2 d = turned.state().blocks.displacement(j);
        const Vec2 back(c * d.x() + s * d.y(), -s * d.x() + c * d.y());
        off = std::max(off, (back - plain.state().blocks.displacement(i)).norm());
        way = std::max(way, plain.state().blocks.displacement(i).norm());
    }
    return off / way;
}

struct Turned
{
    const char* case_file;
    int stages;
};

void check_a19(Report& report)
{
    for (const char* method : all_methods)
        for (const Turned& turned : {Turned{"sliding/incline.toml", 2}, Turned{"sliding/stop.toml", 2},
                                     Turned{"paper_dynamic/dynamic.toml", 1}, Turned{"chain/pair.toml", 1}})
            for (const char* damping : {"dynamic", "default"})
            {
                Overrides overrides{set("contact.method", std::string(method))};
                for (int stage = 0; stage < turned.stages; ++stage)
                    overrides.push_back(set(fmt::format("stage[{}].damping", stage), std::string(damping)));
                const Quantity quantity{
                    fmt::format("{}, {}, {}: off when turned by 37° [of the way]", method, damping, turned.case_file), "isotropy",
                    0.0, turned_difference(report, turned.case_file, overrides)};
                // Local damping takes the sign of a velocity: a block at rest is damped or not by whether its velocity is 0 or round-off.
                std::string(damping) == "dynamic" ? report.require(quantity, absolute(1e-9)) : report.inform(quantity);
            }
}
}  // namespace

std::vector<Check> stability_checks()
{
    return {{"closed_form.A2", "onset of sliding and of toppling", check_a2},
            {"closed_form.A12", "overhang of stacked bricks", check_a12},
            {"closed_form.A12.until", "the same by stages that end at rest", check_a12_until},
            {"closed_form.A16.until", "tilted cubes and wall, by stages that end at rest", check_a16_until},
            {"closed_form.A16.cubes", "tilted stack of five cubes", check_a16_cubes},
            {"closed_form.A16.wall", "tilted running-bond wall", check_a16_wall},
            {"closed_form.A16.wall_10K", "the same at ten times the stiffness (about a minute)", check_a16_stiff_wall,
             Check::Length::is_long},
            {"closed_form.A19", "the same in a frame turned by 37°", check_a19}};
}
}  // namespace hdem::verification
