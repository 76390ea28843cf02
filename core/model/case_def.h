#pragma once
/// Everything a case file can say, as plain structs with defaults. io/ fills them, core/rock builds a Model from them.
/// SI units; angles in degrees where the name ends in _deg. Each field's default, range and effect stands once more, for
/// users, in io/case_schema (which writes io/case_format.md).

#include "core/joint/user_law.h"
#include "core/model/distribution_def.h"
#include "core/model/stage_end.h"
#include "core/model/trace_cells.h"
#include "core/types.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
enum class Method
{
    force,    ///< springs with Coulomb slip at every contact, Eqs. (1)-(14)
    impulse,  ///< momentum exchange at every contact, Eqs. (15)-(22)
    hybrid    ///< chosen per contact point and cycle by the threshold velocity, Eqs. (24)-(30)
};

// ---- rock mass ------------------------------------------------------------------------------------------------------

/// What holds rock that tractions press from all sides.
enum class DomainHold
{
    none,
    mean  ///< the blocks at the pressed sides, which together neither move nor turn: core/boundary/mean_hold.h
};

/// [domain]: the area that is filled with rock; a rectangle (width, height, origin), a polygon, or what lies below a profile.
struct DomainDef
{
    bool given = false;
    double width = 0.0;            ///< [m]
    double height = 0.0;           ///< [m]
    Vec2 origin = {0.0, 0.0};      ///< lower left corner of the rectangle [m]
    Polygon polygon;               ///< instead of width and height; simple, any orientation; of a profile once io/ has read it [m]
    std::string profile;           ///< or a CSV file of x, y of the ground
    std::optional<double> bottom;  ///< y of the lower side below a profile [m]
    std::vector<std::string> fixed;  ///< "left", "right", "bottom", "top": blocks with an edge on that side are fixed
    std::vector<int> fixed_edges;    ///< same for edges of the polygon, 0 = first to second vertex
    DomainHold hold = DomainHold::none;
    std::string material = "rock";
    std::string traces_file;   ///< WKT or CSV of joint traces; cut by io/ into CaseDef::trace_cells
    std::string traces_joint;  ///< name of a [joint.NAME] for contacts along traces; "" = by materials
    double traces_snap = 0.0;  ///< a trace that ends nearer than this to another one meets it [m]
};

/// [[fault]]: one long joint, cut before all joint sets.
struct FaultDef
{
    std::string name;
    Polygon points;     ///< at least two; it runs from the first to the last [m]
    std::string joint;  ///< name of a [joint.NAME] for contacts along it; "" = by materials
};

/// [[region]]: a part of the domain with joint sets or a material of its own; what lies in all that is given.
struct RegionDef
{
    std::string name;
    Polygon polygon;       ///< its outline is cut into the rock; empty: none [m]
    std::string above;     ///< name of the fault it lies above; "" = none
    std::string below;     ///< name of the fault it lies below; "" = none
    std::string material;  ///< of its blocks; "" = that of the domain
    std::string joint;     ///< name of a [joint.NAME] for contacts along the outline; "" = by materials
};

/// Orientation of a plane in space, and the vertical section that it is seen in. Azimuths are from north, clockwise.
struct OrientationDef
{
    double dip = 0.0;            ///< below the horizontal [deg]
    double dip_direction = 0.0;  ///< azimuth of the line of steepest descent [deg]
    double section = 0.0;        ///< azimuth of +x [deg]
};

