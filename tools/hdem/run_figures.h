#pragma once
/// Figures and words that the beginning and the end of a run both print.

#include "core/model/model.h"
#include "core/state/state.h"

#include <string>
#include <vector>

namespace hdem
{
[[nodiscard]] Index present_blocks(const State& state);
[[nodiscard]] Index free_blocks(const State& state);
[[nodiscard]] double smallest_free_mass(const Model& model, const State& state);  ///< [kg]

/// The most memory that this program has held so far [MB].
[[nodiscard]] double peak_megabytes();

/// The first names, and how many more.
[[nodiscard]] std::string first_of(const std::vector<std::string>& names);
}  // namespace hdem
