#include "io/printable.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
TEST(Printable, KeepsTextsAsTheyAre)
{
    for (const char* text : {"", "Tunnel 3\n\twith tabs",
                             "Gr\xc3\xb6\xc3\x9f"
                             "e \xe2\x82\xac \xe5\xb2\xa9 \xf0\x9f\xaa\xa8"})
        EXPECT_EQ(printable(text), text);
}

TEST(Printable, ShowsControlCharactersByTheirCodes)
{
    EXPECT_EQ(printable("\x1b[31m red"), "\\x1b[31m red");
    EXPECT_EQ(printable("a\rb\ac\x7f"), "a\\x0db\\x07c\\x7f");
    EXPECT_EQ(printable("\xc2\x9b"
                        "2J"),
              "\\x9b2J");  // the C1 form of ESC [
    EXPECT_EQ(printable("\xe2\x80\xae"
                        "abc\xe2\x81\xa6"),
              "\\u202eabc\\u2066");  // turns the direction of writing
}

TEST(Printable, ShowsBytesThatAreNotUtf8)
{
    EXPECT_EQ(printable("\x9b"
                        "2J\xff"),
              "\\x9b2J\\xff");
    EXPECT_EQ(printable("\xc3"), "\\xc3");           // ends too early
    EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");  // a longer form than needed
    EXPECT_EQ(printable("\xe2\x82"
                        "a"),
              "\\xe2\\x82"
              "a");
}
}  // namespace
}  // namespace hdem
