#pragma once
/// A state in the groups /state, /blocks and /contacts of a checkpoint.

#include "core/model/model.h"
#include "core/state/state.h"
#include "io/hdf5_reader.h"
#include "io/hdf5_writer.h"

namespace hdem
{
void save_state(const Model& model, const State& state, Hdf5Writer& file);

/// The state as it was saved. Brings the model's blocks into the order they had then.
/// Throws RunError when the file is damaged or does not belong to this model: whatever is returned can be run.
State load_state(const Hdf5Reader& file, Model& model);
}  // namespace hdem
