#pragma once
/// The table /energy of results.h5: how a run stands, and its energy ledger.

#include "core/model/model.h"
#include "core/state/state.h"
#include "io/results_writer.h"

#include <vector>

namespace hdem
{
/// Energies and unbalance, closed points by regime, terms of the ledger, what springs hold, and the residual.
[[nodiscard]] std::vector<Column> energy_columns();

/// One value a column.
void sample_energies(const Model& model, const State& state, std::vector<double>& row);
}  // namespace hdem
