/// Bolts of which hdem critical finds the least force that holds the rock.

#include "core/contact/contact_report.h"
#include "core/motion/equilibrium.h"
#include "core/support/bolt_forces.h"
#include "parallel/critical_search.h"
#include "verification/checks/case_run.h"
#include "verification/checks/same_bits.h"
#include "verification/checks/support_checks.h"
#include "verification/checks/turned_case.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace hdem::verification
{
namespace
{
constexpr std::array force_and_hybrid{"force", "hybrid"};

/// As `hdem critical` does it.
Bracket find_critical(const std::string& case_file, const Overrides& overrides, const std::string& key, const CriticalRange& range,
                      double tolerance, const FailureCondition& fails)
{
    const StandsAt stands = [&](double x, int threads, const std::stop_token& stop)
    {
        LoadedCase loaded = load_case(case_folder() / case_file, overrides + Overrides{set(key, x)});
        Simulation simulation(std::move(loaded.setup.model), std::move(loaded.setup.state), threads);
        return !run_to_condition(simulation, fails, stop).fails;
    };
    return search_between(range, tolerance, 1, stands);
}

/// Force of a level anchor through the lowest column that keeps the columns of support/goodman_bray.toml from toppling and sliding [N/m], by limit equilibrium
/// (Goodman & Bray 1976): from the top down each column hands on the greater one of the forces without which it topples about its lower corner or slides; between
/// columns the friction is spent and the force of one that topples acts at its upper corner.
double anchor_by_limit_equilibrium(double friction)
{
    constexpr double width = 10.0, step = 1.0, unit_weight = 25e3;  // [m], [m] from base to base, [N/m3]
    constexpr double slope = std::numbers::pi / 6.0;                // of the bases
    constexpr int columns = 16, highest = 10;
    const auto height = [](int n) { return n <= highest ? 4.0 * n : 40.0 - 6.0 * (n - highest); };
    const auto weight = [&](int n) { return unit_weight * width * height(n); };
    const double c = std::cos(slope), s = std::sin(slope);
    double force = 0.0;
    for (int n = columns; n > 1; --n)
    {
        const double y = height(n), above = n < columns ? height(n + 1) + step : 0.0, below = height(n - 1) - step;
        const double from = std::min(y, above), to = std::min(y, below);  // above the base of n
        const double topples = (force * (from - width * friction) + 0.5 * weight(n) * (y * s - width * c)) / to;
        const double slides = force - weight(n) * (c * friction - s) / (1.0 - friction * friction);
        force = std::max({topples, slides, 0.0});
    }
    return (force * (1.0 - friction * friction) - weight(1) * (friction * c - s)) / (friction * s + c);
}
/// What acts on a block, by its kind [N].
struct BlockBalance
{
    Vec2 weight = {0.0, 0.0}, joints = {0.0, 0.0}, bolts = {0.0, 0.0};
};

std::vector<BlockBalance> balances(const Model& model, State state)
{
    std::vector<BlockBalance> all(static_cast<std::size_t>(model.blocks()));
    for (Index i = 0; i < model.blocks(); ++i)
        all[i].weight = model.mass[i] * model.gravity;
    for (Index i = 0; i < state.contacts.size(); ++i)
        if (is_closed_contact(state, i))
        {
            const ContactReport contact = report_contact(state, i);
            const Vec2 on_second = contact.normal_force * contact.normal + contact.shear_force * contact.shear_axis();
            all[contact.second].joints += on_second;
            all[contact.first].joints -= on_second;
        }
    std::vector<BlockPush> pushes;
    pull_bolts(model, state, 0.0, pushes);
    for (const BlockPush& push : pushes)
        all[push.block].bolts += Vec2(push.force.x, push.force.y);
    return all;
}
}  // namespace

namespace
{
/// Turned, the joints of a set cross the domain at other places, so that other deviations of their dip are drawn: another rock mass of the same kind.
void check_tunnel_held(Report& report, const char* method, double angle)
{
    const std::string file = "support/tunnel.toml", key = "bolt[0].yield";
    const std::string as = fmt::format("{}{}: ", method, angle == 0.0 ? "" : ", turned by 23°");
    const Overrides base = turned_case(file, {set("contact.method", std::string(method))}, angle);
    const CaseRun without(report, file, base + Overrides{set(key, 1.0)});
    const std::vector<Index> lost = report_displacements(without.model(), without.state()).detached;
    const auto number = static_cast<double>(lost.size());
    if (angle == 0.0)
        report.require({as + "blocks that are lost with bolts of 1 N", "three", 3.0, number}, absolute(0.0));
    else
        report.require({as + "blocks that are lost with bolts of 1 N", "some", 1.0, number}, at_least());
    const FailureCondition falls{.quantity = FailureCondition::Quantity::detached, .blocks = {}, .limit = 0.0};
    const Bracket least = find_critical(file, base, key, {1e5, 1.0}, 2e3, falls);
    report.require({as + "least yield of a bolt that holds all [N]", "found between 0 and 100 kN", 1e5, *least.stands}, at_most());
    const CaseRun run(report, file, base + Overrides{set(key, *least.stands)});
    const Model& model = run.model();
    report.require({as + "blocks that are lost with it", "none", 0.0,
                    static_cast<double>(report_displacements(model, run.state()).detached.size())},
                   absolute(0.0));
    const std::vector<BlockBalance> balance = balances(model, run.state());
    for (const Index was : lost)
    {
        const std::string& name = without.model().name[was];
        const BlockBalance& on = balance[run.block(name)];
        report.require({as + fmt::format("{}: weight, bolts and joints together, as a share of its weight of {:.0f} kN/m", name,
                                         1e-3 * on.weight.norm()),
                        "equilibrium", 0.0, (on.weight + on.joints + on.bolts).norm() / on.weight.norm()},
                       absolute(1e-2));
    }
}
}  // namespace

void check_tunnel(Report& report)
{
    for (const char* method : force_and_hybrid)
        for (const double angle : {0.0, 23.0 * std::numbers::pi / 180.0})
            check_tunnel_held(report, method, angle);
    require_same_bits(report, "support/tunnel.toml", {set("bolt[0].yield", 2e4)}, force_and_hybrid);
}

void check_goodman_bray(Report& report)
{
    constexpr double turn = 23.0 * std::numbers::pi / 180.0, published = 2013e3;
    report.require({"limit equilibrium, tan φ 0.65: force [N/m]", "Goodman and Bray", published, anchor_by_limit_equilibrium(0.65)},
                   relative(1e-3));
    const FailureCondition moves{.quantity = FailureCondition::Quantity::displacement, .blocks = {}, .limit = 5e-3};
    const std::string file = "support/goodman_bray.toml";
    for (const char* method : force_and_hybrid)
        for (const double angle : {0.0, turn})
        {
            const Overrides given = turned_case(file, {set("contact.method", std::string(method))}, angle);
            const Bracket found = find_critical(file, given, "bolt[0].pretension", {3e6, 1e6}, 4e3, moves);
            report.require({fmt::format("{}{}: least force of the anchor [N/m]", method, angle == 0.0 ? "" : ", turned by 23°"),
                            "Goodman and Bray", published, found.middle()},
                           relative(1e-2));
        }
    require_same_bits(report, file, {set("bolt[0].pretension", 1.02 * published)}, force_and_hybrid);
    const CaseRun held(report, file, {set("bolt[0].pretension", 1.02 * published)});
    report.require({"with 2 % more: cycles to rest", "at rest", 2e4, static_cast<double>(held.state().cycle)}, at_most());
    const Bracket soft = find_critical(file, {set("joint.default.shear_stiffness", 5e8)}, "bolt[0].pretension", {3e6, 1e6}, 4e3,
                                       moves);
    report.require(
        {"joints a quarter as stiff in shear: least force of the anchor [N/m]", "Goodman and Bray", published, soft.middle()},
        relative(1e-2));
}
}  // namespace hdem::verification
