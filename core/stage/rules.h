#pragma once
/// The rules of a stage: all that follows from method, damping preset, kind of stage and loads is decided here, once.
///
/// Each part of the cycle receives its own rule and asks for no mode. The screen, `hdem check` and the checks of a case ask the same function, so
/// that what a user is told is what runs.

#include "core/contact/impulse_islands.h"
#include "core/contact/regime.h"
#include "core/model/case_def.h"
#include "core/model/model.h"
#include "core/motion/damping.h"
#include "core/motion/fast_blocks.h"
#include "core/motion/rest.h"
#include "core/motion/step_control.h"
#include "core/state/state.h"
#include "core/water/water_motion.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace hdem
{
/// Bounds of a load that acts for ever, whatever the cycle.
inline constexpr std::int64_t always_from = std::numeric_limits<std::int64_t>::min() / 2;
inline constexpr std::int64_t always_until = std::numeric_limits<std::int64_t>::max() / 2;

/// What the rules follow from.
struct StageSetting
{
    Method method = Method::hybrid;
    DampingPreset preset = DampingPreset::automatic;
    DampingDef damping;
    double stable_fraction = 0.9;  ///< time.stable_fraction
    ConvergenceDef convergence;
    double gravity = 9.81;         ///< size of [m/s2]
    bool until_converged = false;  ///< the stage ends when the rock is at rest
    bool has_loads = false;        ///< the case has loads of any kind
    bool has_support = false;      ///< bolts or liners are installed
    bool has_water = false;
    bool loads_change = false;      ///< loads or sides change, now or later in the stage
    bool tractions_change = false;  ///< those on sides
    bool times_to_come = false;     ///< something changes at a time given in seconds
    bool releases = false;          ///< forces of excavated blocks are being taken off
    bool holds_released = false;    ///< some of them act, whether or not they become less
    bool is_calm = false;           ///< no block moves any more; what is out of balance still keeps the stage from ending
    bool is_driven = false;         ///< some motion is prescribed
    bool moves_walls = false;       ///< by a [[boundary]]
    bool holds_mean = false;        ///< domain.hold
    bool has_step = false;          ///< the case gives the time step
    bool keeps_released = false;    ///< a share of them stays to the end of the stage
    bool relaxes = false;           ///< they are taken off over cycles
    bool is_large = false;          ///< the model has so many blocks that a static solution is faster than cycles
    bool has_histories = false;
    RestSolver solver = RestSolver::automatic;
};

struct StageRules
{
    RegimeRule contact;
    ExactIslands islands = ExactIslands::great_mass_ratios;
    DampingRule damping;
    GroupRule groups;
    StepRule step;
    RestRule rest;
    WaterRule water;
    bool ends_at_rest = false;      ///< the stage ends when the rock is at rest
    bool has_loads = false;         ///< there are loads to be looked at in each cycle
    bool has_support = false;       ///< bolts and liners act; they turn off neither rest nor longer steps
    bool tractions_change = false;  ///< those on sides have to be found anew in each cycle
    bool moves_walls = false;       ///< walls of [[boundary]] move
    bool tries_statics = false;     ///< the state of rest is sought by a static solution first, from where the stage begins
};

[[nodiscard]] StageRules resolve_rules(const StageSetting& setting);

/// Rules of the running stage; before the first one, of the case as a whole.
[[nodiscard]] StageRules resolve_rules(const Model& model, const State& state);

/// Rules of the cycles that approach a static solution: those of the stage, by springs alone.
[[nodiscard]] StageRules approach_rules(const Model& model, const State& state);

/// Rules of each stage of a case, in their order, once its loads do not change any more.
[[nodiscard]] std::vector<StageRules> resolve_rules(const CaseDef& def);

/// Does a stage end when the rock is at rest?
[[nodiscard]] bool ends_at_rest(const StageDef& stage);

/// Is its rest to be sought by a static solution, if anything allows one?
[[nodiscard]] bool asks_for_statics(const StageDef& stage);

/// A stage that brings rock to rest by springs, and waits for it as long as it takes.
[[nodiscard]] StageDef stage_until_rest(std::string name);

/// Do impulses alone act between blocks? They do not determine the stress in the rock.
[[nodiscard]] bool is_by_impulses(Method method);

/// Do impulses alone act in some stage of the case?
[[nodiscard]] bool has_impulses_alone(const CaseDef& def);

/// Do the springs of a stage begin without force? Those of the first stage of rock without stress do, and those that follow impulses.
/// @param last  method of the stage before; that of the case in the first stage
[[nodiscard]] bool begins_with_empty_springs(std::size_t stage, Method last, Method now, bool has_stress);
[[nodiscard]] std::vector<const StageDef*> stages_with_empty_springs(const CaseDef& def);

/// Is the step of Eq. (32) taken to the letter where a case gives none?
[[nodiscard]] bool takes_paper_step(const CaseDef& def);

/// Do blocks begin with a motion that forces do not change?
[[nodiscard]] bool have_driven_blocks(const CaseDef& def);

/// Does a block have a motion that forces do not change, from the start or by loads?
[[nodiscard]] bool is_driven(const CaseDef& def);

/// The same of the running stage, moving walls included.
[[nodiscard]] bool is_driven(const Model& model, const State& state);

/// The method as the case file spells it.
[[nodiscard]] const char* name_of(Method method);
}  // namespace hdem