/// [[joint_set]]: parallel joints, through-going or of finite length. Either `spacing` or `p21`.
struct JointSetDef
{
    std::string name;                           ///< "set1", "set2", ... when not given
    double dip_deg = 0.0;                       ///< inclination of the trace to the x axis, positive anticlockwise [deg]
    double spacing = 0.0;                       ///< mean distance between neighbouring joints, across them; 0 with p21 [m]
    double deviation_deg = 0.0;                 ///< each joint's dip is uniform in dip_deg +- deviation_deg
    DistributionDef dip_law;                    ///< of dip_deg, where it is drawn: dip_deg is its mean [deg]
    DistributionDef spacing_law;                ///< of spacing, where it is drawn [m]
    std::optional<DistributionDef> trace;       ///< length of joints that end in the rock [m]
    std::optional<DistributionDef> gap;         ///< between joints on one line [m]
    double p21 = 0.0;                           ///< length of traces an area, instead of spacing and gap; 0 = by these [m/m2]
    std::optional<OrientationDef> orientation;  ///< from which io/ has found dip_deg and the spacing in the section
    std::vector<std::string> stops_at;          ///< names of faults at which joints end
    double persistence = 1.0;                   ///< chance that a block in a joint's path is cut, 0 < p <= 1
    std::optional<Vec2> origin;         ///< one (undeviated) joint passes through this point [m]; default: centre of the domain
    std::optional<std::uint64_t> seed;  ///< of this set's random stream; default: derived from generator.seed and the set's number
    std::string joint;                  ///< name of a [joint.NAME] for contacts on this set's faces; "" = by materials
    std::string region;                 ///< only blocks in the region of this name are cut; "" = all
    std::string outside;                ///< only blocks outside the region of this name are cut; "" = all
};

/// [voronoi]: a part of the domain in cells around random points.
struct VoronoiDef
{
    bool given = false;
    double edge = 0.0;                  ///< mean length of the cells' edges [m]
    int iterations = 5;                 ///< times that points move to the centroids of their cells (Lloyd)
    std::string region;                 ///< name of the region it fills; "" = the domain
    std::string joint;                  ///< name of a [joint.NAME] for contacts between cells; "" = by materials
    std::optional<std::uint64_t> seed;  ///< of its random points; default: derived from generator.seed
};

/// [generator]
struct GeneratorDef
{
    std::uint64_t seed = 1;
    double
        smallest_block_area = 0.0;  ///< a cut that would leave a piece below it is refused; outline pieces below it are merged [m2]
    double smallest_edge = 0.0;     ///< a cut that would leave an edge shorter than this is refused [m]
};

enum class OutlineShape
{
    horseshoe,  ///< rectangle of width x (height - width/2) under a half circle; position = middle of the floor
    circle,     ///< position = centre
    rectangle,  ///< position = middle of the floor
    polygon
};

enum class InsideOutline
{
    jointed,   ///< blocks inside keep the joints that cut them
    one_block  ///< the inside is a single rigid block
};

/// [[excavation]]: an outline cut into the blocks; what lies inside is removed when a stage says so.
struct ExcavationDef
{
    std::string name;
    OutlineShape shape = OutlineShape::polygon;
    Vec2 position = {0.0, 0.0};  ///< [m]
    double width = 0.0;          ///< [m] horseshoe, rectangle
    double height = 0.0;         ///< [m] horseshoe, rectangle
    double diameter = 0.0;       ///< [m] circle
    int arc_segments = 16;       ///< straight edges of the half circle (horseshoe) or circle
    Polygon polygon;             ///< [m]
    InsideOutline inside = InsideOutline::jointed;
};

/// [[block]]: one explicit block.
struct BlockDef
{
    std::string name;  ///< "block1", ... when not given
    Polygon polygon;   ///< simple, convex or concave, any orientation [m]
    std::string material = "rock";
    bool fix_x = false;  ///< the velocity component never changes by forces (it stays at `velocity`)
    bool fix_y = false;
    bool fix_rotation = false;
    Vec2 velocity = {0.0, 0.0};     ///< at the start [m/s]
    double angular_velocity = 0.0;  ///< at the start [rad/s]
};

/// [material.NAME]
struct MaterialDef
{
    std::string name;
    double density = 0.0;  ///< [kg/m3]

    bool operator==(const MaterialDef&) const = default;
};

enum class JointLaw
{
    coulomb,                ///< friction and cohesion; with tension, residual values or dilation: core/joint/coulomb_residual.h
    barton_bandis,          ///< core/joint/barton_bandis.h
    patton,                 ///< core/joint/patton.h
    continuously_yielding,  ///< core/joint/continuously_yielding.h
    plesha,                 ///< core/joint/plesha.h
    saeb_amadei,            ///< core/joint/saeb_amadei.h
    library                 ///< of a shared library: core/joint/user_law.h
};

