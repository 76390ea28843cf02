#include "core/support/liner_forces.h"

#include "core/model/liner_growth.h"
#include "core/support/bolt_link.h"
#include "core/support/liner_damping.h"
#include "core/support/liner_load.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace hdem
{
namespace
{
/// Keep all forces as the modulus changes: plastic deformations of the beams are changed accordingly.
void harden(const Liner& liner, double factor, const LinerMemory& memory)
{
    if (*memory.factor == factor)
        return;
    const double share = *memory.factor / factor;
    for (std::size_t s = 0; s < liner.segments.size(); ++s)
    {
        const LinerSegment& segment = liner.segments[s];
        LinerSegmentMemory& own = memory.segment[s];
        const BeamShape shape(segment);
        const double* first = &memory.moved[3 * segment.node[0]];
        const double* second = &memory.moved[3 * segment.node[1]];
        const auto seen = [&](double now, double flowed) { return now - (now - flowed) * share; };
        own.plastic = seen(shape.of(0, first, second), own.plastic);
        for (int end = 0; end < 2; ++end)
            own.turned[end] = seen(shape.of(1 + end, first, second), own.turned[end]);
    }
    *memory.factor = factor;
}

/// @param before  velocities of the nodes in the last cycle
void slow_down(const std::vector<double>& before, double damping, const LinerMemory& memory)
{
    const auto share_kept = [&](double power, double change, double speed)
    { return power < 0.0 ? std::max(1.0 - damping * change / speed, 0.0) : 1.0; };
    for (std::size_t at = 0; at < before.size(); at += 3)
    {
        double* v = &memory.velocity[at];
        const Vec2 speed(v[0], v[1]), change = speed - Vec2(before[at], before[at + 1]);
        const double kept = share_kept(change.dot(speed), change.norm(), speed.norm());
        v[0] *= kept;
        v[1] *= kept;
        const double turned = v[2] - before[at + 2];
        v[2] *= share_kept(turned * v[2], std::abs(turned), std::abs(v[2]));
    }
}

/// Forces and moments of a liner on the blocks that touch others by impulses.
std::map<Index, Triple> on_impulsive_blocks(const Liner& liner, const LinerLoad& load, const LinerMemory& memory,
                                            const Blocks& blocks, const LinerSolver& solver)
{
    std::map<Index, Triple> sums;
    for (std::size_t s = 0; s < liner.segments.size(); ++s)
    {
        const LinerSegment& segment = liner.segments[s];
        if (load.gone[s] != 0 || !can_move(blocks.inertia[segment.block]) ||
            (blocks.force[segment.block].contacts & contact_impulse) == 0)
            continue;
        Triple& sum = sums[segment.block];
        for (int end = 0; end < 2; ++end)
        {
            const TieAnswer tie = solver.tie(s, end, load, memory);
            const Vec2 force = tie.normal * segment.to_rock() + tie.shear * segment.along;
            const Vec2 arm = turned_with(blocks.motion[segment.block], segment.arm[end]);
            sum = {sum.x + force.x(), sum.y + force.y(), sum.w + cross(arm, force)};
        }
    }
    return sums;
}

/// Size of the force against a swing, see liner_damping.h.
/// @param mobility  speed that a unit impulse gives [1/kg]
/// @param rate      of the force, along the velocity [N/s]
double damping_force(double share, double mobility, double speed, double rate, double step)
{
    // The speed is half a step old: see bolt_forces.cpp.
    constexpr double most_taken = 0.25;
    if (!(mobility > 0.0 && speed > 0.0 && rate < 0.0))
        return 0.0;
    return std::min(2.0 * share * std::sqrt(-rate * speed / mobility), most_taken * speed / (mobility * step));
}

void damp_blocks(const std::map<Index, Triple>& before, const std::map<Index, Triple>& now, double share, const Blocks& blocks,
                 std::vector<BlockPush>& pushes)
{
    const double step = blocks.step.last;
    for (const auto& [block, force] : now)
    {
        const Triple& was = before.at(block);
        const BlockMotion& m = blocks.motion[block];
        const BlockInertia& inertia = blocks.inertia[block];
        const double speed = Vec2(m.vx, m.vy).norm();
        const Vec2 along = speed > 0.0 ? Vec2(m.vx / speed, m.vy / speed) : Vec2(0.0, 0.0);
        const double rate = ((force.x - was.x) * along.x() + (force.y - was.y) * along.y()) / step;
        const double mobility = inertia.inverse_mass_x * along.x() * along.x() + inertia.inverse_mass_y * along.y() * along.y();
        const double turning = std::copysign(1.0, m.w), turn_rate = turning * (force.w - was.w) / step;
        const double against = damping_force(share, mobility, speed, rate, step);
        const double moment = damping_force(share, inertia.inverse_inertia, std::abs(m.w), turn_rate, step);
        if (against > 0.0 || moment > 0.0)
            pushes.push_back(
                {block, {-against * along.x(), -against * along.y(), -moment * turning}, {m.vx, m.vy, m.w}, 0.0, true});
    }
}

/// Book what flowed in the cycle, and press on the rock.
class Booking
{
  public:
    Booking(const Liner& liner, const LinerLoad& load, const LinerMemory& memory, const Blocks& blocks, LinerRecord& record,
            std::vector<BlockPush>& pushes)
        : liner_(liner),
          load_(load),
          memory_(memory),
          blocks_(blocks),
          record_(record),
          pushes_(pushes)
    {
    }

    void run(const LinerSolver& solver)
    {
        record_.thrust = record_.moment = record_.displacement = record_.parted = record_.stored = 0.0;
        for (std::size_t s = 0; s < liner_.segments.size(); ++s)
        {
            const BeamAnswer beam = solver.beam(s, load_, memory_);
            const TieAnswer ties[2] = {load_.gone[s] == 0 ? solver.tie(s, 0, load_, memory_) : TieAnswer{},
                                       load_.gone[s] == 0 ? solver.tie(s, 1, load_, memory_) : TieAnswer{}};
            book(beam, memory_.segment[s]);
            for (int end = 0; end < 2; ++end)
                press(s, end, ties[end], beam.flows == 0);
        }
        count_hinges();
        for (std::size_t node = 0; node < liner_.nodes.size(); ++node)
            record_.displacement = std::max(record_.displacement,
                                            Vec2(memory_.moved[3 * node], memory_.moved[3 * node + 1]).norm());
    }

  private:
    void count_hinges()
    {
        std::vector<std::uint8_t> turned(liner_.nodes.size(), 0);
        for (std::size_t s = 0; s < liner_.segments.size(); ++s)
            for (int end = 0; end < 2; ++end)
                if (memory_.segment[s].hinge[end] != 0.0)
                    turned[liner_.segments[s].node[end]] = 1;
        record_.hinges = std::ranges::count(turned, std::uint8_t{1});
    }

    void book(const BeamAnswer& beam, LinerSegmentMemory& own)
    {
        own.plastic += beam.stretched;
        for (int end = 0; end < 2; ++end)
        {
            own.turned[end] += beam.turned[end];
            own.hinge[end] = beam.turned[end] != 0.0 ? 1.0 : own.hinge[end];
            record_.moment = std::max(record_.moment, std::abs(beam.moment[end]));
        }
        record_.thrust = std::max(record_.thrust, -beam.thrust);
        record_.stored += beam.stored;
        record_.spent += beam.spent;
    }

    void press(std::size_t s, int end, const TieAnswer& tie, bool is_elastic)
    {
        if (load_.gone[s] != 0)
            return;
        const LinerSegment& segment = liner_.segments[s];
        LinerSegmentMemory& own = memory_.segment[s];
        own.slip[end] += tie.slips;
        own.pressed[end] = tie.normal;
        own.parted[end] = tie.parts ? 1.0 : own.parted[end];
        record_.parted += tie.normal_tangent == 0.0 ? 0.5 * segment.length : 0.0;
        record_.stored += tie.stored;
        record_.spent += tie.spent;
        const Vec2 force = tie.normal * segment.to_rock() + tie.shear * segment.along;
        if (force.isZero(0.0))
            return;
        const BlockMotion& m = blocks_.motion[segment.block];
        const Vec2 arm = turned_with(m, segment.arm[end]);
        pushes_.push_back(
            {segment.block, {force.x(), force.y(), cross(arm, force)}, {m.vx, m.vy, m.w}, is_elastic ? force.norm() : 0.0});
    }

    const Liner& liner_;
    const LinerLoad& load_;
    const LinerMemory& memory_;
    const Blocks& blocks_;
    LinerRecord& record_;
    std::vector<BlockPush>& pushes_;
};
}  // namespace

LinerSolvers::LinerSolvers() = default;
LinerSolvers::~LinerSolvers() = default;
LinerSolvers::LinerSolvers(LinerSolvers&&) noexcept = default;
LinerSolvers& LinerSolvers::operator=(LinerSolvers&&) noexcept = default;

LinerSolver& LinerSolvers::of(const Model& model, std::size_t liner)
{
    solvers_.resize(model.support.liners.size());
    if (!solvers_[liner])
        solvers_[liner] = std::make_unique<LinerSolver>(model.support.liners[liner]);
    return *solvers_[liner];
}

bool install_liners(const Model& model, State& state)
{
    bool any = false;
    for (std::size_t i = 0; i < model.support.liners.size(); ++i)
    {
        const Liner& liner = model.support.liners[i];
        if (liner.stage != state.stage)
            continue;
        std::fill_n(state.support.history.begin() + liner.history, liner.history_size, 0.0);
        const LinerMemory memory = liner_memory(liner, state.support.history);
        *memory.factor = hardening_at(liner, 0);
        for (std::size_t s = 0; s < liner.segments.size(); ++s)
            for (int end = 0; liner.segments[s].block != no_index && end < 2; ++end)
            {
                const Vec2 place = place_of_rock(liner.segments[s], end, state.blocks);
                memory.segment[s].place[end][0] = place.x();
                memory.segment[s].place[end][1] = place.y();
            }
        state.support.liners[i] = {.installed = 1, .since = state.cycle};
        any = true;
    }
    return any;
}

void press_liners(const Model& model, State& state, LinerSolvers& solvers, std::vector<BlockPush>& pushes)
{
    press_liners(model, state, solvers, 0.0, pushes);
}

void press_liners(const Model& model, State& state, LinerSolvers& solvers, double damping, std::vector<BlockPush>& pushes)
{
    std::vector<double> before;
    std::map<Index, Triple> before_on, now_on;
    for (std::size_t i = 0; i < model.support.liners.size(); ++i)
    {
        const Liner& liner = model.support.liners[i];
        LinerRecord& record = state.support.liners[i];
        if (record.installed == 0)
            continue;
        const LinerMemory memory = liner_memory(liner, state.support.history);
        const LinerLoad load = load_of(liner, record, memory, model, state);
        harden(liner, load.factor, memory);
        LinerSolver& solver = solvers.of(model, i);
        if (damping > 0.0)
        {
            before.assign(memory.velocity.begin(), memory.velocity.end());
            before_on = on_impulsive_blocks(liner, last_load(liner, record, memory, model, state), memory, state.blocks, solver);
        }
        solver.solve(load, memory);
        if (damping > 0.0)
        {
            slow_down(before, damping, memory);
            now_on = on_impulsive_blocks(liner, load, memory, state.blocks, solver);
        }
        Booking(liner, load, memory, state.blocks, record, pushes).run(solver);
        if (damping > 0.0)
            damp_blocks(before_on, now_on, damping * std::numbers::inv_pi, state.blocks, pushes);
    }
}

std::vector<Vec2> liner_nodes(const Model& model, const State& state, std::size_t i)
{
    const Liner& liner = model.support.liners[i];
    std::vector<double> history = state.support.history;
    const LinerMemory memory = liner_memory(liner, history);
    // What it counts from is where the rock was when it was installed, not where it was drawn.
    std::vector<Vec2> nodes = liner.nodes, begun(nodes.size(), Vec2(0.0, 0.0));
    std::vector<double> ties(nodes.size(), 0.0);
    for (std::size_t s = 0; s < liner.segments.size(); ++s)
        for (int end = 0; liner.segments[s].block != no_index && end < 2; ++end)
        {
            const Index node = liner.segments[s].node[end];
            begun[node] += Vec2(memory.segment[s].place[end][0], memory.segment[s].place[end][1]);
            ties[node] += 1.0;
        }
    for (std::size_t n = 0; n < nodes.size(); ++n)
        nodes[n] = (ties[n] > 0.0 ? Vec2(begun[n] / ties[n]) : nodes[n]) + Vec2(memory.moved[3 * n], memory.moved[3 * n + 1]);
    return nodes;
}

std::vector<LinerForce> liner_forces(const Model& model, const State& state, std::size_t i)
{
    const Liner& liner = model.support.liners[i];
    std::vector<double> history = state.support.history;
    const LinerMemory memory = liner_memory(liner, history);
    const LinerSolver solver(liner);
    const LinerLoad load{.factor = *memory.factor, .rock = {}, .gone = {}};
    std::vector<LinerForce> forces;
    for (std::size_t s = 0; s < liner.segments.size(); ++s)
    {
        const BeamAnswer beam = solver.beam(s, load, memory);
        // The inside of the liner lies on its left: a moment that turns the first end anticlockwise stretches it.
        forces.push_back({.thrust = -beam.thrust,
                          .shear = (beam.moment[0] + beam.moment[1]) / liner.segments[s].length,
                          .moment = {beam.moment[0], -beam.moment[1]}});
    }
    return forces;
}
}  // namespace hdem
