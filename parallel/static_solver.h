#pragma once
/// The state of rest found by Newton's iteration in place of cycles.

#include "core/model/model.h"
#include "core/state/state.h"

#include <functional>

namespace hdem
{
/// What a static solution has to reach.
struct StaticRule
{
    double ratio = 1e-6;         ///< sum of unbalanced forces and moments over that of weights [-]
    double accepted = 1e-5;      ///< where no more can be reached [-]
    double nearly = 1e-3;        ///< from where cycles may go on [-]
    double acceleration = 1e-3;  ///< greatest of a block, moment over radius included [m/s2]
    double most_loose = 0.1;     ///< share of the blocks that may come away before there is no equilibrium [-]
    int stagnation = 50;         ///< a search is given up after so many iterations in which the unbalance has not fallen by a tenth
    int most_iterations = 350;
    std::function<bool()> is_to_stop{};        ///< asked in every iteration; true: BrokenOff is thrown
    std::function<void(double ratio)> tell{};  ///< told the unbalanced ratio of every iteration
};

/// Thrown within a static solution that is to end early; the state is as before it.
struct BrokenOff
{
};

/// Throws BrokenOff when the rule says that the solution is to end early.
void stop_if_asked(const StaticRule& rule);

/// The rule of a model: it seeks a tenth of the limits of its convergence criteria, and accepts these limits.
[[nodiscard]] StaticRule static_rule(const Model& model);

struct StaticOutcome
{
    using Kind = StaticEnd;
    Kind kind = Kind::not_converged;
    /// Is the state the one that was found?
    [[nodiscard]] bool is_taken() const { return kind == Kind::balanced || kind == Kind::nearly_balanced; }
    int iterations = 0;
    int solves = 0;              ///< of the linear system's preconditioner
    int searches = 0;            ///< of contacts
    double residual = 0.0;       ///< unbalanced ratio of what stands, by the dynamic law [-]
    std::vector<Index> loose{};  ///< blocks that have come away, ascending; or that moved when the search was given up
};

/// "balanced", "nearly_balanced", "no_equilibrium" or "not_converged".
[[nodiscard]] const char* name_of(StaticOutcome::Kind kind);

/// Is it worth a try where the rules of the stage allow it (StageRules::tries_statics)? Many blocks, all but at rest, all contacts on springs.
[[nodiscard]] bool can_solve_statics(const Model& model, const State& state);

/// Bring the blocks to rest under their weight: small steps of Newton's iteration on the contact forces as a cycle finds them, every increment of shear from the last
/// equilibrium on. Blocks that come away are held where that is found. They keep the forces that they bear there, and fall in the cycles that follow.
/// Where the others do not stand without them there is no equilibrium.
///
/// 1. residual, status of each point, tangent with friction (core/statics/static_contacts.h)
/// 2. Cholesky factor of the tangent without the coupling of friction; GMRES on the whole tangent with it, to 1e-2
/// 3. a share t in [1/2, 1] of the step, by the energy with frozen shear strengths, which is convex
/// 4. blocks far more out of balance than the others are brought near to it by such steps of their own (parallel/static_spots.cpp)
/// 5. in balance: features and contacts are found anew; the state is the answer if it is still in balance
///
/// From zero stress Newton and cycles may take turns first (parallel/static_approach.h); after an excavation see parallel/static_ways.h.
///
/// `state` changes only when it is balanced, or nearly: places, forces and regimes of contacts, velocities 0, ledger. The slip's work goes to friction, all else that
/// weight and springs have given to local damping, as the cycles in its place would have done. The same bits on any number of threads.
/// @pre  can_solve_statics, contacts are not outdated.  Afterwards they are those of the new places.
/// @see  verification/unit/parallel/static_solver_test.cpp
StaticOutcome solve_statics(const Model& model, State& state, int threads, const StaticRule& rule);
}  // namespace hdem
