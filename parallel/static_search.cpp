#include "parallel/static_search.h"

#include "core/contact/block_forces.h"
#include "core/detection/edge_touch.h"
#include "core/state/contact_order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hdem
{
namespace
{
constexpr double parts_below = 1e-3;  // unbalanced ratio below which all open points lose their cohesion,
constexpr double holds_below = 5e-3;  // and blocks that have come away are held
constexpr int holds_after = 4;        // iterations without gain, when they may be what keeps the others out of balance
constexpr double many_parted = 1e-3;  // share of the points: where fewer part, the search is not farther from its end than before
constexpr double freezes_below = 0.05;
constexpr int freezes_after = 15;        // iterations without gain, and below that ratio, when the worst blocks are left out
constexpr int keeps_features_after = 5;  // searches for contacts
constexpr double least_far = 5e-3;       // of the middle size of a block
constexpr double moves = 0.2;            // of far: what a point has moved whose block is named when the search is given up
constexpr int shortens_after = 12;       // iterations without gain
constexpr int stuck_after = 10;          // iterations without gain after which what is accepted is taken
constexpr double short_far = 0.02;
constexpr double settled =
    1e-3;  // a search that begins farther out of balance is not carried to the end: new features will change the forces again
}  // namespace

StaticSearch::StaticSearch(const Model& model, State& state, int threads, const StaticRule& rule, std::vector<Triple> given)
    : model_(model),
      state_(state),
      threads_(threads),
      rule_(rule),
      given_(std::move(given)),
      moved_(3 * static_cast<std::size_t>(model.blocks())),
      step_(moved_.size()),
      is_held_(static_cast<std::size_t>(model.blocks()))
{
    spots_.is_whole = false;
    std::vector<double> sizes(static_cast<std::size_t>(model.blocks()));
    for (Index b = 0; b < model.blocks(); ++b)
        sizes[b] = model.size(b);
    if (sizes.empty())
        return;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    block_size_ = *middle;
}

std::vector<Index> StaticSearch::loose() const
{
    std::vector<Index> all = moving_;
    for (Index b = 0; b < model_.blocks(); ++b)
        if (is_held_[b] == come_away)
            all.push_back(b);
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

void StaticSearch::find_contacts()
{
    const Contacts before = searches_ >= keeps_features_after ? state_.contacts : Contacts();
    with_team(threads_, [&](const Team& team) { rebuild_.run(model_, state_, team); });
    keep_features(before);
    ++searches_;
    const auto contacts = static_cast<std::size_t>(state_.contacts.size());
    points_.resize(2 * contacts);
    tangents_.resize(contacts);
    loads_.resize(2 * contacts);
    list_block_contacts(state_.contacts, state_.blocks.size(), list_);
    // What impulses or new features have left in a spring is given back with time, so at rest there is none of it.
    for (ContactLanes& l : state_.contacts.lane)
        for (auto& overlap : l.rest_overlap)
            overlap = {};
    start_ = state_.blocks.motion;
    std::ranges::replace(is_held_, std::uint8_t{frozen}, std::uint8_t{not_held});
    begin();
}

/// Two parts that face each other with two pairs of edges about as well may change from one to the other at each search, and back: they stay as they are.
void StaticSearch::keep_features(const Contacts& before)
{
    Contacts& now = state_.contacts;
    const auto parts = [](const Contacts& contacts, Index i) { return std::pair(contacts.part_a[i], contacts.part_b[i]); };
    const std::vector<Index> order = order_by_parts(before);
    auto known = order.begin();
    for (const Index i : order_by_parts(now))
    {
        while (known != order.end() && parts(before, *known) < parts(now, i))
            ++known;
        if (known == order.end())
            break;
        const Index old = *known;
        if (parts(before, old) == parts(now, i) &&
            (before.ref_edge[old] != now.ref_edge[i] || before.inc_edge[old] != now.inc_edge[i]))
        {
            Contact kept = before.get(old);
            const EdgeView v = view_edges(kept.edges, state_.blocks.motion[kept.ref], state_.blocks.motion[kept.inc]);
            kept.seen = {static_cast<float>(v.t0), static_cast<float>(v.m0), static_cast<float>(v.t1), static_cast<float>(v.m1)};
            now.put(i, kept);
            now.stale[i] = 0;
        }
    }
}

void StaticSearch::number()
{
    number(whole_, number_unknowns(state_, is_held_));
    std::ranges::fill(step_, 0.0);  // what is not sought any more stays where it is
}

void StaticSearch::number(Part& part, Unknowns unknowns)
{
    part.unknowns = std::move(unknowns);
    const std::vector<Index>& block = part.unknowns.block;
    part.has_prescribed = std::ranges::any_of(block,
                                              [&](Index b)
                                              {
                                                  const BlockInertia& i = state_.blocks.inertia[b];
                                                  return i.inverse_mass_x == 0.0 || i.inverse_mass_y == 0.0 ||
                                                         i.inverse_inertia == 0.0;
                                              });
    const auto size = static_cast<Index>(block.size());
    std::vector<CoupledPair> pairs;
    if (part.is_whole)
        pairs = coupled_pairs(state_.contacts, part.unknowns);
    else
        for (const Index i : part.contacts)
            pairs.push_back({part.unknowns.of_block[state_.contacts.ref[i]], part.unknowns.of_block[state_.contacts.inc[i]]});
    part.tangent.set_pattern(size, pairs);
    part.symmetric = part.tangent;
    std::vector<Vec2> places(static_cast<std::size_t>(size));
    for (Index u = 0; u < size; ++u)
        places[u] = {start_[block[u]].x, start_[block[u]].y};
    with_team(threads_, [&](const Team& team) { part.factor.analyse(team, part.symmetric.graph(), places); });
    part.net.resize(3 * static_cast<std::size_t>(size));
    part.solution.resize(part.net.size());
}

void StaticSearch::begin()
{
    std::fill(moved_.begin(), moved_.end(), 0.0);
    whole_.unknowns = number_unknowns(state_, is_held_);
    for (const Index b : find_loose(state_, whole_.unknowns, is_held_, tangents_, moved_, std::numeric_limits<double>::infinity()))
        is_held_[b] = come_away;  // no chain of contacts leads to what stands still
    number();
    place_blocks({0, state_.blocks.size()}, start_, moved_, state_);
    for_contacts(whole_, [&](IndexRange range) { begin_points(range, model_, state_, points_); });
    far_ = 0.0;
}

StaticSearch::End StaticSearch::run()
{
    if (const End end = iterate({}); end != End::gave_up)
        return end;
    // Not from one pass: steps of half at least may have thrown blocks out of a place where they can stand.
    std::ranges::fill(is_held_, std::uint8_t{not_held});
    begun_again_ = true;
    begin();
    moving_.clear();
    return iterate({.least_share = 0.0});
}

bool StaticSearch::is_balanced(const StaticRule& goal) const
{
    return whole_.imbalance.ratio() < goal.ratio && whole_.imbalance.worst < goal.acceleration && tally_.newly_parted == 0 &&
           tally_.open == 0;
}

StaticSearch::End StaticSearch::iterate(const Pass& pass)
{
    if (too_many_held())
        return End::gave_up;
    double best = std::numeric_limits<double>::infinity();
    int since_best = 0;
    bool is_careful = false, is_known = false;  // known: the imbalance
    StaticRule goal = rule_;
    for (int i = 0;; ++i, ++since_best)
    {
        stop_if_asked(rule_);
        if (!is_known)
            find_imbalance(whole_, false, false);
        tally_ = renew(whole_, {.part_all_open = whole_.imbalance.ratio() < parts_below, .is_first = i == 0});
        if (tally_.newly_parted > 0)
            find_imbalance(whole_, false, false);
        if (rule_.tell)
            rule_.tell(whole_.imbalance.ratio());
        if (i == 0 && whole_.imbalance.ratio() > settled)
        {
            goal.ratio = std::max(goal.ratio, 0.1 * settled);
            goal.acceleration = std::numeric_limits<double>::infinity();
        }
        if (is_balanced(goal))
            return i == 0 ? End::in_balance_from_the_start : End::in_balance;
        if (whole_.imbalance.ratio() < 0.9 * best || tally_.newly_parted > many_parted * static_cast<double>(points_.size()))
        {
            best = whole_.imbalance.ratio();
            since_best = 0;
        }
        if (whole_.imbalance.ratio() < rule_.accepted && since_best > stuck_after && tally_.open == 0)
            return End::nearly_in_balance;
        if (since_best > freezes_after && whole_.imbalance.ratio() < freezes_below && freeze_worst())
        {
            best = whole_.imbalance.ratio();
            since_best = 0;
        }
        const bool looks_for_loose = i > 0 && (whole_.imbalance.ratio() < holds_below || since_best >= holds_after);
        const bool too_many = looks_for_loose && !hold_loose();
        if (!too_many && std::isfinite(whole_.imbalance.ratio()))
            relax_spots();
        if (too_many || since_best > rule_.stagnation || iterations_ >= rule_.most_iterations ||
            !std::isfinite(whole_.imbalance.ratio()) || !find_step(whole_))
        {
            moving_ = find_loose(state_, whole_.unknowns, is_held_, tangents_, moved_, moves * far_);
            return End::gave_up;
        }
        ++iterations_;
        if (far_ == 0.0)
            far_ = std::max(least_far * block_size_, 20.0 * greatest_way_of_step(whole_));
        // For the rest of the pass: after long steps it would soon be as far off as before.
        is_careful = is_careful || since_best >= shortens_after;
        shorten_step(whole_, pass.far_share, is_careful ? short_far : pass.far_share);
        is_known = take_step(whole_, is_careful ? 0.0 : pass.least_share);
    }
}

std::vector<Triple> StaticSearch::net_forces_at_start()
{
    find_imbalance(whole_, false, false);
    std::vector<Triple> net(static_cast<std::size_t>(model_.blocks()));
    for (std::size_t u = 0; u < whole_.unknowns.block.size(); ++u)
        net[whole_.unknowns.block[u]] = {whole_.net[3 * u], whole_.net[3 * u + 1], whole_.net[3 * u + 2]};
    return net;
}

void StaticSearch::commit()
{
    friction_ += tally_.friction;
    for_contacts(whole_, [&](IndexRange range) { commit_points(range, model_, points_, state_); });
}
}  // namespace hdem
