#include "core/support/grouted_bolt.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr int most_steps = 60;
constexpr double plate_share = 1e6;  // of the stiffness of the first segment: a plate gives way by nothing that counts
constexpr double soft = 1e-8;        // of an elastic stiffness, where the tangent is zero

/// Force of an elastic, perfectly plastic spring, its tangent and its energy up to a stretch.
struct Spring
{
    double stiffness = 0.0;
    double limit = Bolt::none;

    [[nodiscard]] double force(double stretch) const { return std::clamp(stiffness * stretch, -limit, limit); }
    [[nodiscard]] bool is_at_limit(double stretch) const { return std::abs(stiffness * stretch) > limit; }
    [[nodiscard]] double tangent(double stretch) const { return is_at_limit(stretch) ? soft * stiffness : stiffness; }
    [[nodiscard]] double energy(double stretch) const
    {
        return is_at_limit(stretch) ? limit * (std::abs(stretch) - 0.5 * limit / stiffness) : 0.5 * stiffness * stretch * stretch;
    }
    /// How far it flows beyond its limit.
    [[nodiscard]] double flow(double stretch) const { return is_at_limit(stretch) ? stretch - force(stretch) / stiffness : 0.0; }
};

/// The system of one bolt at given places of the rock.
class Bar
{
  public:
    Bar(const Bolt& bolt, std::span<const double> moved, std::span<const std::uint8_t> gone, const SegmentMemory* memory)
        : bolt_(bolt),
          moved_(moved),
          gone_(gone),
          memory_(memory)
    {
    }

    [[nodiscard]] bool is_gone(std::size_t e) const { return gone_[bolt_.segments[e].part] != 0; }
    [[nodiscard]] Spring bar(std::size_t e) const
    {
        const bool acts = !is_gone(e) && memory_[e].cut == 0.0;
        return {acts ? bolt_.section_stiffness / bolt_.segments[e].length : 0.0, bolt_.yield};
    }
    [[nodiscard]] Spring bond(std::size_t e) const
    {
        const double half = 0.5 * bolt_.segments[e].length;
        return {is_gone(e) || !bolt_.segments[e].is_bonded ? 0.0 : bolt_.bond_stiffness * half, bolt_.bond_strength * half};
    }
    [[nodiscard]] double plate_stiffness() const
    {
        return bolt_.plate && gone_[0] == 0 ? plate_share * bolt_.section_stiffness / bolt_.segments[0].length : 0.0;
    }
    [[nodiscard]] double stretch(std::size_t e, std::span<const double> u) const { return u[e + 1] - u[e] - memory_[e].plastic; }
    [[nodiscard]] double bond_stretch(std::size_t e, int end, std::span<const double> u) const
    {
        return moved_[bolt_.segments[e].part] - u[e + end] - memory_[e].slip[end];
    }

    [[nodiscard]] double energy(std::span<const double> u) const
    {
        const double pressed = std::max(u[0] - moved_[0], 0.0);
        double sum = 0.5 * plate_stiffness() * (pressed * pressed);
        for (std::size_t e = 0; e < bolt_.segments.size(); ++e)
        {
            sum += bar(e).energy(stretch(e, u));
            for (int end = 0; end < 2; ++end)
                sum += bond(e).energy(bond_stretch(e, end, u));
        }
        return sum;
    }

    /// Net forces on the nodes, and the matrix of their tangents: its diagonal and what stands right of it. @return  the greatest net force
    double assemble(std::span<const double> u, std::vector<double>& net, std::vector<double>& diagonal,
                    std::vector<double>& right) const
    {
        std::ranges::fill(net, 0.0);
        std::ranges::fill(diagonal, 0.0);
        const double pressed = u[0] - moved_[0];
        if (pressed > 0.0)
        {
            net[0] -= plate_stiffness() * pressed;
            diagonal[0] += plate_stiffness();
        }
        for (std::size_t e = 0; e < bolt_.segments.size(); ++e)
        {
            const double long_by = stretch(e, u);
            const Spring steel = bar(e), grout = bond(e);
            const double force = steel.force(long_by);
            const double tangent = std::max(steel.tangent(long_by),
                                            soft * soft * bolt_.section_stiffness / bolt_.segments[e].length);
            net[e] += force;
            net[e + 1] -= force;
            right[e] = -tangent;
            for (int end = 0; end < 2; ++end)
            {
                const double by = bond_stretch(e, end, u);
                net[e + end] += grout.force(by);
                diagonal[e + end] += tangent + std::max(grout.tangent(by), soft * tangent);
            }
        }
        double greatest = 0.0;
        for (const double n : net)
            greatest = std::max(greatest, std::abs(n));
        return greatest;
    }

