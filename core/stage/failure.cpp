#include "core/stage/failure.h"

#include "core/motion/contact_springs.h"
#include "core/motion/equilibrium.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
constexpr double first_mark = 0.5;    ///< in L
constexpr int last_mark = 4;          ///< 8 L
constexpr double growth = 1.15;       ///< of speed from mark to mark
constexpr double way_growth = 1.7;    ///< of d in twice the time
constexpr double creep_share = 0.05;  ///< of L

/// Greatest elastic strain of the joints of each block: of the normal spring by its secant, and of the shear spring [m].
std::vector<double> joint_strains(const Model& model, const State& state)
{
    std::vector<double> strains(static_cast<std::size_t>(model.blocks()), 0.0);
    const Contacts& contacts = state.contacts;
    for (Index i = 0; i < contacts.size(); ++i)
    {
        const CoulombSlip& joint = model.joints.laws[contacts.law[i]];
        const double length = contacts.lane[i / lanes].last_length[i % lanes];
        if (length <= 0.0)
            continue;
        for (int k = 0; k < 2; ++k)
        {
            const double normal = contacts.normal_force(k, i) / length, shear = contacts.shear_force(k, i) / length;
            const bool has_memory = model.joints.has_memory(contacts.law[i]);
            const double closure = has_memory ? closure_under(model.joints.rows[contacts.law[i]], normal)
                                              : normal / joint.normal_stiffness;
            const double slide = joint.shear_stiffness > 0.0 ? std::abs(shear) / joint.shear_stiffness : 0.0;
            for (const Index block : {contacts.ref[i], contacts.inc[i]})
                strains[block] = std::max({strains[block], std::abs(closure), slide});
        }
    }
    return strains;
}

/// How much farther the bolts of each block stretch until they yield, or how far they are stretched if they never do: before, they hold with less than their strength [m].
std::vector<double> bolt_stretches(const Model& model, const State& state)
{
    std::vector<double> stretches(static_cast<std::size_t>(model.blocks()), 0.0);
    for (std::size_t i = 0; i < model.support.bolts.size(); ++i)
    {
        const Bolt& bolt = model.support.bolts[i];
        for (const BoltLink& link : bolt.links)
        {
            const double stiffness = bolt.kind == BoltKind::anchored ? bolt.stiffness : link.axial_stiffness;
            const double now = state.support.bolts[i].force;
            const double force = bolt.yield < Bolt::none ? std::max(bolt.yield - now, 0.0) : now;
            for (const Index block : {link.first, link.second})
                if (block != no_index && stiffness > 0.0)
                    stretches[block] = std::max(stretches[block], force / stiffness);
        }
    }
    return stretches;
}
}  // namespace

double rim_displacement(Index block, const Model& model, const Blocks& blocks)
{
    const double turn = std::abs(blocks.motion[block].angle - blocks.reference_angle[block]);
    return blocks.displacement(block).norm() + std::min(turn, 2.0) * model.radius[block];
}

FailureWatch::FailureWatch(const FailureRule& rule, const Model& model, const State& state)
    : rule_(rule),
      track_(static_cast<std::size_t>(model.blocks())),
      time_(state.time)
{
    const std::vector<double> strains = joint_strains(model, state), stretches = bolt_stretches(model, state);
    for (Index i = 0; i < model.blocks(); ++i)
        track_[model.user_number[i]].limit = rule.displacement.value_or(
            std::max({rule.share * model.size(i), rule.strains * strains[i], rule.stretches * stretches[i]}));
}

bool FailureWatch::advance(Track& track, double moved, double seconds) const
{
    const double speed = seconds > 0.0 ? std::max(moved - track.last, 0.0) / seconds : 0.0;
    bool fails = false;
    while (track.marks <= last_mark && moved >= std::ldexp(first_mark * track.limit, track.marks))
    {
        fails = fails || track.marks == last_mark || (track.marks > 0 && speed >= growth * track.mark_speed);
        track.mark_speed = speed;
        ++track.marks;
    }
    return fails;
}

std::vector<Index> FailureWatch::look(const Model& model, const State& state)
{
    const double seconds = state.time - time_;
    time_ = state.time;
    std::vector<Index> failed;
    farthest_ = {};
    for (Index user = 0; user < static_cast<Index>(track_.size()); ++user)
    {
        const Index block = model.slot_of_user[user];
        if (!state.blocks.is_free(block))
            continue;
        Track& track = track_[user];
        const double moved = rim_displacement(block, model, state.blocks);
        if (!track.has_failed && advance(track, moved, seconds))
        {
            track.has_failed = true;
            failed.push_back(user);
        }
        track.last = moved;
        if (counts(user, model) && (farthest_.block == no_index || moved * farthest_.limit > farthest_.moved * track.limit))
            farthest_ = {user, moved, track.limit};
    }
    return failed;
}

Index FailureWatch::find_creeping()
{
    Index creeping = no_index;
    for (Index user = 0; user < static_cast<Index>(track_.size()); ++user)
    {
        Track& track = track_[user];
        const bool grows = has_noted_ && track.last >= way_growth * track.noted;
        track.grown = grows ? track.grown + 1 : 0;
        track.noted = track.last;
        if (user == farthest_.block && track.grown >= 2 && track.last >= creep_share * track.limit)
            creeping = user;
    }
    has_noted_ = true;
    return creeping;
}

std::vector<Index> blocks_moving_with(Index failed, const Model& model, const State& state)
{
    const Blocks& blocks = state.blocks;
    const Index leader = model.slot_of_user[failed];
    const double way = rim_displacement(leader, model, blocks), speed = rim_speed(leader, model, blocks);
    std::vector<Index> moving;
    for (const Index block : model.slot_of_user)
        if (block == leader || (blocks.is_free(block) && rim_displacement(block, model, blocks) >= 0.25 * way &&
                                rim_speed(block, model, blocks) >= 0.25 * speed))
            moving.push_back(model.user_number[block]);
    return moving;
}
}  // namespace hdem
