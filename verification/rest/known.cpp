/// Scenes that once came to a wrong rest, each in its case file, turned by every ten degrees, by three methods.

#include "io/case_reader.h"
#include "verification/checks/case_run.h"
#include "verification/rest/families.h"
#include "verification/rest/limit_analysis.h"
#include "verification/rest/springs.h"

#include <array>
#include <cmath>

namespace hdem::verification::rest
{
namespace
{
struct Known
{
    const char* file;
    const char* what;
    Overrides overrides;
    void (*judge)(Scene&);
};

std::size_t block_named(const Scene& scene, const std::string& name)
{
    const auto block = std::ranges::find(scene.def.blocks, name, &BlockDef::name);
    return static_cast<std::size_t>(block - scene.def.blocks.begin());
}

double weight_of(const Scene& scene, std::size_t block)
{
    return density_of(scene, block) * g * area_moments(scene.def.blocks[block].polygon).area;
}

/// What gives way under the weight on a face of that length and dip [m].
double settle_on(const Scene& scene, std::size_t block, double length, double dip_deg)
{
    const JointDef& joint = scene.def.joints.front();
    const Vec2 dip = direction(dip_deg);
    return weight_of(scene, block) / length * (dip.x() / joint.normal_stiffness + dip.y() / joint.shear_stiffness);
}

/// (cos(beta) tan(phi) W + c L) / (W sin(beta))
double factor_on(const Scene& scene, std::size_t block, double length, double dip_deg)
{
    const JointDef& joint = scene.def.joints.front();
    const Vec2 dip = direction(dip_deg);
    return (dip.x() * std::tan(radians(joint.friction_angle_deg)) + joint.cohesion * length / weight_of(scene, block)) / dip.y();
}

/// One block on a plane: stays or moves by its factor of safety.
void judge_on_plane(Scene& scene, const std::string& name, double length, double dip_deg)
{
    const std::size_t block = block_named(scene, name);
    const double factor = factor_on(scene, block, length, dip_deg);
    scene.what += ", F = " + std::to_string(factor);
    scene.settle = settle_on(scene, block, length, dip_deg);
    scene.fate[block] = factor > 1.0 ? Fate::stays : Fate::moves;
    scene.stay = scene.settle * (5.0 + 1.0 / (factor - 1.0));
    scene.least_way = 0.02;
    scene.end = factor > 1.0 ? End::rests : End::never;
}

void judge_rattle(Scene& scene)
{
    judge_on_plane(scene, "block", 2.0, 37.0);
}

void judge_slide(Scene& scene)
{
    judge_on_plane(scene, "slider", 1.0, 30.0);
}

void judge_wedge(Scene& scene)
{
    const Polygon& wedge = scene.def.blocks[block_named(scene, "wedge")].polygon;
    judge_on_plane(scene, "wedge", (wedge[1] - wedge[0]).norm(), 38.0);
    if (scene.end == End::never)
        scene.end = End::open;  // it runs out, and falls
    scene.same_in_twin = scene.end == End::rests;
}

/// Which share of its point load it can carry at most.
double greatest_share(const Scene& scene)
{
    const std::vector<Body> bodies = bodies_of(scene);
    Loads live(bodies.size(), Eigen::Vector3d(0.0, 0.0, 0.0));
    const LoadDef& load = scene.def.loads.front();
    live[block_named(scene, load.blocks.front())].head<2>() = load.force;
    const Strength strength{std::tan(radians(scene.def.joints.front().friction_angle_deg)), scene.def.joints.front().cohesion};
    return load_multiplier(bodies, touching_at_start(scene, bodies), strength, weights(bodies, scene.def.gravity), live)
        .value_or(0.0);
}

void judge_arch(Scene& scene)
{
    const double share = greatest_share(scene);
    scene.what += ", carries at most " + std::to_string(share) + " of it";
    scene.someone_moves = share < 1.0;
    scene.least_way = 0.01;
    scene.settle = 1e-4;
    scene.end = End::open;
    scene.has_twin = false;
}

/// A block that falls on its face beside another one.
void judge_fall(Scene& scene)
{
    const std::size_t great = block_named(scene, "great"), block = block_named(scene, "block");
    scene.settle = settle_on(scene, great, 10.0, 0.0);
    scene.fate[great] = Fate::stays;
    scene.fate[block] = Fate::moves;
    scene.stay = 20.0 * scene.settle;
    const double fall = bounding_box(scene.def.blocks[block].polygon).low.y();
    scene.least_way = 0.9 * fall;
    scene.places.push_back({block, area_moments(scene.def.blocks[block].polygon).centroid - Vec2(0.0, fall),
                            1e-3 * size_of(scene.def.blocks[block].polygon) + 10.0 * scene.settle});
}

/// The plate and both its faces give way by what the heavy block weighs.
void judge_sink(Scene& scene)
{
    const std::size_t heavy = block_named(scene, "heavy"), plate = block_named(scene, "light");
    scene.settle = 2.0 * settle_on(scene, heavy, 1.0, 0.0);
    scene.stay = 3.0 * scene.settle;
    scene.fate[plate] = Fate::stays;
    const double gap = bounding_box(scene.def.blocks[heavy].polygon).low.y() -
                       bounding_box(scene.def.blocks[plate].polygon).high.y();
    scene.places.push_back({heavy, area_moments(scene.def.blocks[heavy].polygon).centroid - Vec2(0.0, gap), scene.stay});
    scene.has_twin = false;
}

/// The plate is not passed: the block stays above its middle, or the run stops.
void judge_through(Scene& scene)
{
    scene.overlap_stops = true;
    scene.end = End::open;
    scene.region = Box{{-3.0, 0.1}, {3.0, 1e3}};
    scene.same_in_twin = false;
}

/// No joint alone holds it: it turns as it slides, until it lies.
void judge_turning(Scene& scene)
{
    scene.fate[block_named(scene, "bar")] = Fate::moves;
    scene.settle = 1e-4;
    scene.least_way = 2.0;
    scene.same_in_twin = false;  // it ends with an impact
}

const std::vector<Known>& all_known()
{
    static const std::vector<Known> known{
        {"rattle", "on 37° at friction 45°", {}, judge_rattle},
        {"rattle", "on 37° at friction 37.5°", {set("joint.default.friction_angle_deg", 37.5)}, judge_rattle},
        {"slide", "on 30°", {}, judge_slide},
        {"wedge", "a wedge of 30 m", {}, judge_wedge},
        {"wedge",
         "a wedge of 30 m",
         {set("joint.default.friction_angle_deg", 24.967), set("joint.default.cohesion", 40323.0)},
         judge_wedge},
        {"arch", "17 % above its collapse load", {}, judge_arch},
        {"hang", "falls 0.5 m", {}, judge_fall},
        {"throw", "falls 3 m", {}, judge_fall},
        {"sink", "a heavy block falls on a light plate", {}, judge_sink},
        {"sink", "the same until converged", {{"stage", "[{until = \"converged\", max_cycles = 200000}]"}}, judge_sink},
        {"through", "soft joint at 50 m/s", {}, judge_through},
        {"lean", "a slab against a wall, with two thirds of the friction it needs", {}, judge_turning},
        {"notch", "a bar between two planes", {}, judge_turning}};
    return known;
}
constexpr int orientations = 36;
}  // namespace

const int known_scenes = 3 * orientations * static_cast<int>(all_known().size());

Scene known_scene(int number)
{
    const std::size_t count = all_known().size(), at = static_cast<std::size_t>(number) / 3;
    const Known& known = all_known()[at % count];
    Scene scene = new_scene("known", number);
    const Method method = scene.def.contact.method;
    scene.def = read_case(case_folder() / (std::string("rest/known_") + known.file + ".toml"), known.overrides);
    scene.def.contact.method = method;
    scene.what = std::string(known.file) + ": " + known.what;
    scene.fate.assign(scene.def.blocks.size(), Fate::open);
    known.judge(scene);
    scene.placement = turned_by(360.0 / orientations * static_cast<double>(at / count));
    scene.twin.mirrored = true;
    return scene;
}
}  // namespace hdem::verification::rest
