#pragma once
/// How loads and sides of a case change as the run goes on.
/// Part of CaseDef (case_def.h): plain structs with defaults; SI units, angles in degrees where the name ends in _deg.

#include "core/types.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hdem
{
/// Rows [cycle or time, factor].
using FactorTable = std::vector<std::array<double, 2>>;

enum class TableColumn
{
    cycle,
    time
};

/// Factor of a load or a side in the course of a run; at most one of ramp_cycles, ramp_time, table, table_file.
struct FactorDef
{
    std::optional<Vec2> ramp_cycles;  ///< from and until: the factor grows from 0 to 1
    std::optional<Vec2> ramp_time;    ///< the same [s]
    FactorTable table;                ///< rows; of table_file once io/ has read it
    std::string table_file;           ///< CSV with a heading: cycle,factor or time,factor
    TableColumn table_by = TableColumn::cycle;
    std::string since;  ///< name of a stage at whose start cycles and times are 0; "": at the start of the run
};
}  // namespace hdem
