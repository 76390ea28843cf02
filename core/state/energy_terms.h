#pragma once
/// Sums of the energy ledger since the start of the run; part of the state.

#include <cstdint>

namespace hdem
{
/// What went in (first group) and what was spent (second), all [J], spent energy positive.
struct EnergyLedger
{
    double initial = 0.0;  ///< stored at the start
    double gravity_work = 0.0;
    double load_work = 0.0;            ///< by loads and prescribed motions
    double position_correction = 0.0;  ///< put into springs by the position correction

    double friction = 0.0;
    double local_damping = 0.0;
    double global_damping = 0.0;
    double impulse_loss = 0.0;     ///< by restitution and by friction of impulses
    double contact_changes = 0.0;  ///< see change_energy in core/energy_ledger.h
    double removed = 0.0;          ///< taken away with excavated or fixed blocks

    double coasting =
        0.0;  ///< of this cycle alone: what the contact forces do in the half step after them, to be booked with the next cycle's contact_changes

    void add(const EnergyLedger& other)
    {
        initial += other.initial;
        gravity_work += other.gravity_work;
        load_work += other.load_work;
        position_correction += other.position_correction;
        friction += other.friction;
        local_damping += other.local_damping;
        global_damping += other.global_damping;
        impulse_loss += other.impulse_loss;
        contact_changes += other.contact_changes;
        removed += other.removed;
        coasting += other.coasting;
    }
};

/// The worst residual of the ledger that a run has had, against what it should have.
struct WorstResidual
{
    double residual = 0.0;  ///< relative [-]
    double share = 0.0;     ///< of the bar
    std::int64_t cycle = 0;
};
}  // namespace hdem
