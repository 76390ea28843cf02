#pragma once
/// What `hdem fos` says of the factor of safety.

#include "tools/hdem/fos_search.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace hdem
{
/// Heading of the rows, and one row.
[[nodiscard]] std::string trial_heading();
[[nodiscard]] std::string trial_row(const FactorTrial& trial);
/// "1.572 by limit analysis (12 blocks ...)", or why there is none.
[[nodiscard]] std::string bound_text(const StrengthBound& bound);
/// "1.135 (1.133 stands, 1.138 fails)", or beyond what it lies.
[[nodiscard]] std::string factor_text(const Bracket& bracket);
/// The answer, line by line.
[[nodiscard]] std::vector<std::string> closing_lines(const FosOutcome& outcome, const Model& model);

/// Blocks that were let fall in trials that count; the user's numbers.
[[nodiscard]] std::vector<Index> all_let_fall(const SafetyFactor& factor);
/// Do corners that touch in a point bear a part of it?
[[nodiscard]] bool leans_on_corners(const FosOutcome& outcome);

/// A trial as it stands there.
[[nodiscard]] nlohmann::ordered_json trial_json(const FactorTrial& trial, const Model& model);
/// Key factor_of_safety of summary.json.
[[nodiscard]] nlohmann::ordered_json fos_json(const FosOutcome& outcome, const Model& model);
/// Put it into FOLDER/summary.json, which the run has written.
void add_to_summary(const std::filesystem::path& file, const nlohmann::ordered_json& factor);

/// Names of blocks, from the user's numbers.
[[nodiscard]] std::vector<std::string> names_of_blocks(const Model& model, const std::vector<Index>& users);
}  // namespace hdem
