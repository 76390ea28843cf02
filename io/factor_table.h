#pragma once
/// Files of factors by which loads and sides change.
///
///   time,factor
///   0.00,0.0
///   0.02,0.4
///
/// The heading is cycle,factor or time,factor. Lines that begin with # are skipped.

#include "core/check.h"
#include "core/model/factor_def.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace hdem
{
struct FactorFile
{
    TableColumn by = TableColumn::cycle;
    FactorTable rows;
    std::vector<Problem> problems;  ///< located: their texts begin with file:line
};

FactorFile read_factors(std::istream& in, const std::string& file_name);

/// First row whose cycle or time is not greater than that before it; 0 without one.
[[nodiscard]] std::size_t first_unsorted(const FactorTable& rows);
}  // namespace hdem
