#include "core/energy_ledger.h"

#include "core/contact/contact_forces_wide.h"
#include "core/contact/contact_report.h"
#include "core/kernels.h"
#include "core/motion/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// The same of what impulses take: loads of a block at rest are known by them [J].
double one_step_push(const State& state, const Contact& contact)
{
    const auto mobility = [&](Index block)
    {
        const BlockInertia& inertia = state.blocks.inertia[block];
        return std::max(inertia.inverse_mass_x, inertia.inverse_mass_y);
    };
    double squares = 0.0;
    for (const PointHistory& point : contact.point)
        squares += point.normal_force * point.normal_force + point.shear_force * point.shear_force;
    const double dt = state.blocks.step.last;
    return 0.5 * squares * dt * dt * (mobility(contact.ref) + mobility(contact.inc));
}
}  // namespace

namespace
{
SpringEnergies spring_energies(const Model& model, const State& state)
{
    static const bool has_wide = has_wide_packs();
    constexpr Index wide = 2 * lanes;
    const Index all = state.contacts.size(), by_eight = has_wide ? (all + lanes - 1) / wide * wide : 0;
    SpringEnergies sums;
    if (by_eight > 0)
        add_spring_energies_by_eight({0, by_eight}, model, state.blocks, state.contacts, sums);
    if (by_eight < all)
        kernels().add_spring_energies({by_eight, all}, model, state.blocks, state.contacts, sums);
    return sums;
}
}  // namespace

StoredEnergy stored_energy(const Model& model, const State& state)
{
    StoredEnergy stored;
    const double fall = model.gravity.norm() * state.blocks.step.last;
    for (Index i = 0; i < state.blocks.size(); ++i)
    {
        if (state.blocks.present[i] != 0)
            stored.kinetic += kinetic_energy(model, state.blocks, i);
        if (state.blocks.is_free(i))
            stored.one_step_fall += 0.5 * model.mass[i] * fall * fall;
    }
    const auto impulsive = [](const std::vector<std::uint8_t>& regime)
    { return std::ranges::find(regime, static_cast<std::uint8_t>(Regime::impulse)) != regime.end(); };
    const bool has_impulses = std::ranges::any_of(state.contacts.regime, impulsive);
    for (Index i = 0; has_impulses && i < state.contacts.size(); ++i)
        if (!is_spring(state.contacts.regime[0][i]) && !is_spring(state.contacts.regime[1][i]) && is_closed_contact(state, i))
            stored.one_step_fall += one_step_push(state, state.contacts.get(i));
    const SpringEnergies springs = spring_energies(model, state);
    stored.elastic_shear = springs.shear;
    stored.pending = springs.pending;
    stored.elastic_normal = springs.held - state.ledger.coasting - stored.elastic_shear;
    return stored;
}

double held_energy(const Model& model, const Contact& contact)
{
    if (model.joints.has_memory(contact.law))
        return contact.point[0].energy + contact.point[1].energy;
    const double shear_stiffness = model.joints.laws[contact.law].shear_stiffness * contact.last_length;
    double held = 0.0;
    for (const PointHistory& point : contact.point)
        if (is_spring(static_cast<std::uint8_t>(point.regime)))
            held += 0.5 * point.normal_force * (point.overlap - point.rest_overlap) +
                    (point.shear_force != 0.0 ? 0.5 * point.shear_force * point.shear_force / shear_stiffness : 0.0);
    return held;
}

double residual(const EnergyLedger& ledger, const StoredEnergy& stored)
{
    double in = 0.0, spent = 0.0;
    for (const LedgerTerm& term : ledger_terms)
        (term.side == LedgerSide::in ? in : spent) += term.side == LedgerSide::aside ? 0.0 : ledger.*term.value;
    return in - spent - stored.total();
}

double relative_residual(const EnergyLedger& ledger, const StoredEnergy& stored)
{
    double most = std::max(stored.total(), stored.one_step_fall);
    for (const LedgerTerm& term : ledger_terms)
        if (term.is_scale)
            most = std::max(most, std::abs(ledger.*term.value));
    return most > 0.0 ? residual(ledger, stored) / most : 0.0;
}

void watch_ledger(const Model& model, State& state)
{
    const EnergyLedger& ledger = state.ledger;
    const double now = std::abs(relative_residual(ledger, stored_energy(model, state)));
    const bool has_impulses = ledger.impulse_loss != 0.0 || ledger.position_correction != 0.0;
    const double of_bar = now / (has_impulses ? impulses_residual : springs_residual);
    if (!(of_bar <= state.worst_residual.share))
        state.worst_residual = {.residual = now, .share = of_bar, .cycle = state.cycle};
}
}  // namespace hdem
