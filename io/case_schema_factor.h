#pragma once
/// Keys of what grows and falls as a run goes on; loads and sides have the same. For the files io/case_schema*.cpp only.

#include "io/case_fields.h"

namespace hdem::fields
{
/// @tparam Factor  the FactorDef in the section's struct
template <auto Factor>
void add_factor_keys(std::vector<KeySpec>& keys)
{
    const Range cycles{.low = 0, .high = 1e15};
    const char* const none = "constant";
    keys.push_back(inner_field<Factor, &FactorDef::ramp_cycles>(
        {.name = "ramp_cycles",
         .effect = "[from, until] in cycles: all that is given grows linearly from 0 to its full value in between. It is 0 before. "
                   "A stage with until ends only after that.",
         .example = "[0, 5000]",
         .range = cycles,
         .default_note = none}));
    keys.push_back(inner_field<Factor, &FactorDef::ramp_time>({.name = "ramp_time",
                                                               .unit = "s",
                                                               .effect = "The same in seconds.",
                                                               .example = "[0.0, 0.5]",
                                                               .range = cycles,
                                                               .default_note = none}));
    keys.push_back(inner_field<Factor, &FactorDef::table>(
        {.name = "table",
         .effect = "Rows [cycle, factor]: all that is given is multiplied by the factor, which is linear between rows and constant "
                   "before the first and after the last.",
         .example = "[[0, 0.0], [2000, 1.0], [8000, -0.5]]",
         .range = any_size,
         .default_note = none}));
    keys.push_back(inner_field<Factor, &FactorDef::table_file>({.name = "table_file",
                                                                .effect = "A text file with such rows, see below.",
                                                                .example = "\"record.csv\"",
                                                                .default_note = none}));
    keys.push_back(
        inner_field<Factor, &FactorDef::table_by>({.name = "table_by",
                                                   .effect = "What the first column of `table` is. A file says it in its heading.",
                                                   .choices = {"cycle", "time"}}));
    keys.push_back(inner_field<Factor, &FactorDef::since>(
        {.name = "since",
         .effect = "Name of the stage from whose start cycles and times of this entry are counted, also from_cycle and the like. "
                   "Before that stage a load does not act, and a side has its first factor.",
         .example = "\"shear\"",
         .default_note = "the start of the run"}));
}
}  // namespace hdem::fields