enum class JointStart
{
    intact,
    broken
};

/// [joint.NAME]: properties of a contact; "default" must exist. Which law takes which numbers: io/case_checks_joint.cpp.
struct JointDef
{
    std::string name;
    JointLaw law = JointLaw::coulomb;
    double normal_stiffness = 0.0;                      ///< [Pa/m]; with normal_exponent e: a of K_N = a sigma^e [Pa^(1-e)/m]
    double shear_stiffness = 0.0;                       ///< [Pa/m]; with shear_exponent likewise
    double friction_angle_deg = 0.0;                    ///< [deg]
    double cohesion = 0.0;                              ///< [Pa]
    std::optional<double> tension;                      ///< T [Pa]
    std::optional<double> residual_friction_angle_deg;  ///< [deg]
    std::optional<double> residual_cohesion;            ///< [Pa]
    std::optional<double> residual_tension;             ///< [Pa]
    std::optional<double> dilation_angle_deg;           ///< [deg]
    std::optional<double> dilation_limit;               ///< slip at which dilation stops [m]
    JointStart initially = JointStart::intact;
    std::optional<double> greatest_closure;  ///< V_m of a hyperbolic normal spring [m]
    std::optional<double> normal_exponent;   ///< e of K_N = a sigma^e [-]
    std::optional<double> shear_exponent;    ///< the same of K_S [-]
    double greatest_stiffness = 1e12;        ///< bound of both [Pa/m]
    std::optional<double> normal_stress;     ///< greatest that is expected [Pa]
    double jrc = 0.0;                        ///< JRC_0 [-]
    double jcs = 0.0;                        ///< JCS_0 [Pa]
    std::optional<double> length;            ///< L, block size along the joint [m]
    double damage = 2.0;                     ///< M [-]
    std::optional<double> rock_strength;     ///< sigma_c of the closure by Bandis [Pa]
    int closure_cycle = 3;                   ///< of loading, 1 to 3
    double asperity_angle_deg = 0.0;         ///< i, alpha_0, i_0 [deg]
    double mobilised_angle_deg = 0.0;        ///< phi_m at first [deg]
    double wear_length = 0.0;                ///< R [m]
    double wear = 0.0;                       ///< C [m2/J]
    double transition_stress = 0.0;          ///< sigma_T [Pa]
    double rock_cohesion = 0.0;              ///< s_0 [Pa]
    double rock_friction_angle_deg = 0.0;    ///< phi_0 [deg]
    double residual_displacement = 0.01;     ///< u_r [m]
    double residual_share = 1.0;             ///< B_0 [-]
    std::string library;                     ///< file of a shared library with the law
    std::vector<double> parameters;          ///< of that law
    JointFunction function = nullptr;        ///< found there by io/
    std::optional<double> restitution;       ///< [-] instead of contact.restitution
    std::vector<std::string> materials;      ///< the two materials this joint lies between; empty: only used by name

    bool operator==(const JointDef&) const = default;
};

// ---- stress at the start --------------------------------------------------------------------------------------------

/// A stress, tension positive [Pa], or how it changes upwards [Pa/m].
struct StressDef
{
    double xx = 0.0;
    double yy = 0.0;
    double xy = 0.0;
};

/// [insitu]: what the rock carries before the first cycle; either `stress` or `surface`.
struct InsituDef
{
    bool given = false;
    std::optional<StressDef> stress;  ///< at y = reference [Pa]
    StressDef gradient;               ///< d/dy [Pa/m]
    double reference = 0.0;           ///< [m]
    std::optional<double> surface;    ///< y of the ground [m]
    std::optional<double> ratio;      ///< of horizontal to vertical stress [-]
    double ratio_offset = 0.0;        ///< horizontal compression besides [Pa]
};

// ---- water ----------------------------------------------------------------------------------------------------------

/// [[water_crack]]: a crack with standing water that seeps out along a plane.
struct WaterCrackDef
{
    Polygon crack;       ///< its points; the last one is its foot [m]
    Polygon outlet;      ///< points from the foot on; at the last one the pressure is 0 [m]
    double level = 0.0;  ///< of the water in the crack, against gravity [m]
};

