#include "parallel/reference_state.h"

#include "core/motion/equilibrium.h"

namespace hdem
{
void BeforeLastStage::observe(const Model& model, const State& state)
{
    if (!state.stage_begun && model.stages.size() == 1)
        moment_ = {model, state};
}

void BeforeLastStage::end_stage(const Model& model, const State& state)
{
    if (state.stage + 2 == static_cast<Index>(model.stages.size()))
        moment_ = {model, state};
}

std::vector<Index> blocks_that_gave_way(const Moment& last, bool found_rest, double least_area, double far)
{
    const auto& [model, state] = last;
    std::vector<Index> found;
    for (const Index block : model.slot_of_user)
    {
        if (state.blocks.present[block] == 0 || !can_move(model.full_inertia[block]) || model.area[block] < least_area)
            continue;
        const bool is_far = rim_displacement(block, model, state.blocks) > far * model.size(block);
        if (is_far || (!found_rest && state.blocks.is_free(block) && !is_supported(block, model, state)))
            found.push_back(model.user_number[block]);
    }
    return found;
}

Reference find_reference(const Moment& last, const std::vector<Index>& gave_way, const std::optional<Moment>& before,
                         const ThreadRule& threads)
{
    if (gave_way.empty() || !before)
        return {elastic_state(last, threads)};
    return {elastic_stage(*before, last.state, threads), gave_way};
}
}  // namespace hdem
