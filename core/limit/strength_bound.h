#pragma once
/// The factor of safety by limit analysis, from above.

#include "core/model/model.h"
#include "core/state/state.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
/// What the linear programs have found.
struct StrengthBound
{
    enum class End
    {
        found,
        none,  ///< strength does not limit what can be balanced: in-situ stress or geometry may hold the blocks at any F up to `most`
        no_balance,  ///< not even great strength balances the blocks
        not_found    ///< too many blocks, or Clp gave up
    };
    End end = End::not_found;
    double factor = 0.0;  ///< F, where found; `most` where there is none
    int rows = 0, columns = 0, solutions = 0;
    std::string why;  ///< not found
};

/// Forces N (compression) and S at the two ends of each contact that
///
///   balance weight, loads and tractions on every free block (force and moment)
///   are admissible:  N >= -T l / F,  |S| <= c l / F + N tan phi / F;  bolts any within their strength (core/support/bolt_strength.h), which is divided by F
///                    where `weakens_bolts`
///
/// where l is the point's share of the contact length. The greatest F for which there are such forces bounds the factor of safety from above,
/// for any flow rule (Drucker 1954; Livesley 1978): where there are none the rock cannot be at rest. Geometry is that of `state`.
///
/// Each F is one linear program: the greatest share lambda <= 1 of all loads that can be balanced; F stands where lambda = 1. F is found by
/// bisection, each program beginning from the last basis. With c' = c - T tan phi >= 0 the strength is a cone with its tip at -T l and a bounded
/// shear force besides,
///
///   N + T l = a + b,  S = tan phi (b - a) + s,  a, b >= 0,  |s| <= c' l
///
/// so that the program has three rows a block and two or three columns a point. Strength curves of other laws are replaced by their
/// tangent at the present normal stress, which lies above them. Contacts that are open by less than their least length count.
///
/// @param weakened  per [joint.NAME]: is its strength divided by F? Empty: all
/// @see verification/unit/core/limit/strength_bound_test.cpp
[[nodiscard]] StrengthBound strength_bound(const Model& model, const State& state, const std::vector<std::uint8_t>& weakened,
                                           double least, double most, bool weakens_bolts = false);

/// The same where corners that touch a side or a corner bear nothing (force_points). A corner that cannot be crushed holds more than rock
/// does: the tip of a wedge at a bend of its slip surface, for example, stands on the lower plane.
/// @param with_corners  the bound where corners bear; found, or none: then the search begins at its `most`. It is returned if the bound without corners is
/// lower by less than a fiftieth
[[nodiscard]] StrengthBound strength_bound_without_corners(const Model& model, const State& state,
                                                           const std::vector<std::uint8_t>& weakened, double least,
                                                           const StrengthBound& with_corners, bool weakens_bolts = false);
}  // namespace hdem
