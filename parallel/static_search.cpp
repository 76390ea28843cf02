#include "parallel/static_search.h"

#include "core/contact/block_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
constexpr Index piece = 1024;  // contacts or blocks whose sums are formed together, on any number of threads

constexpr double parts_below = 1e-3;  // unbalanced ratio below which all open points lose their cohesion,
constexpr double holds_below = 5e-3;  // and blocks that have come away are held
constexpr int holds_after = 4;        // iterations without gain, when they may be what keeps the others out of balance
constexpr int freezes_after = 15;     // iterations without gain, and below that ratio,
constexpr double
    frozen_share = 0.2;  // blocks farther out of balance than this share of the worst, which swing to and fro, are left out,
constexpr double most_frozen = 2e-3;  // if they are no more of all blocks
constexpr double least_far = 5e-3;    // [m]
constexpr double away = 1e-2;         // [m]
constexpr double moves = 0.2;         // of far: what a point has moved whose block is named when the search is given up
constexpr double longest_way = 0.3;   // of far, of a point in one step
constexpr int most_restraints = 3;    // of points that go farther, until the step is taken as it is
constexpr int shortens_after = 12;    // iterations without gain
constexpr int stuck_after = 10;       // iterations without gain after which what is accepted is taken
constexpr double short_far = 0.02;
constexpr double settled =
    1e-3;  // a search that begins farther out of balance is not carried to the end: new features will change the forces again
constexpr double enough_gain = 0.5;   // of the unbalanced ratio, by a whole step that needs no closer look
constexpr double first_shift = 1e-8;  // of the diagonal
constexpr int line_search_steps = 4;

Index pieces(Index size)
{
    return (size + piece - 1) / piece;
}

/// work(range) for the pieces of [0, size) on all threads, returning a sum that does not depend on their number.
template <typename Sum, typename Work>
Sum sum_pieces(int threads, Index size, const Work& work)
{
    std::vector<Sum> sums(static_cast<std::size_t>(pieces(size)));
    with_team(threads,
              [&](const Team& team)
              {
                  const IndexRange mine = team.share(pieces(size));
                  for (Index p = mine.begin; p < mine.end; ++p)
                      sums[p] = work(IndexRange{p * piece, std::min(size, (p + 1) * piece)});
              });
    Sum all{};
    for (const Sum& sum : sums)
        all += sum;
    return all;
}

/// The greatest of several numbers, as a sum.
struct Greatest
{
    double value = 0.0;
    Greatest& operator+=(const Greatest& other)
    {
        value = std::max(value, other.value);
        return *this;
    }
};

struct Nothing
{
    Nothing& operator+=(const Nothing&) { return *this; }
};
}  // namespace

StaticSearch::StaticSearch(const Model& model, State& state, int threads, const StaticRule& rule)
    : model_(model),
      state_(state),
      threads_(threads),
      rule_(rule),
      moved_(3 * static_cast<std::size_t>(model.blocks())),
      step_(moved_.size()),
      is_held_(static_cast<std::size_t>(model.blocks()))
{
}

template <typename Work>
void StaticSearch::for_contacts(const Work& work)
{
    sum_pieces<Nothing>(threads_, state_.contacts.size(),
                        [&](IndexRange range)
                        {
                            work(range);
                            return Nothing{};
                        });
}

std::vector<Index> StaticSearch::loose() const
{
    std::vector<Index> all = moving_;
    for (Index b = 0; b < model_.blocks(); ++b)
        if (is_held_[b] == come_away)
            all.push_back(b);
    std::sort(all.begin(), all.end());
    return all;
}

void StaticSearch::find_contacts()
{
    with_team(threads_, [&](const Team& team) { rebuild_.run(model_, state_, team); });
    const auto contacts = static_cast<std::size_t>(state_.contacts.size());
    points_.resize(2 * contacts);
    tangents_.resize(contacts);
    loads_.resize(2 * contacts);
    list_block_contacts(state_.contacts, state_.blocks.size(), list_);
    start_ = state_.blocks.motion;
    std::ranges::replace(is_held_, std::uint8_t{frozen}, std::uint8_t{not_held});
    begin();
}

