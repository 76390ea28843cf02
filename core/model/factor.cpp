#include "core/model/factor.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
std::int64_t whole(double cycle)
{
    return cycle < 9.0e18 ? static_cast<std::int64_t>(cycle) : std::numeric_limits<std::int64_t>::max();
}
}  // namespace

double Factor::at(std::int64_t cycles, double step) const
{
    if (rows.empty())
        return 1.0;
    const double now = cycles < 0 ? rows.front()[0] : static_cast<double>(cycles) * (is_by_time ? step : 1.0);
    const auto next = std::ranges::upper_bound(rows, now, {}, [](const auto& row) { return row[0]; });
    if (next == rows.begin())
        return rows.front()[1];
    if (next == rows.end())
        return rows.back()[1];
    const auto& [x0, y0] = *(next - 1);
    const auto& [x1, y1] = *next;
    return y0 + (y1 - y0) * ((now - x0) / (x1 - x0));
}

std::int64_t Factor::first_cycle(double step) const
{
    return whole(std::floor(rows.front()[0] / (is_by_time ? step : 1.0)));
}

std::int64_t Factor::last_cycle(double step) const
{
    return whole(std::ceil(rows.back()[0] / (is_by_time ? step : 1.0)));
}

Factor factor_of(const FactorDef& def, const std::vector<StageDef>& stages)
{
    Factor factor{.rows = def.table, .is_by_time = def.table_by == TableColumn::time};
    if (const std::optional<Vec2>& ramp = def.ramp_cycles ? def.ramp_cycles : def.ramp_time; ramp)
    {
        factor.rows = {{ramp->x(), 0.0}, {ramp->y(), 1.0}};
        factor.is_by_time = !def.ramp_cycles;
    }
    if (const auto stage = std::ranges::find(stages, def.since, &StageDef::name); !def.since.empty() && stage != stages.end())
        factor.since = static_cast<Index>(stage - stages.begin());
    return factor;
}
}  // namespace hdem
