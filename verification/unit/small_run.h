#pragma once
/// What the tests of the writers share: a model of a ground, a block on it and a concave block, made by hand, and a folder
/// that goes away.

#include "core/check.h"
#include "core/geometry/convex_part.h"
#include "core/geometry/polygon.h"
#include "core/geometry/reflex_vertices.h"
#include "core/geometry/twin_edges.h"
#include "core/model/model.h"
#include "core/state/state.h"
#include "verification/runs/scratch_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace hdem::test
{
using runs::ScratchFolder;

inline std::string text_in(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// Of the RunError that it ends with.
template <class Action>
std::string message_of(const Action& action)
{
    try
    {
        action();
    }
    catch (const RunError& error)
    {
        return error.what();
    }
    return "no error";
}

struct SmallRun
{
    Model model;
    State state;
};

/// Add a block of convex parts given in the user's coordinates, with the density 2700 kg/m3.
inline Index add_block(SmallRun& run, const std::string& name, const std::vector<ConvexPart>& parts, bool fixed)
{
    Model& model = run.model;
    Blocks& blocks = run.state.blocks;
    const Index number = model.blocks();
    std::vector<AreaMoments> moments;
    for (const ConvexPart& part : parts)
        moments.push_back(area_moments(part.vertices));
    const AreaMoments whole = combined(moments);
    double radius = 0.0;
    for (const ConvexPart& part : parts)
        for (const Vec2& v : part.vertices)
            radius = std::max(radius, (v - whole.centroid).norm());
    if (number == 0)
        model.shapes.part_begin = model.shapes.vertex_begin = {0};
    for (const ConvexPart& part : parts)
    {
        for (std::size_t i = 0; i < part.vertices.size(); ++i)
        {
            const Vec2 edge = part.vertices[next(i, part.vertices.size())] - part.vertices[i];
            model.shapes.vertex.push_back(part.vertices[i] - whole.centroid);
            model.shapes.edge_tangent.push_back(edge.normalized());
            model.shapes.edge_length.push_back(edge.norm());
            model.shapes.edge_source.push_back(part.source[i]);
        }
        model.shapes.part_centre.push_back(area_moments(part.vertices).centroid - whole.centroid);
        model.shapes.part_radius.push_back(2.0 * radius);
        model.shapes.part_block.push_back(number);
        model.shapes.vertex_begin.push_back(static_cast<Index>(model.shapes.vertex.size()));
    }
    std::ranges::copy(reflex_vertices(parts), std::back_inserter(model.shapes.is_reflex));
    std::ranges::copy(twin_edges(parts), std::back_inserter(model.shapes.to_twin));
    model.shapes.part_begin.push_back(model.shapes.parts());
    model.name.push_back(name);
    model.material.push_back(fixed ? 1 : 0);
    model.excavation.push_back(no_index);
    model.area.push_back(whole.area);
    model.mass.push_back(2700.0 * whole.area);
    model.inertia.push_back(2700.0 * whole.polar);
    model.radius.push_back(radius);
    const Vec2 at = whole.centroid - model.origin;
    blocks.motion.push_back({.x = at.x(), .y = at.y()});
    blocks.force.emplace_back();
    blocks.stable_step.push_back(0.0);
    blocks.bearing_force.push_back(0.0);
    blocks.rest.push_back(0);
    blocks.margin.push_back(1.0);
    blocks.inertia.push_back(
        fixed ? BlockInertia{} : BlockInertia{1.0 / model.mass.back(), 1.0 / model.mass.back(), 1.0 / model.inertia.back(), 0.0});
    blocks.present.push_back(1);
    blocks.reference_position.push_back(at);
    model.start.push_back(at);
    blocks.reference_angle.push_back(0.0);
    return number;
}

/// One [[history]]; blocks: one name, or two for the contacts between them.
inline HistoryDef history(const std::string& name, const std::vector<std::string>& blocks,
                          const std::vector<std::string>& quantities, std::int64_t every = 1)
{
    HistoryDef def;
    def.name = name;
    if (blocks.size() == 1)
        def.block = blocks[0];
    else
        def.between = blocks;
    def.quantities = quantities;
    def.every = every;
    return def;
}

inline ConvexPart rectangle(double x0, double y0, double x1, double y1, std::vector<std::int32_t> source = {})
{
    if (source.empty())
        source.assign(4, edge_plain);
    return {.vertices = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, .source = std::move(source)};
}

/// A contact between faces that touch: edge numbers within the first part of each block, ref owns the reference edge.
inline void add_contact(SmallRun& run, Index ref, Index ref_edge, Index inc, Index inc_edge)
{
    const Shapes& shapes = run.model.shapes;
    const auto place_of = [&](Index block, Index edge, int end)
    {
        const Index part = shapes.part_begin[block];
        const Index v = shapes.vertex_begin[part] + edge;
        return shapes.vertex[end == 0 ? v : shapes.next_vertex(part, v)];
    };
    const Index edge = shapes.vertex_begin[shapes.part_begin[ref]] + ref_edge;
    const Vec2 t = shapes.edge_tangent[edge];
    const Vec2 start = shapes.vertex[edge];
    const Vec2 p0 = place_of(inc, inc_edge, 0);
    const Vec2 p1 = place_of(inc, inc_edge, 1);
    Contact contact;
    contact.part_a = std::min(shapes.part_begin[ref], shapes.part_begin[inc]);
    contact.part_b = std::max(shapes.part_begin[ref], shapes.part_begin[inc]);
    contact.ref = ref;
    contact.inc = inc;
    contact.ref_edge = edge;
    contact.inc_edge = shapes.vertex_begin[shapes.part_begin[inc]] + inc_edge;
    contact.length_floor = 1e-3;
    contact.last_length = 0.5;
    contact.edges = {t.x(),  t.y(),  start.dot(t), start.dot(turned_left(t)), shapes.edge_length[edge], p0.x(),
                     p0.y(), p1.x(), p1.y()};
    const Index i = run.state.contacts.size();
    run.state.contacts.resize(i + 1);
    run.state.contacts.put(i, contact);
    ++run.state.broad_phase_runs;
}

inline void load_contact(SmallRun& run, Index contact, double normal, double shear, Regime regime)
{
    for (int k = 0; k < 2; ++k)
    {
        run.state.contacts.normal_force(k, contact) = 0.5 * normal;
        run.state.contacts.shear_force(k, contact) = 0.5 * shear;
        run.state.contacts.regime[k][contact] = static_cast<std::uint8_t>(regime);
    }
}

/// Stored in the order ground, l, block; the user's order is ground 0, block 1, l 2. The ground's upper face is y = 200; the block
/// 1 m x 1 m stands on it at x = 100 to 101, the l of two parts floats beside.
inline SmallRun small_run()
{
    SmallRun run;
    Model& model = run.model;
    model.title = "small run";
    model.origin = {100.0, 200.0};
    model.material_names = {"rock", "ground"};
    model.joints.laws = {{.normal_stiffness = 7e9, .shear_stiffness = 5e8, .friction_coefficient = 0.5}};
    model.stages.resize(1);
    model.stages[0].name = "rest";
    model.time_step = 1e-4;
    run.state.blocks.step = {1e-4, 1e-4};
    add_block(run, "ground", {rectangle(99.0, 199.0, 102.0, 200.0)}, true);
    const ConvexPart lower = {.vertices = {{103.0, 200.0}, {105.0, 200.0}, {105.0, 201.0}, {104.0, 201.0}, {103.0, 201.0}},
                              .source = {edge_plain, edge_plain, edge_plain, edge_internal, edge_plain}};
    add_block(run, "l", {lower, rectangle(103.0, 201.0, 104.0, 202.0, {edge_internal, edge_plain, edge_plain, edge_plain})}, false);
    add_block(run, "block", {rectangle(100.0, 200.0, 101.0, 201.0)}, false);
    model.user_number = {0, 2, 1};
    model.slot_of_user = {0, 2, 1};
    add_contact(run, 0, 2, 2, 0);
    run.state.cycle = 7;
    run.state.time = 7e-4;
    return run;
}
}  // namespace hdem::test
