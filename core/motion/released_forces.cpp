#include "core/motion/released_forces.h"

#include "core/boundary/side_forces.h"
#include "core/detection/edge_touch.h"
#include "core/motion/loads.h"

#include <algorithm>
#include <map>

namespace hdem
{
namespace
{
/// Force of one contact on its incident block, with the moment about that block's centroid, and the same on the reference block.
struct ContactForce
{
    Triple on_inc, on_ref;
};

ContactForce force_of(const State& state, Index contact)
{
    const Contacts& contacts = state.contacts;
    const EdgeTouch touch = touch_edges(contacts.edges(contact), state.blocks.motion[contacts.ref[contact]],
                                        state.blocks.motion[contacts.inc[contact]]);
    double along = 0.0, across = 0.0;
    ContactForce force;
    for (int k = 0; k < 2; ++k)
    {
        const TouchPoint& p = touch.point[k];
        const double shear = contacts.shear_force(k, contact), normal = contacts.normal_force(k, contact);
        along += shear;
        across -= normal;
        force.on_inc.w -= p.inc_t * normal + p.inc_m * shear;
        force.on_ref.w += p.ref_t * normal + p.ref_m * shear;
        // Of turning contacts, half of the overlap beyond the point (contact/force_law.h).
        const double tilt = contacts.tilt_force(k, contact), beyond = 0.5 * p.overlap;
        along += tilt;
        force.on_inc.w -= (p.inc_m + beyond) * tilt;
        force.on_ref.w += (p.ref_m + beyond) * tilt;
    }
    force.on_inc.x = touch.ex * along - touch.ey * across;
    force.on_inc.y = touch.ey * along + touch.ex * across;
    force.on_ref.x = -force.on_inc.x;
    force.on_ref.y = -force.on_inc.y;
    return force;
}

}  // namespace

void release_forces(const std::vector<std::uint8_t>& removed, State& state)
{
    std::vector<Triple> given(removed.size());
    std::vector<std::uint8_t> is_given(removed.size(), 0);
    const auto add = [&](Index block, const Triple& force)
    {
        given[block] = {given[block].x + force.x, given[block].y + force.y, given[block].w + force.w};
        is_given[block] = 1;
    };
    for (const ReleasedForce& force : state.released)
        add(force.block, {force.x, force.y, force.moment});
    const Contacts& contacts = state.contacts;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const Index ref = contacts.ref[i], inc = contacts.inc[i];
        const bool acts = contacts.regime[0][i] != 0 || contacts.regime[1][i] != 0;
        if (!acts || removed[ref] == removed[inc] || state.blocks.present[ref] == 0 || state.blocks.present[inc] == 0)
            continue;
        const ContactForce force = force_of(state, i);
        if (removed[ref] != 0)
            add(inc, force.on_inc);
        else
            add(ref, force.on_ref);
    }
    state.released.clear();
    for (Index b = 0; b < state.blocks.size(); ++b)
        if (is_given[b] != 0 && removed[b] == 0)
            state.released.push_back({b, given[b].x, given[b].y, given[b].w});
}

void release_water(const std::vector<Triple>& before, State& state)
{
    std::map<Index, ReleasedForce> sums;
    for (const ReleasedForce& force : state.released)
        sums[force.block] = force;
    for (Index b = 0; b < static_cast<Index>(before.size()); ++b)
    {
        const Triple &was = before[b], &is = state.water[b];
        if (!state.blocks.is_free(b) || (was.x == is.x && was.y == is.y && was.w == is.w))
            continue;
        ReleasedForce& sum = sums[b];
        sum = {b, sum.x + was.x - is.x, sum.y + was.y - is.y, sum.moment + was.w - is.w};
    }
    state.released.clear();
    for (const auto& [block, force] : sums)
        state.released.push_back(force);
}

void hold_back_loads(const Model& model, const std::vector<BlockPush>& tensioned, State& state)
{
    std::vector<Triple> loads = constant_forces(model, state);
    loads.resize(static_cast<std::size_t>(model.blocks()));
    add_lasting_loads(model, state, model.stages[state.stage].relax_cycles, loads);
    for (const BlockPush& push : tensioned)
        loads[push.block] = {loads[push.block].x + push.force.x, loads[push.block].y + push.force.y,
                             loads[push.block].w + push.force.w};
    state.released.clear();
    for (Index b = 0; b < model.blocks(); ++b)
    {
        if (!state.blocks.is_free(b) || state.blocks.present[b] == 0)
            continue;
        const Triple& load = loads[b];
        state.released.push_back(
            {b, -load.x - model.mass[b] * model.gravity.x(), -load.y - model.mass[b] * model.gravity.y(), -load.w});
    }
}

std::int64_t released_until(const Model& model, const State& state)
{
    return state.stage_begin_cycle + model.stages[state.stage].relax_cycles;
}

double released_share(const Model& model, const State& state)
{
    const StageDef& stage = model.stages[state.stage];
    const auto left = static_cast<double>(std::max<std::int64_t>(released_until(model, state) - state.cycle, 0));
    return stage.relax_to + (1.0 - stage.relax_to) * (left / static_cast<double>(stage.relax_cycles));
}

bool are_forces_released(const Model& model, const State& state)
{
    return !state.released.empty() && state.cycle < released_until(model, state);
}

void keep_released_forces(const Model& model, State& state)
{
    if (state.released.empty())
        return;
    const double share = released_share(model, state);
    for (ReleasedForce& force : state.released)
        force = {force.block, share * force.x, share * force.y, share * force.moment};
}

void clear_released_forces(const State& state, const std::vector<Triple>& constant, std::vector<Triple>& external)
{
    for (const ReleasedForce& force : state.released)
        external[force.block] = constant.empty() ? Triple{} : constant[force.block];
}

void apply_released_forces(const Model& model, const State& state, std::vector<Triple>& external, std::vector<Triple>& before)
{
    const double share = released_share(model, state);
    before.clear();
    for (const ReleasedForce& force : state.released)
    {
        Triple& on = external[force.block];
        on = {on.x + share * force.x, on.y + share * force.y, on.w + share * force.moment};
        const BlockMotion& motion = state.blocks.motion[force.block];
        before.push_back({motion.vx, motion.vy, motion.w});
    }
}

void add_released_work(const Model& model, const std::vector<Triple>& before, State& state)
{
    const double share = released_share(model, state);
    const Steps& step = state.blocks.step;
    for (std::size_t i = 0; i < before.size(); ++i)
    {
        const ReleasedForce& force = state.released[i];
        const BlockMotion& now = state.blocks.motion[force.block];
        const auto power = [&](double x, double y, double w) { return share * (force.x * x + force.y * y + force.moment * w); };
        const double after = 0.5 * step.next * power(now.vx, now.vy, now.w);
        state.ledger.load_work += 0.5 * step.last * power(before[i].x, before[i].y, before[i].w) + after;
        state.ledger.coasting -= after;
    }
}
}  // namespace hdem
