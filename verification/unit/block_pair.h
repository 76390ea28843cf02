#pragma once
/// Two blocks and the contacts between them, without a run around them: detection and contact laws one call at a time.

#include "core/contact/block_forces.h"
#include "core/contact/contact_forces.h"
#include "core/detection/contact_tracking.h"
#include "core/detection/edge_touch.h"
#include "core/detection/manifold.h"
#include "core/rock/build_model.h"
#include "verification/scenes/scenes.h"

#include <rapidcheck.h>

#include <cmath>
#include <string>
#include <vector>

namespace hdem::test
{
/// Uniform in [low, high] in steps of a millionth of it; shrinks towards `low`.
inline double number(double low, double high)
{
    return low + (high - low) * 1e-6 * static_cast<double>(*rc::gen::inRange(0, 1000001));
}

/// Convex, 3 to 7 corners on an ellipse about the origin, size 0.5 to 2 m, no edge next to nothing.
inline Polygon random_convex()
{
    const int corners = *rc::gen::inRange(3, 8);
    const double a = number(0.25, 1.0), b = number(0.25, 1.0);
    const double start = number(0.0, 6.28);
    Polygon polygon;
    for (int k = 0; k < corners; ++k)
    {
        const double angle = start + 2.0 * std::numbers::pi / corners * (k + number(0.0, 0.6));
        polygon.emplace_back(a * std::cos(angle), b * std::sin(angle));
    }
    return polygon;
}

/// Blocks `a` and `b`, shapes as given, 100 m apart until placed.
inline CaseDef pair_scene(const Polygon& a, const Polygon& b)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_block(scene, "a", a);
    Polygon moved = b;
    for (Vec2& p : moved)
        p += Vec2(100.0, 0.0);
    scenes::add_block(scene, "b", moved);
    scene.time.step = 1e-5;
    return scene;
}

struct BlockPair
{
    Model model;
    State state;
    ContactLoads loads;
    Index a, b;

    explicit BlockPair(const CaseDef& scene) : BlockPair(build_model(scene)) {}
    explicit BlockPair(Setup setup)
        : model(std::move(setup.model)),
          state(std::move(setup.state)),
          a(model.find_block("a")),
          b(model.find_block("b"))
    {
    }

    BlockMotion& motion(Index block) { return state.blocks.motion[block]; }

    void place(Index block, const Vec2& at, double angle)
    {
        BlockMotion& m = motion(block);
        m.x = at.x();
        m.y = at.y();
        m.c = std::cos(angle);
        m.s = std::sin(angle);
        m.angle = angle;
    }

    /// Of a block's part at its pose.
    [[nodiscard]] Polygon outline(Index block, Index part = 0) const
    {
        const Shapes& shapes = model.shapes;
        const BlockMotion& m = state.blocks.motion[block];
        Polygon polygon;
        const Index p = shapes.part_begin[block] + part;
        for (Index v = shapes.vertex_begin[p]; v < shapes.vertex_begin[p + 1]; ++v)
            polygon.push_back(world(m, shapes.vertex[v]));
        return polygon;
    }
    static Vec2 world(const BlockMotion& m, const Vec2& p)
    {
        return {m.x + m.c * p.x() - m.s * p.y(), m.y + m.s * p.x() + m.c * p.y()};
    }

    /// Search all contacts between all blocks; contacts known before keep their history.
    void search()
    {
        std::vector<Contact> found;
        const Shapes& shapes = model.shapes;
        for (Index i = 0; i < shapes.parts(); ++i)
            for (Index j = i + 1; j < shapes.parts(); ++j)
            {
                Contact contact{.part_a = i, .part_b = j};
                for (Index k = 0; k < state.contacts.size(); ++k)
                    if (state.contacts.part_a[k] == i && state.contacts.part_b[k] == j)
                        contact = state.contacts.get(k);
                if (shapes.part_block[i] != shapes.part_block[j] &&
                    find_features(model, state.blocks, contact) <= skin_width(model))
                    found.push_back(contact);
            }
        state.contacts.resize(static_cast<Index>(found.size()));
        for (Index i = 0; i < state.contacts.size(); ++i)
            state.contacts.put(i, found[i]);
    }

    /// Contact forces at the present poses, without weights; forces on each block are in state.blocks.force.
    void evaluate(ContactLaw law = ContactLaw::springs) { evaluate(RegimeRule{.law = law}); }
    void evaluate(const RegimeRule& rule)
    {
        const IndexRange all{0, state.contacts.size()};
        loads.resize(state.contacts.stale.size());
        evaluate_contacts(all, model, rule, state.blocks, state.contacts, loads);
        BlockContacts list;
        list_block_contacts(state.contacts, state.blocks.size(), list);
        Model weightless = model;
        weightless.gravity = {0.0, 0.0};
        sum_forces({0, state.blocks.size()}, weightless, list, loads, {}, true, state.blocks);
    }

    [[nodiscard]] Vec2 force(Index block) const { return {state.blocks.force[block].x, state.blocks.force[block].y}; }
    [[nodiscard]] double moment(Index block) const { return state.blocks.force[block].moment; }

    [[nodiscard]] EdgeTouch touch(const Contact& contact) const
    {
        const BlockMotion& ref = state.blocks.motion[contact.ref];
        const BlockMotion& inc = state.blocks.motion[contact.inc];
        return touch_edges(contact.edges, ref, inc);
    }
    [[nodiscard]] bool is_closed_at(const Contact& contact) const
    {
        const EdgeTouch t = touch(contact);
        return is_closed(t.length, t.point[0].overlap, contact.length_floor) ||
               is_closed(t.length, t.point[1].overlap, contact.length_floor);
    }
};
}  // namespace hdem::test
