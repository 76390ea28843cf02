/// Factors of safety: slopes and a roof wedge with closed forms, by strength reduction and by limit analysis.

#include "parallel/critical_search.h"
#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"
#include "verification/checks/fos_answer.h"
#include "verification/checks/turned_case.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr double turn = 23.0 * std::numbers::pi / 180.0;  ///< by which models are turned

double tan_deg(double degrees)
{
    return std::tan(degrees * std::numbers::pi / 180.0);
}

struct SlopeProblem
{
    std::string file;
    std::string source;
    double factor = 0.0;
    Overrides overrides{};
    Overrides turned{};     ///< besides polygons, loads and gravity
    bool has_bound = true;  ///< limit analysis gives the same
    std::vector<const char*> methods = {"force", "hybrid"};
};

void check_problem(Report& report, const SlopeProblem& p, const std::string& name)
{
    for (const char* method : p.methods)
    {
        const Overrides base = p.overrides + Overrides{set("contact.method", std::string(method))};
        const FosAnswer drawn = find_factor(p.file, base);
        report.require({fmt::format("{}, {}: F", name, method), p.source, p.factor, drawn.value()}, relative(0.01));
        report.require(
            {fmt::format("{}, {}: F with joints three times as stiff", name, method), p.source, p.factor, drawn.stiffer()},
            relative(0.01));
        if (p.has_bound)
            report.require({fmt::format("{}, {}: bound by limit analysis", name, method), p.source, p.factor, drawn.bound.factor},
                           relative(0.002));
        const FosAnswer turned = find_factor(p.file, turned_case("fos/" + p.file, base, turn) + p.turned);
        report.require({fmt::format("{}, {}, turned by 23°: F", name, method), p.source, p.factor, turned.value()}, relative(0.01));
    }
    require_same_trials(report, name + ": ", find_factor(p.file, p.overrides), p.file, p.overrides);
}

void check_plane(Report& report)
{
    check_problem(report, {.file = "plane.toml", .source = "(c A + N tan φ)/S", .factor = 1.13749}, "F1 plane");
}

void check_crack(Report& report)
{
    check_problem(report, {.file = "crack.toml", .source = "Wyllie & Mah, dry", .factor = 1.5445}, "F2 dry crack");
}

void check_hoek(Report& report)
{
    check_problem(report, {.file = "hoek.toml", .source = "Hoek, dry", .factor = 1.5843}, "F3 dry");
    check_problem(report,
                  {.file = "hoek.toml",
                   .source = "Hoek, dry, 0.08 g",
                   .factor = 1.3716,
                   .overrides = {set("gravity.vector", Vec2(-0.08 * 9.81, -9.81))}},
                  "F3 dry, 0.08 g");
}

/// Water in the crack up to `level`, which seeps along the plane to its toe.
Overrides water_in_crack(const Vec2& mouth, const Vec2& foot, double level)
{
    return {{"water", "{}"},
            {"water_crack", fmt::format("[{{crack = [[{0}, {1}], [{2}, {3}]], outlet = [[{2}, {3}], [0.0, 0.0]], level = {4}}}]",
                                        mouth.x(), mouth.y(), foot.x(), foot.y(), level)}};
}

void check_wet_cracks(Report& report)
{
    const Vec2 foot(10.9282032303, 7.65201028093), mouth(10.9282032303, 12.0);
    const Vec2 hoek_foot(65.6817362484, 45.9908468438), hoek_mouth(65.6817362484, 60.0);
    const auto check = [&](const char* file, double factor, const Overrides& overrides, const std::string& name)
    { check_problem(report, {.file = file, .source = "with U and V", .factor = factor, .overrides = overrides}, name); };
    check("crack.toml", 1.2467, water_in_crack(mouth, foot, foot.y() + 3.0), "F2, 3 m of water");
    check("crack.toml", 1.0725, water_in_crack(mouth, foot, foot.y() + 4.35), "F2, full");
    const double depth = hoek_mouth.y() - hoek_foot.y();
    const Overrides full = water_in_crack(hoek_mouth, hoek_foot, hoek_mouth.y());
    check("hoek.toml", 1.4164, water_in_crack(hoek_mouth, hoek_foot, hoek_foot.y() + 0.5 * depth), "F3, half full");
    check("hoek.toml", 1.2057, full, "F3, full");
    check("hoek.toml", 1.0403,
          full + Overrides{{"load", fmt::format("[{{blocks = [\"wedge\"], acceleration = [{}, 0.0]}}]", -0.08 * 9.81)}},
          "F3, full, 0.08 g");
}

