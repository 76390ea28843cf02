#pragma once
/// The loops that take most of a cycle's time, compiled for several kinds of processors. A run chooses its version when it begins. All versions give the same bits.
///
///     contact/contacts_by_four.cpp, contact/joint_points.cpp    laws of contacts, four at a time
///     contact/load_sums.cpp                                     forces on blocks
///     contact/spring_energies.cpp                               energies of springs
///     motion/integrator_kernels.cpp                             velocities and positions
///     statics/front_kernels.cpp, statics/front_solve.cpp        dense part of the static solver's factorisation
///
/// A build for any x86-64 processor holds two versions: plain, and with AVX2 (kernels_avx2.cpp). contact/contact_forces_wide.cpp and motion/integrator_wide.cpp are for AVX-512.

#include "core/contact/block_forces.h"
#include "core/contact/contact_forces.h"
#include "core/contact/running_sums.h"
#include "core/energy_ledger.h"
#include "core/motion/integrator.h"
#include "core/statics/front.h"

namespace hdem
{
struct Kernels
{
    /// evaluate_contacts, four contacts at a time.
    ContactTally (*evaluate_contacts)(IndexRange range, const Model& model, const RegimeRule& rule, const Blocks& blocks,
                                      Contacts& contacts, ContactLoads& loads, const ContactTally& sums, const PassNeeds& needs);
    /// sum_forces.
    void (*sum_loads)(IndexRange range, const Model& model, const BlockContacts& list, const ContactLoads& loads,
                      const std::vector<Triple>& external, bool find_joint, Blocks& blocks);
    /// RunningSums::add.
    void (*add_loads)(const PartEntries& part, const Model& model, const std::vector<std::uint8_t>& present,
                      const std::vector<Triple>& external, const ContactLoads& loads, bool find_joint, BlockForce* sums,
                      ContactLoads& kept);
    /// Of stored_energy.
    void (*add_spring_energies)(IndexRange range, const Model& model, const Blocks& blocks, const Contacts& contacts,
                                SpringEnergies& sums);
    /// update_velocities.
    void (*advance_velocities)(IndexRange range, const Model& model, const DampingRule& rule, Blocks& blocks, VelocityWorks& works);
    /// update_positions.
    Travel (*advance_positions)(IndexRange range, const Model& model, Blocks& blocks, std::vector<Triple>* pseudo);
    /// factor_diagonal, solve_panels, update_panels, solve_forward, solve_backward.
    Index (*eliminate_diagonal)(const Strip& strip, const double* smallest, double* factor);
    void (*eliminate_panels)(const Strip& strip, IndexRange panels, double* factor);
    void (*subtract_strip)(const FrontShape& shape, Index strip, IndexRange panels, double* factor, double* contribution);
    void (*substitute_forward)(const FrontShape& shape, const double* factor, double* x);
    void (*substitute_backward)(const FrontShape& shape, const double* factor, double* x);
};

/// Kernels for this processor.
[[nodiscard]] const Kernels& kernels();
/// Kernels for any processor that the program runs on.
[[nodiscard]] const Kernels& plain_kernels();
}  // namespace hdem
