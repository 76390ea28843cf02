#pragma once
/// Direct shear of one joint whose sides are cut into pieces.

#include "verification/scenes/scenes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace hdem::scenes
{
/// Which side of the joint is in pieces.
enum class Cut
{
    base,
    top
};

/// A move of the box at constant speed, and a rest.
struct Move
{
    double way = 0.0;  ///< [m]
    std::int64_t cycles = 0, rest = 0;
};

inline constexpr double box_width = 2.0;       ///< [m]
inline constexpr double box_pressure = 1.0e6;  ///< [Pa]

/// Name of a piece of the box, counted from 0 on the left.
[[nodiscard]] std::string top_name(int i);

/// A box of 2 m under 1 MPa, `top0` and so on, on a base that is longer than it; one of them in pieces. Force-based, without gravity.
[[nodiscard]] CaseDef shear_box(const JointDef& joint, Cut cut, int pieces, double step, const std::vector<Move>& moves);

/// Moves to 2, 5, 0 and -5 mm, after a rest; the last micrometres slowly, so that what trembles has died down. Each of the four is three moves.
[[nodiscard]] std::vector<Move> slow_moves();

/// Ten times 5 mm to the right, to the left and back, fast.
[[nodiscard]] std::vector<Move> ten_fast_reversals();
}  // namespace hdem::scenes
