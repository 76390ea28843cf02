/// Rock around a tunnel by static solutions: what collapses is said to, what stands stands, whichever way the rock is turned.

#include "core/contact/contact_report.h"
#include "core/limit/strength_bound.h"
#include "core/motion/equilibrium.h"
#include "core/rock/build_model.h"
#include "core/rock/rock_mass.h"
#include "verification/checks/case_run.h"
#include "verification/checks/checks.h"
#include "verification/rest/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <set>

namespace hdem::verification
{
namespace
{
/// A rock mass of the ensemble's kind: seed, dips of three joint sets, joints.
struct RockCase
{
    int seed = 1;
    std::array<double, 3> dips_deg;
    double friction_deg = 0.0;
    double cohesion = 0.0;         ///< [Pa]
    double shear_stiffness = 5e8;  ///< [Pa/m]; across the joint 7e9

    [[nodiscard]] std::string name() const
    {
        return fmt::format("seed {}, dips {:g}/{:g}/{:g}°, φ {:g}°, c {:g} kPa, K_S/K_N {:.2g}", seed, dips_deg[0], dips_deg[1],
                           dips_deg[2], friction_deg, 1e-3 * cohesion, shear_stiffness / 7e9);
    }
};

/// Slow cycles lose a sixth to a half of the blocks of these.
const std::array<RockCase, 5> collapsing = {{{1, {25.0, 75.0, -55.0}, 5.0, 0.0},
                                             {1, {25.0, 75.0, -55.0}, 8.0, 0.0},
                                             {1, {20.0, 70.0, -60.0}, 10.0, 0.0},
                                             {2, {25.0, 75.0, -55.0}, 10.0, 0.0},
                                             {2, {15.0, 75.0, -65.0}, 15.0, 1e3}}};

/// The first three lose a block from the roof. The first one is at its limit at 10 degrees: at 9.9 degrees slow cycles lose 57 to 71 of its 158 blocks, at 10.1 degrees 1 to 4.
const std::array<RockCase, 5> standing = {{{1, {25.0, 75.0, -55.0}, 11.0, 0.0},
                                           {1, {20.0, 70.0, -60.0}, 15.0, 1e3},
                                           {2, {20.0, 70.0, -60.0}, 30.0, 0.0, 5e7},
                                           {3, {30.0, 80.0, -50.0}, 25.0, 1e4, 7e9},
                                           {2, {25.0, 75.0, -55.0}, 35.0, 1e5, 5e7}}};

/// Nothing falls here: what falls hits the floor, and where it comes to lie hangs on its way.
const std::array<RockCase, 5> quiet = {{{8, {25.0, 75.0, -55.0}, 35.0, 1e5, 2e9},
                                        {3, {30.0, 80.0, -50.0}, 35.0, 1e5},
                                        {10, {25.0, 75.0, -55.0}, 30.0, 1e5},
                                        {11, {50.0, -80.0, -30.0}, 12.0, 1e5},
                                        {1, {15.0, 65.0, -65.0}, 35.0, 1e5, 5e7}}};

constexpr double collapse_share = 0.1;  // of the free blocks lost: as StaticRule::most_loose
constexpr std::int64_t slow_removal = 5000, slowest_removal = 100'000, cycles_after = 20'000;

Polygon outline(const RockBlock& block)
{
    std::map<std::pair<double, double>, Vec2> next_of;
    for (const ConvexPart& part : block.parts)
        for (std::size_t i = 0; i < part.vertices.size(); ++i)
            if (part.source[i] != edge_internal)
                next_of[{part.vertices[i].x(), part.vertices[i].y()}] = part.vertices[next(i, part.vertices.size())];
    Polygon ring;
    for (Vec2 p = next_of.begin()->second; ring.size() < next_of.size(); p = next_of.at({p.x(), p.y()}))
        ring.push_back(p);
    return ring;
}

/// The rock with each block written out, so that it can be turned.
CaseDef written_out(const RockCase& rock)
{
    Overrides overrides{set("generator.seed", static_cast<double>(rock.seed)),
                        set("joint.default.friction_angle_deg", rock.friction_deg), set("joint.default.cohesion", rock.cohesion),
                        set("joint.default.shear_stiffness", rock.shear_stiffness)};
    for (std::size_t i = 0; i < rock.dips_deg.size(); ++i)
        overrides.push_back(set(fmt::format("joint_set[{}].dip_deg", i), rock.dips_deg[i]));
    CaseDef def = load_case(case_folder() / "statics/tunnel.toml", overrides).file.def;
    const RockMass mass = generate_rock_mass(def);
    std::vector<std::string> removed;
    for (const RockBlock& block : mass.blocks)
    {
        def.blocks.push_back({.name = block.name,
                              .polygon = outline(block),
                              .material = block.material,
                              .fix_x = block.fix_x,
                              .fix_y = block.fix_y,
                              .fix_rotation = block.fix_rotation});
        if (block.excavation != no_index)
            removed.push_back(block.name);
    }
    def.domain = {};
    def.joint_sets.clear();
    def.excavations.clear();
    def.stages.back().excavate = removed;
    return def;
}

/// What has become of a rock once its tunnel was made.
struct Outcome
{
    StaticResult statics;
    std::set<std::string> lost;  ///< moved by more than convergence.loose_distance
    double share_lost = 0.0;     ///< of the free blocks
    double share_moved = 0.0;    ///< by more than a centimetre: those that collapse are still on their way
    double mean = 0.0;           ///< displacement next to the tunnel [m]
    /// Of the blocks next to it, by name: displacement [m] and mean stress [Pa].
    std::map<std::string, std::pair<Vec2, Eigen::Matrix2d>> next_to_tunnel;
};

Outcome run(const CaseDef& def)
{
    Setup setup = build_model(def);
    Simulation simulation(std::move(setup.model), std::move(setup.state), 1);
    const std::vector<StageResult> stages = run_stages(simulation, {});
    const DisplacementReport found = report_displacements(simulation.model(), simulation.state());
    Outcome outcome{.statics = stages.back().statics.value_or(StaticResult{}), .lost = {}, .mean = found.mean};
    Index free = 0, moved = 0;
    const Blocks& blocks = simulation.state().blocks;
    for (Index b = 0; b < blocks.size(); ++b)
        if (blocks.is_free(b))
        {
            ++free;
            moved += blocks.displacement(b).norm() > 0.01 ? 1 : 0;
        }
    for (const Index b : found.detached)
        outcome.lost.insert(simulation.model().name[b]);
    const std::vector<MeanStress> stress = mean_stresses(simulation.model(), simulation.state());
    for (const Index b : simulation.state().next_to_excavation)
        if (blocks.is_free(b))
            outcome.next_to_tunnel[simulation.model().name[b]] = {
                blocks.displacement(b), (Eigen::Matrix2d() << stress[b].xx, stress[b].xy, stress[b].xy, stress[b].yy).finished()};
    outcome.share_lost = static_cast<double>(found.detached.size()) / free;
    outcome.share_moved = static_cast<double>(moved) / free;
    return outcome;
}

/// By cycles alone, as the forces of the tunnel's rock are taken off slowly.
Outcome run_slowly(CaseDef def)
{
    for (StageDef& stage : def.stages)
        stage.solver = RestSolver::dynamics;
    def.stages.back().relax_cycles = slow_removal;
    return run(def);
}

/// Mean difference over the mean, of displacements and stresses next to the tunnel; `found` stands as it was placed.
std::pair<double, double> differences(const Outcome& found, const rest::Placement& placement, const Outcome& reference)
{
    Eigen::Matrix2d axes;
    axes << placement.turned({1.0, 0.0}), placement.turned({0.0, 1.0});
    double ways = 0.0, way_differences = 0.0, stresses = 0.0, stress_differences = 0.0;
    for (const auto& [name, there] : reference.next_to_tunnel)
    {
        const auto& [way, stress] = found.next_to_tunnel.at(name);
        ways += there.first.norm();
        way_differences += (placement.turned_back(way) - there.first).norm();
        stresses += there.second.norm();
        stress_differences += (axes.transpose() * stress * axes - there.second).norm();
    }
    return {way_differences / ways, stress_differences / stresses};
}

/// Strength over the least that balances all blocks, at most: below 1 there is no equilibrium of all of them.
double greatest_factor(CaseDef def)
{
    for (StageDef& stage : def.stages)
        stage.max_cycles = 1;
    Setup setup = build_model(def);
    Simulation simulation(std::move(setup.model), std::move(setup.state), 1);
    run_stages(simulation, {});
    const StrengthBound bound = strength_bound(simulation.model(), simulation.state(), {}, 0.2, 20.0);
    const bool is_known = bound.end == StrengthBound::End::found || bound.end == StrengthBound::End::no_balance;
    return is_known ? bound.factor : std::numeric_limits<double>::quiet_NaN();
}

/// Drawn, turned, and turned and mirrored; by springs and hybrid.
template <typename Judge>
void in_all_ways(const CaseDef& def, const std::string& name, const Judge& judge)
{
    rest::Placement turned = rest::turned_by(23.0), mirrored = turned;
    mirrored.mirrored = true;
    for (const rest::Placement& placement : {rest::Placement{}, turned, mirrored})
        for (const Method method : {Method::force, Method::hybrid})
        {
            CaseDef placed = rest::placed(def, placement);
            placed.contact.method = method;
            judge(placed, placement, fmt::format("{}; {}, {}: ", name, placement.name(), name_of(method)));
        }
}

void check_collapse(Report& report)
{
    for (const RockCase& rock : collapsing)
    {
        CaseDef def = written_out(rock);
        report.require({rock.name() + ": share lost by slow cycles", "collapses", collapse_share, run_slowly(def).share_lost},
                       at_least());
        report.require({rock.name() + ": greatest factor of safety of all blocks", "limit analysis: no equilibrium", 1.0,
                        greatest_factor(def)},
                       at_most());
        def.stages.back().max_cycles = cycles_after;
        in_all_ways(def, rock.name(),
                    [&](const CaseDef& placed, const rest::Placement&, const std::string& as)
                    {
                        const Outcome found = run(placed);
                        const bool is_seen = found.statics.outcome == "no_equilibrium";
                        report.require({as + "no equilibrium", "seen", 1.0, is_seen ? 1.0 : 0.0}, absolute(0.0));
                        report.require({as + "blocks named", "a tenth", collapse_share * static_cast<double>(placed.blocks.size()),
                                        static_cast<double>(found.statics.loose.size())},
                                       at_least());
                        report.require(
                            {as + "share moved by 1 cm in the cycles that follow", "goes on", collapse_share, found.share_moved},
                            at_least());
                    });
    }
}

/// A block on the verge may stand in the static answer and fall by slow cycles: both numbers are shown.
void check_standing(Report& report)
{
    for (const RockCase& rock : standing)
    {
        CaseDef def = written_out(rock);
        const Outcome slow = run_slowly(def);
        report.require({rock.name() + ": share lost by slow cycles", "stands", 0.02, slow.share_lost}, at_most());
        in_all_ways(def, rock.name(),
                    [&](const CaseDef& placed, const rest::Placement&, const std::string& as)
                    {
                        const Outcome found = run(placed);
                        const bool is_balanced = found.statics.outcome == "balanced";
                        report.require({as + "in balance", "stands", 1.0, is_balanced ? 1.0 : 0.0}, absolute(0.0));
                        report.require({as + "share lost", "stands", 0.02, found.share_lost}, at_most());
                        report.inform({as + "blocks lost", "slow cycles", static_cast<double>(slow.lost.size()),
                                       static_cast<double>(found.lost.size())});
                        report.inform({as + "displacement next to the tunnel [m]", "slow cycles", slow.mean, found.mean});
                    });
    }
}
/// The forces of the tunnel's rock are taken off slowly in both. The reference stands as drawn and begins from the same balance under gravity.
void check_against_slow(Report& report)
{
    for (const RockCase& rock : quiet)
    {
        CaseDef def = written_out(rock);
        def.stages.back().relax_cycles = slow_removal;
        CaseDef slow_def = def;
        slow_def.stages.back().solver = RestSolver::dynamics;
        slow_def.stages.back().relax_cycles = slowest_removal;
        const Outcome slow = run(slow_def);
        report.require({rock.name() + ": blocks lost by slow cycles", "none", 0.0, static_cast<double>(slow.lost.size())},
                       absolute(0.0));
        in_all_ways(
            def, rock.name(),
            [&](const CaseDef& placed, const rest::Placement& placement, const std::string& as)
            {
                const Outcome found = run(placed);
                const auto [ways, stresses] = differences(found, placement, slow);
                report.require({as + "blocks lost", "slow cycles", 0.0, static_cast<double>(found.lost.size())}, absolute(0.0));
                report.require({as + "displacement next to the tunnel, mean difference", "slow cycles", 0.02, ways}, at_most());
                report.require({as + "stress next to the tunnel, mean difference", "slow cycles", 0.02, stresses}, at_most());
            });
    }
}
}  // namespace

std::vector<Check> static_rock_checks()
{
    return {
        {"statics.collapse", "tunnels that collapse, by static solutions (some minutes)", check_collapse, Check::Length::is_long},
        {"statics.stands", "tunnels that stand, likewise", check_standing, Check::Length::is_long},
        {"statics.slow", "standing rock by static solutions beside slow cycles (a minute)", check_against_slow,
         Check::Length::is_long}};
}
}  // namespace hdem::verification
