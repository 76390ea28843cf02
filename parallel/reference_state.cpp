#include "parallel/reference_state.h"

#include "core/motion/equilibrium.h"
#include "core/stage/failure.h"

#include <algorithm>
#include <iterator>
#include <utility>

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

namespace
{
constexpr double far_share = 0.2;        // of its size: no rock settles by so much
constexpr double detached_share = 0.02;  // of its size: that of a trial that fails (core/stage/failure.h)
constexpr double settled_share = 0.5;    // of its way: what rock of great strength goes, too

template <typename Is>
std::vector<Index> free_blocks(const Moment& last, double least_area, const Is& is)
{
    const auto& [model, state] = last;
    std::vector<Index> found;
    for (const Index block : model.slot_of_user)
        if (state.blocks.present[block] != 0 && can_move(model.full_inertia[block]) && model.area[block] >= least_area && is(block))
            found.push_back(model.user_number[block]);
    return found;
}

std::vector<Index> blocks_that_went_far(const Moment& last, double least_area)
{
    const Model& model = last.model;
    const State& state = last.state;
    return free_blocks(last, least_area,
                       [&](Index block)
                       {
                           const double least = std::min(detached_share * model.size(block), model.convergence.detached_distance);
                           return rim_displacement(block, model, state.blocks) > least;
                       });
}

bool settled(Index user, const Moment& last, const Moment& strong)
{
    const auto way = [user](const Moment& m) { return rim_displacement(m.model.slot_of_user[user], m.model, m.state.blocks); };
    return way(strong) >= settled_share * way(last);
}
}  // namespace

std::vector<Index> blocks_that_gave_way(const Moment& last, bool found_rest, double least_area)
{
    const Model& model = last.model;
    const State& state = last.state;
    return free_blocks(last, least_area,
                       [&](Index block)
                       {
                           return rim_displacement(block, model, state.blocks) > far_share * model.size(block) ||
                                  (!found_rest && state.blocks.is_free(block) && !is_supported(block, model, state));
                       });
}

Reference find_reference(const Moment& last, const LastStage& stage, const ThreadRule& threads)
{
    std::vector<Index> gave_way = blocks_that_gave_way(last, stage.found_rest, stage.least_area);
    std::vector<Index> went_far = blocks_that_went_far(last, stage.least_area);
    const bool asks = stage.before && !(gave_way.empty() && went_far.empty());
    const std::optional<Moment> before = asks ? stage.before() : std::nullopt;
    if (!before)
        return {elastic_state(last, threads), std::move(gave_way)};
    Moment strong = elastic_stage(*before, last.state, threads);
    std::erase_if(went_far, [&](Index user) { return settled(user, last, strong); });
    std::vector<Index> all;
    std::ranges::set_union(gave_way, went_far, std::back_inserter(all));
    if (all.empty())
        return {elastic_state(last, threads)};
    return {std::move(strong), std::move(all), true};
}
}  // namespace hdem
