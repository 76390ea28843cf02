#pragma once
/// The stages of a cycle in their order, and which thread does what.

#include "core/contact/running_sums.h"
#include "core/model/model.h"
#include "core/motion/moving_groups.h"
#include "core/motion/rest.h"
#include "core/stage/rules.h"
#include "core/state/state.h"
#include "core/state/workspace.h"
#include "core/support/liner_forces.h"
#include "parallel/contact_rebuild.h"
#include "parallel/partition.h"
#include "parallel/stage_times.h"
#include "parallel/thread_choice.h"

#include <vector>

namespace hdem
{
class Team;

/// Runs cycles; keeps what they need between them and nothing that would change a result.
class CycleRunner
{
  public:
    using FindRules = StageRules (*)(const Model&, const State&);

    /// @param find_rules  of the stage, asked again before each call's cycles
    /// @param least_for_sums  contacts from which on forces are summed as they are found (RunningSums), where nothing is left out: the same bits
    explicit CycleRunner(FindRules find_rules = resolve_rules, Index least_for_sums = large_model)
        : least_for_sums_(least_for_sums),
          find_rules_(find_rules)
    {
    }
    /// From here on the loads of contacts fit no cache: their way through memory costs more than sums that are formed part by part (perf/measured.md).
    static constexpr Index large_model = 100000;

    /// The stages in the order of core/README.md, `cycles` times, or fewer when the order of the blocks in memory has decayed: then contacts are outdated.
    /// The same bits on any number of threads, and however a run is cut into calls.
    /// @return  a contact whose springs have begun to act in the last cycle and are too stiff for the step (core/motion/step_check.h): the run must not go on;
    ///          no_index without one
    /// @pre contacts are not outdated
    [[nodiscard]] Index run(const Model& model, State& state, std::int64_t cycles, ThreadChoice& threads);
    /// On a fixed number of threads.
    [[nodiscard]] Index run(const Model& model, State& state, std::int64_t cycles, int threads);

    /// Find the contacts anew, after blocks were taken away, fixed or freed.
    void renew_contacts(const Model& model, State& state, int threads);

    /// Call it after contacts or constant forces were found elsewhere: the runner prepares anew for them.
    void take_contacts() { prepared_ = false; }

    /// Closed contact points summed over all cycles.
    [[nodiscard]] std::int64_t contact_point_updates() const { return contact_point_updates_; }

    /// One entry a thread. All of its time in cycles, shared out to the stages as in every 17th cycle; searches for contacts are all timed.
    [[nodiscard]] std::vector<StageTimes> stage_times() const;
    /// Forget the times so far.
    void forget_times() { samples_.clear(); }
    /// Was an overlap above contact.overlap_limit in the last cycle? `run` then ends with it.
    [[nodiscard]] bool found_deep_overlap() const;

  private:
    void renew_contacts(const Model& model, State& state, const Team& team);
    void regroup_contacts(const Model& model, State& state, const Team& team);
    [[nodiscard]] bool is_prepared(const Model& model, const State& state, const StageRules& rules) const;
    /// Bounds on the share of their margins that blocks have used up.
    struct Way
    {
        double since_found;   ///< since the contacts were found; it only decides when to look closely
        double in_run = 0.0;  ///< since the call of run
    };

    /// Run up to `end`, unless the last of the cycles is to be looked at.
    /// @param way  the first member's is that of all
    /// @return  whether cycles go on
    bool run_piece(const Model& model, State& state, std::int64_t first, std::int64_t end, const Team& team, Way& way);
    /// @return  whether the step is small enough for the springs that have begun to act
    bool cycle(const Model& model, State& state, const Team& team, std::int64_t now, Way& way, StageClock& clock);
    /// What one thread does when all have evaluated their contacts, before any goes on.
    void close_evaluation(const Model& model, State& state, std::int64_t now);
    /// The same when all have moved their blocks.
    void close_cycle(const Model& model, State& state);
    void prepare(const Model& model, const State& state);
    void prepare_forces(const Model& model, const State& state);
    void take_tractions(const Model& model, const State& state);
    void take_loads(const Model& model, State& state);
    [[nodiscard]] Index find_unstable_contact() const;
    [[nodiscard]] StageSamples& samples_of(const Team& team);
    /// @param is_last  the state is looked at after this cycle
    void evaluate(const Model& model, State& state, const Team& team, double gone, bool is_last, StageClock& clock);
    [[nodiscard]] bool may_have_fast(const BlockPart& part) const;
    void find_fast(const Model& model, const State& state, const Team& team, std::int64_t now);
    void store_tilts(State& state, const Team& team);
    void add_up_contacts(State& state);
    void leave_out(const State& state, const Team& team, std::int64_t now);
    [[nodiscard]] bool saves_enough() const;
    void mark_woken(const Contacts& contacts);
    void prepare_sums(const State& state, int threads);
    [[nodiscard]] bool sums_run() const { return sums_run_ && !left_out_; }
    void find_groups(const Model& model, State& state, std::int64_t now);
    void find_creeping(const Model& model, State& state, std::int64_t now);
    void sum_up_forces(const Model& model, State& state, BlockPart& part);
    void change_velocities(const Model& model, State& state, std::int64_t now, BlockPart& part);
    double change_positions(const Model& model, State& state, BlockPart& part, std::vector<Triple>* pseudo);
    void move(const Model& model, State& state, const Team& team, std::int64_t now);
    void move_with_impulses(const Model& model, State& state, const Team& team, std::int64_t now, StageClock& clock);

    Workspace work_;
    RunningSums sums_;
    MovingGroups groups_;
    int sums_for_ = 0;                      ///< threads that share the contacts
    std::vector<ContactLoads> part_loads_;  ///< of a part, for each thread
    Index least_for_sums_;                  ///< contacts
    bool left_out_ = false;                 ///< contacts are
    bool rest_unknown_ = true;              ///< blocks may have been stopped or woken between two calls of run
    bool sums_run_ = false;                 ///< in this stretch of cycles, while no contacts are left out
    bool has_loads_ = false;                ///< work_.loads are those of all contacts
    LinerSolvers liner_solvers_;
    ContactRebuild rebuild_;
    Partition partition_;
    std::vector<StageSamples> samples_;
    double used_ = 0.0;      ///< share of their margins
    bool goes_on_ = true;    ///< after this cycle: the step is small enough for the springs that have begun to act
    Index impulses_ = 0;     ///< contact points of this cycle
    double farthest_ = 0.0;  ///< share of its margin that some block has used up in this cycle
    std::int64_t contact_point_updates_ = 0;
    FindRules find_rules_;
    StageRules rules_;  ///< of the running stage
    bool prepared_ = false;
    Index prepared_stage_ = no_index;
    std::int64_t first_evaluation_ = 0;  ///< cycle in which all contacts take part: they were found then, or a run goes on
    bool has_stiff_contacts_ = false;
    std::int64_t run_end_ = 0;  ///< cycle at which the call of run ends
};
}  // namespace hdem
