#pragma once
/// The rock mass of a case: the area that is filled with rock, what cuts it into blocks, what is excavated, single blocks.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include "core/model/distribution_def.h"
#include "core/types.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
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
}  // namespace hdem
