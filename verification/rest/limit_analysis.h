#pragma once
/// Limit analysis of rigid bodies with Coulomb contacts, by linear programming.

#include "verification/rest/touching.h"

#include <Eigen/Core>

#include <optional>

namespace hdem::verification::rest
{
/// |S| <= N tan(phi) + c l, N >= 0 at each point.
struct Strength
{
    double friction = 0.0;  ///< tan(phi) [-]
    double cohesion = 0.0;  ///< [Pa]
};

/// Force and moment about the centroid, one per body [N, N, N m].
using Loads = std::vector<Eigen::Vector3d>;
/// Weights of the free bodies; 0 for fixed ones.
[[nodiscard]] Loads weights(const std::vector<Body>& bodies, const Vec2& gravity);

/// Static theorem: forces N, S at the points that are admissible (no tension, Coulomb's cone) and balance every free body. Where there are
/// none the bodies cannot be at rest, whatever the flow rule. Where there are some they may be: with friction that does not dilate, the greatest load
/// that has such forces is only an upper bound of the one that is carried [Drucker 1954; Livesley 1978].
///
/// @return  the least s for which such forces leave no free body out of balance by more than s of its weight, |F_x|, |F_y|, |M| / radius <= s m |g|:
///          0 where forces balance all of it; 1 for a body that hangs in the air. Bodies of less than light_share of the heaviest weight count as if they had that
inline constexpr double light_share = 1e-4;
[[nodiscard]] double least_unbalance(const std::vector<Body>& bodies, const std::vector<TouchingPoint>& points,
                                     const Strength& strength, const Vec2& gravity);

/// Greatest lambda for which admissible forces balance dead + lambda live; infinite if any; nothing if not even dead alone is balanced.
[[nodiscard]] std::optional<double> load_multiplier(const std::vector<Body>& bodies, const std::vector<TouchingPoint>& points,
                                                    const Strength& strength, const Loads& dead, const Loads& live);

/// Factor by which friction and cohesion may be divided until no forces balance the weights any more; at most `most`, 0 if they do not at all: below 1 the bodies
/// certainly move.
[[nodiscard]] double strength_factor(const std::vector<Body>& bodies, const std::vector<TouchingPoint>& points,
                                     const Strength& strength, const Vec2& gravity, double most = 8.0);
}  // namespace hdem::verification::rest
