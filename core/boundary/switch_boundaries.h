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
    std::vector<Index> freed;        ///< blocks of fixed sides
    std::vector<Index> held;

    [[nodiscard]] bool any() const { return !ends.empty() || !begins.empty() || !freed.empty() || !held.empty(); }
};

[[nodiscard]] BoundaryChange boundary_change(const Model& model, Index from, Index to);

/// What tractions that end have given goes to the forces that the stage takes off over its relax_cycles.
void release_tractions(const Model& model, Index from, Index to, State& state);

/// Take walls away.
void remove_walls(const std::vector<std::uint8_t>& walls, State& state);

/// Put the walls of the state's stage that are not there yet where they touch the blocks of their side, without force.
/// Before the first cycle of a run they stand as drawn.
void place_walls(const Model& model, State& state);

/// Walls of kind velocity begin to move in the state's stage, all others stand. A wall has no mass: that is no energy.
void start_walls(const Model& model, State& state);
}  // namespace hdem
