#include "core/detection/cell_list.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>

namespace hdem
{
namespace
{
std::vector<std::uint64_t> by_brute_force(const std::vector<Box>& boxes)
{
    std::vector<std::uint64_t> pairs;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j)
            if (!is_empty(boxes[i]) && !is_empty(boxes[j]) && boxes[i].meets(boxes[j]))
                pairs.push_back(pair_key(static_cast<Index>(i), static_cast<Index>(j)));
    return pairs;
}

std::vector<std::uint64_t> by_cells(const std::vector<Box>& boxes)
{
    CellList cells;
    cells.build(boxes);
    std::vector<std::uint64_t> pairs;
    cells.find_pairs({0, static_cast<Index>(boxes.size())}, pairs);
    return pairs;
}

/// Every overlapping pair, each once: equal after sorting to what brute force finds.
bool agrees_with_brute_force(const std::vector<Box>& boxes)
{
    std::vector<std::uint64_t> found = by_cells(boxes);
    std::sort(found.begin(), found.end());
    return found == by_brute_force(boxes);
}

double number(double low, double high)
{
    return low + (high - low) * 1e-6 * *rc::gen::inRange(0, 1000001);
}

Box box_at(const Vec2& centre, double width, double height)
{
    return {centre - 0.5 * Vec2(width, height), centre + 0.5 * Vec2(width, height)};
}

std::vector<Box> random_boxes(double spread, int orders_of_magnitude)
{
    std::vector<Box> boxes(*rc::gen::inRange(0, 120));
    for (Box& box : boxes)
    {
        const double size = std::pow(10.0, -number(0.0, orders_of_magnitude));
        box = box_at({number(-spread, spread), number(-spread, spread)}, size, size * number(0.1, 1.0));
    }
    return boxes;
}

RC_GTEST_PROP(CellList, FindsThePairsOfBoxesOfOneSize, ())
{
    RC_ASSERT(agrees_with_brute_force(random_boxes(3.0, 0)));
}

RC_GTEST_PROP(CellList, FindsThePairsOfSizesFromOneToAThousand, ())
{
    RC_ASSERT(agrees_with_brute_force(random_boxes(1.0, 3)));
}

RC_GTEST_PROP(CellList, FindsThePairsInClustersFarApart, ())
{
    std::vector<Box> boxes = random_boxes(0.3, 2);
    for (std::size_t i = 0; i < boxes.size(); ++i)
    {
        const Vec2 cluster = i % 3 == 0 ? Vec2(0, 0) : (i % 3 == 1 ? Vec2(1e9, -1e9) : Vec2(-1e6, 3.0));
        boxes[i] = {boxes[i].low + cluster, boxes[i].high + cluster};
    }
    RC_ASSERT(agrees_with_brute_force(boxes));
}

RC_GTEST_PROP(CellList, LeavesEmptyBoxesOutAndTakesPointsAndTouchingBoxes, ())
{
    std::vector<Box> boxes;
    const int n = *rc::gen::inRange(0, 60);
    for (int i = 0; i < n; ++i)
    {
        const Vec2 corner(*rc::gen::inRange(-4, 5), *rc::gen::inRange(-4, 5));  // integers: many exact touches
        const Vec2 size(*rc::gen::inRange(0, 3), *rc::gen::inRange(0, 3));
        boxes.push_back(*rc::gen::inRange(0, 5) == 0 ? empty_box : Box{corner, corner + size});
    }
    RC_ASSERT(agrees_with_brute_force(boxes));
}

TEST(CellList, GivesNoPairsForNothing)
{
    EXPECT_TRUE(by_cells({}).empty());
    EXPECT_TRUE(by_cells({empty_box, empty_box}).empty());
    EXPECT_TRUE(by_cells({box_at({0, 0}, 1, 1)}).empty());
}

TEST(CellList, PairsAThousandFoldLargerBoxWithEverythingInIt)
{
    std::vector<Box> boxes = {box_at({0, 0}, 1000, 1000)};
    for (int i = 0; i < 200; ++i)
        boxes.push_back(box_at({-400.0 + 4.0 * i, 3.0 * i - 300.0}, 1.0, 1.0));
    EXPECT_EQ(by_cells(boxes).size(), 200u);
}

/// Positions that are not numbers must neither crash nor hang nor meet anything; the run's check names their block.
TEST(CellList, LeavesOutBoxesThatAreNotNumbers)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Box> boxes = {box_at({0, 0}, 1, 1), {{nan, nan}, {nan, nan}}, box_at({0.5, 0}, 1, 1), {{0, nan}, {1, nan}}};
    EXPECT_EQ(by_cells(boxes), std::vector<std::uint64_t>{pair_key(0, 2)});
}

TEST(CellList, SurvivesBoxesBeyondAllCells)
{
    std::vector<Box> boxes = {box_at({0, 0}, 1e-3, 1e-3), box_at({0, 0}, 1, 1), box_at({1e30, -1e30}, 1, 1),
                              box_at({1e30, 1e30}, 1, 1)};
    EXPECT_TRUE(agrees_with_brute_force(boxes));
}

RC_GTEST_PROP(CellList, GivesTheSameOrderHoweverTheRangesAreCut, ())
{
    const std::vector<Box> boxes = random_boxes(1.0, 2);
    const auto n = static_cast<Index>(boxes.size());
    CellList cells;
    cells.build(boxes);
    const Index cut = *rc::gen::inRange(0, n + 1);
    std::vector<std::uint64_t> pairs;
    cells.find_pairs({0, cut}, pairs);
    cells.find_pairs({cut, n}, pairs);
    RC_ASSERT(pairs == by_cells(boxes));
}

RC_GTEST_PROP(PairKey, HoldsBothNumbersAndSortsByTheFirst, (std::uint32_t x, std::uint32_t y))
{
    const auto i = static_cast<Index>(x >> 1), j = static_cast<Index>(y >> 1);
    const std::uint64_t key = pair_key(i, j);
    RC_ASSERT(first_of(key) == i && second_of(key) == j);
    RC_ASSERT(i >= std::numeric_limits<Index>::max() - 1 || key < pair_key(i + 1, 0));
}
}  // namespace
}  // namespace hdem
