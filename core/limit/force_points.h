#pragma once
/// What the linear programs of strength_bound begin from: where forces can act between blocks, how strong each point is, and what has to be balanced.

#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/triple.h"

#include <array>
#include <vector>

namespace hdem
{
/// Strength of a point at F = 1.
struct PointStrength
{
    double friction = 0.0;  ///< tan phi
    double cohesion = 0.0;  ///< c l [N]
    double tension = 0.0;   ///< T l [N]
    bool is_weakened = true;

    [[nodiscard]] PointStrength at(double factor) const
    {
        const double f = is_weakened ? factor : 1.0;
        return {friction / f, cohesion / f, tension / f, is_weakened};
    }
};

/// An end of a contact.
struct ForcePoint
{
    std::array<Index, 2> block{};                 ///< ref, inc
    std::array<std::array<double, 3>, 2> normal;  ///< on each block: force and moment over radius of N = 1
    std::array<std::array<double, 3>, 2> shear;
    PointStrength strength;
    bool is_open = false;                   ///< by a gap below the length floor: it bears nothing now
    std::array<int, 3> column{-1, -1, -1};  ///< of the program that it is part of
};

/// The ends of all contacts that can bear, in an order that follows the user's numbers and not places in memory.
/// @param kept          laws that keep their strength
/// @param corners_bear  contacts no longer than the length floor count too, and those of one corner at more than 3 degrees to a side
[[nodiscard]] std::vector<ForcePoint> force_points(const Model& model, const State& state, const std::vector<Index>& kept,
                                                   bool corners_bear);

/// Share of open points in the cohesion between these blocks and all others [-]. Limit analysis counts it, although open points have none now.
/// @param users  the user's numbers
[[nodiscard]] double open_share_of_cohesion(const Model& model, const State& state, const std::vector<Index>& users);

/// Weight, loads as they act now, and tractions on each block: forces, and the moment over the block's radius [N].
[[nodiscard]] std::vector<Triple> loads_to_balance(const Model& model, const State& state);
}  // namespace hdem
