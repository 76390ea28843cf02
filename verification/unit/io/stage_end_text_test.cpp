#include "io/stage_end_text.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

StageEndDef end_of(const std::string& text)
{
    const ReadStageEnd read = read_stage_end(text);
    EXPECT_EQ(read.why, "") << text;
    return read.end;
}

TEST(StageEndText, SaysWhatIsWatchedAndTheLimit)
{
    const StageEndDef moved = end_of("displacement:slab, b17 > 0.1");
    EXPECT_EQ(moved.quantity, EndQuantity::displacement);
    EXPECT_THAT(moved.blocks, ElementsAre("slab", "b17"));
    EXPECT_EQ(moved.test, EndTest::above);
    EXPECT_EQ(moved.limit, 0.1);
    EXPECT_FALSE(moved.is_settling());
    EXPECT_THAT(end_of("displacement>=2.5e-3").blocks, IsEmpty());
    EXPECT_EQ(end_of("displacement>=2.5e-3").limit, 2.5e-3);
    EXPECT_THAT(end_of("displacement:* > 1").blocks, IsEmpty());
    EXPECT_THAT(end_of("displacement:left wall: top > 1").blocks, ElementsAre("left wall: top"));
    EXPECT_THAT(end_of("speed:within > 1").blocks, ElementsAre("within"));

    const StageEndDef force = end_of("history:my prop.normal_force < -1e6 for 20 cycles");
    EXPECT_EQ(force.history, "my prop");
    EXPECT_EQ(force.column, "normal_force");
    EXPECT_EQ(force.limit, -1e6);
    EXPECT_EQ(force.for_cycles, 20);
    EXPECT_FALSE(force.is_settling()) << "a force that falls as a load acts";
}

TEST(StageEndText, SaysForHowLong)
{
    const StageEndDef quiet = end_of("quiet for 0.5 s");
    EXPECT_EQ(quiet.quantity, EndQuantity::quiet);
    EXPECT_EQ(quiet.test, EndTest::nothing);
    EXPECT_EQ(quiet.for_time, 0.5);
    EXPECT_TRUE(quiet.is_settling());
    const StageEndDef band = end_of("history:h.speed within 1e-6 for 300 cycles");
    EXPECT_EQ(band.test, EndTest::within);
    EXPECT_EQ(band.limit, 1e-6);
    EXPECT_EQ(band.for_cycles, 300);
    EXPECT_TRUE(end_of("speed < 1e-4").is_settling());
    EXPECT_TRUE(end_of("time > 2").is_by_clock());
}

TEST(StageEndText, SaysWhatIsWrong)
{
    const struct
    {
        const char* text;
        const char* why;
    } wrong[] = {{"", "is no end of a stage"},
                 {"convergd", "no end of a stage is called convergd"},
                 {"displacement", "has no limit"},
                 {"displacement >", "is no end of a stage"},
                 {"displacement: > 1", "names no block"},
                 {"displacement:a,,b > 1", "names no block"},
                 {"displacement < 1", "it is 0 when the stage begins"},
                 {"displacement > 0", "not above 0"},
                 {"displacement > -1", "not above 0"},
                 {"displacement > 1e999", "no finite number"},
                 {"displacement > 1 m", "is no end of a stage"},
                 {"displacement within 1", "for how long"},
                 {"displacement > nan", "is no end of a stage"},
                 {"converged for 0.1 s", "takes no limit and no time"},
                 {"converged > 1", "takes no limit and no time"},
                 {"velocity > 1", "no end of a stage is called velocity"},
                 {"time < 1", "time only grows"},
                 {"unbalanced_force_ratio > 1", "it is great when the stage begins"},
                 {"time > 1 for 2 s", "passes its limit once"},
                 {"time:a > 1", "that of the whole model"},
                 {"quiet", "for how long"},
                 {"quiet > 1 for 1 s", "has no limit"},
                 {"quiet for 0 s", "above 0"},
                 {"quiet for 1.5 cycles", "whole numbers"},
                 {"quiet for 1 min", "is no end of a stage"},
                 {"history > 1", "which history"},
                 {"history:a > 1", "which history"},
                 {"history:.x > 1", "which history"}};
    for (const auto& [text, why] : wrong)
    {
        EXPECT_THAT(read_stage_end(text).why, HasSubstr(why)) << text;
        EXPECT_FALSE(read_stage_end(text).remedy.empty()) << text;
    }
    EXPECT_THAT(read_stage_end("convergd").remedy, HasSubstr("\"converged\", \"displacement:block1 > 0.1\""));
    EXPECT_THAT(read_stage_end(std::string(100'000, 'a')).why, HasSubstr("is no end")) << "does not exhaust the stack";
}
}  // namespace
}  // namespace hdem
