#include "core/boundary/mean_hold.h"

#include <algorithm>

namespace hdem
{
namespace
{
/// Blocks as one rigid body.
struct RigidBody
{
    double mass = 0.0;     ///< [kg]
    double inertia = 0.0;  ///< about the centre [kg m2]
    Vec2 centre = {0.0, 0.0};
};

RigidBody body_of(const std::vector<Index>& held, const Model& model, const Blocks& blocks)
{
    RigidBody body;
    for (const Index b : held)
    {
        body.mass += model.mass[b];
        body.centre += model.mass[b] * Vec2(blocks.motion[b].x, blocks.motion[b].y);
    }
    body.centre /= body.mass;
    for (const Index b : held)
        body.inertia += model.mass[b] * (Vec2(blocks.motion[b].x, blocks.motion[b].y) - body.centre).squaredNorm() +
                        model.inertia[b];
    return body;
}

/// Of a rigid body: acceleration or velocity of its centre, and of its turn.
struct RigidMotion
{
    Vec2 along = {0.0, 0.0};
    double turn = 0.0;

    [[nodiscard]] Vec2 at(const Vec2& arm) const { return along + turn * turned_left(arm); }
};
}  // namespace

std::vector<Index> blocks_held_on_average(const Model& model, const State& state)
{
    std::vector<Index> users;
    if (!model.holds_mean)
        return users;
    for (const Boundary& boundary : model.boundaries)
        if (boundary.kind == BoundaryKind::stress && boundary.acts(state.stage))
            for (const BoundaryFace& face : boundary.faces)
                if (state.blocks.is_free(face.block))
                    users.push_back(model.user_number[face.block]);
    std::ranges::sort(users);
    users.erase(std::unique(users.begin(), users.end()), users.end());
    for (Index& number : users)
        number = model.slot_of_user[number];
    return users;
}

void hold_forces(const std::vector<Index>& held, const Model& model, Blocks& blocks)
{
    const RigidBody body = body_of(held, model, blocks);
    Vec2 force(0.0, 0.0);
    double moment = 0.0;
    const auto arm = [&](Index b) { return Vec2(Vec2(blocks.motion[b].x, blocks.motion[b].y) - body.centre); };
    for (const Index b : held)
    {
        const Vec2 on(blocks.force[b].x, blocks.force[b].y);
        force += on;
        moment += cross(arm(b), on) + blocks.force[b].moment;
    }
    const RigidMotion acceleration{force / body.mass, moment / body.inertia};
    for (const Index b : held)
    {
        const Vec2 carried = model.mass[b] * acceleration.at(arm(b));
        blocks.force[b].x -= carried.x();
        blocks.force[b].y -= carried.y();
        blocks.force[b].moment -= model.inertia[b] * acceleration.turn;
    }
}

void hold_velocities(const std::vector<Index>& held, const Model& model, const std::vector<Triple>* pseudo, Blocks& blocks,
                     EnergyLedger& ledger)
{
    const RigidBody body = body_of(held, model, blocks);
    Vec2 momentum(0.0, 0.0);
    double spin = 0.0;
    const auto arm = [&](Index b) { return Vec2(Vec2(blocks.motion[b].x, blocks.motion[b].y) - body.centre); };
    for (const Index b : held)
    {
        const Triple corrected = pseudo == nullptr ? Triple{} : (*pseudo)[static_cast<std::size_t>(b)];
        const Vec2 v = model.mass[b] * (blocks.velocity(b) + Vec2(corrected.x, corrected.y));
        momentum += v;
        spin += cross(arm(b), v) + model.inertia[b] * (blocks.motion[b].w + corrected.w);
    }
    const RigidMotion velocity{momentum / body.mass, spin / body.inertia};
    const double after = 0.5 * blocks.step.next;
    for (const Index b : held)
    {
        BlockMotion& motion = blocks.motion[b];
        const BlockForce& force = blocks.force[b];
        const Vec2 before(motion.vx, motion.vy), change = -velocity.at(arm(b)), weight = model.mass[b] * model.gravity;
        const Vec2 mean = before + 0.5 * change;
        motion.vx += change.x();
        motion.vy += change.y();
        motion.w -= velocity.turn;
        // Weight and contacts act over the second half of the step with the new velocities; the rest of the change is this one's.
        const double of_weight = after * weight.dot(change);
        const double of_all = after * (force.x * change.x() + force.y * change.y() - force.moment * velocity.turn);
        const double gain = model.mass[b] * mean.dot(change) - model.inertia[b] * (motion.w + 0.5 * velocity.turn) * velocity.turn;
        ledger.gravity_work += of_weight;
        ledger.coasting += of_all - of_weight;
        ledger.load_work += gain - of_all;
    }
}
}  // namespace hdem