/// [water]: pressure in the joints and on free faces; its level by `level`, `table` or `pressure`.
struct WaterDef
{
    bool given = false;
    std::optional<double> level;                   ///< against gravity [m]
    Polygon table;                                 ///< points of the water table [m]
    double density = 1000.0;                       ///< [kg/m3]
    std::string pressure;                          ///< CSV file of x, y, pressure
    std::vector<std::array<double, 3>> pressures;  ///< its rows, found by io/ [m], [m], [Pa]
    bool ponded = true;                            ///< presses on free faces below the table too
    std::vector<std::string> joints;               ///< that water gets into; empty: all
    std::vector<std::string> flooded;              ///< excavations that are not drained
};

// ---- as time goes on ------------------------------------------------------------------------------------------------

/// Rows [cycle or time, factor].
using FactorTable = std::vector<std::array<double, 2>>;

enum class TableColumn
{
    cycle,
    time
};

/// By what a load or a side is multiplied as the run goes on; at most one of ramp_cycles, ramp_time, table, table_file.
struct FactorDef
{
    std::optional<Vec2> ramp_cycles;  ///< from and until: the factor grows from 0 to 1
    std::optional<Vec2> ramp_time;    ///< the same [s]
    FactorTable table;                ///< rows; of table_file once io/ has read it
    std::string table_file;           ///< CSV with a heading: cycle,factor or time,factor
    TableColumn table_by = TableColumn::cycle;
    std::string since;  ///< name of a stage at whose start cycles and times are 0; "": the run's
};

// ---- sides ----------------------------------------------------------------------------------------------------------

enum class BoundaryKind
{
    fixed,     ///< blocks with an edge on the side do not move
    roller,    ///< a wall without friction
    stress,    ///< a given traction
    velocity,  ///< a wall that moves as prescribed
    servo      ///< a wall that moves until it presses with a given stress
};

/// [[boundary]]: what holds or presses a side of the domain.
struct BoundaryDef
{
    std::string name;        ///< "boundary1", ... when not given
    std::string side;        ///< of a rectangle: "left", "right", "bottom" or "top"
    std::vector<int> edges;  ///< or of domain.polygon, 0 = first to second vertex
    BoundaryKind kind = BoundaryKind::fixed;
    bool is_insitu = false;              ///< stress: sigma n of [insitu]
    std::optional<Vec2> stress;          ///< or compression, and shear along the side anticlockwise [Pa]
    double target = 0.0;                 ///< servo: compression [Pa]
    std::optional<double> max_velocity;  ///< servo; not given: convergence.mean_speed [m/s]
    Vec2 velocity = {0.0, 0.0};          ///< velocity [m/s]
    std::vector<std::string> stages;     ///< in which it acts; empty: all
    FactorDef factor;                    ///< of stress, velocity, target
};

// ---- support --------------------------------------------------------------------------------------------------------

enum class BoltKind
{
    anchored,  ///< a bar between two points
    grouted,   ///< a bar that is bonded to the rock along its length
    local      ///< an axial and a shear spring at each joint that it crosses
};

/// [[bolt]]: one bolt (from, to), or a pattern around an excavation (around). Forces are those of one bolt; `spacing` divides them per metre.
struct BoltDef
{
    std::string name;  ///< "bolt1", ... when not given
    BoltKind kind = BoltKind::anchored;
    std::optional<Vec2> from;              ///< its head, as drawn [m]
    std::optional<Vec2> to;                ///< [m]
    std::string around;                    ///< or the name of an excavation, around which bolts stand
    double length = 0.0;                   ///< of each bolt around it [m]
    double along = 0.0;                    ///< distance of their heads along the outline [m]
    std::optional<Vec2> arc;               ///< only between these directions, seen from the middle of the outline [deg]
    std::string stage;                     ///< at whose start it is installed; "" = the first
    double spacing = 1.0;                  ///< of bolts out of plane [m]
    double area = 0.0;                     ///< of the bar [m2]
    double modulus = 2e11;                 ///< of the bar [Pa]
    std::optional<double> stiffness;       ///< anchored: instead of E A / L; local: axial [N/m]
    std::optional<double> free_length;     ///< anchored: that stretches; grouted: without bond, from the head on [m]
    double pretension = 0.0;               ///< anchored [N]
    std::optional<double> yield;           ///< axial force at which it yields [N]
    std::optional<double> rupture_strain;  ///< [-]
    double bond_stiffness = 0.0;           ///< grouted [N/m/m]
    double bond_strength = 0.0;            ///< grouted [N/m]
    std::optional<double> segment;         ///< grouted: longest distance of nodes [m]
    bool plate = false;                    ///< grouted: a plate at the head
    double shear_stiffness = 0.0;          ///< local [N/m]
    std::optional<double> shear_strength;  ///< local [N]
    double active_length = 0.0;            ///< local: across a joint [m]
};

