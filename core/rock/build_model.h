#pragma once
/// Case definition -> model and initial state.

#include "core/check.h"
#include "core/model/model.h"
#include "core/rock/rock_mass.h"
#include "core/state/state.h"

namespace hdem
{
/// The case's gravity as the tilted model has it [m/s2].
[[nodiscard]] Vec2 tilted_gravity(const CaseDef& def);

struct Setup
{
    Model model;
    State state;
    std::vector<Problem> warnings;
    RockMass rock;  ///< counts of the generator; its blocks have moved into the model
};

/// Generate the rock mass, sort its blocks along a Hilbert curve, resolve names and times.
/// Throws InputError with every problem found.
Setup build_model(const CaseDef& def);

/// Fix a block where it is, or free all its components; what a stage says.
void set_mobility(const Model& model, Index block, bool is_free, Blocks& blocks);
}  // namespace hdem
