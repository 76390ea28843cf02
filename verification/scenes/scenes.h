#pragma once
/// Case definitions that the tests and the benchmarks share: what a case file could say, written in C++.
///
/// Every scene has one material `rock` (2700 kg/m3), one joint `default` (7e9 and 5e8 Pa/m, 30 degrees, no cohesion), gravity
/// 9.81 m/s2 downwards, one stage of `cycles` cycles, and otherwise the defaults of CaseDef. The ground, where there is one, is a fixed block
/// called `ground` with its upper face at y = 0. Change what a test needs afterwards: the structs are plain.
///
/// @see verification/unit/scenes_test.cpp

#include "core/model/case_def.h"

namespace hdem::scenes
{
/// No blocks yet.
CaseDef empty_scene(std::int64_t cycles = 1000);

/// Anticlockwise, from its lower left corner [m].
Polygon rectangle(const Vec2& low, const Vec2& high);

/// Add a block; the reference stays valid until the next one is added.
BlockDef& add_block(CaseDef& scene, const std::string& name, const Polygon& polygon);
BlockDef& add_fixed_block(CaseDef& scene, const std::string& name, const Polygon& polygon);

/// `block`, width x height [m], its lower face touching the ground, its centre above x = 0.
CaseDef block_on_ground(double width = 1.0, double height = 1.0);

/// Unit blocks `block1` (lowest) to `blockN` on each other.
CaseDef stack(int n);

/// Running bond of bricks 2 m x 1 m, half a brick of offset from course to course. Bricks are called `c.k`, course c from 1 (lowest),
/// k from 1 (left).
CaseDef wall(int courses, int bricks_per_course);

/// Unit squares `c.r` without gaps, column c and row r from 1, between fixed walls `left` and `right` on the ground.
CaseDef grid(int columns, int rows);

/// Random convex blocks about 1 m across above the ground, in rows of `columns`, between fixed walls, with gaps that gravity
/// will close. The same seed gives the same pile on every platform.
CaseDef pile(int n, int columns, std::uint64_t seed = 1);

/// Voronoi cells of one random point in each of columns x rows unit squares, without gaps; cells at the sides and at the bottom are
/// fixed. The same seed gives the same blocks on every platform.
CaseDef voronoi(int columns, int rows, std::uint64_t seed = 1);

/// Two sets of through-going joints cut width x height [m] of rock: dips of 10 and -80 degrees, both at `spacing` [m]; sides and bottom are
/// fixed. `deviation_deg` scatters the dips, as in rock.
CaseDef joints(double width, double height, double spacing, double deviation_deg = 0.0);
/// Rock that three sets of joints cut, about as the tunnel of the publication stands in.
CaseDef three_joint_sets(double spacing, double friction_angle_deg, double cohesion);

/// The same scene seen from elsewhere: explicit blocks, velocities, gravity and loads turned anticlockwise about the origin, ...
/// @pre no [domain]: the generator has its own axes
CaseDef turned(CaseDef scene, double angle_deg);
/// ... mirrored at the y axis, ...
CaseDef mirrored(CaseDef scene);
/// ... moved.
CaseDef moved(CaseDef scene, const Vec2& by);
}  // namespace hdem::scenes
