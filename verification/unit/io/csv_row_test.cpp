#include "io/csv_row.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using testing::ElementsAre;

TEST(CsvRow, IsCutAtCommasOutsideOfQuotes)
{
    EXPECT_THAT(csv_columns("bench, 1.5 ,-2"), ElementsAre("bench", "1.5", "-2"));
    EXPECT_THAT(csv_columns(R"("bench","1,5", "say ""no""" ,)"), ElementsAre("bench", "1,5", "say \"no\"", ""));
    EXPECT_THAT(csv_columns(R"(0,"open)"), ElementsAre("0", "open"));
    EXPECT_THAT(csv_columns(""), ElementsAre(""));
    EXPECT_THAT(csv_columns(R"("a"b,c)"), ElementsAre("ab", "c"));
}

TEST(CsvRow, HasNumbersThatFillTheirColumn)
{
    double x = 0.0;
    EXPECT_TRUE(read_csv_number("-1.5e3", x));
    EXPECT_EQ(x, -1500.0);
    for (const char* text : {"", "x", "1 m", "1,5", "nan", "1e999"})
        EXPECT_FALSE(read_csv_number(text, x)) << text;
}

/// Columns are read by their place: a heading that says another order, or another unit, is none.
TEST(CsvRow, IsAHeadingWithTheRightNamesInTheRightOrder)
{
    const std::vector<CsvColumn> names = {{"x", "m"}, {"y", "m"}, {"pressure", "Pa"}};
    const auto is_heading = [&](std::string_view row) { return is_csv_heading(csv_columns(row), names); };
    for (const char* row : {"x,y,pressure", "X,Y,Pressure", "x [m], y [m], pressure (Pa)", R"("x","y","pressure")", "x,y"})
        EXPECT_TRUE(is_heading(row)) << row;
    for (const char* row : {"y,x,pressure", "x,y,head", "x,y,pressure [kPa]", "x,y,pressure,more", "xx,y,pressure", "1,2,3"})
        EXPECT_FALSE(is_heading(row)) << row;
}

TEST(FileNames, HaveEndingsInCapitalsToo)
{
    EXPECT_TRUE(has_ending("MAP.CSV", ".csv"));
    EXPECT_FALSE(has_ending("csv", ".csv"));
    EXPECT_FALSE(has_ending("map.csv.wkt", ".csv"));
}
}  // namespace
}  // namespace hdem
