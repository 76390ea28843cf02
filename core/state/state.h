#pragma once
/// Everything that changes during a run. A checkpoint holds exactly this.

#include "core/model/method_def.h"
#include "core/state/blocks.h"
#include "core/state/contacts.h"
#include "core/state/energy_terms.h"
#include "core/state/stage_outcome.h"
#include "core/state/support_state.h"
#include "core/state/triple.h"

#include <cstdint>
#include <vector>

namespace hdem
{
/// Force of excavated blocks on a block that stays (core/motion/released_forces.h).
struct ReleasedForce
{
    Index block = no_index;
    double x = 0.0;  ///< [N]
    double y = 0.0;
    double moment = 0.0;  ///< about the block's centroid [N m]
};

/// How a block moves that is damped otherwise than a block by itself (core/motion/moving_groups.h).
enum class FreeMotion : std::uint8_t
{
    slides,  ///< its group slides on joints of one direction: damped across them
    flies,   ///< its group touches nothing: not damped
    tips,    ///< about the point in which others bear it, or slides on a block that moves, or turns as it slides: not damped
    dragged  ///< a fast block drags or pushes its group, and nothing holds this: not damped
};

struct MovingBlock
{
    Index block = no_index;
    FreeMotion how = FreeMotion::slides;
    float t_x = 1.0F, t_y = 0.0F;  ///< direction of the joints on which it slides [-]
};

/// A loose block that is slow (core/motion/creeping_blocks.h), as last looked at.
struct CreepingBlock
{
    Index block = no_index;
    std::int32_t looks = 0;                        ///< in succession at which it had gone on in the same direction
    double x = 0.0, y = 0.0, turn = 0.0;           ///< where it was [m]; its rotation times its radius [m]
    double by_x = 0.0, by_y = 0.0, by_turn = 0.0;  ///< way since the look before [m]
};

struct State
{
    Blocks blocks;
    Contacts contacts;
    std::vector<BlockMotion> rebuilt_at;    ///< poses at the last broad-phase rebuild
    std::vector<Index> next_to_excavation;  ///< blocks that touched what was excavated, ascending
    std::vector<ReleasedForce> released;    ///< still to be removed in the running stage, ascending by block
    std::vector<MovingBlock> moving;        ///< as last found, ascending by block
    std::vector<CreepingBlock> creeping;    ///< loose slow blocks that may creep, ascending by block
    std::vector<Triple> water;     ///< forces and moments of water, one a block, as last found; empty without water [N], [N m]
    std::int64_t water_until = 0;  ///< cycle up to which they hold
    SupportState support;
    EnergyLedger ledger;
    WorstResidual worst_residual;
    std::int64_t cycle = 0;
    double time = 0.0;  ///< sum of all steps [s]
    std::int64_t stage_begin_cycle = 0;
    double quiet_since = -1.0;              ///< all checks of rest in the stage have held since then; < 0: the last one did not [s]
    Index stage = 0;                        ///< running, or next to begin
    bool stage_begun = false;               ///< `stage` runs, or has just come to its end
    std::vector<StageOutcome> stages_done;  ///< one for each stage before `stage`
    std::vector<EndWatch> ends;             ///< one for each end of the running stage
    std::vector<StageBlock> not_at_rest;    ///< blocks not supported when one of these stages ended without rest, ascending
    std::vector<StaticSolution> statics;    ///< found when a stage began, the running one included; ascending by stage
    std::vector<StageBlock> came_loose;     ///< blocks that came away in these solutions, ascending
    Method method = Method::hybrid;         ///< in force now
    DampingPreset damping = DampingPreset::automatic;
    std::int64_t excavation_cycle = -1;  ///< of the last excavation, -1: none yet
    std::int64_t broad_phase_runs = 0;
    std::int64_t feature_searches = 0;
    bool contacts_outdated = true;  ///< broad phase must run before the next cycle
    double default_step = 0.0;      ///< of a case without time.step whose model gives one that its contacts do not bear; else 0 [s]
    bool flies_ahead = false;       ///< blocks in flight take longer steps than the others
    bool is_calm = false;           ///< no block moves any more; what is out of balance still keeps the running stage from ending
    bool statics_due = false;    ///< a static solution is to be sought before the next cycle; it was broken off, or is being sought
    bool statics_taken = false;  ///< the running stage has been brought to rest, or near it, by a static solution
    bool rest_changed = false;   ///< blocks have been stopped or woken in the last cycle
};
}  // namespace hdem
