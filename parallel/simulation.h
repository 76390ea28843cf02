#pragma once
/// A run: model, state and scratch together, advanced cycle by cycle.

#include "core/check.h"
#include "core/energy_ledger.h"
#include "core/motion/equilibrium.h"
#include "core/stage/stage_ends.h"
#include "parallel/cycle.h"
#include "parallel/static_solver.h"

#include <array>
#include <optional>

namespace hdem
{
/// Closed contact points by regime.
struct ContactCounts
{
    std::array<Index, 4> points{};  ///< indexed by Regime; open ones are not counted
    [[nodiscard]] Index closed() const { return points[1] + points[2] + points[3]; }
};

struct BoundaryChange;

class Simulation
{
  public:
    /// The state is the first one of a run, or one that a checkpoint gave back together with its model.
    Simulation(Model model, State state, const ThreadRule& threads = 1);

    [[nodiscard]] const Model& model() const { return model_; }
    [[nodiscard]] const State& state() const { return state_; }
    /// Greatest number of threads.
    [[nodiscard]] int threads() const { return threads_.rule().most; }
    [[nodiscard]] const ThreadChoice& thread_choice() const { return threads_; }

    /// Problems that need contacts to be seen: a step above the stable limit.
    [[nodiscard]] std::vector<Problem> find_problems();

    /// Excavate, fix, free; set method and damping; count displacements from here. Where the stage ends at rest a static solution is tried.
    void begin_stage(Index stage);
    /// Free blocks that have left the model are held where they are; their energy, and that of joints between them, is removed.
    void hold_lost_blocks();
    /// Take blocks out of the model, as an excavation does.
    void take_away(const std::vector<Index>& blocks);
    void find_calm(const Equilibrium& now);
    /// `is_to_stop` is asked now and then within a static solution, from this thread. If it says true, the solution is broken off and the function that
    /// seeks it throws BrokenOff.
    void ask_in_statics(std::function<bool()> is_to_stop) { is_to_stop_ = std::move(is_to_stop); }
    /// `follow` is told the number of each iteration of a static solution and its unbalanced ratio, from this thread.
    void follow_statics(std::function<void(int, double)> follow) { follow_ = std::move(follow); }
    /// Seek the static solution at the beginning of a stage, if the state comes from a run that was broken off within it.
    void solve_due_statics();
    /// Seek a static solution later in a stage, where every block is slow: rock that only settles on its joints is brought to rest. Changes nothing where
    /// a block comes away.
    void finish_by_statics();
    /// Result of the last static solution in the present stage, if one was tried; the cycles go on from there.
    [[nodiscard]] const std::optional<StaticOutcome>& statics() const { return statics_; }
    /// The end of the present stage, of those in its case, that is met now. Each look is remembered.
    /// @param is_settled  ends that rock comes to when it settles count
    [[nodiscard]] std::optional<EndMet> look_at_ends(bool is_settled);
    /// How the present stage ended, and the user's numbers of blocks that were not at rest, ascending; before the next one begins.
    void note_outcome(const StageOutcome& outcome, const std::vector<Index>& not_at_rest);

    /// Change poses and velocities of blocks from outside, between cycles: `change` writes them. All blocks take part again,
    /// contacts are found anew. The energy that this brings is work of loads.
    /// @pre  what `change` writes is finite; c and s belong to the angle; what is fixed stays where it is
    void change_motion(const std::function<void(std::vector<BlockMotion>&)>& change);

    /// Throws RunError in the cycle in which springs begin to act that are too stiff for the step.
    void advance(std::int64_t cycles);
    /// Throws RunError: see state_check.h. Looks at the ledger.
    void check_state();

    [[nodiscard]] Equilibrium equilibrium() const;
    /// Do the criteria of rest hold, and every_block, where it is one of them, for long enough? Each check is remembered.
    bool check_rest();
    [[nodiscard]] ContactCounts count_contacts() const;
    [[nodiscard]] double critical_step();  ///< 2 / omega_max [s]
    /// Closed contact points summed over all cycles run by this object.
    [[nodiscard]] std::int64_t contact_point_updates() const { return runner_.contact_point_updates(); }
    /// Times of all cycles run by this object, one entry a thread; without the first search for contacts.
    [[nodiscard]] std::vector<StageTimes> stage_times() const { return runner_.stage_times(); }

  private:
    /// The step of a case that gives none: Eq. (32) of the lightest block, or less where a block has so many neighbours that this is not stable.
    void find_default_step();
    /// Greatest stable value of a step that is never shortened; infinite where steps are shortened as needed [s].
    [[nodiscard]] double step_limit();
    /// Books as removed what the change takes from the stored energy, but for what contacts that are found anew change.
    void remove_energy(const std::function<void()>& change);
    /// Excavate, fix and free what the stage says.
    void change_blocks(const StageDef& stage, const BoundaryChange& sides);
    void change_sides(const BoundaryChange& sides);
    /// Forces of the water of the stage that begins, where the blocks are now.
    void change_water();
    /// Set the joints and materials of the running stage.
    void change_properties();
    /// Set the present joints, where the stage changes them over some cycles.
    void set_joints();
    void excavate(const std::string& name);
    /// Forces of excavated blocks and of sides that have ended act no more.
    void end_released_forces();
    void renew_contacts();
    void renew_water();  ///< its forces, and how long they hold
    [[nodiscard]] bool holds_rest();
    bool has_other_water();
    void solve_statics();

    Model model_;
    State state_;
    StageLaws joints_before_;        ///< the running stage
    std::optional<StageEnds> ends_;  ///< of the running stage, once they have been looked at
    CycleRunner runner_;
    ThreadChoice threads_;
    std::optional<StaticOutcome> statics_;
    std::function<bool()> is_to_stop_;
    std::function<void(int, double)> follow_;
};
}  // namespace hdem
