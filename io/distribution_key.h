#pragma once
/// Keys that are a plain number or a table of a distribution, {mean = 1.2, distribution = "exponential", least = 0.2}, and the table of an
/// orientation in space.

#include "core/model/distribution_def.h"
#include "io/case_problems.h"

namespace hdem
{
/// @pre find_distribution_complaint has none
[[nodiscard]] DistributionDef read_distribution(const TomlNode& value, const KeySpec& key);

/// What is wrong with a number or a table; choices of the key are the distributions it may have.
[[nodiscard]] std::vector<Complaint> find_distribution_complaint(const KeySpec& key, const TomlNode& value);

/// @pre find_orientation_complaint has none
[[nodiscard]] OrientationDef read_orientation(const TomlNode& value);

[[nodiscard]] std::vector<Complaint> find_orientation_complaint(const TomlNode& value);

/// Are these numbers lengths, which are never negative?
[[nodiscard]] bool is_length(const KeySpec& key);
}  // namespace hdem