void StaticSearch::number()
{
    unknowns_ = number_unknowns(state_, is_held_);
    has_prescribed_ = std::any_of(unknowns_.block.begin(), unknowns_.block.end(),
                                  [&](Index b)
                                  {
                                      const BlockInertia& i = state_.blocks.inertia[b];
                                      return i.inverse_mass_x == 0.0 || i.inverse_mass_y == 0.0 || i.inverse_inertia == 0.0;
                                  });
    const auto size = static_cast<Index>(unknowns_.block.size());
    const std::vector<CoupledPair> pairs = coupled_pairs(state_.contacts, unknowns_);
    tangent_.set_pattern(size, pairs);
    symmetric_.set_pattern(size, pairs);
    std::vector<Vec2> places(static_cast<std::size_t>(size));
    for (Index u = 0; u < size; ++u)
        places[u] = {start_[unknowns_.block[u]].x, start_[unknowns_.block[u]].y};
    with_team(threads_, [&](const Team& team) { factor_.analyse(team, symmetric_.graph(), places); });
    net_.resize(3 * static_cast<std::size_t>(size));
    solution_.resize(net_.size());
}

void StaticSearch::begin()
{
    std::fill(moved_.begin(), moved_.end(), 0.0);
    unknowns_ = number_unknowns(state_, is_held_);
    for (const Index b : find_loose(state_, unknowns_, is_held_, tangents_, moved_, std::numeric_limits<double>::infinity()))
        is_held_[b] = come_away;  // no chain of contacts leads to what stands still
    number();
    place_blocks({0, state_.blocks.size()}, start_, moved_, state_);
    for_contacts([&](IndexRange range) { begin_points(range, model_, state_, points_); });
    far_ = 0.0;
}

StaticSearch::End StaticSearch::run()
{
    if (const End end = iterate({}); end != End::gave_up)
        return end;
    // Not from one pass: steps of half at least may have thrown blocks out of a place where they can stand.
    std::ranges::fill(is_held_, std::uint8_t{not_held});
    begin();
    moving_.clear();
    return iterate({.least_share = 0.0});
}

bool StaticSearch::is_balanced(const StaticRule& goal) const
{
    return imbalance_.ratio() < goal.ratio && imbalance_.worst < goal.acceleration && tally_.newly_parted == 0 && tally_.open == 0;
}

