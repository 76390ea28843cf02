#include "parallel/stage_times.h"
#include "verification/unit/case_run.h"

#include <chrono>

namespace hdem
{
namespace
{
using test::CaseRun;

TEST(StageSamples, ShareOutTheWholeTimeButLeaveSearchesAsTheyWereTimed)
{
    StageSamples samples{.all = 14.0};
    samples.sampled.of(CycleStage::broad) = 2.0;
    samples.sampled.of(CycleStage::force) = 15.0;  // samples may have met the slow cycles
    samples.sampled.of(CycleStage::wait) = 5.0;
    StageTimes times = samples.shared_out();
    EXPECT_DOUBLE_EQ(times.of(CycleStage::broad), 2.0);
    EXPECT_DOUBLE_EQ(times.of(CycleStage::force), 9.0);
    EXPECT_DOUBLE_EQ(times.of(CycleStage::wait), 3.0);
    EXPECT_DOUBLE_EQ(times.total(), 14.0);
}

TEST(StageSamples, SayNothingOfStagesBeforeACycle)
{
    StageSamples samples{.all = 2.5};
    samples.sampled.of(CycleStage::broad) = 2.0;
    EXPECT_EQ(samples.shared_out().total(), 2.0);
}

/// Calls of all lengths: what is not sampled is timed all the same, and nothing twice.
TEST(CycleTimes, AddUpToNoMoreThanTheClockSaysAndToNearlyAllOfIt)
{
    for (const int threads : {1, 3})
    {
        CaseRun run(scenes::wall(30, 30), threads);
        const auto begin = std::chrono::steady_clock::now();
        for (const std::int64_t cycles : {1, 2, 15, 16, 17, 200})
            run.advance(cycles);
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
        ASSERT_EQ(run.simulation.stage_times().size(), static_cast<std::size_t>(threads));
        for (StageTimes& times : run.simulation.stage_times())
        {
            EXPECT_LE(times.total(), seconds);
            if (threads == 1)
            {
                EXPECT_GE(times.total(), 0.5 * seconds)
                    << "the rest looks at the blocks' ways; threads would have to wake up as well";
            }
            EXPECT_GT(times.of(CycleStage::force), 0.0);
        }
    }
}
}  // namespace
}  // namespace hdem
