#include "core/support/liner_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hdem
{
namespace
{
constexpr int most_steps = 50, most_halves = 30;
constexpr double accuracy = 1e-10;   // of the greatest force in the liner
constexpr double round_off = 1e-12;  // of the energies in it; displacements: 1e-3 of that

}  // namespace

LinerSolver::LinerSolver(Liner made_of) : liner_(std::move(made_of))
{
    const Liner& liner = liner_;
    const std::size_t n = 3 * liner.nodes.size();
    mass_.assign(n, 0.0);
    aim_.assign(n, 0.0);
    from_.assign(n, 0.0);
    net_.resize(static_cast<Eigen::Index>(n));
    for (const LinerSegment& s : liner.segments)
        for (const Index node : s.node)
        {
            const double half = 0.5 * liner.mass * s.length;
            mass_[3 * node] += half;
            mass_[3 * node + 1] += half;
            mass_[3 * node + 2] += half * s.length * s.length / 12.0;
        }
    flows_.assign(liner.segments.size(), 0);
}

BeamAnswer LinerSolver::beam(std::size_t s, const LinerLoad& load, const LinerMemory& memory) const
{
    const Liner& liner = liner_;
    const LinerSegment& segment = liner.segments[s];
    const LinerSegmentMemory& own = memory.segment[s];
    const BeamShape shape(segment);
    const double* first = &memory.moved[3 * segment.node[0]];
    const double* second = &memory.moved[3 * segment.node[1]];
    const BeamLaw law = {.axial = load.factor * liner.axial_stiffness / segment.length,
                         .bending = load.factor * liner.bending_stiffness / segment.length,
                         .compressive_strength = load.factor * liner.compressive_strength,
                         .tensile_strength = load.factor * liner.tensile_strength,
                         .moment_strength = load.factor * liner.moment_strength};
    return answer_of_beam(law, shape.of(0, first, second) - own.plastic,
                          {shape.of(1, first, second) - own.turned[0], shape.of(2, first, second) - own.turned[1]});
}

TieAnswer LinerSolver::tie(std::size_t s, int end, const LinerLoad& load, const LinerMemory& memory) const
{
    const LinerSegment& segment = liner_.segments[s];
    const LinerSegmentMemory& own = memory.segment[s];
    const double* node = &memory.moved[3 * segment.node[end]];
    const Vec2 apart = Vec2(node[0], node[1]) - load.rock[2 * s + end];
    return answer_of_tie(liner_, 0.5 * segment.length, apart.dot(segment.to_rock()), apart.dot(segment.along) - own.slip[end],
                         own.parted[end] != 0.0, own.pressed[end]);
}

void LinerSolver::add(Index row, Index column, double value)
{
    if (row >= column)
        entries_.emplace_back(row, column, value);
}

void LinerSolver::add_beam(std::size_t s, const BeamAnswer& answer)
{
    const LinerSegment& segment = liner_.segments[s];
    const BeamShape shape(segment);
    const auto place = [&](int d) { return 3 * segment.node[d / 3] + d % 3; };
    const double force[3] = {answer.thrust, answer.moment[0], answer.moment[1]};
    for (int d = 0; d < 6; ++d)
        for (int r = 0; r < 3; ++r)
            net_[place(d)] -= shape.row[r][d] * force[r];
    if (!needs_matrix_)
        return;
    const double tangent[3][3] = {
        {answer.axial, 0.0, 0.0}, {0.0, answer.bending[0], answer.bending[1]}, {0.0, answer.bending[1], answer.bending[2]}};
    for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b)
        {
            double sum = 0.0;
            for (int r = 0; r < 3; ++r)
                for (int q = 0; q < 3; ++q)
                    sum += shape.row[r][a] * tangent[r][q] * shape.row[q][b];
            add(place(a), place(b), sum);
        }
}

void LinerSolver::add_tie(std::size_t s, int end, const TieAnswer& answer)
{
    const LinerSegment& segment = liner_.segments[s];
    const Vec2 n = segment.to_rock(), t = segment.along;
    const Index at = 3 * segment.node[end];
    net_[at] -= answer.normal * n.x() + answer.shear * t.x();
    net_[at + 1] -= answer.normal * n.y() + answer.shear * t.y();
    if (!needs_matrix_)
        return;
    const double a = answer.normal_tangent, b = answer.shear_tangent;
    add(at, at, a * n.x() * n.x() + b * t.x() * t.x());
    add(at + 1, at, a * n.x() * n.y() + b * t.x() * t.y());
    add(at + 1, at + 1, a * n.y() * n.y() + b * t.y() * t.y());
}

