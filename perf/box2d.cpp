/// Box2D 2.4 on the same scenes, in the same run: box2d/<scene>/<blocks>. Its contact points through one step, with 8 velocity and 3 position
/// iterations, beside contact-point updates of hdem: one point through one whole cycle. Only the rate is compared: Box2D is in single precision, gives no true
/// stresses, and its steps are longer.

#include "perf/counters.h"
#include "perf/limits.h"
#include "perf/scene_run.h"

#include <benchmark/benchmark.h>
#include <box2d/box2d.h>

namespace hdem::perf
{
namespace
{
constexpr float step_length = 1.0f / 60.0f;
constexpr int velocity_iterations = 8;
constexpr int position_iterations = 3;

b2Vec2 to_box2d(const Vec2& v)
{
    return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}

void add_parts(const Model& model, Index block, b2Body& body)
{
    const Shapes& shapes = model.shapes;
    for (Index part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part)
    {
        std::vector<b2Vec2> vertices;
        for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
            vertices.push_back(to_box2d(shapes.vertex[v]));
        // Its polygons have no more corners than that; in Voronoi cells one or two of a thousand have.
        vertices.resize(std::min<std::size_t>(vertices.size(), b2_maxPolygonVertices));
        b2PolygonShape shape;
        shape.Set(vertices.data(), static_cast<int32>(vertices.size()));
        b2FixtureDef fixture;
        fixture.shape = &shape;
        fixture.density = static_cast<float>(model.mass[block] / model.area[block]);
        fixture.friction = static_cast<float>(model.joints.laws.front().friction_coefficient);
        fixture.restitution = 0.0f;
        body.CreateFixture(&fixture);
    }
}

void fill(b2World& world, const Model& model, const Blocks& blocks)
{
    for (Index i = 0; i < model.blocks(); ++i)
    {
        b2BodyDef def;
        def.type = blocks.is_free(i) ? b2_dynamicBody : b2_staticBody;
        def.position = to_box2d({blocks.motion[i].x, blocks.motion[i].y});
        add_parts(model, i, *world.CreateBody(&def));
    }
}

std::int64_t touching_points(const b2World& world)
{
    std::int64_t points = 0;
    for (const b2Contact* contact = world.GetContactList(); contact != nullptr; contact = contact->GetNext())
        if (contact->IsTouching())
            points += contact->GetManifold()->pointCount;
    return points;
}

void run_steps(benchmark::State& bench, const std::string& scene, Index blocks)
{
    const Simulation settled = settled_run(scene, blocks, Method::hybrid, 1);
    b2World world(to_box2d(settled.model().gravity));
    world.SetAllowSleeping(false);
    fill(world, settled.model(), settled.state().blocks);
    const auto steps = std::max<std::int64_t>(2, 100'000 / blocks);
    for (int i = 0; i < 10; ++i)
        world.Step(step_length, velocity_iterations, position_iterations);
    std::int64_t points = 0;
    Limits limits(1, false);
    Elapsed time;
    for (auto _ : bench)
    {
        for (std::int64_t i = 0; i < steps; ++i)
        {
            limits.look();
            const Stopwatch watch;
            world.Step(step_length, velocity_iterations, position_iterations);
            time += watch.elapsed();
            points += touching_points(world);
        }
        bench.SetIterationTime(time.wall);
    }
    report_points(bench, static_cast<double>(points));
    limits.report_operations(bench, static_cast<double>(points), time);
    bench.counters["contact_points"] = static_cast<double>(touching_points(world));
    bench.counters["blocks"] = static_cast<double>(settled.model().blocks());
}

[[maybe_unused]] const bool registered = []
{
    for (const char* scene : {"wall", "voronoi", "joints"})
        for (const Index blocks : {1'000, 10'000, 100'000})
            benchmark::RegisterBenchmark(("box2d/" + std::string(scene) + "/" + std::to_string(blocks)).c_str(),
                                         [=](benchmark::State& bench) { run_steps(bench, scene, blocks); })
                ->UseManualTime()
                ->Iterations(1)
                ->Unit(benchmark::kMillisecond);
    return true;
}();
}  // namespace
}  // namespace hdem::perf
