#pragma once
/// A run: model, state and scratch together, advanced cycle by cycle.

#include "core/check.h"
#include "core/motion/equilibrium.h"
#include "parallel/cycle.h"

#include <array>

namespace hdem
{
/// Closed contact points by regime.
struct ContactCounts
{
    std::array<Index, 4> points{};  ///< indexed by Regime; open ones are not counted
    [[nodiscard]] Index closed() const { return points[1] + points[2] + points[3]; }
};

/// Threads to use when the user names no number: OMP_NUM_THREADS, else the processors this process may run on.
[[nodiscard]] int default_threads();

class Simulation
{
  public:
    /// The state is the first one of a run, or one that a checkpoint gave back together with its model.
    Simulation(Model model, State state, int threads = 1);

    [[nodiscard]] const Model& model() const { return model_; }
    [[nodiscard]] const State& state() const { return state_; }
    [[nodiscard]] int threads() const { return threads_; }

    /// Problems that need contacts to be seen: a step above the stable limit.
    [[nodiscard]] std::vector<Problem> find_problems();

    /// Excavate, fix, free; set method and damping; count displacements from here.
    void begin_stage(Index stage);
    /// How the present stage ended; before the next one begins.
    void note_outcome(bool converged);

    /// Throws RunError in the cycle in which springs begin to act that are too stiff for the step.
    void advance(std::int64_t cycles);
    /// Throws RunError: see state_check.h.
    void check_state() const;

    [[nodiscard]] Equilibrium equilibrium() const;
    [[nodiscard]] ContactCounts count_contacts() const;
    [[nodiscard]] double critical_step();  ///< 2 / omega_max [s]
    /// Closed contact points summed over all cycles run by this object.
    [[nodiscard]] std::int64_t contact_point_updates() const { return runner_.contact_point_updates(); }
    /// Likewise, one entry a thread; from the first cycle on, without the contacts that were found to begin with.
    [[nodiscard]] std::vector<StageTimes> stage_times() const { return runner_.stage_times(); }

  private:
    void excavate(const std::string& name);
    void renew_contacts();

    Model model_;
    State state_;
    CycleRunner runner_;
    int threads_ = 1;
};
}  // namespace hdem
