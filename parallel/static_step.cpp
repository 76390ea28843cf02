/// The step of a static search: its linear system, and how much of it is taken.

#include "core/contact/block_forces.h"
#include "parallel/static_search.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double enough_gain = 0.5;   // of the unbalanced ratio, by a whole step that needs no closer look
constexpr double first_shift = 1e-8;  // of the diagonal
constexpr int line_search_steps = 4;
}  // namespace

double StaticSearch::greatest_way_of_step()
{
    return sum_pieces<Greatest>(threads_, state_.contacts.size(),
                                [&](IndexRange range) { return Greatest{greatest_way(range, state_, tangents_, step_)}; })
        .value;
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
}  // namespace hdem
