#pragma once
/// Sums of the energy ledger since the start of the run; part of the state.

#include <array>
#include <cstdint>

namespace hdem
{
/// All [J]. What each means: ledger_terms.
struct EnergyLedger
{
    double initial = 0.0;
    double insitu = 0.0;
    double gravity_work = 0.0;
    double load_work = 0.0;
    double boundary = 0.0;
    double water = 0.0;
    double support = 0.0;
    double position_correction = 0.0;
    double dilation = 0.0;

    double friction = 0.0;
    double bond_breaking = 0.0;
    double local_damping = 0.0;
    double global_damping = 0.0;
    double impulse_loss = 0.0;
    double contact_changes = 0.0;
    double property_changes = 0.0;
    double removed = 0.0;

    double coasting = 0.0;

    inline void add(const EnergyLedger& other);
};

enum class LedgerSide
{
    in,     ///< energy that came in
    spent,  ///< energy that went out, positive
    aside   ///< of the last cycle alone
};

struct LedgerTerm
{
    const char* name;
    double EnergyLedger::*value;
    LedgerSide side;
    bool is_scale;  ///< the residual is seen against the largest of these
    const char* meaning;
};

/// The only list of the ledger's terms: sums, files, checks and reports follow it.
inline constexpr std::array ledger_terms = {
    LedgerTerm{"initial", &EnergyLedger::initial, LedgerSide::in, true, "stored at the start, without insitu"},
    LedgerTerm{"insitu", &EnergyLedger::insitu, LedgerSide::in, true, "stored in the joints by [insitu] at the start"},
    LedgerTerm{"gravity_work", &EnergyLedger::gravity_work, LedgerSide::in, true, "work of gravity"},
    LedgerTerm{"load_work", &EnergyLedger::load_work, LedgerSide::in, true,
               "work of loads, of prescribed motions of blocks, and of forces of excavated blocks"},
    LedgerTerm{"boundary", &EnergyLedger::boundary, LedgerSide::in, true, "work of tractions on sides, and of walls that move"},
    LedgerTerm{"water", &EnergyLedger::water, LedgerSide::in, true, "work of water pressures"},
    LedgerTerm{"support", &EnergyLedger::support, LedgerSide::in, true,
               "work of bolts on blocks: less what bolts hold and have spent since they were installed"},
    LedgerTerm{"position_correction", &EnergyLedger::position_correction, LedgerSide::in, false,
               "put into springs by the position correction"},
    LedgerTerm{"dilation", &EnergyLedger::dilation, LedgerSide::in, true,
               "of friction: given back against the normal force where joints open as they slip"},
    LedgerTerm{"friction", &EnergyLedger::friction, LedgerSide::spent, true, "shear force times slip"},
    LedgerTerm{"bond_breaking", &EnergyLedger::bond_breaking, LedgerSide::spent, true,
               "freed where tension is cut off and where cohesion drops"},
    LedgerTerm{"local_damping", &EnergyLedger::local_damping, LedgerSide::spent, true, "taken by local damping"},
    LedgerTerm{"global_damping", &EnergyLedger::global_damping, LedgerSide::spent, true, "taken by global damping"},
    LedgerTerm{"impulse_loss", &EnergyLedger::impulse_loss, LedgerSide::spent, true, "by restitution and by friction of impulses"},
    LedgerTerm{"contact_changes", &EnergyLedger::contact_changes, LedgerSide::spent, false,
               "taken by contacts that open or close between two cycles or change their length, features or regime"},
    LedgerTerm{"property_changes", &EnergyLedger::property_changes, LedgerSide::spent, false,
               "taken where a stage changes stiffness or density"},
    LedgerTerm{"removed", &EnergyLedger::removed, LedgerSide::spent, false, "gone with excavated, fixed or lost blocks"},
    LedgerTerm{
        "coasting", &EnergyLedger::coasting, LedgerSide::aside, false,
        "of the last cycle alone: what contact forces do in the half step after them, to be booked with the next contact_changes"},
};
static_assert(sizeof(EnergyLedger) == ledger_terms.size() * sizeof(double), "each term stands in the list once");

inline void EnergyLedger::add(const EnergyLedger& other)
{
    for (const LedgerTerm& term : ledger_terms)
        this->*term.value += other.*term.value;
}

/// The worst residual of the ledger that a run has had, compared with its limit.
struct WorstResidual
{
    double residual = 0.0;  ///< relative [-]
    double share = 0.0;     ///< of the bar
    std::int64_t cycle = 0;
};
}  // namespace hdem
