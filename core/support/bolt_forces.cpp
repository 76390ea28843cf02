#include "core/support/bolt_forces.h"

#include "core/motion/damping.h"
#include "core/support/bolt_link.h"
#include "core/support/bolt_memory.h"
#include "core/support/grouted_bolt.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hdem
{
namespace
{
/// Force of a spring that flows at `limit`; what flows is added to `plastic`.
double flow(double stiffness, double stretch, double limit, double& plastic, BoltRecord& record)
{
    const double trial = stiffness * (stretch - plastic);
    if (!(std::abs(trial) > limit))
        return trial;
    const double force = std::copysign(limit, trial), by = (trial - force) / stiffness;
    plastic += by;
    record.spent += force * by;
    record.status = BoltStatus::yielded;
    return force;
}

/// Forces on the blocks of a link, at points seen from their centroids: `force` on the first one.
class Pull
{
  public:
    Pull(const Model& model, const Blocks& blocks, double damping, std::vector<BlockPush>& pushes)
        : model_(model),
          blocks_(blocks),
          damping_(damping),
          pushes_(pushes)
    {
    }

    void add(const BoltLink& link, const Vec2& force, const Vec2& first_place, const Vec2& second_place, double reserve)
    {
        push(link.first, force, first_place, reserve, false);
        push(link.second, -force, second_place, reserve, false);
    }

    /// Along the bolt.
    /// @param least  damping force, against what the bolt pulls
    /// @param most   the same with it
    void damp(const BoltLink& link, const LinkPlace& at, double stiffness, double least, double most)
    {
        if (damping_ == 0.0 || !(is_by_impulses(link.first) || is_by_impulses(link.second)))
            return;
        const double mobility = mobility_of(link.first, at.first, at.line) + mobility_of(link.second, at.second, at.line);
        if (!(mobility > 0.0))
            return;
        // The speed is half a step old: with a quarter of it taken in a step the swing is stable at 0.9 of the step that it would bear without.
        constexpr double most_taken = 0.25;
        const double sum = mobility * static_cast<double>(std::max(links_at(link.first), links_at(link.second)));
        const double coefficient = std::min(2.0 * damping_ * std::sqrt(stiffness / sum), most_taken / (sum * blocks_.step.kick()));
        const double parting = at.line.dot(velocity_of(link.second, at.second) - velocity_of(link.first, at.first));
        const Vec2 force = std::clamp(coefficient * parting, std::min(least, 0.0), std::max(most, 0.0)) * at.line;
        push(link.first, force, at.first, 0.0, true);
        push(link.second, -force, at.second, 0.0, true);
    }

  private:
    [[nodiscard]] bool is_by_impulses(Index block) const
    {
        return can_move(blocks_.inertia[block]) && (blocks_.force[block].contacts & contact_impulse) != 0;
    }

    [[nodiscard]] Index links_at(Index block) const
    {
        const IndexRange ends = ends_of(model_.support, block);
        return can_move(blocks_.inertia[block]) ? ends.end - ends.begin : 1;
    }

    [[nodiscard]] Vec2 arm_of(Index block, const Vec2& place) const
    {
        return place - Vec2(blocks_.motion[block].x, blocks_.motion[block].y);
    }

    [[nodiscard]] Vec2 velocity_of(Index block, const Vec2& place) const
    {
        const BlockMotion& m = blocks_.motion[block];
        return Vec2(m.vx, m.vy) + m.w * turned_left(arm_of(block, place));
    }

    /// Speed along `line` that a unit impulse along it gives [1/kg].
    [[nodiscard]] double mobility_of(Index block, const Vec2& place, const Vec2& line) const
    {
        const BlockInertia& inertia = blocks_.inertia[block];
        const double lever = cross(arm_of(block, place), line);
        return inertia.inverse_mass_x * line.x() * line.x() + inertia.inverse_mass_y * line.y() * line.y() +
               inertia.inverse_inertia * lever * lever;
    }

    void push(Index block, const Vec2& force, const Vec2& place, double reserve, bool damps)
    {
        const BlockMotion& m = blocks_.motion[block];
        pushes_.push_back({block, {force.x(), force.y(), cross(arm_of(block, place), force)}, {m.vx, m.vy, m.w}, reserve, damps});
    }

    const Model& model_;
    const Blocks& blocks_;
    double damping_;
    std::vector<BlockPush>& pushes_;
};

void pull_anchored(const Bolt& bolt, const Blocks& blocks, AnchoredMemory& memory, BoltRecord& record, Pull& pull)
{
    const LinkPlace at = place_of(bolt, bolt.links.front(), blocks);
    const double stretch = at.distance - memory.free;
    if (stretch > bolt.rupture * bolt.length)
    {
        record.status = BoltStatus::ruptured;
        record.spent += record.stored;
        record.force = record.stored = 0.0;
        return;
    }
    const double long_by = stretch - memory.plastic;
    record.force = long_by > 0.0 ? flow(bolt.stiffness, stretch, bolt.yield, memory.plastic, record) : 0.0;
    record.stored = energy_in(record.force, bolt.stiffness);
    record.elongation = stretch - bolt.pretension / bolt.stiffness;
    if (!(record.force > 0.0))
        return;
    pull.add(bolt.links.front(), record.force * at.line, at.first, at.second, bolt.yield - record.force);
    pull.damp(bolt.links.front(), at, bolt.stiffness, -record.force, bolt.yield - record.force);
}

void pull_local(const Bolt& bolt, const Blocks& blocks, LocalMemory* memory, BoltRecord& record, Pull& pull)
{
    record.force = record.shear_force = record.stored = record.elongation = 0.0;
    for (std::size_t l = 0; l < bolt.links.size(); ++l)
    {
        const BoltLink& link = bolt.links[l];
        LocalMemory& own = memory[l];
        if (own.cut != 0.0 || !is_there(link, blocks))
            continue;
        const LinkPlace at = place_of(bolt, link, blocks);
        const double stretch = at.distance - own.free, across = at.across - own.straight;
        BoltRecord limits = record;
        const double axial = flow(bolt.stiffness, stretch, bolt.yield, own.plastic, limits);
        const double shear = flow(bolt.shear_stiffness, across, bolt.shear_strength, own.sheared, limits);
        const double energy = energy_in(axial, bolt.stiffness) + energy_in(shear, bolt.shear_stiffness);
        if (record.status != BoltStatus::ruptured)
            record.status = limits.status;
        record.spent = limits.spent;
        record.elongation += stretch;
        if (stretch > bolt.rupture * bolt.length)
        {
            own.cut = 1.0;
            record.status = BoltStatus::ruptured;
            record.spent += energy;
            continue;
        }
        record.stored += energy;
        record.force = std::max(record.force, axial);
        record.shear_force = std::max(record.shear_force, std::abs(shear));
        const Vec2 middle = 0.5 * (at.first + at.second);
        pull.add(link, axial * at.line, at.first, at.second, bolt.yield - std::abs(axial));
        pull.damp(link, at, bolt.stiffness, -bolt.yield - axial, bolt.yield - axial);
        pull.add(link, shear * turned_left(at.axis), middle, middle, bolt.shear_strength - std::abs(shear));
    }
}

/// Opening of each link along the bolt, on top of one another: how far each part of the rock has moved.
void pull_bar(const Bolt& bolt, const Blocks& blocks, const GroutedMemory& memory, BoltRecord& record, Pull& pull)
{
    thread_local std::vector<double> moved, tension, reserve;
    thread_local std::vector<std::uint8_t> gone;
    moved.assign(bolt.blocks.size(), 0.0);
    tension.assign(bolt.links.size(), 0.0);
    reserve.assign(bolt.links.size(), 0.0);
    gone.clear();
    for (const Index block : bolt.blocks)
        gone.push_back(blocks.present[block] != 0 ? 0 : 1);
    for (std::size_t l = 0; l < bolt.links.size(); ++l)
        moved[l + 1] = moved[l] + place_of(bolt, bolt.links[l], blocks).distance - memory.opening[l];
    pull_grouted(bolt, moved, gone, memory, tension, reserve, record);
    record.elongation = moved.back();
    for (std::size_t l = 0; l < bolt.links.size(); ++l)
    {
        if (!is_there(bolt.links[l], blocks))
            continue;
        const LinkPlace at = place_of(bolt, bolt.links[l], blocks);
        pull.add(bolt.links[l], tension[l] * at.line, at.first, at.second, reserve[l]);
        pull.damp(bolt.links[l], at, bolt.links[l].axial_stiffness, -reserve[l], reserve[l]);
    }
}
}  // namespace

void pull_bolts(const Model& model, State& state, double damping, std::vector<BlockPush>& pushes)
{
    pushes.clear();
    Pull pull(model, state.blocks, damping, pushes);
    for (std::size_t i = 0; i < model.support.bolts.size(); ++i)
    {
        const Bolt& bolt = model.support.bolts[i];
        BoltRecord& record = state.support.bolts[i];
        if (!acts(bolt, record))
            continue;
        if (std::ranges::none_of(bolt.links, [&](const BoltLink& link) { return is_there(link, state.blocks); }))
        {
            record.status = BoltStatus::lost;
            record.force = record.shear_force = record.stored = 0.0;
            continue;
        }
        if (bolt.kind == BoltKind::anchored)
            pull_anchored(bolt, state.blocks, *memory_of<AnchoredMemory>(bolt, state.support.history), record, pull);
        else if (bolt.kind == BoltKind::local)
            pull_local(bolt, state.blocks, memory_of<LocalMemory>(bolt, state.support.history), record, pull);
        else
            pull_bar(bolt, state.blocks, grouted_memory(bolt, state.support.history), record, pull);
        record.greatest_force = std::max(record.greatest_force, record.force);
    }
}

void clear_bolt_forces(const std::vector<BlockPush>& pushes, const std::vector<Triple>& constant, std::vector<Triple>& external)
{
    for (const BlockPush& push : pushes)
        external[push.block] = constant.empty() ? Triple{} : constant[push.block];
}

void add_bolt_forces(const std::vector<BlockPush>& pushes, std::vector<Triple>& external)
{
    for (const BlockPush& push : pushes)
    {
        Triple& on = external[push.block];
        on = {on.x + push.force.x, on.y + push.force.y, on.w + push.force.w};
    }
}

void hold_by_bolts(const std::vector<BlockPush>& pushes, IndexRange range, Blocks& blocks)
{
    for (const BlockPush& push : pushes)
    {
        const double pull = std::sqrt(push.force.x * push.force.x + push.force.y * push.force.y);
        if (push.block < range.begin || push.block >= range.end || !(push.reserve > 0.0) || !(pull > 0.0))
            continue;
        BlockForce& on = blocks.force[push.block];
        if (on.mobilised > static_cast<float>(sliding_from))
            continue;
        on.reserve += push.reserve;
        const bool joints_hold = on.mobilised >= 0.0F || (on.contacts & contact_impulse) != 0;
        if (on.contacts != 0 && joints_hold)
            continue;
        on.contacts |= contact_force;
        on.mobilised = 0.0F;
        on.t_x = static_cast<float>(push.force.x / pull);
        on.t_y = static_cast<float>(push.force.y / pull);
    }
}

void add_bolt_work(const std::vector<BlockPush>& pushes, const Blocks& blocks, EnergyLedger& ledger)
{
    const auto power = [](const Triple& f, double x, double y, double w) { return f.x * x + f.y * y + f.w * w; };
    for (const BlockPush& push : pushes)
    {
        const BlockMotion& now = blocks.motion[push.block];
        const double after = 0.5 * blocks.step.next * power(push.force, now.vx, now.vy, now.w);
        const double work = 0.5 * blocks.step.last * power(push.force, push.velocity.x, push.velocity.y, push.velocity.w) + after;
        if (push.damps)
            ledger.local_damping -= work;
        else
            ledger.support += work;
        ledger.coasting -= after;
    }
}
}  // namespace hdem