StaticSearch::End StaticSearch::iterate(const Pass& pass)
{
    if (too_many_held())
        return End::gave_up;
    double best = std::numeric_limits<double>::infinity();
    int since_best = 0;
    StaticRule goal = rule_;
    for (int i = 0;; ++i, ++since_best)
    {
        find_imbalance(false, false);
        const PointRule rule{.part_all_open = imbalance_.ratio() < parts_below, .is_first = i == 0};
        tally_ = sum_pieces<PointTally>(threads_, state_.contacts.size(),
                                        [&](IndexRange range)
                                        { return renew_points(range, model_, state_, rule, points_, tangents_); });
        if (tally_.newly_parted > 0)
            find_imbalance(false, false);
        if (i == 0 && imbalance_.ratio() > settled)
        {
            goal.ratio = std::max(goal.ratio, 0.1 * settled);
            goal.acceleration = std::numeric_limits<double>::infinity();
        }
        if (is_balanced(goal))
            return i == 0 ? End::in_balance_from_the_start : End::in_balance;
        if (imbalance_.ratio() < 0.9 * best || tally_.newly_parted > 0)
        {
            best = imbalance_.ratio();
            since_best = 0;
        }
        if (imbalance_.ratio() < rule_.accepted && since_best > stuck_after && tally_.open == 0)
            return End::nearly_in_balance;
        if (since_best > freezes_after && imbalance_.ratio() < holds_below && freeze_worst())
        {
            best = imbalance_.ratio();
            since_best = 0;
        }
        const bool looks_for_loose = i > 0 && (imbalance_.ratio() < holds_below || since_best >= holds_after);
        const bool too_many = looks_for_loose && !hold_loose();
        if (too_many || since_best > rule_.stagnation || iterations_ >= rule_.most_iterations ||
            !std::isfinite(imbalance_.ratio()) || !find_step())
        {
            moving_ = find_loose(state_, unknowns_, is_held_, tangents_, moved_, moves * far_);
            return End::gave_up;
        }
        ++iterations_;
        if (far_ == 0.0)
            far_ = std::max(least_far, 20.0 * greatest_way_of_step());
        const bool careful = since_best >= shortens_after;
        for (int k = 0; k < most_restraints && greatest_way_of_step() > longest_way * far_; ++k)
        {
            for_contacts([&](IndexRange range)
                         { restrain_points(range, state_, step_, pass.far_share * far_, points_, tangents_); });
            if (!find_step())
                break;
        }
        const double restrained = (careful ? short_far : pass.far_share) * far_;
        for_contacts([&](IndexRange range) { restrain_points(range, state_, step_, restrained, points_, tangents_); });
        take_step(careful ? 0.0 : pass.least_share);
    }
}

double StaticSearch::greatest_way_of_step()
{
    return sum_pieces<Greatest>(threads_, state_.contacts.size(),
                                [&](IndexRange range) { return Greatest{greatest_way(range, state_, tangents_, step_)}; })
        .value;
}

void StaticSearch::find_imbalance(bool frozen, bool along_step)
{
    for_contacts([&](IndexRange range) { put_loads(range, model_, state_, points_, frozen, loads_); });
    const std::vector<double> none;
    imbalance_ = sum_pieces<Imbalance>(
        threads_, static_cast<Index>(unknowns_.block.size()),
        [&](IndexRange range)
        { return net_forces(range, model_, state_, unknowns_, list_, loads_, along_step ? step_ : none, net_); });
}

bool StaticSearch::too_many_held() const
{
    Index free = 0, held = 0;
    for (Index b = 0; b < model_.blocks(); ++b)
    {
        free += state_.blocks.is_free(b) ? 1 : 0;
        held += is_held_[b] == come_away ? 1 : 0;
    }
    return static_cast<double>(held) > rule_.most_loose * static_cast<double>(free);
}

/// False when too many have come away.
bool StaticSearch::hold_loose()
{
    const std::vector<Index> loose = find_loose(state_, unknowns_, is_held_, tangents_, moved_, std::max(away, far_));
    if (loose.empty())
        return true;
    for (const Index b : loose)
        is_held_[b] = come_away;
    if (too_many_held())
        return false;
    number();
    find_imbalance(false, false);
    return true;
}

/// Leave out the blocks that are farthest out of balance, for the rest of the search, if they are few.
bool StaticSearch::freeze_worst()
{
    std::vector<Index> worst;
    for (std::size_t u = 0; u < unknowns_.block.size(); ++u)
        if (unbalanced(model_, unknowns_.block[u], &net_[3 * u]) > frozen_share * imbalance_.worst)
            worst.push_back(unknowns_.block[u]);
    if (static_cast<double>(worst.size()) > most_frozen * static_cast<double>(unknowns_.block.size()))
        return false;
    for (const Index b : worst)
        is_held_[b] = frozen;
    number();
    find_imbalance(false, false);
    return true;
}

