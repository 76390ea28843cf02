#pragma once
/// The constant side of a run: shapes, masses, joints, loads, stages and settings. Nothing here changes after set-up;
/// what changes each cycle is in core/state.
///
/// Blocks and parts are stored along a space-filling curve; `user_number` leads back to the order the user knows.
/// Coordinates are relative to `origin`, so that a model at 1e6 m keeps its digits.

#include "core/joint/coulomb_slip.h"
#include "core/joint/joint_row.h"
#include "core/model/boundary.h"
#include "core/model/insitu_def.h"
#include "core/model/load_def.h"
#include "core/model/method_def.h"
#include "core/model/output_def.h"
#include "core/model/stage_def.h"
#include "core/model/support.h"
#include "core/model/water.h"
#include "core/state/blocks.h"

#include <string>
#include <vector>

namespace hdem
{
/// Shapes of all blocks as convex parts, vertices anticlockwise in the block's own frame (origin = its centroid).
struct Shapes
{
    std::vector<Index> part_begin;          ///< per block + 1: its parts
    std::vector<Index> part_block;          ///< per part
    std::vector<Index> vertex_begin;        ///< per part + 1: its vertices
    std::vector<Vec2> vertex;               ///< body frame [m]; edge i runs from vertex i to the next of its part
    std::vector<Vec2> edge_tangent;         ///< per vertex: unit vector along edge i [-]; outward normal = tangent turned right
    std::vector<double> edge_length;        ///< per vertex [m]
    std::vector<std::int32_t> edge_source;  ///< per vertex: EdgeSource, or a number of EdgeSources (model/edge_sources.h)
    std::vector<std::uint8_t> is_reflex;    ///< per vertex: is the block's angle there above 180 degrees?
    std::vector<Index> to_twin;             ///< per vertex: steps to the same internal edge of the part beyond it; 0: none
    std::vector<Vec2> part_centre;          ///< per part: centre of its bounding circle, body frame [m]
    std::vector<double> part_radius;        ///< per part: of that circle [m]

    [[nodiscard]] Index parts() const { return static_cast<Index>(part_block.size()); }
    [[nodiscard]] Index next_vertex(Index part, Index v) const
    {
        return v + 1 == vertex_begin[part + 1] ? vertex_begin[part] : v + 1;
    }
};

/// Which joint lies between two touching edges: by joint set, else by pair of materials, else the default.
struct JointTable
{
    std::vector<std::string> names;
    std::vector<CoulombSlip> laws;
    std::vector<JointRow> rows;  ///< per law: what it needs beyond that; empty where all are plain
    std::vector<Index>
        unbonded;  ///< per law: the same without cohesion, tension and roughness, for blocks that have met since the start
    std::vector<Index> of_joint_set;  ///< per joint set, and for all traces: law, or no_index
    std::vector<Index> of_materials;  ///< materials x materials: law
    Index materials = 0;
    Index of_walls = no_index;  ///< law of the walls of [[boundary]], on whatever they press

    [[nodiscard]] bool has_memory() const { return !rows.empty(); }
    [[nodiscard]] bool has_memory(Index law) const { return !rows.empty() && rows[law].has_memory(); }
    /// Law of blocks that have met since the start.
    [[nodiscard]] Index unbonded_of(Index law) const { return unbonded.empty() ? law : unbonded[law]; }
    [[nodiscard]] Index find(std::int32_t source_a, std::int32_t source_b, Index material_a, Index material_b) const;
};

/// Laws of the case's joints from a stage on; the first of JointTable::laws and rows.
struct StageLaws
{
    std::vector<CoulombSlip> laws;
    std::vector<JointRow> rows;
};

/// A load with names resolved to blocks and times to cycles: acts while from <= cycle < until, counted from factor.since.
struct Load
{
    std::string name;
    std::vector<Index> blocks;
    Vec2 acceleration = {0.0, 0.0};          ///< [m/s2]
    Vec2 force = {0.0, 0.0};                 ///< [N]
    std::vector<Vec2> arm;                   ///< of the force, per block, in its own frame; empty: it acts at the centroids [m]
    double moment = 0.0;                     ///< [N m]
    std::optional<double> velocity_x;        ///< [m/s]
    std::optional<double> velocity_y;        ///< [m/s]
    std::optional<double> angular_velocity;  ///< [rad/s]
    Interval interval;                       ///< as the case gives it
    std::int64_t from = 0;
    std::int64_t until = 0;
    Factor factor;  ///< of all of these