  private:
    const Bolt& bolt_;
    std::span<const double> moved_;
    std::span<const std::uint8_t> gone_;
    const SegmentMemory* memory_;
};

/// Solve the symmetric tridiagonal system in place; `x` holds its right side and receives its solution.
void solve_tridiagonal(std::vector<double>& diagonal, const std::vector<double>& right, std::vector<double>& x)
{
    for (std::size_t k = 1; k < diagonal.size(); ++k)
    {
        const double share = right[k - 1] / diagonal[k - 1];
        diagonal[k] -= share * right[k - 1];
        x[k] -= share * x[k - 1];
    }
    for (std::size_t k = diagonal.size(); k-- > 0;)
        x[k] = (x[k] - (k + 1 < diagonal.size() ? right[k] * x[k + 1] : 0.0)) / diagonal[k];
}

struct Scratch
{
    std::vector<double> step, way, diagonal, right, tried;
};

/// Newton's method. A full step counts where it makes the greatest net force less; else the halves of it do, until the energy is no more than before.
void balance(const Bar& bar, std::span<double> u, double accuracy)
{
    thread_local Scratch s;
    for (std::vector<double>* each : {&s.step, &s.way, &s.diagonal, &s.right, &s.tried})
        each->resize(u.size());
    double net = bar.assemble(u, s.step, s.diagonal, s.right);
    for (int i = 0; i < most_steps && net > accuracy; ++i)
    {
        solve_tridiagonal(s.diagonal, s.right, s.step);
        std::swap(s.step, s.way);
        const auto go = [&](double share)
        {
            for (std::size_t k = 0; k < u.size(); ++k)
                s.tried[k] = u[k] + share * s.way[k];
        };
        go(1.0);
        double next = bar.assemble(s.tried, s.step, s.diagonal, s.right);
        if (!(next < net))
        {
            const double before = bar.energy(u), allowed = before + 1e-12 * std::abs(before);  // round-off is no worsening
            double share = 1.0;
            for (int half = 0; half < 40 && bar.energy(s.tried) > allowed; ++half)
                go(share *= 0.5);
            next = bar.assemble(s.tried, s.step, s.diagonal, s.right);
        }
        std::ranges::copy(s.tried, u.begin());
        net = next;
    }
}

/// What the bar and the bond on the weaker side of each link bear, less what is in use.
void find_reserve(const Bar& bar, const Bolt& bolt, std::span<const double> tension, std::span<double> reserve)
{
    const std::size_t segments = bolt.segments.size();
    const auto pass = [&](std::size_t e, double grip)
    {
        const bool holds = bar.bar(e).stiffness > 0.0;
        return holds ? grip + 2.0 * (bar.bond(e).stiffness > 0.0 ? bar.bond(e).limit : 0.0) : 0.0;
    };
    const auto is_link = [&](std::size_t e) { return bolt.segments[e + 1].part != bolt.segments[e].part; };
    double grip = bar.plate_stiffness() > 0.0 ? Bolt::none : 0.0;
    for (std::size_t e = 0; e + 1 < segments; ++e)
    {
        grip = pass(e, grip);
        if (is_link(e))
            reserve[bolt.segments[e].part] = std::min(bolt.yield, grip);
    }
    grip = 0.0;
    for (std::size_t e = segments - 1; e > 0; --e)
    {
        grip = pass(e, grip);
        double& left = reserve[bolt.segments[e - 1].part];
        if (is_link(e - 1))
            left = std::max(std::min(left, grip) - std::abs(tension[bolt.segments[e - 1].part]), 0.0);
    }
}
}  // namespace

