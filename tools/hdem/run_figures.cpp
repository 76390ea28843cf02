#include "tools/hdem/run_figures.h"

#include "core/motion/equilibrium.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace hdem
{
Index free_blocks(const State& state)
{
    Index count = 0;
    for (Index i = 0; i < state.blocks.size(); ++i)
        count += state.blocks.is_free(i) ? 1 : 0;
    return count;
}

Index present_blocks(const State& state)
{
    return std::accumulate(state.blocks.present.begin(), state.blocks.present.end(), Index{0});
}

double smallest_free_mass(const Model& model, const State& state)
{
    double mass = std::numeric_limits<double>::infinity();
    for (Index i = 0; i < model.blocks(); ++i)
        if (state.blocks.is_free(i))
            mass = std::min(mass, model.mass[i]);
    return mass;
}

double peak_megabytes()
{
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

std::string first_of(const std::vector<std::string>& names)
{
    constexpr std::size_t most = 10;
    const auto shown = static_cast<std::ptrdiff_t>(std::min(most, names.size()));
    return fmt::format("{}{}", fmt::join(names.begin(), names.begin() + shown, ", "),
                       names.size() > most ? fmt::format(" and {} more", names.size() - most) : "");
}

std::vector<std::string> run_warnings(const Simulation& simulation, const RunSummary& s)
{
    std::vector<std::string> warnings;
    if (!s.stages.empty() && !s.stages.back().to_come.empty())
        warnings.push_back(
            fmt::format("the run ended in cycle {}, but {}. Let the last stage last longer, or let these end earlier.", s.cycles,
                        fmt::join(s.stages.back().to_come, "; ")));
    if (!s.lost_blocks.empty())
        warnings.push_back(
            fmt::format("blocks have left the model and are held outside it: {}. Give walls or a ground to hold them, or a "
                        "greater convergence.lost_distance.",
                        first_of(s.lost_blocks)));
    std::vector<std::string> outside;
    const Model& model = simulation.model();
    for (const Index block : model.slot_of_user)
        if (has_left(block, model, simulation.state().blocks) && simulation.state().blocks.is_free(block))
            outside.push_back(model.name[block]);
    if (!outside.empty())
        warnings.push_back(
            fmt::format("blocks have left the model and move on outside it: {}. Give walls or a ground to hold them, or "
                        "a stage with until = \"converged\", which ends their way.",
                        first_of(outside)));
    if (const WorstResidual& watch = simulation.state().worst_residual; watch.share > 1.0)
        warnings.push_back(
            fmt::format("energy ledger: residual = {:.2g} of its largest term in cycle {} ({:.3g} times what it should be). "
                        "Give a smaller time.step or time.stable_fraction.",
                        watch.residual, watch.cycle, watch.share));
    return warnings;
}
}  // namespace hdem
