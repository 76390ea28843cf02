#include "core/geometry/convex_decomposition.h"
#include "core/geometry/hole_joining.h"
#include "core/geometry/unit_direction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace hdem
{
namespace
{
/// @param mirrored  the ring runs the other way around then
CutPolygon turned(Polygon ring, int degrees, bool mirrored)
{
    const Vec2 by = unit_direction(degrees);
    if (mirrored)
    {
        for (Vec2& p : ring)
            p.x() = 10.0 - p.x();
        std::ranges::reverse(ring);
    }
    for (Vec2& p : ring)
        p = {by.x() * p.x() - by.y() * p.y(), by.y() * p.x() + by.x() * p.y()};
    const std::size_t n = ring.size();
    return {std::move(ring), std::vector<EdgeTag>(n)};
}

/// Triangles that hang on each other in corners, in two chains from corners of a square.
TEST(HolesThatTouch, LeaveConvexPartsBesideEachOther)
{
    const Polygon square = {{0, 0}, {5, 0}, {10, 0}, {10, 10}, {5, 10}, {0, 10}};
    const std::vector<Polygon> triangles = {{{5, 0}, {6, 1}, {4, 1}}, {{4, 1}, {3, 3}, {2, 2}},  {{6, 1}, {8, 2}, {7, 3}},
                                            {{3, 3}, {4, 5}, {3, 5}}, {{7, 3}, {8, 5}, {6, 5}},  {{3, 5}, {4, 7}, {2, 7}},
                                            {{8, 5}, {9, 7}, {8, 7}}, {{5, 10}, {6, 9}, {4, 9}}, {{4, 9}, {3, 8}, {2, 9}}};
    double area = 100.0;
    for (const Polygon& triangle : triangles)
        area -= std::abs(signed_area(triangle));
    for (int copy = 0; copy < 72; ++copy)
    {
        const int degrees = copy % 36 * 10;
        const bool mirrored = copy >= 36;
        std::vector<CutPolygon> holes;
        for (Polygon triangle : triangles)
        {
            if (signed_area(triangle) > 0.0)
                std::ranges::reverse(triangle);
            holes.push_back(turned(triangle, degrees, mirrored));
        }
        const std::optional<CutPolygon> whole = join_holes(turned(square, degrees, mirrored), holes);
        ASSERT_TRUE(whole.has_value()) << copy;
        double sum = 0.0;
        for (const CutPolygon& part : convex_parts(*whole))
        {
            EXPECT_GT(signed_area(part.vertices), 1e-12) << copy;
            sum += std::abs(signed_area(part.vertices));
        }
        EXPECT_NEAR(sum, area, 1e-9) << copy;
    }
}
}  // namespace
}  // namespace hdem
