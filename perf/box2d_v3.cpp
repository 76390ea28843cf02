/// Box2D v3 on the same scenes, in the same run: box2d_v3_<substeps>/<scene>/<blocks>, where the build has been given one (HDEM_BOX2D_V3). Its contact points through one substep, beside
/// contact-point updates of hdem: one point through one whole cycle. As with Box2D 2.4 only the rate is compared.

#include "perf/counters.h"
#include "perf/limits.h"
#include "perf/scene_run.h"

#include <benchmark/benchmark.h>
#include <box2d/box2d.h>

#include <algorithm>

namespace hdem::perf
{
namespace
{
constexpr float step_length = 1.0F / 60.0F;
constexpr std::size_t most_corners = 8;

b2Vec2 to_box2d(const Vec2& v)
{
    return {static_cast<float>(v.x()), static_cast<float>(v.y())};
}

/// Since 3.1 friction is a number of the material.
template <typename ShapeDef>
void set_surface(ShapeDef& shape, float friction)
{
    if constexpr (requires { shape.material.friction; })
    {
        shape.material.friction = friction;
        shape.material.restitution = 0.0F;
    }
    else
    {
        shape.friction = friction;
        shape.restitution = 0.0F;
    }
}

/// A world, and its bodies.
class World
{
  public:
    World(const Model& model, const Blocks& blocks)
    {
        b2WorldDef def = b2DefaultWorldDef();
        def.gravity = to_box2d(model.gravity);
        def.enableSleep = false;
        world_ = b2CreateWorld(&def);
        for (Index i = 0; i < model.blocks(); ++i)
        {
            b2BodyDef body = b2DefaultBodyDef();
            body.type = blocks.is_free(i) ? b2_dynamicBody : b2_staticBody;
            body.position = to_box2d({blocks.motion[i].x, blocks.motion[i].y});
            bodies_.push_back(b2CreateBody(world_, &body));
            add_parts(model, i);
        }
    }
    ~World() { b2DestroyWorld(world_); }
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    void step(int substeps) { b2World_Step(world_, step_length, substeps); }

    [[nodiscard]] std::int64_t touching_points()
    {
        std::int64_t points = 0;
        for (const b2BodyId body : bodies_)
        {
            contacts_.resize(static_cast<std::size_t>(b2Body_GetContactCapacity(body)));
            const int found = b2Body_GetContactData(body, contacts_.data(), static_cast<int>(contacts_.size()));
            for (int i = 0; i < found; ++i)  // both bodies have it: it counts where the body is its first one
            {
                const b2BodyId first = b2Shape_GetBody(contacts_[i].shapeIdA);
                points += first.index1 == body.index1 ? contacts_[i].manifold.pointCount : 0;
            }
        }
        return points;
    }

  private:
    void add_parts(const Model& model, Index block)
    {
        const Shapes& shapes = model.shapes;
        b2ShapeDef def = b2DefaultShapeDef();
        def.density = static_cast<float>(model.mass[block] / model.area[block]);
        set_surface(def, static_cast<float>(model.joints.laws.front().friction_coefficient));
        for (Index part = shapes.part_begin[block]; part < shapes.part_begin[block + 1]; ++part)
        {
            std::vector<b2Vec2> corners;
            for (Index v = shapes.vertex_begin[part]; v < shapes.vertex_begin[part + 1]; ++v)
                corners.push_back(to_box2d(shapes.vertex[v]));
            corners.resize(std::min(corners.size(), most_corners));
            const b2Hull hull = b2ComputeHull(corners.data(), static_cast<int>(corners.size()));
            if (hull.count == 0)
                continue;  // too small for single precision
            const b2Polygon polygon = b2MakePolygon(&hull, 0.0F);
            b2CreatePolygonShape(bodies_.back(), &def, &polygon);
        }
    }

    b2WorldId world_;
    std::vector<b2BodyId> bodies_;
    std::vector<b2ContactData> contacts_;
};

void run_steps(benchmark::State& bench, const std::string& scene, Index blocks, int substeps)
{
    const Simulation settled = settled_run(scene, blocks, Method::hybrid, 1);
    World world(settled.model(), settled.state().blocks);
    const auto steps = std::max<std::int64_t>(2, 200'000 / blocks);
    for (int i = 0; i < 10; ++i)
        world.step(substeps);
    std::int64_t points = 0;
    Limits limits(1, false);
    Elapsed time;
    for (auto _ : bench)
    {
        for (std::int64_t i = 0; i < steps; ++i)
        {
            limits.look();
            const Stopwatch watch;
            world.step(substeps);
            time += watch.elapsed();
            points += substeps * world.touching_points();
        }
        bench.SetIterationTime(time.wall);
    }
    report_points(bench, static_cast<double>(points));
    limits.report_operations(bench, static_cast<double>(points), time);
    bench.counters["contact_points"] = static_cast<double>(world.touching_points());
    bench.counters["blocks"] = static_cast<double>(settled.model().blocks());
}

[[maybe_unused]] const bool registered = []
{
    for (const char* scene : {"wall", "voronoi", "joints"})
        for (const Index blocks : {1'000, 10'000, 100'000})
            for (const int substeps : {4, 16})
                benchmark::RegisterBenchmark(
                    ("box2d_v3_" + std::to_string(substeps) + '/' + scene + '/' + std::to_string(blocks)).c_str(),
                    [=](benchmark::State& bench) { run_steps(bench, scene, blocks, substeps); })
                    ->UseManualTime()
                    ->Iterations(1)
                    ->Unit(benchmark::kMillisecond);
    return true;
}();
}  // namespace
}  // namespace hdem::perf
