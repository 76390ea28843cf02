/// hdem fos: the factor of safety.

#include "parallel/reference_state.h"
#include "parallel/safety_factor.h"
#include "tools/hdem/console.h"
#include "tools/hdem/finished_run.h"

#include <fmt/format.h>

namespace hdem
{
int fos_command(const FosOptions& options)
{
    BeforeLastStage before;
    RunOptions run_options = options.run;
    FinishedRun run = run_case(run_options, &before);
    if (!run.is_complete)
        return run.exit_code;
    const Moment last{run.simulation->model(), run.simulation->state()};
    const int threads = run.simulation->threads();
    const FactorOfSafetyDef& def = run.start.loaded.file.def.factor_of_safety;
    const bool found_rest = !run.stages.back().sought_rest || run.stages.back().at_rest;
    const Reference reference = find_reference(last, blocks_that_gave_way(last, found_rest, def.least_size), before.moment(),
                                               threads);
    FactorSetting setting{.def = def, .threads = threads};
    setting.show = [&](const FactorTrial& t)
    {
        run.log->line(fmt::format("{:<9} {:8.4f} {:<10} {:>9} {:10.4g} s {:10.4g} m  {}", name_of(t.search), t.trial.factor,
                                  name_of(t.trial.end), t.trial.cycles, t.trial.time, t.trial.displacement, t.trial.reason));
    };
    const SafetyFactor found = find_safety_factor(reference.moment, setting);
    if (found.as_given.is_closed())
        run.log->line(fmt::format("factor of safety {:.4f} ({:.4f} stands, {:.4f} fails)", found.as_given.middle(),
                                  *found.as_given.stands, *found.as_given.fails));
    return exit_done;
}
}  // namespace hdem
