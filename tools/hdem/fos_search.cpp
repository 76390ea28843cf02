#include "tools/hdem/fos_search.h"

#include "core/boundary/resolve_boundaries.h"
#include "io/printable.h"
#include "tools/hdem/fos_report.h"

#include <fmt/format.h>

namespace hdem
{
FosAnswer find_factor(const Moment& last, const FosQuestion& question)
{
    FosOutcome outcome{.def = question.def};
    const std::vector<Index> gave_way = blocks_that_gave_way(last, question.found_rest, outcome.def.least_size);
    outcome.gave_way = names_of_blocks(last.model, gave_way);
    const bool runs_anew = !gave_way.empty() && outcome.def.begin == FactorStart::last_stage;
    Reference reference = find_reference(last, gave_way, runs_anew ? question.before() : std::nullopt, question.threads);
    const Model& model = reference.moment.model;
    outcome.bound = strength_bound(model, reference.moment.state, weakened_joints(model.joints, outcome.def), least_factor,
                                   greatest_factor, weakens_bolts(outcome.def));
    if (question.begin)
        question.begin(outcome);
    FactorSetting setting{.def = outcome.def, .bound = {}, .threads = question.threads, .store = question.store};
    const bool is_found = outcome.bound.end == StrengthBound::End::found;
    if (is_found)
        setting.bound = outcome.bound.factor;
    if (is_found || outcome.bound.end == StrengthBound::End::none)
    {
        const StrengthBound lower = strength_bound_without_corners(model, reference.moment.state,
                                                                   weakened_joints(model.joints, outcome.def), least_factor,
                                                                   outcome.bound, weakens_bolts(outcome.def));
        if (lower.end == StrengthBound::End::found && lower.factor < outcome.bound.factor)
            outcome.without_corners = lower.factor;
    }
    setting.show = question.show;
    setting.stop = question.stop;
    outcome.factor = find_safety_factor(reference.moment, setting);
    outcome.warnings = fos_warnings(outcome, reference.moment, last.state.method);
    return {std::move(outcome), std::move(reference.moment)};
}

void refuse_driven(const CaseDef& def)
{
    const auto refuse = [](const std::string& what)
    {
        throw InputError(
            Problem{.key = {},
                    .text = fmt::format("hdem fos: {} (a motion is prescribed: the rock is never at rest). End it before the "
                                        "last stage.",
                                        what)});
    };
    for (const BoundaryDef& side : def.boundaries)
        if (side.kind == BoundaryKind::velocity && !side.velocity.isZero() && acts_in(side, def.stages.back().name))
            refuse(fmt::format("boundary \"{}\": velocity", printable(side.name)));
    for (const LoadDef& load : def.loads)
        if ((load.velocity_x || load.velocity_y || load.angular_velocity) && !load.interval.until_cycle &&
            !load.interval.until_time)
            refuse("load: velocity");
}
}  // namespace hdem
