#include "verification/checks/robust_watch.h"

#include "core/energy_ledger.h"
#include "core/motion/equilibrium.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hdem::verification
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

Vec2 turned(const BlockMotion& m, const Vec2& v)
{
    return {m.c * v.x() - m.s * v.y(), m.s * v.x() + m.c * v.y()};
}

/// Greatest distance of part `other` from the lines of the edges of `part`; negative when it reaches behind all of them.
double separation(const Shapes& shapes, Index part, const BlockMotion& at, Index other, const BlockMotion& other_at)
{
    double greatest = -infinity;
    for (Index e = shapes.vertex_begin[part]; e < shapes.vertex_begin[part + 1]; ++e)
    {
        const Vec2 outward = -turned_left(turned(at, shapes.edge_tangent[e]));
        const Vec2 from = Vec2(other_at.x - at.x, other_at.y - at.y) - turned(at, shapes.vertex[e]);
        double least = infinity;
        for (Index v = shapes.vertex_begin[other]; v < shapes.vertex_begin[other + 1]; ++v)
            least = std::min(least, outward.dot(from + turned(other_at, shapes.vertex[v])));
        greatest = std::max(greatest, least);
    }
    return greatest;
}
}  // namespace

double penetration(const Model& model, const Blocks& blocks, Index a, Index b)
{
    const BlockMotion& at_a = blocks.motion[a];
    const BlockMotion& at_b = blocks.motion[b];
    if (std::hypot(at_a.x - at_b.x, at_a.y - at_b.y) > model.radius[a] + model.radius[b])
        return 0.0;
    const Shapes& shapes = model.shapes;
    double deepest = 0.0;
    for (Index i = shapes.part_begin[a]; i < shapes.part_begin[a + 1]; ++i)
        for (Index j = shapes.part_begin[b]; j < shapes.part_begin[b + 1]; ++j)
        {
            const double apart = separation(shapes, i, at_a, j, at_b);
            if (apart < 0.0)
                deepest = std::max(deepest, -std::max(apart, separation(shapes, j, at_b, i, at_a)));
        }
    return deepest;
}

double least_width(const Model& model, Index block)
{
    const Shapes& shapes = model.shapes;
    double width = infinity;
    for (Index part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part)
        for (Index e = shapes.vertex_begin[part]; e < shapes.vertex_begin[part + 1]; ++e)
        {
            double across = 0.0;
            for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
                across = std::max(across, cross(shapes.edge_tangent[e], Vec2(shapes.vertex[v] - shapes.vertex[e])));
            width = std::min(width, across);
        }
    return width;
}

void RobustWatch::observe(const Model& model, const State& state)
{
    if (width_.empty())
        for (Index i = 0; i < model.blocks(); ++i)
            width_.push_back(least_width(model, model.slot_of_user[i]));
    look_at_shapes(model, state.blocks);
    look_at_energy(model, state);
    if (state.time > late_)
        look_at_rest(model, state.blocks);
}

void RobustWatch::look_at_shapes(const Model& model, const Blocks& blocks)
{
    for (Index i = 0; i < model.blocks(); ++i)
    {
        const BlockMotion& m = blocks.motion[i];
        is_finite_ = is_finite_ && std::isfinite(m.x + m.y + m.c + m.s + m.vx + m.vy + m.w);
        if (!blocks.is_free(i))
            continue;
        greatest_speed_ = std::max(greatest_speed_, blocks.velocity(i).norm());
        lowest_centroid_ = std::min(lowest_centroid_, m.y + model.origin.y());
        for (Index j = 0; j < model.blocks(); ++j)
        {
            if (j == i || blocks.present[j] == 0 || (j < i && blocks.is_free(j)))
                continue;
            const double other = blocks.is_free(j) ? width_[model.user_number[j]] : infinity;
            const double width = std::min(width_[model.user_number[i]], other);
            worst_overlap_ = std::max(worst_overlap_, penetration(model, blocks, i, j) / width);
        }
    }
}

void RobustWatch::look_at_energy(const Model& model, const State& state)
{
    const StoredEnergy stored = stored_energy(model, state);
    const double energy = stored.total() - stored.pending - state.ledger.gravity_work - state.ledger.load_work -
                          state.ledger.boundary - state.ledger.water + state.ledger.removed;
    least_energy_ = std::min(least_energy_, energy);
    worst_rise_ = std::max(worst_rise_, energy - least_energy_);
    greatest_energy_ = std::max({greatest_energy_, stored.total(), std::abs(state.ledger.gravity_work)});
    if (settling_ == 0.0)
        for (Index i = 0; i < model.blocks(); ++i)
            settling_ += state.blocks.is_free(i) ? 1e-4 * least_width(model, i) * model.mass[i] * model.gravity.norm() : 0.0;
}

void RobustWatch::look_at_rest(const Model& model, const Blocks& blocks)
{
    double mass = 0.0, kinetic = 0.0, carried = 0.0;
    const double g = model.gravity.norm();
    for (Index i = 0; i < model.blocks(); ++i)
    {
        if (blocks.present[i] == 0)
            continue;
        if (blocks.is_free(i))
        {
            mass += model.mass[i];
            kinetic += kinetic_energy(model, blocks, i);
        }
        else
            carried -= (Vec2(blocks.force[i].x, blocks.force[i].y) - model.mass[i] * model.gravity).y();
    }
    ++late_samples_;
    late_speed_squared_ += 2.0 * kinetic / mass;
    late_carried_ += carried / (mass * g);
}

double RobustWatch::late_speed() const
{
    return late_samples_ > 0 ? std::sqrt(late_speed_squared_ / late_samples_) : 0.0;
}
}  // namespace hdem::verification