void check_toppling(Report& report)
{
    const FosAnswer drawn = find_factor("toppling.toml", {});
    const FosAnswer turned = find_factor("toppling.toml", turned_case("fos/toppling.toml", {}, turn));
    const FosAnswer hybrid = find_factor("toppling.toml", {set("contact.method", std::string("hybrid"))});
    const FosAnswer impulse = find_factor("toppling.toml", {set("contact.method", std::string("impulse"))});
    const FosAnswer other = find_factor("toppling.toml",
                                        {{"factor_of_safety.bracket", "[0.7, 2.2]"}, {"factor_of_safety.tolerance", "0.005"}});
    for (const auto& [name, f] : {std::pair{"F4", drawn.value()}, std::pair{"F4 turned by 23°", turned.value()},
                                  std::pair{"F4, stiffer joints", drawn.stiffer()}, std::pair{"F4, hybrid", hybrid.value()},
                                  std::pair{"F4, impulse", impulse.value()}})
    {
        report.require({fmt::format("{}: F", name), "Goodman and Bray, side forces at the tops", 1.05, f}, at_least());
        report.require({fmt::format("{}: F", name), "limit analysis", 1.272, f}, at_most());
    }
    report.require({"F4: bound by limit analysis", "φ 33.41°", 1.2721, drawn.bound.factor}, relative(0.002));
    report.require({"F4: F by other trials, of half the width", "the same", drawn.value(), other.value()}, relative(0.005));
    report.require({"F4: F with joints three times as stiff", "the same", drawn.value(), drawn.stiffer()}, relative(0.01));
    require_same_trials(report, "F4: ", drawn, "toppling.toml", {});
}

void check_biplanar(Report& report)
{
    check_problem(report,
                  {.file = "biplanar.toml", .source = "two blocks", .factor = 1.25673, .methods = {"force", "hybrid", "impulse"}},
                  "F5");
}

void check_wedge(Report& report)
{
    const double s = load_case(case_folder() / "fos/wedge.toml").file.def.insitu.stress->xx;
    const double c = std::cos(turn), n = std::sin(turn);
    check_problem(report,
                  {.file = "wedge.toml",
                   .source = "P_lim(φ) = weight",
                   .factor = 1.08535,
                   .turned = {{"insitu.stress", fmt::format("[{:.17g}, {:.17g}, {:.17g}]", c * c * s, n * n * s, c * n * s)}},
                   .has_bound = false},
                  "F6 roof wedge");
}

/// 417 blocks behind the plane of F3. They settle unevenly, and what is open has no cohesion; where they hardly settle, F is that of a rigid base.
void check_rock(Report& report)
{
    const auto begin = std::chrono::steady_clock::now();
    const FosAnswer a = find_factor("rock.toml", {}, {.threads = 2});
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    report.require({"F3 with 417 blocks behind the plane: bound by limit analysis", "Hoek, dry", 1.5843, a.bound.factor},
                   relative(0.002));
    report.require({"F", "the bound", a.bound.factor, a.value()}, at_most());
    report.require({"F with joints three times as stiff", "the same", a.value(), a.stiffer()}, relative(0.02));
    report.require({"time on two threads [s]", "two minutes", 120.0, seconds}, at_most());
    const FosAnswer stiff = find_factor("rock.toml",
                                        {set("joint.rock.normal_stiffness", 5e11), set("joint.rock.shear_stiffness", 2e11),
                                         set("factor_of_safety.check_stiffness", 1.0)},
                                        {.threads = 2});
    report.require({"F with joints of the rock a hundred times as stiff", "Hoek, dry", 1.5843, stiff.value()}, relative(0.01));
}

/// A load that is counted from the start of the last stage acts on in the trials as at its end, also where the run is past the load's own cycles.
void check_loads(Report& report)
{
    const double g = 9.81, driving = 0.5 * g, bearing = g * std::cos(std::numbers::pi / 6.0) * tan_deg(40.0);
    const auto factor = [](const std::string& when)
    {
        return find_factor("slab.toml", {{"stage", "[{name = \"first\", cycles = 50000}, {name = \"stand\", cycles = 30000}]"},
                                         {"load", "[{blocks = [\"slab\"], acceleration = [-1.0, 0.0], " + when + "}]"}})
            .value();
    };
    const std::string grown = "ramp_cycles = [0, 2000], since = \"stand\", until_cycle = 40000";
    report.require(
        {"F with a load that has grown: " + grown, "g cos β tan φ / (g sin β + a)", bearing / (driving + 1.0), factor(grown)},
        relative(0.01));
    const std::string half = "ramp_cycles = [0, 60000], since = \"stand\"";
    report.require({"F with half of a load: " + half, "g cos β tan φ / (g sin β + a / 2)", bearing / (driving + 0.5), factor(half)},
                   relative(0.01));
}

/// The shipped slope in coarser rock: dry, with its water table, and that turned.
void check_slope(Report& report)
{
    const std::string file = "../slope/slope.toml";
    const Overrides coarse{set("joint_set[0].spacing", 6.0), set("joint_set[1].spacing", 7.0)};
    const FosAnswer wet = find_factor(file, coarse);
    const FosAnswer dry = find_factor(file, coarse + Overrides{{"water.table", "[[0.0, 0.0], [95.0, 0.0]]"}});
    report.require({"slope of 85 blocks, wet: F", "hdem, when the case was made", 1.147, wet.value()}, relative(0.01));
    report.require({"slope of 85 blocks, dry: F", "hdem, when the case was made", 1.2746, dry.value()}, relative(0.01));
    report.require({"wet: F", "limit analysis", wet.bound.factor, wet.value()}, at_most());
    report.require({"dry: F", "limit analysis", dry.bound.factor, dry.value()}, at_most());
    report.require({"wet: bound by limit analysis", "below that of the dry slope", dry.bound.factor, wet.bound.factor}, at_most());
    require_same_trials(report, "wet: ", wet, file, coarse);
}

