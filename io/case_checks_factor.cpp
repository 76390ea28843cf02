#include "io/case_check.h"
#include "io/factor_table.h"

#include <array>

namespace hdem
{
namespace
{
constexpr std::array ways = {"ramp_cycles", "ramp_time", "table", "table_file"};
}  // namespace

void CaseCheck::check_factor(const FactorDef& factor, const std::string& path, const std::string& object)
{
    for (std::size_t i = 0; i < ways.size(); ++i)
        for (std::size_t k = i + 1; k < ways.size(); ++k)
            exclude(path, object, ways[i], ways[k]);
    const auto check_ramp = [&](const std::optional<Vec2>& ramp, const char* key, const char* unit)
    {
        if (ramp && ramp->y() <= ramp->x())
            problems_.add(path + "." + key, object, fmt::format("{} = [{}, {}]{}", key, ramp->x(), ramp->y(), unit),
                          "it ends before it begins", "Give a greater second number.");
    };
    check_ramp(factor.ramp_cycles, "ramp_cycles", "");
    check_ramp(factor.ramp_time, "ramp_time", " s");
    if (given(path + ".table_by") && !given(path + ".table"))
        problems_.add(path + ".table_by", object, "table_by", "belongs to table, which is not given",
                      "Give table, or remove this key.");
    if (const std::size_t row = first_unsorted(factor.table); row > 0 && given(path + ".table") && !problems_.has(path + ".table"))
        problems_.add(path + ".table", object, fmt::format("table[{}] = [{}, {}]", row, factor.table[row][0], factor.table[row][1]),
                      fmt::format("it comes after {}", factor.table[row - 1][0]),
                      "Sort the rows, and keep one for each cycle or time.");
    if (!factor.since.empty())
        check_reference(path + ".since", object, factor.since, "stage", stages_);
}
}  // namespace hdem
