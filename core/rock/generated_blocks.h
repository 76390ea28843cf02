#pragma once
/// Blocks of the rock mass once it is cut: what holds them, their order and names.

#include "core/model/case_def.h"
#include "core/rock/block_cutter.h"
#include "core/rock/regions.h"
#include "core/rock/rock_mass.h"

#include <set>
#include <vector>

namespace hdem
{
/// The domain, anticlockwise, and which of its edges hold blocks fast.
struct DomainOutline
{
    Polygon polygon;
    std::set<Index> fixed_edges;
    std::vector<std::set<Index>> boundary_edges;  ///< per [[boundary]]
};

[[nodiscard]] DomainOutline outline_of_domain(const CaseDef& def);

/// Blocks in order of their excavation (none first), then from the bottom up by their centroids, then from the left; names count them.
void add_generated_blocks(const CaseDef& def, const DomainOutline& domain, const Regions& regions, CutMass& mass, RockMass& rock);

/// A block that is the whole inside of an excavation is called as the user wants: others may have that name already.
/// Throws InputError.
void check_block_names(const CaseDef& def, const RockMass& rock);
}  // namespace hdem
