#include "io/summary.h"
#include "verification/unit/small_run.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace hdem
{
namespace
{
TEST(Summary, HasAllKeysThatOthersRelyOn)
{
    const test::ScratchFolder folder("summary");
    RunSummary summary{.case_name = "tunnel", .method = "hybrid", .threads = 2, .blocks = 700};
    summary.cycles_after_excavation = 32709;
    summary.detached_blocks = {"b12", "b13"};
    summary.detached_before = {"b7"};
    summary.stages = {{.name = "initial", .cycles = 5000},
                      {.name = "excavated", .cycles = 32709, .sought_rest = true, .at_rest = true}};
    summary.stages[1].statics = StaticResult{.outcome = "balanced", .iterations = 22, .residual = 2e-9, .loose = {"b12"}};
    summary.state_hash = 0xabc;
    summary.thread_use = {.fixed = false, .share = {0.0, 0.25, 0.75}, .changes = {{0, 2}, {7000, 1}}, .trials = 12};
    write_summary(folder / "summary.json", summary);
    const auto json = nlohmann::json::parse(test::text_in(folder / "summary.json"));
    for (const char* key : {"case",
                            "method",
                            "threads",
                            "version",
                            "blocks",
                            "free_blocks",
                            "contact_points",
                            "time_step",
                            "cycles",
                            "converged",
                            "cycles_after_excavation",
                            "kinetic_energy",
                            "mean_displacement",
                            "max_displacement",
                            "met_ends",
                            "detached_blocks",
                            "wall_seconds",
                            "contact_point_updates_per_second",
                            "state_hash",
                            "kinetic_energy_limit",
                            "unbalanced_force_ratio",
                            "stages",
                            "mean_displacement_all",
                            "max_displacement_all",
                            "smallest_block_mass",
                            "paper_time_step",
                            "warnings"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json["case"], "tunnel");
    EXPECT_EQ(json["cycles_after_excavation"], 32709);
    EXPECT_EQ(json["detached_blocks"], (std::vector<std::string>{"b12", "b13"}));
    EXPECT_EQ(json["detached_before"], std::vector<std::string>{"b7"});
    EXPECT_EQ(json["stages"][1]["converged"], true);
    EXPECT_EQ(json["state_hash"], "0000000000000abc");
    EXPECT_TRUE(json["stages"][0]["static_solution"].is_null());
    const auto& use = json["thread_use"];
    EXPECT_EQ(use["rule"], "auto");
    EXPECT_EQ(use["share_of_cycles"], (nlohmann::json{{"1", 0.25}, {"2", 0.75}}));
    EXPECT_EQ(use["changes"][1], (nlohmann::json{{"cycle", 7000}, {"threads", 1}}));
    EXPECT_EQ(use["trials"], 12);
    const auto& statics = json["stages"][1]["static_solution"];
    EXPECT_EQ(statics["outcome"], "balanced");
    EXPECT_EQ(statics["iterations"], 22);
    EXPECT_EQ(statics["unbalanced_force_ratio"], 2e-9);
    EXPECT_EQ(statics["loose_blocks"], std::vector<std::string>{"b12"});
}

TEST(Summary, IsJsonWhateverTheNumbersAndTexts)
{
    RunSummary summary{.title = "broken \xff text \"quoted\""};
    summary.kinetic_energy = std::numeric_limits<double>::quiet_NaN();
    const auto json = nlohmann::json::parse(summary_text(summary));
    EXPECT_TRUE(json["kinetic_energy"].is_null());
    EXPECT_TRUE(json["cycles_after_excavation"].is_null());
}
}  // namespace
}  // namespace hdem
