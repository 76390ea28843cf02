/// The step of a static search: its linear system, and how much of it is taken.

#include "core/contact/block_forces.h"
#include "parallel/static_search.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double enough_gain = 0.5;       // of the unbalanced ratio, by a whole step that needs no closer look
constexpr double first_shift = 1e-8;      // of the diagonal
constexpr double whole_tolerance = 1e-2;  // of a linear solution
constexpr double spots_tolerance = 1e-6;  // small systems: the answer hangs less on units and on the way to it
constexpr int line_search_steps = 4;
constexpr double longest_way = 0.3;  // of far, of a point in one step
constexpr int most_restraints = 3;   // of points that go farther, until the step is taken as it is
}  // namespace

void StaticSearch::find_imbalance(Part& part, bool frozen, bool along_step)
{
    find_loads(part, frozen);
    sum_up(part, along_step);
}

void StaticSearch::find_loads(const Part& part, bool frozen)
{
    for_contacts(part, [&](IndexRange range) { put_loads(range, model_, state_, points_, frozen, loads_); });
}

void StaticSearch::sum_up(Part& part, bool along_step)
{
    const std::vector<double> none;
    part.imbalance = sum_pieces<Imbalance>(
        threads_, static_cast<Index>(part.unknowns.block.size()),
        [&](IndexRange range)
        { return net_forces(range, model_, state_, part.unknowns, list_, loads_, given_, along_step ? step_ : none, part.net); });
}

PointTally StaticSearch::renew(const Part& part, const PointRule& rule)
{
    return sum_contacts<PointTally>(part, [&](IndexRange range)
                                    { return renew_points(range, model_, state_, rule, points_, tangents_); });
}

void StaticSearch::restrain(const Part& part, double far)
{
    for_contacts(part, [&](IndexRange range) { restrain_points(range, state_, step_, far, points_, tangents_); });
}

double StaticSearch::greatest_way_of_step(const Part& part)
{
    return sum_contacts<Greatest>(part, [&](IndexRange range) { return Greatest{greatest_way(range, state_, tangents_, step_)}; })
        .value;
}

/// Solve for the step from the tangents. False where nothing helps.
bool StaticSearch::find_step(Part& part)
{
    double shift = first_shift;
    for (;; shift *= 100.0)
    {
        Index failed = no_index;
        with_team(threads_,
                  [&](const Team& team)
                  {
                      const IndexRange rows = team.share(static_cast<Index>(part.unknowns.block.size()));
                      const auto stiffness = [&](Index k, int side)
                      {
                          const Index i = part.is_whole ? k : part.contacts[k];
                          RowPair both = tangents_[i].stiffness(side);
                          if (part.has_prescribed)
                              for (Matrix36* own : {&both.coupled, &both.symmetric})
                                  leave_out_prescribed(state_.blocks.inertia[state_.contacts.ref[i]],
                                                       state_.blocks.inertia[state_.contacts.inc[i]], side, *own);
                          return both;
                      };
                      BlockMatrix::assemble(rows, stiffness, part.tangent, part.symmetric);
                      for (Index u = rows.begin; u < rows.end; ++u)
                      {
                          finish_diagonal(state_.blocks.inertia[part.unknowns.block[u]], shift, part.tangent.diagonal(u));
                          finish_diagonal(state_.blocks.inertia[part.unknowns.block[u]], shift, part.symmetric.diagonal(u));
                      }
                      team.barrier();
                      const Index block = part.factor.factorise(team, part.symmetric);
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
                      part.tangent.multiply(t.share(part.tangent.blocks()), x, y);
                      t.barrier();
                  };
                  const auto precondition = [&](const Team& t, const double* x, double* y) { part.factor.solve(t, x, y); };
                  const GmresResult mine = gmres_.solve(
                      team, static_cast<Index>(part.net.size()), product, precondition, part.net.data(), part.solution.data(),
                      {.tolerance = part.is_whole ? whole_tolerance : spots_tolerance, .most_iterations = 60});
                  if (team.is_first())
                      result = mine;
              });
    solves_ += result.iterations;
    for (std::size_t u = 0; u < part.unknowns.block.size(); ++u)
        for (std::size_t k = 0; k < 3; ++k)
            step_[3 * static_cast<std::size_t>(part.unknowns.block[u]) + k] = part.solution[3 * u + k];
    return std::isfinite(result.residual);
}

/// The step, found anew a few times with more resistance where a point goes far, and less trust in those points at the next iterate.
void StaticSearch::shorten_step(Part& part, double far_share, double next_far_share)
{
    for (int k = 0; k < most_restraints && greatest_way_of_step(part) > longest_way * far_; ++k)
    {
        restrain(part, far_share * far_);
        if (!find_step(part))
            break;
    }
    restrain(part, next_far_share * far_);
}

void StaticSearch::place(const Part& part, double share)
{
    const auto put = [&](Index b)
    {
        for (std::size_t i = 3 * static_cast<std::size_t>(b); i < 3 * static_cast<std::size_t>(b) + 3; ++i)
            moved_[i] = from_[i] + share * step_[i];
        place_blocks({b, b + 1}, start_, moved_, state_);
    };
    if (part.is_whole)
        for (Index b = 0; b < state_.blocks.size(); ++b)
            put(b);
    else
        for (const Index b : part.unknowns.block)
            put(b);
}

/// All of the step if that brings enough. Else the share of it at which the work along it ends: with shear strengths frozen forces are those of a convex energy. Not less than `least_share`.
/// @return  whether the part's imbalance is that of the places where the blocks are now
bool StaticSearch::take_step(Part& part, double least_share)
{
    from_ = moved_;
    const double before = part.imbalance.ratio();
    place(part, 1.0);
    find_imbalance(part, false, false);
    if (part.imbalance.ratio() < enough_gain * before)
        return true;
    const auto work_at = [&](double share)
    {
        place(part, share);
        find_imbalance(part, true, true);
        return part.imbalance.work;
    };
    double high = 1.0, work_high = work_at(1.0);
    if (work_high >= 0.0)
        return false;
    double low = least_share;
    double work_low = work_at(low);
    if (work_low <= 0.0)
    {
        place(part, std::max(low, 1.0 / 64.0));
        return false;
    }
    for (int i = 0; i < line_search_steps; ++i)
    {
        const double share = std::clamp(low + (high - low) * work_low / (work_low - work_high), low + 0.1 * (high - low),
                                        high - 0.1 * (high - low));
        const double work = work_at(share);
        if (std::abs(work) < 0.1 * work_low)
            return false;
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
    place(part, std::max(low, 1.0 / 64.0));
    return false;
}
}  // namespace hdem