/// F of a slab on a slope with a bolt of constant tension, 40 degrees from the normal of the joint: F W sin psi = (W cos psi + T cos theta) tan phi + F T sin theta.
/// Where the bolt's strength is divided too: F^2 W sin psi - F (W cos psi tan phi + T sin theta) - T cos theta tan phi = 0.
void check_bolts(Report& report)
{
    const double weight = 2700.0 * 9.81 * 2.0, psi = 40.0 * std::numbers::pi / 180.0, s = std::sin(psi), c = std::cos(psi);
    const double t = tan_deg(30.0);
    const std::string source = "(W cos ψ + T cos θ) tan φ / (W sin ψ - T sin θ)";
    for (const auto& [factor, tension] : {std::pair{1.0, 9789.20}, std::pair{1.5, 19657.49}})
        for (const char* method : {"force", "hybrid"})
            for (const double angle : {0.0, turn})
            {
                const Overrides given{set("bolt[0].pretension", tension), set("bolt[0].yield", tension),
                                      set("contact.method", std::string(method))};
                const FosAnswer a = find_factor("../support/slab.toml", turned_case("support/slab.toml", given, angle));
                const std::string name = fmt::format("T {:g} N, {}{}: ", tension, method, angle > 0.0 ? ", turned by 23°" : "");
                report.require({name + "F", source, factor, a.value()}, relative(0.01));
                report.require({name + "bound by limit analysis", source, factor, a.bound.factor}, relative(0.002));
            }
    const double tension = 19657.49, b = weight * c * t + tension * s;
    const double both = (b + std::sqrt(b * b + 4.0 * weight * s * tension * c * t)) / (2.0 * weight * s);
    const FosAnswer a = find_factor("../support/slab.toml", {set("bolt[0].pretension", tension),
                                                             set("bolt[0].yield", tension),
                                                             {"factor_of_safety", R"({reduce = ["joints", "bolts"]})"}});
    report.require({"T 19657.5 N, the bolt's strength divided too: F", "the same with T / F", both, a.value()}, relative(0.01));
    report.require({"T 19657.5 N, the bolt's strength divided too: bound", "the same with T / F", both, a.bound.factor},
                   relative(0.002));
}

/// Angle of a slope at which a block slides.
void check_critical(Report& report)
{
    const FailureCondition slides{.quantity = FailureCondition::Quantity::displacement, .blocks = {"slab"}, .limit = 0.1};
    const StandsAt stands = [&](double tilt, int threads, const std::stop_token& stop)
    {
        LoadedCase loaded = load_case(case_folder() / "fos/slab.toml", Overrides{set("gravity.tilt_deg", tilt)});
        Simulation simulation(std::move(loaded.setup.model), std::move(loaded.setup.state), threads);
        return !run_to_condition(simulation, slides, stop).fails;
    };
    const Bracket up = search_between({20.0, 60.0}, 0.1, 1, stands), down = search_between({-20.0, -60.0}, 0.1, 2, stands);
    double differ = 0.0;
    for (const int threads : {2, 3})
    {
        const Bracket again = search_between({20.0, 60.0}, 0.1, threads, stands);
        differ += again.stands == up.stands && again.fails == up.fails ? 0.0 : 1.0;
    }
    report.require({"brackets that differ", "2, 3 threads", 0.0, differ}, absolute(0.0));
    report.require({"slope at which the slab slides [°]", "φ", 40.0, up.middle()}, absolute(0.1));
    report.require({"the same, tilted the other way [°]", "-φ", -40.0, down.middle()}, absolute(0.1));
}
}  // namespace

std::vector<Check> fos_checks()
{
    return {{"fos.F1", "plane failure", check_plane},
            {"fos.F2", "plane failure with a dry tension crack", check_crack},
            {"fos.F3", "Hoek's slope of 60 m, dry; with 0.08 g", check_hoek},
            {"water.W2", "factor of safety of F2 and F3 with water in the crack", check_wet_cracks},
            {"fos.F4", "toppling by Goodman and Bray", check_toppling},
            {"fos.F5", "two blocks on two planes", check_biplanar},
            {"fos.F6", "roof wedge in a horizontal stress", check_wedge},
            {"fos.laws", "strength reduction of all joint laws", check_laws},
            {"fos.bolts", "slab held by a bolt", check_bolts},
            {"fos.critical", "slope at which a slab slides", check_critical},
            {"fos.loads", "loads that have grown, or still grow, at the end of the last stage", check_loads},
            {"fos.slope", "jointed slope with and without a water table", check_slope},
            {"fos.rock", "F3 with 417 blocks behind the plane", check_rock, Check::Length::is_long}};
}
}  // namespace hdem::verification
