#include "core/statics/static_blocks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hdem
{
namespace
{
std::array<bool, 3> prescribed(const BlockInertia& inertia)
{
    return {inertia.inverse_mass_x == 0.0, inertia.inverse_mass_y == 0.0, inertia.inverse_inertia == 0.0};
}

/// Sets of blocks that are joined; the least block of a set stands for it.
class JoinedSets
{
  public:
    explicit JoinedSets(Index size) : of_(static_cast<std::size_t>(size)) { std::iota(of_.begin(), of_.end(), 0); }

    [[nodiscard]] Index find(Index i)
    {
        while (of_[i] != i)
            i = of_[i] = of_[of_[i]];
        return i;
    }
    void join(Index a, Index b)
    {
        a = find(a);
        b = find(b);
        of_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<Index> of_;
};
}  // namespace

Unknowns number_unknowns(const State& state, const std::vector<std::uint8_t>& is_held)
{
    Unknowns numbers;
    numbers.of_block.assign(static_cast<std::size_t>(state.blocks.size()), no_index);
    for (Index b = 0; b < state.blocks.size(); ++b)
        if (state.blocks.is_free(b) && is_held[b] == not_held)
        {
            numbers.of_block[b] = static_cast<Index>(numbers.block.size());
            numbers.block.push_back(b);
        }
    return numbers;
}

std::vector<CoupledPair> coupled_pairs(const Contacts& contacts, const Unknowns& unknowns)
{
    std::vector<CoupledPair> pairs(static_cast<std::size_t>(contacts.size()));
    for (Index i = 0; i < contacts.size(); ++i)
        pairs[i] = {unknowns.of_block[contacts.ref[i]], unknowns.of_block[contacts.inc[i]]};
    return pairs;
}

void leave_out_prescribed(const BlockInertia& ref, const BlockInertia& inc, int side, Matrix36& rows)
{
    for (int of = 0; of < 2; ++of)
    {
        const std::array<bool, 3> fixed = prescribed(of == 0 ? ref : inc);
        for (int i = 0; i < 3; ++i)
        {
            if (fixed[i])
                rows.col(3 * of + i).setZero();
            if (fixed[i] && of == side)
                rows.row(i).setZero();
        }
    }
}

void finish_diagonal(const BlockInertia& inertia, double shift, Matrix3& diagonal)
{
    const std::array<bool, 3> fixed = prescribed(inertia);
    for (int i = 0; i < 3; ++i)
        diagonal(i, i) = fixed[i] ? 1.0 : diagonal(i, i) * (1.0 + shift);
}

Imbalance& Imbalance::operator+=(const Imbalance& other)
{
    sum += other.sum;
    applied += other.applied;
    worst = !(other.worst <= worst) ? other.worst : worst;
    work += other.work;
    return *this;
}

double unbalanced(const Model& model, Index block, const double* net)
{
    return (std::sqrt(net[0] * net[0] + net[1] * net[1]) + std::abs(net[2]) / model.radius[block]) / model.mass[block];
}

Imbalance net_forces(IndexRange unknowns, const Model& model, const State& state, const Unknowns& numbers,
                     const BlockContacts& list, std::span<const BlockLoad> loads, const std::vector<Triple>& given,
                     const std::vector<double>& step, std::vector<double>& net)
{
    Imbalance sums;
    for (Index u = unknowns.begin; u < unknowns.end; ++u)
    {
        const Index b = numbers.block[u];
        const Vec2 weight = model.mass[b] * model.gravity;
        std::array<double, 3> force = {weight.x(), weight.y(), 0.0};
        if (!given.empty())
            force = {force[0] + given[b].x, force[1] + given[b].y, given[b].w};
        for (Index e = list.begin[b]; e < list.begin[b + 1]; ++e)
        {
            const BlockLoad& load = loads[list.entry[e]];
            force[0] += load.x;
            force[1] += load.y;
            force[2] += load.moment;
        }
        const std::array<bool, 3> fixed = prescribed(state.blocks.inertia[b]);
        for (int i = 0; i < 3; ++i)
        {
            net[3 * u + i] = fixed[i] ? 0.0 : force[i];
            if (!step.empty())
                sums.work += net[3 * u + i] * step[3 * b + i];
        }
        const double out = unbalanced(model, b, &net[3 * u]);
        sums.sum += model.mass[b] * out;
        sums.applied += weight.norm();
        sums.worst = std::max(sums.worst, out);
    }
    return sums;
}

void place_blocks(IndexRange blocks, const std::vector<BlockMotion>& start, const std::vector<double>& moved, State& state)
{
    for (Index b = blocks.begin; b < blocks.end; ++b)
    {
        const BlockMotion& from = start[b];
        BlockMotion& to = state.blocks.motion[b];
        const double turn = moved[3 * b + 2];
        to.x = from.x + moved[3 * b];
        to.y = from.y + moved[3 * b + 1];
        to.angle = from.angle + turn;
        const double q = 0.5 * turn;  // as a cycle turns a block, see motion/integrator
        const double scale = 1.0 / (1.0 + q * q);
        const double c = (1.0 - q * q) * scale, s = 2.0 * q * scale;
        to.c = from.c * c - from.s * s;
        to.s = from.s * c + from.c * s;
    }
}

std::vector<Index> find_loose(const State& state, const Unknowns& numbers, const std::vector<std::uint8_t>& is_held,
                              const std::vector<ContactTangent>& tangents, const std::vector<double>& moved, double far)
{
    const Contacts& contacts = state.contacts;
    const Index blocks = state.blocks.size();
    JoinedSets sets(blocks + 1);  // the last stands for what does not move
    for (Index b = 0; b < blocks; ++b)
        if (numbers.of_block[b] == no_index && is_held[b] != come_away)
            sets.join(b, blocks);
    for (Index i = 0; i < contacts.size(); ++i)
        for (int k = 0; k < 2; ++k)
            if (is_held[contacts.ref[i]] != come_away && is_held[contacts.inc[i]] != come_away &&
                tangents[i].way(k, &moved[3 * contacts.ref[i]], &moved[3 * contacts.inc[i]]) < far)
                sets.join(contacts.ref[i], contacts.inc[i]);
    std::vector<Index> loose;
    for (const Index b : numbers.block)
        if (sets.find(b) != sets.find(blocks))
            loose.push_back(b);
    return loose;
}
}  // namespace hdem
