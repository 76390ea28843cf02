#pragma once
/// Contacts that are fast and keep their springs all the same: see RegimeRule. Out of line: few contacts are fast, and in line
/// this made the force law longer for all.

#include "core/model/model.h"
#include "core/state/blocks.h"

namespace hdem
{
/// A contact that is faster than the threshold velocity.
struct PressedPair
{
    Index ref;
    Index inc;
    double stiffness;      ///< of both its points, K_N L [N/m]
    double speed_squared;  ///< of the faster closed point [m2/s2]
};

/// Standing rock does, unless a loose block would press its springs by more than they bear,
///
///   v sqrt(m / (K_N L))        m: of the loose block
///
/// or has made it faster than by a fall through its own size.
bool does_rock_keep_springs(const PressedPair& pair, const Model& model, const Blocks& blocks);

/// Corners on corners do, contacts shorter than two length floors: where both blocks lie as drawn.
bool do_corners_keep_springs(const PressedPair& pair, const Model& model, const Blocks& blocks);
}  // namespace hdem
