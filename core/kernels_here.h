#pragma once
/// The loops of kernels.h as the file that includes this is compiled.

#include "core/kernels.h"
#include "core/simd.h"

namespace hdem
{
inline namespace HDEM_LANES
{
ContactTally evaluate_by_four(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                              Contacts& contacts, ContactLoads& loads, const ContactTally& sums, const PassNeeds& needs);
void sum_loads(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
               const std::vector<Triple>& external, bool find_joint, Blocks& blocks);
void add_loads(const PartEntries& part, const Model& model, const std::vector<std::uint8_t>& present,
               const std::vector<Triple>& external, const ContactLoads& loads, bool find_joint, BlockForce* sums,
               ContactLoads& kept);
void add_spring_energies(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                         SpringEnergies& sums);
void advance_velocities(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& works);
Travel advance_positions(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo);
Index eliminate_diagonal(const Strip& strip, const double* smallest, double* factor);
void eliminate_panels(const Strip& strip, IndexRange panels, double* factor);
void subtract_strip(const FrontShape& shape, Index strip, IndexRange panels, double* factor, double* contribution);
void substitute_forward(const FrontShape& shape, const double* factor, double* x);
void substitute_backward(const FrontShape& shape, const double* factor, double* x);

inline constexpr Kernels kernels_here{evaluate_by_four,   sum_loads,          add_loads,          add_spring_energies,
                                      advance_velocities, advance_positions,  eliminate_diagonal, eliminate_panels,
                                      subtract_strip,     substitute_forward, substitute_backward};
}  // namespace HDEM_LANES
}  // namespace hdem
