/// Spots of a static search: blocks far more out of balance than the others. They are brought near to balance by themselves, while all others stay where they are.
///
/// A step of the whole model is held up, or spoilt, by a few corners that change between open and closed, and a large model has always some of them. Steps of
/// the blocks around them cost a small part of one of the whole model, and leave it what it is for: to carry loads through the rock.
///
/// [Lanzkron1996] P. J. Lanzkron, D. J. Rose, J. T. Wilkes, An analysis of approximate nonlinear elimination, SIAM J. Sci. Comput. 17 (1996) 538-559.

#include "parallel/static_search.h"

#include <algorithm>

namespace hdem
{
namespace
{
constexpr double outstanding = 10.0;  // times the mean imbalance: a block of a spot
constexpr double least_share = 0.2;   // of all that is out of balance in spots; else steps of the whole model serve better
constexpr double most_blocks = 0.25;  // of the model in spots and rings; likewise
constexpr int rings = 3;              // of blocks around a spot
constexpr int most_steps = 8;
constexpr double enough = 0.1;  // of what was out of balance in spots and rings
}  // namespace

/// Ascending; empty where nothing is to be gained.
std::vector<Index> StaticSearch::blocks_around_spots() const
{
    const double bound = outstanding * whole_.imbalance.ratio() * model_.gravity.norm();
    const std::vector<Index>& block = whole_.unknowns.block;
    std::vector<Index> near;
    double sum = 0.0;
    for (std::size_t u = 0; u < block.size(); ++u)
        if (const double out = unbalanced(model_, block[u], &whole_.net[3 * u]); out > bound)
        {
            near.push_back(block[u]);
            sum += model_.mass[block[u]] * out;
        }
    if (near.empty() || sum < least_share * whole_.imbalance.sum)
        return {};
    add_rings(near);
    if (static_cast<double>(near.size()) > most_blocks * static_cast<double>(block.size()))
        return {};
    std::ranges::sort(near);
    return near;
}

void StaticSearch::add_rings(std::vector<Index>& near) const
{
    std::vector<std::uint8_t> is_near(static_cast<std::size_t>(model_.blocks()));
    for (const Index b : near)
        is_near[b] = 1;
    std::size_t next = 0;
    for (int ring = 0; ring < rings; ++ring)
        for (const std::size_t end = near.size(); next < end; ++next)
            for (Index e = list_.begin[near[next]]; e < list_.begin[near[next] + 1]; ++e)
                for (const Index i = list_.entry[e] / 2; const Index b : {state_.contacts.ref[i], state_.contacts.inc[i]})
                    if (is_near[b] == 0 && whole_.unknowns.of_block[b] != no_index)
                    {
                        is_near[b] = 1;
                        near.push_back(b);
                    }
}

void StaticSearch::number_spots(std::vector<Index> blocks)
{
    Unknowns unknowns;
    unknowns.of_block.assign(static_cast<std::size_t>(model_.blocks()), no_index);
    spots_.contacts.clear();
    for (std::size_t u = 0; u < blocks.size(); ++u)
    {
        unknowns.of_block[blocks[u]] = static_cast<Index>(u);
        for (Index e = list_.begin[blocks[u]]; e < list_.begin[blocks[u] + 1]; ++e)
            spots_.contacts.push_back(list_.entry[e] / 2);
    }
    std::ranges::sort(spots_.contacts);
    spots_.contacts.erase(std::unique(spots_.contacts.begin(), spots_.contacts.end()), spots_.contacts.end());
    unknowns.block = std::move(blocks);
    number(spots_, std::move(unknowns));
}

/// The imbalance of the whole model is that of the present places afterwards, as it was before.
void StaticSearch::relax_spots()
{
    if (far_ == 0.0)  // before the first step of the whole model
        return;
    std::vector<Index> blocks = blocks_around_spots();
    if (blocks.empty())
        return;
    number_spots(std::move(blocks));
    std::vector<StaticPoint> points;
    std::vector<ContactTangent> tangents;
    for (const Index i : spots_.contacts)
    {
        points.insert(points.end(), {points_[2 * i], points_[2 * i + 1]});
        tangents.push_back(tangents_[i]);
    }
    const std::vector<double> moved = moved_;
    std::ranges::fill(step_, 0.0);
    find_imbalance(spots_, false, false);
    const double before = spots_.imbalance.sum;
    step_spots(enough * before);
    std::ranges::fill(step_, 0.0);
    if (!(spots_.imbalance.sum < before))
    {
        moved_ = moved;
        place_blocks({0, state_.blocks.size()}, start_, moved_, state_);
        for (std::size_t k = 0; k < spots_.contacts.size(); ++k)
        {
            const Index i = spots_.contacts[k];
            points_[2 * i] = points[2 * k];
            points_[2 * i + 1] = points[2 * k + 1];
            tangents_[i] = tangents[k];
        }
    }
    find_loads(spots_, false);  // those of all other contacts are as before
    sum_up(whole_, false);
}

void StaticSearch::step_spots(double goal)
{
    for (int step = 0; step < most_steps && find_step(spots_); ++step)
    {
        shorten_step(spots_, Pass().far_share, Pass().far_share);
        if (!take_step(spots_, 0.0))
            find_imbalance(spots_, false, false);
        const PointTally tally = renew(spots_, {});
        if (tally.newly_parted > 0)
            find_imbalance(spots_, false, false);
        if (tally.newly_parted == 0 && !(spots_.imbalance.sum > goal))
            return;
    }
}
}  // namespace hdem
