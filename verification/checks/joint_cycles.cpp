/// All joint laws in the cycle: on contacts that are cut otherwise, on a block that falls, on threads and after a restart.

#include "core/contact/contact_report.h"
#include "core/rock/build_model.h"
#include "verification/checks/case_run.h"
#include "verification/checks/joint_checks.h"
#include "verification/checks/same_bits.h"
#include "verification/scenes/sample_joints.h"
#include "verification/scenes/shear_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace hdem::verification
{
namespace
{
using namespace scenes;

/// Names of the laws of sample_joints.
constexpr std::array<const char*, 8> law_names{"coulomb", "barton_bandis", "patton",         "continuously_yielding",
                                               "plesha",  "saeb_amadei",   "slip_weakening", "of a shared library"};

Simulation simulation_of(const CaseDef& scene)
{
    hdem::Setup setup = build_model(scene);
    return {std::move(setup.model), std::move(setup.state)};
}

double residual(const Simulation& run)
{
    return std::abs(relative_residual(run.state().ledger, stored_energy(run.model(), run.state())));
}

/// Mean stresses of the joint below the box [Pa], how far the box has risen [m], and contacts that it stands on.
std::array<double, 4> look(const Simulation& run, int tops)
{
    std::array<double, 4> seen{};
    for (Index c = 0; c < run.state().contacts.size(); ++c)
    {
        const ContactReport report = report_contact(run.state(), c);
        if (std::abs(report.normal.y()) < 0.5 || !is_closed_contact(run.state(), c))
            continue;  // between pieces
        seen[3] += 1.0;
        seen[0] += report.normal_force / box_width;
        seen[1] += report.shear_force / box_width;
    }
    for (int k = 0; k < tops; ++k)
        seen[2] += run.state().blocks.displacement(run.model().find_block(top_name(k))).y() / tops;
    return seen;
}

/// After each of the four slow moves.
std::vector<std::array<double, 4>> slow_looks(const JointDef& joint, Cut cut, int pieces)
{
    const std::vector<Move> moves = slow_moves();
    Simulation run = simulation_of(shear_box(joint, cut, pieces, 1e-4, moves));
    run.begin_stage(0);
    std::vector<std::array<double, 4>> looks;
    for (std::size_t k = 0; k < moves.size(); ++k)
    {
        run.advance(moves[k].cycles + moves[k].rest);
        if (k > 0 && k % 3 == 0)
            looks.push_back(look(run, cut == Cut::top ? pieces : 1));
    }
    return looks;
}

/// A slab above a slope of 60 degrees, or of another one: friction alone does not hold it.
CaseDef slab_above(double gap, Method method, const JointDef& joint)
{
    CaseDef scene = empty_scene();
    add_fixed_block(scene, "slope", rectangle({-20.0, -1.0}, {20.0, 0.0}));
    add_block(scene, "slab", rectangle({0.0, gap}, {4.0, 0.5 + gap}));
    scene.joints = {joint};
    scene.contact.method = method;
    scene = turned(scene, 60.0);
    scene.gravity = {0.0, -9.81};
    return scene;
}

double way_after(const CaseDef& scene, double time)
{
    Simulation run = simulation_of(scene);
    run.begin_stage(0);
    run.advance(static_cast<std::int64_t>(time / run.model().time_step));
    return run.state().blocks.displacement(run.model().find_block("slab")).norm();
}
}  // namespace

void check_contacts(Report& report)
{
    for (std::size_t law = 0; law + 1 < law_names.size(); ++law)
    {
        const JointDef joint = sample_joints()[law];
        const auto whole = slow_looks(joint, Cut::base, 1);
        double stress = 0.0, height = 0.0, energy = 0.0, others = 0.0;
        for (const Cut cut : {Cut::base, Cut::top})
        {
            for (const int pieces : {2, 16})
            {
                const auto parts = slow_looks(joint, cut, pieces);
                for (std::size_t i = 0; i < whole.size(); ++i)
                {
                    stress = std::max({stress, std::abs(parts[i][0] - whole[i][0]) / box_pressure,
                                       std::abs(parts[i][1] - whole[i][1]) / box_pressure});
                    height = std::max(height, std::abs(parts[i][2] - whole[i][2]));
                    others += parts[i][3] == pieces ? 0.0 : 1.0;
                }
            }
            for (const int pieces : {1, 2, 16})
            {
                const std::vector<Move> moves = ten_fast_reversals();
                Simulation run = simulation_of(shear_box(joint, cut, pieces, 2e-5, moves));
                run.begin_stage(0);
                for (const Move& move : moves)
                {
                    run.advance(move.cycles);
                    energy = std::max(energy, residual(run));
                }
            }
        }
        const std::string name = law_names[law];
        report.require({name + ": stresses on 2 and 16 contacts against 1", "the same joint", 1e-3, stress}, at_most());
        report.require(
            {name + ": shear stress at −5 mm over the pressure", "it slips", 0.4, std::abs(whole.back()[1]) / box_pressure},
            at_least());
        report.require({name + ": looks at another number of contacts than pieces", "as cut", 0.0, others}, absolute(0.0));
        report.require({name + ": height [m]", "the same joint", 1e-6, height}, at_most());
        report.require({name + ": ledger over ten cycles of ±5 mm", "energy", 1e-6, energy}, at_most());
    }
}

void check_fall(Report& report)
{
    JointDef joint = empty_scene().joints[0];
    joint.cohesion = 1e6;
    JointDef brittle = joint;
    brittle.residual_friction_angle_deg = 20.0;
    brittle.residual_cohesion = 0.0;
    for (const auto& [name, law] : {std::pair("c 1 MPa", joint), {"c 1 MPa until it breaks", brittle}})
        for (const auto& [method_name, method] :
             {std::pair("force", Method::force), {"impulse", Method::impulse}, {"hybrid", Method::hybrid}})
        {
            const std::string what = fmt::format("{}, {}: ", name, method_name);
            report.require(
                {what + "way of a slab drawn on 60° in 2 s [m]", "holds", 1e-4, way_after(slab_above(0.0, method, law), 2.0)},
                at_most());
            report.require({what + "way of one that falls 3 m on it in 2 s [m]", "slides on", 5.0,
                            way_after(slab_above(1.5, method, law), 2.0)},
                           at_least());
        }
}

void check_bits(Report& report)
{
    const Overrides begun{{"stage", R"([{name = "heading", excavate = ["heading"], relax_cycles = 100, cycles = 200}])"}};
    const std::string
        coulomb = "friction_angle_deg = 30.0, cohesion = 1e5, residual_friction_angle_deg = 25.0, dilation_angle_deg = 10.0";
    const std::array<std::pair<const char*, std::string>, 7> laws{
        {{"coulomb", coulomb},
         {"barton_bandis", "jrc = 10.0, jcs = 1e8, residual_friction_angle_deg = 30.0"},
         {"patton", "friction_angle_deg = 30.0, asperity_angle_deg = 15.0, residual_friction_angle_deg = 35.0, cohesion = 1e6"},
         {"continuously_yielding", "friction_angle_deg = 30.0, mobilised_angle_deg = 50.0, wear_length = 5e-4"},
         {"plesha", "friction_angle_deg = 30.0, asperity_angle_deg = 15.0, wear = 2e-5"},
         {"saeb_amadei", "greatest_closure = 3e-4, friction_angle_deg = 30.0, asperity_angle_deg = 15.0, transition_stress = 5e7, "
                         "rock_cohesion = 5e6, rock_friction_angle_deg = 40.0"},
         {"slip_weakening", "friction_angle_deg = 35.0, residual_friction_angle_deg = 25.0, wear_length = 1e-3"}}};
    constexpr std::array<const char*, 2> methods{"force", "hybrid"};
    constexpr std::array<int, 3> threads{2, 3, 8};
    for (const auto& [name, keys] : laws)
    {
        const std::string joint = fmt::format("{{law = \"{}\", normal_stiffness = 1e10, shear_stiffness = 2e9, {}}}", name, keys);
        require_same_bits(report, "cavern/cavern.toml", begun + Overrides{{"joint.bedding", joint}, {"joint.jointed", joint}},
                          methods, {threads, name, false});
    }
}
}  // namespace hdem::verification
