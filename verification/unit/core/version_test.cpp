#include "core/version.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::Not;
using testing::StartsWith;

TEST(Version, NumberHasThreeParts)
{
    EXPECT_THAT(std::string(version().number), MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+"));
}

TEST(Version, CommitIsAFullHashOrUnknown)
{
    EXPECT_THAT(std::string(version().commit), MatchesRegex("[0-9a-f]{40}|unknown"));
}

TEST(Version, FlagsNeverAllowTheCompilerToChangeResults)
{
    EXPECT_THAT(version().flags, HasSubstr("-ffp-contract=off"));
    for (const char* unsafe : {"-ffast-math", "-Ofast", "-funsafe-math-optimizations", "-fassociative-math"})
    {
        EXPECT_THAT(version().flags, Not(HasSubstr(unsafe)));
    }
}

TEST(Version, LineNamesProgramAndCompiler)
{
    EXPECT_THAT(version_line(), StartsWith("hdem " + std::string(version().number)));
    EXPECT_THAT(version_line(), HasSubstr(version().compiler));
}
}  // namespace
}  // namespace hdem