/// [[liner]]: beams along the outline of an excavation (around) or along points (path), and what ties them to the rock. Per metre out of plane.
struct LinerDef
{
    std::string name;                            ///< "liner1", ... when not given
    std::string around;                          ///< name of an excavation
    std::optional<Vec2> arc;                     ///< only between these directions, seen from the middle of the outline [deg]
    Polygon path;                                ///< or points with the rock on the right-hand side, as drawn [m]
    std::string stage;                           ///< at whose start it is installed; "" = the first
    double thickness = 0.0;                      ///< [m]
    double modulus = 0.0;                        ///< [Pa]
    std::optional<double> inertia;               ///< second moment of area instead of thickness^3 / 12 [m4/m]
    double density = 2400.0;                     ///< [kg/m3]
    std::optional<double> compressive_strength;  ///< [Pa]
    std::optional<double> tensile_strength;      ///< [Pa]
    std::optional<double> moment_strength;       ///< [N m/m]
    std::optional<double> segment;               ///< longest distance of nodes [m]
    double normal_stiffness = 0.0;               ///< of what ties it to the rock [Pa/m]
    std::optional<double> shear_stiffness;       ///< the same as normal_stiffness when not given [Pa/m]
    double friction_angle_deg = 30.0;            ///< [deg]
    double cohesion = 0.0;                       ///< [Pa]
    double bond_strength = 0.0;                  ///< tension [Pa]
    FactorTable hardening;                       ///< rows: cycles since it was installed, factor of modulus and strengths
    double pressure = 0.0;                       ///< between rock and liner [Pa]
    std::int64_t pressure_cycles = 0;            ///< over which it grows, since it was installed
};

// ---- loads, method, time --------------------------------------------------------------------------------------------

/// From when until when, in cycles or in seconds (both may be open).
struct Interval
{
    std::optional<std::int64_t> from_cycle;
    std::optional<std::int64_t> until_cycle;
    std::optional<double> from_time;   ///< [s]
    std::optional<double> until_time;  ///< [s]
};

/// [[load]]: acts on named blocks.
struct LoadDef
{
    std::vector<std::string> blocks;   ///< names; "*" = all free blocks
    Vec2 acceleration = {0.0, 0.0};    ///< body acceleration [m/s2]
    Vec2 force = {0.0, 0.0};           ///< per metre of thickness [N]
    std::optional<Vec2> point;         ///< of the block as drawn, where the force acts; not given: the centroid [m]
    double moment = 0.0;               ///< [N m]
    std::optional<double> velocity_x;  ///< prescribed, needs the block's x to be fixed [m/s]
    std::optional<double> velocity_y;
    std::optional<double> angular_velocity;
    Interval interval;
    FactorDef factor;  ///< of all of these
};

/// [contact]
struct ContactDef
{
    Method method = Method::hybrid;
    double restitution = 0.1;                  ///< R of Eq. (15) [-]
    std::optional<double> threshold_scale;     ///< C_scale of Eq. (25); not given: Eq. (28)
    std::optional<double> threshold_velocity;  ///< instead of Eq. (25) [m/s]
    bool fixed_mass_counts = false;            ///< fixed blocks keep their mass in m_c of Eqs. (16), (27)
    int impulse_sweeps = 10;
    double correction_fraction = 1.0;  ///< share of the overlap that impulse contacts take back each cycle, Eq. (19)
    double allowed_overlap = 1.0e-7;   ///< overlap that position correction leaves [m]
    double correction_rate =
        0.02;  ///< most of older overlap that is taken back in a second, as a share of the smaller block's size [1/s]
    double length_floor = 1.0e-3;  ///< least contact length, as a share of the smaller block's size [-]
    double overlap_limit = 0.25;   ///< a run stops when an overlap exceeds this share of the smaller block's size [-]
    double recycling_distance =
        1.0e-4;          ///< way after which features are searched anew, as a share of the smaller block's size [-]; 0: every cycle
    double skin = 0.05;  ///< pairs closer than this share of the mean block size are tracked [-]
};