/// Net forces, energy and what flows; the entries of the matrix where it is needed.
void LinerSolver::assemble(const LinerLoad& load, const LinerMemory& memory)
{
    const Liner& liner = liner_;
    const double inertia = 1.0 / (load.step * load.step);
    net_.setZero();
    entries_.clear();
    energy_ = size_ = scale_ = 0.0;
    const auto book = [&](double energy)
    {
        energy_ += energy;
        size_ += std::abs(energy);
    };
    for (std::size_t i = 0; i < mass_.size(); ++i)
    {
        const double away = memory.moved[i] - aim_[i], weight = i % 3 < 2 ? mass_[i] * load.gravity[static_cast<int>(i % 3)] : 0.0;
        net_[static_cast<Eigen::Index>(i)] = weight - mass_[i] * inertia * away;
        book(0.5 * mass_[i] * inertia * away * away);
        book(-weight * memory.moved[i]);
        if (needs_matrix_)
            add(static_cast<Index>(i), static_cast<Index>(i), mass_[i] * inertia);
    }
    for (std::size_t s = 0; s < liner.segments.size(); ++s)
    {
        const LinerSegment& segment = liner.segments[s];
        const BeamAnswer answer = beam(s, load, memory);
        add_beam(s, answer);
        book(answer.stored + answer.spent);
        scale_ = std::max({scale_, std::abs(answer.thrust), std::abs(answer.moment[0]) / segment.length,
                           std::abs(answer.moment[1]) / segment.length});
        unsigned flows = answer.flows;
        for (int end = 0; end < 2; ++end)
        {
            const Index at = 3 * segment.node[end];
            const Vec2 push = -0.5 * segment.length * load.pressure * segment.to_rock();
            net_[at] += push.x();
            net_[at + 1] += push.y();
            book(-push.x() * memory.moved[at] - push.y() * memory.moved[at + 1]);
            TieAnswer held;
            if (load.gone[s] == 0)
                held = tie(s, end, load, memory);
            add_tie(s, end, held);
            book(held.energy);
            scale_ = std::max({scale_, std::abs(held.normal), std::abs(held.shear), push.norm()});
            flows |= (load.gone[s] != 0 ? 3U : held.state) << (3 + 2 * end);
        }
        flows_[s] = static_cast<std::uint8_t>(flows);
    }
}

void LinerSolver::factorise(const LinerLoad& load)
{
    Eigen::SparseMatrix<double> matrix(net_.size(), net_.size());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    if (!has_pattern_)
        factors_.analyzePattern(matrix);
    has_pattern_ = true;
    factors_.factorize(matrix);
    factored_flows_ = flows_;
    factored_step_ = load.step;
    factored_factor_ = load.factor;
}

LinerBalance LinerSolver::balance(const LinerLoad& load, const LinerMemory& memory)
{
    LinerLoad still = load;
    still.step = std::numeric_limits<double>::infinity();
    needs_matrix_ = false;
    assemble(still, memory);
    const double g = load.gravity.norm() > 0.0 ? load.gravity.norm() : 9.81;
    double borne = 0.0, greatest = 0.0, applied = 0.0;
    Vec2 whole(0.0, 0.0);
    LinerBalance found;
    for (std::size_t n = 0; n < liner_.nodes.size(); ++n)
    {
        const auto at = static_cast<Eigen::Index>(3 * n);
        greatest = std::max(greatest, Vec2(net_[at], net_[at + 1]).norm());
        whole += Vec2(net_[at], net_[at + 1]);
        applied += load.gravity.norm() * mass_[3 * n];
        borne += g * mass_[3 * n];
    }
    for (std::size_t s = 0; s < liner_.segments.size(); ++s)
    {
        borne += liner_.segments[s].length * std::abs(load.pressure);
        applied += liner_.segments[s].length * std::abs(load.pressure);
        for (int end = 0; load.gone[s] == 0 && end < 2; ++end)
        {
            const TieAnswer held = tie(s, end, load, memory);
            borne += Vec2(held.normal, held.shear).norm();
        }
        const BeamAnswer beam = this->beam(s, load, memory);
        const double moment = std::max(std::abs(beam.moment[0]), std::abs(beam.moment[1]));
        constexpr double nearly = 1.0 - 1e-3;  // displacements of a lining that collapses are great, and their round-off with them
        found.is_at_strength = found.is_at_strength || -beam.thrust >= nearly * load.factor * liner_.compressive_strength ||
                               beam.thrust >= nearly * load.factor * liner_.tensile_strength ||
                               moment >= nearly * load.factor * liner_.moment_strength;
    }
    found.whole = applied > 0.0 ? whole.norm() / applied : 0.0;
    found.unbalanced = greatest * static_cast<double>(liner_.nodes.size()) / borne;
    return found;
}

void LinerSolver::solve(const LinerLoad& load, const LinerMemory& memory)
{
    const std::size_t n = mass_.size();
    const std::vector<double> before(memory.moved.begin(), memory.moved.end());
    for (std::size_t i = 0; i < n; ++i)
    {
        aim_[i] = memory.moved[i] + load.step * memory.velocity[i];
        memory.moved[i] = aim_[i];
    }
    needs_matrix_ = false;
    assemble(load, memory);
    for (int i = 0; i < most_steps && net_.lpNorm<Eigen::Infinity>() > accuracy * scale_; ++i)
    {
        if (flows_ != factored_flows_ || load.step != factored_step_ || load.factor != factored_factor_)
        {
            needs_matrix_ = true;
            assemble(load, memory);
            factorise(load);
            needs_matrix_ = false;
        }
        step_ = factors_.solve(net_);
        std::ranges::copy(memory.moved, from_.begin());
        const double allowed = energy_ + round_off * size_;
        double share = 1.0;
        for (int half = 0; half < most_halves; ++half, share *= 0.5)
        {
            for (std::size_t k = 0; k < n; ++k)
                memory.moved[k] = from_[k] + share * step_[static_cast<Eigen::Index>(k)];
            assemble(load, memory);
            if (energy_ <= allowed)
                break;
        }
        const double farthest = std::ranges::max(from_, {}, [](double u) { return std::abs(u); });
        if (step_.lpNorm<Eigen::Infinity>() <= 1e-3 * round_off * std::abs(farthest))
            break;
    }
    for (std::size_t i = 0; i < n; ++i)
        memory.velocity[i] = (memory.moved[i] - before[i]) / load.step;
}
}  // namespace hdem
