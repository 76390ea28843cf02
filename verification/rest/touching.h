#pragma once
/// Where polygons touch, found from their shapes alone: the reference of the rest.* checks, independent of hdem's own contacts.

#include "core/geometry/convex_part.h"
#include "core/types.h"

#include <vector>

namespace hdem::verification::rest
{
/// A body of convex parts; their edges between each other are edge_internal.
struct Body
{
    std::vector<ConvexPart> parts;
    Vec2 centroid = {0.0, 0.0};  ///< [m]
    double mass = 0.0;           ///< [kg per m]
    double inertia = 0.0;        ///< about the centroid [kg m2 per m]
    double radius = 0.0;         ///< of the circle about the centroid that holds it [m]
    bool fixed = false;
};
[[nodiscard]] Body body_of(const Polygon& polygon, double density, bool fixed);

/// A point at which two bodies may push each other, and slip on each other.
struct TouchingPoint
{
    std::size_t first = 0;
    std::size_t second = 0;
    Vec2 place = {0.0, 0.0};   ///< [m]
    Vec2 normal = {0.0, 1.0};  ///< from the first body to the second [-]
    double length = 0.0;       ///< its half of the faces' common length; 0 where a corner touches [m]
};

/// Every point where two bodies are nearer to each other than `gap`, or overlap by at most `depth` [m]. For each edge of a part of one that all of a part of the other lies in
/// front of: the ends of the stretch over which both are that near. Faces that touch give two points, a corner on a face one; a corner on a corner
/// gives a point for each face that may meet it, so that no way to carry a force is left out.
[[nodiscard]] std::vector<TouchingPoint> find_touching(const std::vector<Body>& bodies, double gap, double depth);

/// Depth to which two bodies overlap: the least way that takes two of their parts apart, greatest over the parts; 0 when apart [m].
[[nodiscard]] double overlap_depth(const Body& a, const Body& b);
}  // namespace hdem::verification::rest
