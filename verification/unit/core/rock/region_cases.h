#pragma once
/// Cases with faults and regions, as the tests of both read them.

#include "core/geometry/unit_direction.h"
#include "core/rock/fault_lines.h"
#include "core/rock/rock_mass.h"
#include "io/traces.h"
#include "verification/unit/io/case_text.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace hdem::test
{
inline const std::string laws = R"([material.rock]
density = 2700.0
[material.shale]
density = 2400.0
[joint.default]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 30.0
[joint.fault]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 10.0
[joint.bedding]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 20.0
[joint.in_shale]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 15.0
materials = ["shale", "shale"]
[[stage]]
cycles = 1
)";

inline const std::string square = "[domain]\npolygon = [[0, 0], [4, 0], [4, 4], [0, 4]]\n";

/// A fault half way up; joints a metre apart above it, which stand upright.
inline const std::string two_halves = square + R"([[fault]]
name = "main"
points = [[-1, 2], [5, 2]]
joint = "fault"
[[region]]
name = "upper"
above = "main"
[[joint_set]]
name = "columns"
dip_deg = 90.0
spacing = 1.0
origin = [0, 0]
joint = "bedding"
region = "upper"
)" + laws;

/// Shale of 2 m in the middle, in two beds; the rock around it is parted by one upright joint.
inline const std::string lens = square + R"([[region]]
name = "lens"
polygon = [[1, 1], [3, 1], [3, 3], [1, 3]]
material = "shale"
joint = "bedding"
[[joint_set]]
name = "beds"
dip_deg = 0.0
spacing = 1.0
origin = [0, 0]
region = "lens"
[[joint_set]]
name = "upright"
dip_deg = 90.0
spacing = 2.0
origin = [0, 0]
outside = "lens"
)" + laws;

inline Vec2 turned(const Vec2& p, const Vec2& by)
{
    return {by.x() * p.x() - by.y() * p.y(), by.y() * p.x() + by.x() * p.y()};
}

inline void turn_all(Polygon& points, const Vec2& by)
{
    for (Vec2& p : points)
        p = turned(p, by);
}

/// The case with all of its geometry turned about the origin.
inline CaseDef case_of(const std::string& text, double turn_deg = 0.0)
{
    CaseDef def = read(text);
    if (turn_deg == 0.0)
        return def;
    const Vec2 by = unit_direction(turn_deg);
    turn_all(def.domain.polygon, by);
    for (FaultDef& fault : def.faults)
        turn_all(fault.points, by);
    for (RegionDef& region : def.regions)
        turn_all(region.polygon, by);
    for (ExcavationDef& excavation : def.excavations)
        excavation.position = turned(excavation.position, by);
    for (JointSetDef& set : def.joint_sets)
    {
        set.dip_deg += turn_deg;
        if (set.origin)
            set.origin = turned(*set.origin, by);
    }
    def.trace_cells = cut_into_cells(def.domain.polygon, {}, 0.0, source_lines(def));
    return def;
}

/// Areas of the blocks of a material, in increasing order [m²].
inline std::vector<double> areas(const RockMass& rock, const std::string& material)
{
    std::vector<double> found;
    for (const RockBlock& block : rock.blocks)
        if (block.material == material)
            found.push_back(std::round(area(block) * 1e6) * 1e-6);
    std::sort(found.begin(), found.end());
    return found;
}
}  // namespace hdem::test