enum class DampingPreset
{
    automatic,  ///< hdem's own: see core/motion/damping.h
    paper,      ///< sect. 3.3 to the letter, and springs that close and open by whole cycles (core/contact/closing.h)
    dynamic     ///< no local damping: exact motion
};

/// [damping]
struct DampingDef
{
    DampingPreset preset = DampingPreset::automatic;
    double local = 0.8;                 ///< alpha of Eqs. (13), (14) [-]
    double global_damping_ratio = 0.0;  ///< xi_g of Eq. (22) [-]
    double average_frequency = 0.0;     ///< omega_avg of Eq. (22) [rad/s]
};

/// [time]
struct TimeDef
{
    std::optional<double> step;    ///< [s]; not given: default_time_step, core/motion/time_step.h
    double fraction = 0.1;         ///< FRAC of Eq. (32) [-]
    double stable_fraction = 0.9;  ///< of the largest stable step, see core/motion/step_control.h [-]
};

// ---- the run --------------------------------------------------------------------------------------------------------

/// Which free blocks are to be at rest.
enum class ConvergenceBlocks
{
    all,
    standing  ///< those that have not moved farther than loose_distance in their stage
};

/// [convergence]
struct ConvergenceDef
{
    ConvergenceBlocks blocks = ConvergenceBlocks::all;
    std::vector<std::string> criteria = {"kinetic_energy", "unbalanced_force_ratio", "every_block"};  ///< all listed must hold
    double mean_speed = 5.0e-4;              ///< kinetic energy of all free blocks at this speed is the limit [m/s]
    double unbalanced_force_ratio = 1.0e-5;  ///< [-]
    double block_unbalanced_ratio = 1.0e-4;  ///< [-]
    double hold_time = 0.025;                ///< they must have held at all checks for so long [s]
    std::int64_t least_cycles = 1000;        ///< not tested earlier in a stage
    std::int64_t check_every = 10;           ///< tested at multiples of this many cycles
    double loose_distance = 0.05;            ///< a block that moved farther in its stage is loose [m]
    double detached_distance = 0.1;          ///< a block that moved farther counts as detached [m]
    std::optional<double> lost_distance;     ///< one farther outside the model has left it; not given: ten times its size [m]
};

/// How a stage that ends at rest looks for it.
enum class RestSolver
{
    statics,  ///< by a static solution where that is possible, then by cycles
    dynamics  ///< by cycles alone
};

/// [[stage]]
struct StageDef
{
    std::string name;
    std::optional<std::int64_t> cycles;  ///< run this many
    std::optional<double> duration;      ///< or this long [s]
    bool until_converged = false;        ///< or until converged, at most max_cycles
    std::vector<StageEndDef> ends;       ///< or until one of these; the first that is met ends the stage
    std::int64_t max_cycles = 1'000'000;
    RestSolver solver = RestSolver::dynamics;
    std::int64_t relax_cycles = 0;         ///< over which the forces of excavated blocks are taken off; 0: at once
    double relax_to = 0.0;                 ///< share of these forces that is left then, until the stage ends [-]
    std::vector<std::string> excavate;     ///< excavation or block names removed at the start of the stage
    std::vector<std::string> fix;          ///< block names fixed at the start
    std::vector<std::string> free;         ///< block names freed at the start
    std::optional<double> water_level;     ///< of [water] from here on [m]
    Polygon water_table;                   ///< or the table [m]
    std::vector<std::string> set;          ///< "joint.NAME.KEY = VALUE", "material.NAME.density = VALUE": numbers from here on
    std::int64_t set_cycles = 0;           ///< over which strengths of joints come to these values; 0: at once
    std::vector<JointDef> joints;          ///< all joints from here on, where `set` changes some; found by io/
    std::vector<MaterialDef> materials;    ///< all materials from here on, likewise
    std::optional<Method> method;          ///< from here on
    std::optional<DampingPreset> damping;  ///< from here on
};

