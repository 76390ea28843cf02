#pragma once
/// Factor of a load or a side in the course of a run.

#include "core/model/factor_def.h"
#include "core/model/stage_def.h"

#include <cstdint>

namespace hdem
{
/// Linear between its rows, constant before the first and after the last.
struct Factor
{
    FactorTable rows;         ///< ascending; empty: always 1
    bool is_by_time = false;  ///< the first column is in seconds, else in cycles
    Index since = no_index;   ///< stage at whose start the first column is 0; no_index: at the start of the run

    [[nodiscard]] bool varies() const { return !rows.empty(); }

    /// @param cycles  since then; below 0: that stage has not begun
    /// @param step    [s] a cycle, of rows by time
    [[nodiscard]] double at(std::int64_t cycles, double step) const;

    /// First and last of the cycles in which it changes.
    [[nodiscard]] std::int64_t first_cycle(double step) const;
    [[nodiscard]] std::int64_t last_cycle(double step) const;
};

/// The factor that a case gives, with its stage by number.
[[nodiscard]] Factor factor_of(const FactorDef& def, const std::vector<StageDef>& stages);
}  // namespace hdem
