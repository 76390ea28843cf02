#include "verification/unit/block_pair.h"
#include "verification/unit/case_run.h"

#include <gtest/gtest.h>

namespace hdem
{
namespace
{
using scenes::rectangle;
using test::BlockPair;
using test::CaseRun;

const Polygon unit_square = rectangle({-0.5, -0.5}, {0.5, 0.5});

bool is_external(const Model& model, Index edge)
{
    return model.shapes.edge_source[edge] != edge_internal;
}

TEST(Manifold, OfASquareOnASlabIsTheFaceBetweenThem)
{
    BlockPair pair(test::pair_scene(rectangle({-2, -1}, {2, 0}), unit_square));
    pair.place(pair.b,
               pair.motion(pair.a).y == 0.0 ? Vec2(0.25, 1.0 - 1e-5)
                                            : Vec2(pair.motion(pair.a).x + 0.25, pair.motion(pair.a).y + 1.0 - 1e-5),
               0.0);
    pair.search();
    ASSERT_EQ(pair.state.contacts.size(), 1);
    Contact contact = pair.state.contacts.get(0);
    EXPECT_NEAR(find_features(pair.model, pair.state.blocks, contact), -1e-5, 1e-12);  // round-off of some metres
    EXPECT_EQ(contact.ref, pair.a) << "near ties go to the longer edge";
    EXPECT_NEAR(pair.touch(contact).length, 1.0, 1e-12);
    pair.evaluate();
    // Total stiffness 7e9 Pa/m times 1 m, and round-off of the overlap.
    EXPECT_NEAR(pair.force(pair.b).y(), 7e9 * 1e-5, 7e9 * 1e-12);
    EXPECT_NEAR(pair.force(pair.b).x(), 0.0, 1e-6);
    EXPECT_NEAR(pair.moment(pair.b), 0.0, 7e9 * 1e-12);
}

TEST(Manifold, OfACornerOnAFaceTakesTheFaceForReference)
{
    BlockPair pair(test::pair_scene(unit_square, unit_square));
    pair.place(pair.a, {0, 0}, 0.0);
    pair.place(pair.b, {0.1, 0.5 + std::sqrt(0.5) - 1e-4}, radians(45.0));
    pair.search();
    ASSERT_EQ(pair.state.contacts.size(), 1);
    const Contact contact = pair.state.contacts.get(0);
    EXPECT_EQ(contact.ref, pair.a);
    const EdgeTouch touch = pair.touch(contact);
    EXPECT_NEAR(std::max(touch.point[0].overlap, touch.point[1].overlap), 1e-4, 1e-12);
}

TEST(Manifold, CarriesAPairInTheSkinOnly)
{
    BlockPair pair(test::pair_scene(unit_square, unit_square));
    const double skin = skin_width(pair.model);
    ASSERT_GT(skin, 0.0);
    pair.place(pair.a, {0, 0}, 0.0);
    pair.place(pair.b, {0, 1.0 + 0.99 * skin}, 0.0);
    pair.search();
    EXPECT_EQ(pair.state.contacts.size(), 1);
    pair.place(pair.b, {0, 1.0 + 1.01 * skin}, 0.0);
    pair.search();
    EXPECT_EQ(pair.state.contacts.size(), 0);
}

/// A corner on a corner has next to no length; the floor keeps it from being without force.
TEST(Manifold, OfACornerOnACornerStillCarries)
{
    const auto force = [&](double overlap)
    {
        BlockPair pair(test::pair_scene(unit_square, unit_square));
        pair.place(pair.a, {0, 0}, radians(45.0));
        pair.place(pair.b, {1e-6, 2.0 * std::sqrt(0.5) - overlap}, radians(45.0));
        pair.search();
        EXPECT_EQ(pair.state.contacts.size(), 1);
        pair.evaluate();
        return pair.force(pair.b).norm();
    };
    EXPECT_EQ(force(1e-5), 0.0) << "narrower than a corner";
    const double least = 0.5 * 7e9 * 1e-3 * 1e-4;  // one point of half the floor, some of the overlap
    EXPECT_GT(force(1e-3), least);
}

/// Greatest overlap of a pair's contact; 0 when its edges are beside each other.
double overlap_of(const BlockPair& pair)
{
    const EdgeTouch touch = pair.touch(pair.state.contacts.get(0));
    return touch.length > 0.0 ? std::max({0.0, touch.point[0].overlap, touch.point[1].overlap}) : 0.0;
}

/// Middle of the upper side of the slab.
Vec2 top_of(const BlockPair& pair)
{
    Vec2 low(1e9, 1e9), high(-1e9, -1e9);
    for (const Vec2& p : pair.outline(pair.a))
    {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return {0.5 * (low.x() + high.x()), high.y()};
}

/// A side with vertices in its middle, in one line or almost: an outline that joints have cut leaves such ones.
const std::vector<Polygon> split_slabs{{{-2, -1}, {2, -1}, {2, 0}, {0.3, 0}, {-0.5, 0}, {-2, 0}},
                                       {{-2, -1}, {2, -1}, {2, 0}, {0.3, 5e-5}, {-0.5, 5e-5}, {-2, 0}}};

/// The piece under the corner is the reference wherever it is, whichever piece was it before.
TEST(Manifold, OfACornerThatSlidesOverASplitSideKeepsItsOverlap)
{
    for (const Polygon& slab : split_slabs)
    {
        BlockPair pair(test::pair_scene(slab, unit_square));
        const Vec2 top = top_of(pair);
        const double depth = 1e-3;
        for (const double sense : {1.0, -1.0})
            for (double x = -1.9; x <= 1.9; x += 0.01)
            {
                pair.place(pair.b, top + Vec2(sense * x, std::sqrt(0.5) - depth), radians(45.0));
                pair.search();
                ASSERT_EQ(pair.state.contacts.size(), 1);
                EXPECT_NEAR(overlap_of(pair), depth, 6e-5) << "at " << sense * x;
            }
    }
}

/// A corner that looks into a split side: the piece that holds the corner faces it, not its neighbour in the same line.
TEST(Manifold, OfASplitSideOnACornerTakesThePieceOverTheCorner)
{
    for (const Polygon& slab : split_slabs)
    {
        BlockPair pair(test::pair_scene(slab, rectangle({-0.05, -0.05}, {0.05, 0.05})));
        const Vec2 top = top_of(pair);
        // The small block's side runs over the slab's corner, at an angle that makes that side the reference.
        for (const double side : {1.0, -1.0})
            for (const double depth : {1e-4, 1e-3, 5e-3})
            {
                const double turn = radians(-37.0 * side);
                const Vec2 down(std::sin(turn), -std::cos(turn));  // outward normal of its lower side
                pair.place(pair.b, top + Vec2(2.0 * side, 0.0) - (0.05 - depth) * down, turn);
                pair.search();
                ASSERT_EQ(pair.state.contacts.size(), 1);
                EXPECT_NEAR(overlap_of(pair), depth, 6e-5) << side << ' ' << depth;
            }
    }
}

// ---- concave blocks -------------------------------------------------------------------------------------------------

/// Rock 6 m x 3 m over a drift 2 m wide, parted above the walls of the drift up to the surface: one rigid block of several parts with a flat
/// top at y = 3, and a block 1 m x 1 m on it.
CaseDef block_over_drift(double left, double overlap)
{
    CaseDef scene = scenes::empty_scene();
    scene.domain = {
        .given = true, .polygon = {{0.0, 0.0}, {6.0, 0.0}, {6.0, 3.0}, {4.0, 3.0}, {2.0, 3.0}, {0.0, 3.0}}, .fixed_edges = {1, 5}};
    scene.excavations = {{.name = "drift", .shape = OutlineShape::rectangle, .position = {3.0, 0.0}, .width = 2.0, .height = 1.5}};
    scene.stages[0].excavate = {"drift"};
    scenes::add_block(scene, "block", rectangle({left, 3.0 - overlap}, {left + 1.0, 4.0 - overlap}));
    scene.damping.preset = DampingPreset::dynamic;
    scene.contact.method = Method::force;
    return scene;
}

/// Where a boundary between two parts meets the top.
double boundary_on_top()
{
    const hdem::Setup setup = build_model(block_over_drift(0.0, 0.0));
    const Model& model = setup.model;
    const Shapes& shapes = model.shapes;
    for (Index part = 0; part < shapes.parts(); ++part)
        for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
            for (const Index end : {v, shapes.next_vertex(part, v)})
            {
                const Vec2 at = BlockPair::world(setup.state.blocks.motion[shapes.part_block[part]], shapes.vertex[end]) +
                                model.origin;
                if (!is_external(model, v) && std::abs(at.y() - 3.0) < 1e-9 && std::abs(at.x() - 3.0) < 1.5)
                    return at.x();
            }
    ADD_FAILURE() << "no part ends on the top";
    return 3.0;
}

/// Contact force on the block: all but its weight [N].
Vec2 support(const CaseRun& run)
{
    const BlockForce& force = run.state().blocks.force[run.slot("block")];
    return Vec2(force.x, force.y) - run.model().mass[run.slot("block")] * run.model().gravity;
}

TEST(ConcaveBlock, CarriesABlockAcrossThePartsAsIfItWereUncut)
{
    constexpr double overlap = 5e-7;
    const double boundary = boundary_on_top();
    for (const double beyond : {-0.5, -0.25, -0.9, 0.1})
    {
        CaseRun run(block_over_drift(boundary + beyond, overlap));
        run.advance(1);
        // Round-off 1e-15 m of the overlap; a part with no more than a corner of the block on it brings its floor of 1 mm.
        EXPECT_NEAR(support(run).y(), 7e9 * overlap, 2e-3 * 7e9 * overlap) << "from " << beyond << " m beyond the boundary";
        EXPECT_NEAR(support(run).x(), 0.0, 1e-3);
    }
}

/// The least way out of a part may lead across its boundary to the next one, into solid rock.
TEST(ConcaveBlock, PushesOutAcrossItsFacesNeverAcrossItsParts)
{
    const double boundary = boundary_on_top();
    for (const double beyond : {1e-8, -1e-8, 1e-7, 3e-7})
        for (const double side : {0.0, 1.0})
        {
            CaseRun run(block_over_drift(boundary + beyond - side, 5e-7));  // a side face of it stands at the boundary
            run.advance(1);
            EXPECT_NEAR(support(run).x(), 0.0, 1e-3) << beyond;
            EXPECT_GT(support(run).y(), 0.9 * 7e9 * 5e-7);
        }
}

TEST(ConcaveBlock, LetsABlockSlideAcrossItsParts)
{
    const double boundary = boundary_on_top();
    CaseDef scene = block_over_drift(boundary - 1.3, 0.0);
    scene.joints[0].friction_angle_deg = 0.0;
    scene.blocks[0].velocity = {1.0, 0.0};
    CaseRun run(scene);
    while (run.state().time < 0.7)
    {
        run.advance(500);
        const Contacts& contacts = run.state().contacts;
        for (Index c = 0; c < contacts.size(); ++c)
        {
            EXPECT_TRUE(is_external(run.model(), contacts.ref_edge[c]));
            EXPECT_TRUE(is_external(run.model(), contacts.inc_edge[c]));
        }
    }
    // It bobs by its static deflection, 3.8 um, which tilts it by as much while it straddles the parts.
    EXPECT_NEAR(run.velocity("block").x(), 1.0, 1e-3);
    EXPECT_NEAR(run.displacement("block").y(), 0.0, 2e-5);
}

TEST(ConcaveBlock, HoldsABlockInItsNotchOnBothFaces)
{
    CaseDef scene = scenes::empty_scene();
    scenes::add_fixed_block(scene, "l", {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}});
    scenes::add_block(scene, "block", rectangle({1, 1}, {2, 2}));
    scene.gravity = {-9.81, -9.81};
    CaseRun run(scene);
    run.advance(3000);
    // The weight on each face; friction shares some of it, up to strength, so the normal force may be less.
    const double weight = 2700.0 * 9.81;
    EXPECT_LT(run.displacement("block").norm(), 2e-5) << "a few static deflections of 3.8 um";
    EXPECT_LT(run.velocity("block").norm(), 1e-4);
    EXPECT_GT(run.forces_between("l", "block").x(), weight);
    for (Index c = 0; c < run.state().contacts.size(); ++c)
        EXPECT_TRUE(is_external(run.model(), run.state().contacts.ref_edge[c]));
}

// ---- four blocks in one point ---------------------------------------------------------------------------------------

TEST(CornerOnCorner, RockCutByThroughGoingJointsStands)
{
    CaseRun run(scenes::grid(4, 4));
    run.advance(4000);
    EXPECT_LT(run.simulation.equilibrium().greatest_speed, 1e-3);
    for (const std::string name : {"1.1", "2.2", "3.4", "4.4"})
        EXPECT_LT(run.displacement(name).norm(), 1e-4) << name << ": four courses press each other by 40 um at most";
    // What stands on the ground carries the column above it, all but what the walls take by friction.
    EXPECT_NEAR(run.forces_between("ground", "2.1").x(), 4 * 2700.0 * 9.81, 0.05 * 4 * 2700.0 * 9.81);
}

TEST(CornerOnCorner, RockOfInclinedJointsStands)
{
    CaseRun run(scenes::joints(8.0, 8.0, 1.0));
    run.advance(5000);
    EXPECT_LT(run.simulation.equilibrium().greatest_speed, 5e-3);
    for (Index i = 0; i < run.model().blocks(); ++i)
        EXPECT_LT(run.state().blocks.displacement(i).norm(), 1e-3) << run.model().name[i];
}
}  // namespace
}  // namespace hdem
