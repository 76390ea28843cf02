#pragma once
/// Loads of a case: what acts on named blocks, and when.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include "core/model/factor_def.h"
#include "core/types.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
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
    std::string name;
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
}  // namespace hdem