/// Solve for the step from the tangents. False where nothing helps.
bool StaticSearch::find_step()
{
    double shift = first_shift;
    for (;; shift *= 100.0)
    {
        Index failed = no_index;
        with_team(threads_,
                  [&](const Team& team)
                  {
                      const IndexRange rows = team.share(static_cast<Index>(unknowns_.block.size()));
                      const auto stiffness = [&](Index i, bool coupled)
                      {
                          Matrix6 k = tangents_[i].stiffness(coupled);
                          if (has_prescribed_)
                              leave_out_prescribed(state_.blocks.inertia[state_.contacts.ref[i]],
                                                   state_.blocks.inertia[state_.contacts.inc[i]], k);
                          return k;
                      };
                      tangent_.assemble(rows, [&](Index i) { return stiffness(i, true); });
                      symmetric_.assemble(rows, [&](Index i) { return stiffness(i, false); });
                      for (Index u = rows.begin; u < rows.end; ++u)
                      {
                          finish_diagonal(state_.blocks.inertia[unknowns_.block[u]], shift, tangent_.diagonal(u));
                          finish_diagonal(state_.blocks.inertia[unknowns_.block[u]], shift, symmetric_.diagonal(u));
                      }
                      team.barrier();
                      const Index block = factor_.factorise(team, symmetric_);
                      if (team.is_first())
                          failed = block;
                  });
        if (failed == no_index)
            break;
        if (shift > 1e-2)
            return false;
    }
    GmresResult result;
    with_team(threads_,
              [&](const Team& team)
              {
                  const auto product = [&](const Team& t, const double* x, double* y)
                  {
                      tangent_.multiply(t.share(tangent_.blocks()), x, y);
                      t.barrier();
                  };
                  const auto precondition = [&](const Team& t, const double* x, double* y) { factor_.solve(t, x, y); };
                  const GmresResult mine = gmres_.solve(team, static_cast<Index>(net_.size()), product, precondition, net_.data(),
                                                        solution_.data(), {.tolerance = 1e-2, .most_iterations = 60});
                  if (team.is_first())
                      result = mine;
              });
    solves_ += result.iterations;
    for (std::size_t u = 0; u < unknowns_.block.size(); ++u)
        for (std::size_t k = 0; k < 3; ++k)
            step_[3 * static_cast<std::size_t>(unknowns_.block[u]) + k] = solution_[3 * u + k];
    return std::isfinite(result.residual);
}

void StaticSearch::place(double share)
{
    for (std::size_t i = 0; i < moved_.size(); ++i)
        moved_[i] = from_[i] + share * step_[i];
    place_blocks({0, state_.blocks.size()}, start_, moved_, state_);
}

/// All of the step if that brings enough. Else the share of it at which the work along it ends: with shear strengths frozen forces are those of a convex energy. Not less than `least_share`.
void StaticSearch::take_step(double least_share)
{
    from_ = moved_;
    const double before = imbalance_.ratio();
    place(1.0);
    find_imbalance(false, false);
    if (imbalance_.ratio() < enough_gain * before)
        return;
    const auto work_at = [&](double share)
    {
        place(share);
        find_imbalance(true, true);
        return imbalance_.work;
    };
    double high = 1.0, work_high = work_at(1.0);
    if (work_high >= 0.0)
        return;
    double low = least_share;
    double work_low = work_at(low);
    if (work_low <= 0.0)
    {
        place(std::max(low, 1.0 / 64.0));
        return;
    }
    for (int i = 0; i < line_search_steps; ++i)
    {
        const double share = std::clamp(low + (high - low) * work_low / (work_low - work_high), low + 0.1 * (high - low),
                                        high - 0.1 * (high - low));
        const double work = work_at(share);
        if (std::abs(work) < 0.1 * work_low)
            return;
        if (work > 0.0)
        {
            low = share;
            work_low = work;
        }
        else
        {
            high = share;
            work_high = work;
        }
    }
    place(std::max(low, 1.0 / 64.0));
}

void StaticSearch::commit()
{
    friction_ += tally_.friction;
    for_contacts([&](IndexRange range) { commit_points(range, model_, points_, state_); });
}
}  // namespace hdem