Index grouted_history_size(const Bolt& bolt)
{
    constexpr std::size_t numbers = sizeof(SegmentMemory) / sizeof(double);
    return static_cast<Index>(bolt.links.size() + bolt.segments.size() + 1 + numbers * bolt.segments.size());
}

GroutedMemory grouted_memory(const Bolt& bolt, std::vector<double>& history)
{
    double* at = history.data() + bolt.history;
    const std::size_t links = bolt.links.size(), nodes = bolt.segments.size() + 1;
    return {{at, links}, {at + links, nodes}, reinterpret_cast<SegmentMemory*>(at + links + nodes)};
}

void pull_grouted(const Bolt& bolt, std::span<const double> moved, std::span<const std::uint8_t> gone, const GroutedMemory& memory,
                  std::span<double> tension, std::span<double> reserve, BoltRecord& record)
{
    const Bar bar(bolt, moved, gone, memory.segment);
    const double round_off = 1e-15 * bolt.section_stiffness;
    balance(bar, memory.node, std::max(round_off, 1e-9 * record.force));
    record.stored = record.force = 0.0;
    for (std::size_t e = 0; e < bolt.segments.size(); ++e)
    {
        SegmentMemory& own = memory.segment[e];
        const Spring steel = bar.bar(e), grout = bar.bond(e);
        const double by = bar.stretch(e, memory.node), force = steel.force(by);
        double end_bond = 0.0;
        for (int end = 0; end < 2; ++end)
        {
            const double bond_by = bar.bond_stretch(e, end, memory.node), flow = grout.flow(bond_by);
            end_bond = grout.force(bond_by);
            own.slip[end] += flow;
            record.spent += grout.limit * std::abs(flow);
            record.stored += grout.stiffness > 0.0 ? 0.5 * end_bond * end_bond / grout.stiffness : 0.0;
            if (flow != 0.0 && record.status == BoltStatus::elastic)
                record.status = BoltStatus::slips;
        }
        if (e + 1 < bolt.segments.size() && bolt.segments[e + 1].part != bolt.segments[e].part)
            tension[bolt.segments[e].part] = force - end_bond;
        record.force = std::max(record.force, force);
        if (steel.stiffness == 0.0)
            continue;
        const double flow = steel.flow(by), held = 0.5 * force * force / steel.stiffness;
        own.plastic += flow;
        record.spent += steel.limit < Bolt::none ? steel.limit * std::abs(flow) : 0.0;
        if (flow != 0.0 && record.status != BoltStatus::ruptured)
            record.status = BoltStatus::yielded;
        if (memory.node[e + 1] - memory.node[e] > bolt.rupture * std::max(bolt.segments[e].length, bolt.length))
        {
            own.cut = 1.0;
            record.status = BoltStatus::ruptured;
            record.spent += held;
        }
        else
            record.stored += held;
    }
    for (const double t : tension)
        record.force = std::max(record.force, t);
    find_reserve(bar, bolt, tension, reserve);
}

std::vector<double> link_stiffness(const Bolt& bolt)
{
    Bolt elastic = bolt;
    elastic.yield = elastic.bond_strength = Bolt::none;
    const std::vector<SegmentMemory> fresh(bolt.segments.size());
    const std::vector<std::uint8_t> gone(bolt.links.size() + 1, 0);
    std::vector<double> sums(bolt.links.size(), 0.0), moved(gone.size(), 0.0), nodes(bolt.segments.size() + 1);
    for (std::size_t opened = 0; opened < bolt.links.size(); ++opened)
    {
        for (std::size_t part = 0; part < moved.size(); ++part)
            moved[part] = part > opened ? 1.0 : 0.0;
        std::ranges::fill(nodes, 0.0);
        const Bar bar(elastic, moved, gone, fresh.data());
        balance(bar, nodes, 1e-12 * bolt.section_stiffness);
        for (std::size_t e = 0; e + 1 < bolt.segments.size(); ++e)
            if (bolt.segments[e + 1].part != bolt.segments[e].part)
                sums[bolt.segments[e].part] += std::abs(bar.bar(e).force(bar.stretch(e, nodes)) -
                                                        bar.bond(e).force(bar.bond_stretch(e, 1, nodes)));
    }
    return sums;
}
}  // namespace hdem
