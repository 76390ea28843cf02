#pragma once
/// Sides that begin and end with a stage.

#include "core/model/model.h"
#include "core/state/state.h"

#include <vector>

namespace hdem
{
/// What changes from one stage to another.
struct BoundaryChange
{
    std::vector<std::uint8_t> ends;  ///< per block: is it a wall that ends? Empty without one
    std::vector<Index> begins;       ///< walls
    std::vector<Index> freed;        ///< blocks of fixed sides, unless `fix` of a stage holds them
    std::vector<Index> held;

    [[nodiscard]] bool any() const { return !ends.empty() || !begins.empty() || !freed.empty() || !held.empty(); }
};

[[nodiscard]] BoundaryChange boundary_change(const Model& model, Index from, Index to);

/// Forces of tractions that end join the forces that the stage removes over its relax_cycles.
void release_tractions(const Model& model, Index from, Index to, State& state);

/// Take walls away.
void remove_walls(const std::vector<std::uint8_t>& walls, State& state);

/// Put the walls of the state's stage that are not there yet where they touch the blocks of their side, without force.
/// Before the first cycle of a run they stand as drawn.
void place_walls(const Model& model, State& state);

/// Start the walls of kind velocity of the state's stage, and stop all others. A wall has no mass, so no energy is booked.
void start_walls(const Model& model, State& state);
}  // namespace hdem
