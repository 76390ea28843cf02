#pragma once
/// Contacts that are fast and still keep their springs: see RegimeRule. Not inline: few contacts are fast, and inline code would make the force law
/// longer for all.

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

/// Does standing rock keep its springs? Yes, unless a loose block would press them by more than they bear,
///
///   v sqrt(m / (K_N L))        m: of the loose block
///
/// or has made it faster than by a fall through its own size.
bool does_rock_keep_springs(const PressedPair& pair, const Model& model, const Blocks& blocks);

/// Does a corner on a corner (a contact shorter than two length floors) keep its springs? Yes, if both blocks lie where they were.
bool do_corners_keep_springs(const PressedPair& pair, const Model& model, const Blocks& blocks);
}  // namespace hdem