    [[nodiscard]] bool prescribes() const { return velocity_x || velocity_y || angular_velocity; }
    [[nodiscard]] bool has_times() const { return interval.from_time || interval.until_time || factor.is_by_time; }
};

/// Stress at the start: linear in y. See core/stress/insitu_stress.h.
struct InsituField
{
    bool given = false;
    StressDef stress;                ///< at the reference, tension positive [Pa]
    StressDef gradient;              ///< [Pa/m]
    double reference = 0.0;          ///< y in local coordinates [m]
    bool ends_at_reference = false;  ///< none above it: the ground
    double density = 0.0;            ///< of the domain's material [kg/m3]
};

struct Model
{
    std::string title;
    Vec2 origin = {0.0, 0.0};  ///< of the local coordinates in the user's [m]
    Vec2 centre = {0.0, 0.0};  ///< of the box around all blocks at the start [m]
    double lost_beyond = std::numeric_limits<
        double>::infinity();  ///< blocks farther than this from the centre have left the model [m]
    Shapes shapes;

    // one per block
    std::vector<std::string> name;
    std::vector<Index> user_number;   ///< position in the user's order
    std::vector<Index> slot_of_user;  ///< its inverse
    std::vector<Index> material;
    std::vector<Index> excavation;           ///< number of the excavation it lies in, or no_index
    std::vector<double> area;                ///< [m2]
    std::vector<double> mass;                ///< [kg per m]
    std::vector<double> inertia;             ///< about the centroid [kg m2 per m]
    std::vector<BlockInertia> full_inertia;  ///< with the block's own mass even where its motion is prescribed
    std::vector<double> radius;              ///< of the smallest circle about the centroid that holds the block [m]
    std::vector<Vec2> start;                 ///< centroid when the run begins [m]

    std::vector<std::string> material_names;
    std::vector<std::string> excavation_names;
    std::vector<std::string> joint_set_names;  ///< by number of EdgeSources, without the traces
    InsituField insitu;
    Water water;
    Support support;
    std::vector<Boundary> boundaries;
    JointTable joints;
    std::vector<StageLaws> stage_laws;                 ///< per stage; empty ones change nothing
    std::vector<std::vector<double>> stage_densities;  ///< per stage and material; empty ones change nothing [kg/m3]
    std::vector<double> density;                       ///< per material, now [kg/m3]
    std::optional<std::uint64_t> drawn_hash;           ///< model_hash of the case as it begins, once a stage has changed something
    std::vector<Load> loads;
    std::vector<StageDef> stages;
    std::vector<HistoryDef> histories;

    Vec2 gravity = {0.0, -9.81};  ///< [m/s2]
    ContactDef contact;
    DampingDef damping;
    ConvergenceDef convergence;
    OutputDef output;
    double time_step = 0.0;           ///< [s]
    double paper_time_step = 0.0;     ///< Eq. (32) [s]
    double default_time_step = 0.0;   ///< what a case without a step takes, see core/motion/time_step.h [s]
    double greatest_stiffness = 0.0;  ///< normal or shear, of all joints and stages [Pa/m]
    bool holds_mean = false;          ///< the blocks at pressed sides together neither move nor turn, see core/boundary/mean_hold.h
    bool is_driven = false;           ///< a block has a motion that it cannot leave
    bool has_step = false;            ///< the case gives the time step
    double stable_fraction = 0.9;     ///< that share [-]
    double threshold_scale = 1.0;     ///< C_scale of Eq. (25) [-]
    double mean_size = 0.0;           ///< square root of the mean block area [m]

    [[nodiscard]] Index blocks() const { return static_cast<Index>(mass.size()); }
    [[nodiscard]] bool is_wall(Index block) const { return mass[block] == 0.0; }  ///< of a [[boundary]]
    [[nodiscard]] bool is_far_outside(const Vec2& at) const { return (at - centre).norm() > lost_beyond; }
    [[nodiscard]] double size(Index block) const;                         ///< square root of the area [m]
    [[nodiscard]] Index find_block(const std::string& block_name) const;  ///< or no_index
};
}  // namespace hdem
