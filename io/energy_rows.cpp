#include "io/energy_rows.h"

#include "core/contact/point_counts.h"
#include "core/energy_ledger.h"
#include "core/motion/equilibrium.h"

namespace hdem
{
namespace
{
/// Of blocks that move as they are told: work of the loads that nothing else shows.
double driven_kinetic_energy(const Model& model, const Blocks& blocks)
{
    double sum = 0.0;
    for (Index i = 0; i < blocks.size(); ++i)
        if (blocks.present[i] != 0 && !blocks.is_free(i))
            sum += kinetic_energy(model, blocks, i);
    return sum;
}
}  // namespace

std::vector<Column> energy_columns()
{
    std::vector<Column> columns = {{"kinetic_energy", "J"},   {"unbalanced_force_ratio", "1"},
                                   {"greatest_speed", "m/s"}, {"stick_points", "1"},
                                   {"slip_points", "1"},      {"impulse_points", "1"}};
    for (const LedgerTerm& term : ledger_terms)
        if (term.side != LedgerSide::aside)
            columns.push_back({term.name, "J"});
    columns.insert(columns.end(), {{"elastic_normal", "J"}, {"elastic_shear", "J"}, {"driven_kinetic", "J"}, {"residual", "J"}});
    return columns;
}

void sample_energies(const Model& model, const State& state, std::vector<double>& row)
{
    Equilibrium sums;
    add_equilibrium({0, state.blocks.size()}, model, state, ConvergenceBlocks::all, sums);
    row = {sums.kinetic_energy, sums.unbalanced_force_ratio(), sums.greatest_speed};
    const std::array<Index, 4> points = count_points(state.contacts);
    row.insert(row.end(), points.begin() + 1, points.end());
    for (const LedgerTerm& term : ledger_terms)
        if (term.side != LedgerSide::aside)
            row.push_back(state.ledger.*term.value);
    const StoredEnergy stored = stored_energy(model, state);
    row.insert(row.end(), {stored.elastic_normal, stored.elastic_shear, driven_kinetic_energy(model, state.blocks),
                           residual(state.ledger, stored)});
}
}  // namespace hdem
