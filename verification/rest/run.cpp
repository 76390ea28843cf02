#include "verification/rest/run.h"

#include "core/contact/contact_report.h"
#include "core/motion/equilibrium.h"
#include "core/state/state_hash.h"
#include "io/load_case.h"
#include "parallel/stages.h"
#include "verification/rest/case_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem::verification::rest
{
namespace
{
LoadedCase load(const Scene& scene, const Placement& placement)
{
    return load_case(scene_text(scene, placement), {}, "rest." + scene.name(), {});
}

/// Throws InputError as `hdem run` would refuse the case.
Simulation simulation_of(LoadedCase loaded, int threads)
{
    Simulation simulation(std::move(loaded.setup.model), std::move(loaded.setup.state), threads);
    if (const std::vector<Problem> problems = simulation.find_problems(); !problems.empty())
        throw InputError(loaded.file.source.located(problems));
    return simulation;
}

/// The body turned about its centroid, and moved.
Body moved(Body body, const Vec2& way, double rotation)
{
    const double c = std::cos(rotation), s = std::sin(rotation);
    for (ConvexPart& part : body.parts)
        for (Vec2& v : part.vertices)
        {
            const Vec2 from = v - body.centroid;
            v = body.centroid + way + Vec2(c * from.x() - s * from.y(), s * from.x() + c * from.y());
        }
    body.centroid += way;
    return body;
}

void describe_blocks(const Scene& scene, const Placement& placement, const Simulation& simulation, const EnergyWatch& watch,
                     Outcome& outcome)
{
    const Model& model = simulation.model();
    const Blocks& blocks = simulation.state().blocks;
    for (std::size_t i = 0; i < scene.def.blocks.size(); ++i)
    {
        const Index slot = model.slot_of_user[i];
        const BlockMotion& m = blocks.motion[slot];
        const BlockForce& f = blocks.force[slot];
        outcome.way.push_back(placement.turned_back(Vec2(m.x, m.y) - watch.start()[slot]));
        outcome.rotation.push_back(placement.sense() * m.angle);
        const Vec2 force = placement.turned_back({f.x, f.y});
        outcome.net.emplace_back(force.x(), force.y(), placement.sense() * f.moment);
        // One that has left the model is held where it is, and says so in the warnings: nothing is asked of its balance.
        const bool is_held = scene.is_fixed(i) || has_left(slot, model, blocks);
        outcome.bodies.push_back(moved(body_of(scene.def.blocks[i].polygon, density_of(scene, i), is_held), outcome.way.back(),
                                       outcome.rotation.back()));
    }
}

Vec2 carried_force(const Support& support, const Placement& placement, const Simulation& simulation)
{
    const Index lower = simulation.model().slot_of_user[support.lower];
    const Index upper = simulation.model().slot_of_user[support.upper];
    Vec2 sum(0.0, 0.0);
    for (Index i = 0; i < simulation.state().contacts.size(); ++i)
    {
        if (!is_closed_contact(simulation.state(), i))
            continue;
        const ContactReport contact = report_contact(simulation.state(), i);
        const Vec2 on_second = contact.normal_force * contact.normal + contact.shear_force * contact.shear_axis();
        if (contact.first == lower && contact.second == upper)
            sum += on_second;
        if (contact.first == upper && contact.second == lower)
            sum -= on_second;
    }
    return placement.turned_back(sum);
}

std::string all_texts(const InputError& error)
{
    std::string text;
    for (const Problem& problem : error.problems())
        text += (text.empty() ? "" : " ") + problem.text;
    return text;
}
}  // namespace

double rim_way(const Outcome& outcome, std::size_t block)
{
    return outcome.way[block].norm() + std::abs(outcome.rotation[block]) * outcome.bodies[block].radius;
}

double farthest_way(const Outcome& outcome)
{
    double farthest = 0.0;
    for (std::size_t i = 0; i < outcome.way.size(); ++i)
        farthest = std::max(farthest, rim_way(outcome, i));
    return farthest;
}

std::string scene_text(const Scene& scene, const Placement& placement)
{
    CaseDef def = placed(scene.def, placement);
    def.title = fmt::format("rest.{}: {}; {}", scene.name(), scene.what, placement.name());
    return case_text(def);
}

Outcome run_scene(const Scene& scene, const Placement& placement)
{
    Outcome outcome;
    try
    {
        Simulation simulation = simulation_of(load(scene, placement), 1);
        EnergyWatch watch(scene);
        const std::array<Observer*, 1> observers{&watch};
        outcome.converged = run_stages(simulation, observers).back().at_rest;
        outcome.cycles = simulation.state().cycle;
        outcome.time = simulation.state().time;
        const EnergyLedger& ledger = simulation.state().ledger;
        outcome.had_impulses = ledger.impulse_loss != 0.0 || ledger.position_correction != 0.0;
        describe_blocks(scene, placement, simulation, watch, outcome);
        for (const Support& support : scene.supports)
            outcome.carried.push_back(carried_force(support, placement, simulation));
        outcome.peak = watch.peak();
        outcome.rise = watch.rise();
        outcome.residual = watch.residual();
    }
    catch (const InputError& error)
    {
        outcome.failure = "refused: " + all_texts(error);
    }
    catch (const RunError& error)
    {
        outcome.failure = error.what();
    }
    return outcome;
}

Scene slow_version(const Scene& scene, double step, double seconds)
{
    Scene slow = scene;
    slow.def.time.step = step;
    slow.def.stages = {{.name = "slow", .duration = seconds}};
    return slow;
}

Trace trace(const Scene& scene, const Placement& placement, std::int64_t cycles, int threads)
{
    Scene shortened = scene;
    for (StageDef& stage : shortened.def.stages)
        stage.max_cycles = std::min(stage.max_cycles, cycles);
    Simulation simulation = simulation_of(load(shortened, placement), threads);
    run_stages(simulation, {});
    return {state_hash(simulation.model(), simulation.state()), simulation.state().contacts.size()};
}
}  // namespace hdem::verification::rest
