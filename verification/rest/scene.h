#pragma once
/// A scene of the rest.* checks: a case, and what certainly becomes of it.

#include "core/geometry/polygon.h"
#include "core/model/case_def.h"
#include "verification/rest/placement.h"

#include <optional>
#include <string>
#include <vector>

namespace hdem::verification::rest
{
inline constexpr double g = 9.81;       ///< [m/s2]
inline constexpr double rock = 2700.0;  ///< density [kg/m3]

/// What becomes of a block.
enum class Fate
{
    open,   ///< not certain
    stays,  ///< where it is, but for what its joints give way (Scene::stay)
    moves   ///< at least Scene::least_way
};

/// How the stage that runs until it has converged ends.
enum class End
{
    open,   ///< not certain, or not within the cycles it has
    rests,  ///< is called converged
    never   ///< cannot come to rest: must not be called converged
};

/// Where the centroid of a block lies at the end.
struct Place
{
    std::size_t block = 0;
    Vec2 centroid = {0.0, 0.0};  ///< [m]
    double tolerance = 0.0;      ///< [m]
};

/// What one block carries of another at the end, upwards.
struct Support
{
    std::size_t lower = 0;
    std::size_t upper = 0;
    double force = 0.0;      ///< [N]
    double tolerance = 0.0;  ///< [N]
};

/// Greatest way of a block from its start; in energy's bounds, whatever happens on it.
struct MostWay
{
    std::size_t block = 0;
    double way = 0.0;  ///< [m]
};

/// Upright: gravity pulls along -y. What is said of blocks is said in these axes, wherever the scene is placed.
struct Scene
{
    std::string family;
    int number = 0;
    std::string what;  ///< in a line: sizes, angles, factor of safety
    CaseDef def;

    std::vector<Fate> fate;  ///< one per block
    End end = End::rests;
    double settle = 0.0;     ///< how far the joints give way under the weight that they carry at rest [m]
    double stay = 0.0;       ///< a block that stays moves less, centroid and rim [m]
    double least_way = 0.0;  ///< [m]
    std::vector<Place> places;
    std::vector<MostWay> most_ways;
    std::vector<Support> supports;
    bool someone_moves = false;  ///< at least one block, by least_way; which one is not certain
    std::optional<Box> region;   ///< all free centroids lie in it at the end
    bool overlap_stops = false;  ///< the run may stop with the error on contact.overlap_limit
    bool has_twin = true;        ///< run in two placements
    bool same_in_twin = true;    ///< it ends alike in both,
    double
        same_settle = 0.1;  ///< but for this share of `settle`: which joints slip as blocks are set down, round-off may decide [-]
    double slow_run = 0.0;  ///< above 0: `stays` only holds where a slow run of so many seconds agrees [s]

    Placement placement;
    Placement twin;

    [[nodiscard]] std::string name() const { return family + ' ' + std::to_string(number); }
    [[nodiscard]] bool is_fixed(std::size_t block) const { return def.blocks[block].fix_x; }
};

/// An empty scene of the family: the base case without blocks, method `number` modulo 3, stage 0 until converged.
[[nodiscard]] Scene new_scene(const std::string& family, int number);

/// Adds a block and its fate; returns its number.
std::size_t add_block(Scene& scene, const std::string& name, Polygon polygon, Fate fate, double density = rock);
std::size_t add_fixed(Scene& scene, const std::string& name, Polygon polygon);

/// Stiffnesses 2e9 to 2e10 Pa/m along the normal, 1/14 to 1 of it in shear.
void draw_stiffness(Scene& scene, Draw& draw);
[[nodiscard]] JointDef& joint(Scene& scene);

/// hdem's own step, or a share 0.1 to 0.95 of `limit` [s] (see stable_limit in springs.h).
void draw_step(Scene& scene, Draw& draw, double limit);
/// A step that the scene does not go below, by which its cycles are counted: the given one, or a tenth of the limit [s].
[[nodiscard]] double least_step(const Scene& scene, double limit);

/// Two different placements.
void draw_placements(Scene& scene, Draw& draw);

[[nodiscard]] Polygon rectangle(double x0, double y0, double x1, double y1);
/// From `corner`, `length` along `along` and `height` to the left of it.
[[nodiscard]] Polygon rectangle_along(const Vec2& corner, const Vec2& along, double length, double height);
/// Unit vector [deg from x, anticlockwise].
[[nodiscard]] Vec2 direction(double angle_deg);
[[nodiscard]] double size_of(const Polygon& polygon);  ///< square root of the area [m]
[[nodiscard]] double density_of(const Scene& scene, std::size_t block);
/// Size of the smallest free block [m].
[[nodiscard]] double least_size(const Scene& scene);
}  // namespace hdem::verification::rest
