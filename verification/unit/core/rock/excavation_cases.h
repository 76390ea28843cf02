#pragma once
/// Excavations in jointed rock, for the tests of what is cut and joined around them.

#include "core/rock/excavation.h"
#include "verification/unit/core/rock/rock_invariants.h"

#include <string>

namespace hdem::test
{
inline ExcavationDef excavation(const std::string& name, OutlineShape shape, const Vec2& position, double width, double height)
{
    ExcavationDef def;
    def.name = name;
    def.shape = shape;
    def.position = position;
    def.width = width;
    def.height = height;
    def.diameter = width;
    return def;
}

/// 20 m x 18 m with three joint sets.
inline CaseDef rock_case(std::uint64_t seed = 1)
{
    return jointed_case(20.0, 18.0, {{-10.0, 1.7}, {70.0, 1.7}, {-75.0, 3.5}}, seed);
}

/// Area of the blocks in the excavation of this number [m²].
inline double area_inside(const RockMass& rock, Index number)
{
    double sum = 0.0;
    for (const RockBlock& block : rock.blocks)
    {
        sum += block.excavation == number ? area(block) : 0.0;
    }
    return sum;
}
}  // namespace hdem::test
