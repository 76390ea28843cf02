/// Which corners of the parts of a block lie in a hollow corner of the block.

#include "core/geometry/reflex_vertices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hdem
{
namespace
{
/// A square and a rectangle that lie in line, so that the second one's side goes on straight where the block has its hollow corner. Rounding makes such an angle pi or -pi.
TEST(ReflexVertices, AreFoundWhereASideGoesOnAsASeam)
{
    const std::vector<std::vector<Vec2>> shape{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}},
                                               {{1.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {1.0, 2.0}, {1.0, 1.0}}};
    for (int i = 0; i < 720; ++i)
    {
        const double angle = i * std::numbers::pi / 360.0 + 1e-3;
        std::vector<ConvexPart> parts(2);
        for (std::size_t k = 0; k < 2; ++k)
            for (const Vec2& p : shape[k])
                parts[k].vertices.emplace_back(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                                               std::sin(angle) * p.x() + std::cos(angle) * p.y());
        const std::vector<std::uint8_t> found = reflex_vertices(parts);
        EXPECT_EQ(found, (std::vector<std::uint8_t>{0, 0, 1, 0, 0, 0, 0, 0, 1})) << i;
    }
}

TEST(ReflexVertices, AreNoneInAConvexBlockOfTwoParts)
{
    std::vector<ConvexPart> parts(2);
    parts[0].vertices = {{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
    parts[1].vertices = {{1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}};
    EXPECT_EQ(reflex_vertices(parts), std::vector<std::uint8_t>(8, 0));
}
}  // namespace
}  // namespace hdem