/// What the trials of a strength reduction begin from, where blocks gave way in the last stage.
enum class FactorStart
{
    last_stage,  ///< the stage is run anew under great strength
    last_state   ///< where they lie
};

/// [factor_of_safety]: strength reduction by `hdem fos`, once all stages have run.
struct FactorOfSafetyDef
{
    std::vector<std::string> reduce = {"joints"};  ///< "joints": all; or names of [joint.NAME]
    Vec2 bracket = {0.5, 3.0};                     ///< factors that the search begins with where no bound is known [-]
    double tolerance = 0.01;                       ///< width of the last bracket [-]
    std::optional<double> displacement;            ///< a block that moved farther has failed; not given: core/stage/failure.h [m]
    double least_size = 0.0;                       ///< smaller blocks may fall [m2]
    FactorStart begin = FactorStart::last_stage;
    bool peak = true;              ///< find the factor of the peak strength too, where slip or breaking takes some
    double check_stiffness = 3.0;  ///< look whether the factor is the same with joints that many times as stiff; 1: do not
};

/// [[history]]: quantities sampled every n cycles into results.h5.
struct HistoryDef
{
    std::string name;
    std::string block;  ///< block quantities: displacement, position, velocity, rotation, angular_velocity, force, kinetic_energy
    std::optional<Vec2> point;  ///< or a place: pore_pressure [m]
    std::vector<std::string>
        between;  ///< or contact quantities between two named blocks: normal_force, shear_force, overlap, shear_displacement, contact_length, impulse_points
    std::string bolt;   ///< or quantities of a bolt: axial_force, across_force, greatest_force, elongation
    std::string liner;  ///< or of a liner: thrust, moment, liner_displacement, hinges
    std::vector<std::string> quantities;
    std::int64_t every = 1;  ///< cycles
};

/// [output]
struct OutputDef
{
    std::int64_t row_every = 1000;          ///< cycles between rows on the screen and in run.log, and samples of the energy history
    std::int64_t frame_every = 0;           ///< cycles between frames; 0: at the end of each stage only
    bool contacts = true;                   ///< write contact frames as well
    std::int64_t checkpoint_every = 0;      ///< cycles between checkpoints; 0: by wall time only
    double checkpoint_wall_minutes = 10.0;  ///< of a clock on the wall; 0: by cycles only
};

struct CaseDef
{
    std::string title;
    DomainDef domain;
    TraceCells trace_cells;  ///< what faults, outlines and traces cut the domain into, found by io/; empty without
    std::vector<FaultDef> faults;
    std::vector<RegionDef> regions;
    std::vector<JointSetDef> joint_sets;
    VoronoiDef voronoi;
    GeneratorDef generator;
    std::vector<ExcavationDef> excavations;
    std::vector<BlockDef> blocks;
    std::string blocks_file;  ///< WKT, one POLYGON a line; read by io/ into `blocks`
    std::vector<MaterialDef> materials;
    std::vector<JointDef> joints;
    InsituDef insitu;
    WaterDef water;
    std::vector<WaterCrackDef> water_cracks;
    std::vector<BoundaryDef> boundaries;
    std::vector<BoltDef> bolts;
    std::vector<LinerDef> liners;
    Vec2 gravity = {0.0, -9.81};    ///< [m/s2]
    double gravity_tilt_deg = 0.0;  ///< by which the model is tilted, anticlockwise [deg]
    std::vector<LoadDef> loads;
    ContactDef contact;
    DampingDef damping;
    TimeDef time;
    ConvergenceDef convergence;
    std::vector<StageDef> stages;
    FactorOfSafetyDef factor_of_safety;
    std::vector<HistoryDef> histories;
    OutputDef output;
};
}  // namespace hdem
