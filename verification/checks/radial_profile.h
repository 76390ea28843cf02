#pragma once
/// Contact stresses along a ray from an opening into the rock, as in Fig. 12 of [Lee2025].

#include "core/model/model.h"
#include "core/state/state.h"

#include <vector>

namespace hdem::verification
{
struct Ray
{
    Vec2 from = {0.0, 0.0};   ///< the opening's centre, in the model's local coordinates [m]
    double angle_deg = 0.0;   ///< from the x axis, anticlockwise
    double begins_at = 0.0;   ///< distance of the opening's boundary from the centre along the ray [m]
    double reaches_to = 0.0;  ///< distance from the centre at which it ends [m]
};

struct StressPoint
{
    double distance = 0.0;  ///< from the centre [m]
    double traction = 0.0;  ///< size of the traction vector, sqrt(F_N^2 + F_S^2) / L [Pa]
    double normal = 0.0;    ///< F_N / L [Pa]
};

/// The closed contacts that the ray crosses, nearest first.
///
///   A contact is the straight stretch between its two points, over which the edges of two blocks face each other. F_N, F_S are
///   the sums over both points, L is the length they bear. The distance is that of the crossing. Contacts of detached blocks carry
///   no rock and are left out.
///
/// The paper draws six such profiles but does not say which contacts belong to one. A crossing needs no width to be chosen, and
/// contacts of corners, whose length is next to nothing, are hardly ever met.
/// @see verification/unit/checks/radial_profile_test.cpp
[[nodiscard]] std::vector<StressPoint> stress_along(const Ray& ray, const Model& model, const State& state);

/// Distance from a point inside of a polygon to where the ray leaves it for good [m].
[[nodiscard]] double distance_to_outline(const Vec2& from, double angle_deg, const Polygon& outline);
}  // namespace hdem::verification
