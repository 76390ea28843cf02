#pragma once
/// Explicit blocks of the robust.* scenes, built here and given to the case file as one override. The surface of the rock is y = 0.

#include "verification/checks/case_run.h"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace hdem::verification
{
struct Scene
{
    std::string name;
    std::string case_file;
    Overrides overrides;
    double greatest_speed = 0.0;  ///< that energy allows any centroid [m/s]; 0: not asked, light blocks are thrown by heavy ones
    bool comes_to_rest = true;    ///< under damping, within its duration
};

struct SceneBlock
{
    Polygon polygon;
    std::string material = "rock";
    bool fixed = false;
    Vec2 velocity = {0.0, 0.0};     ///< [m/s]
    double angular_velocity = 0.0;  ///< [rad/s]
};
using SceneBlocks = std::vector<SceneBlock>;

/// Uniform between two bounds, the same on every machine.
class Draw
{
  public:
    explicit Draw(int seed) : bits_(static_cast<std::uint32_t>(seed)) {}
    [[nodiscard]] double between(double low, double high)
    {
        return low + (high - low) * static_cast<double>(bits_()) / 4294967296.0;
    }

  private:
    std::mt19937 bits_;
};

[[nodiscard]] Polygon rectangle(double x0, double y0, double x1, double y1);
[[nodiscard]] Polygon rectangle_at(const Vec2& centre, double width, double height);
[[nodiscard]] SceneBlock fixed_block(Polygon polygon);
/// The rock, wide enough for all that is thrown aside.
[[nodiscard]] SceneBlock ground();
/// The ground and `count` unit blocks on each other from height `bottom` on.
[[nodiscard]] SceneBlocks column(int count, double bottom);

/// Blocks from `first` on turned together by `angle` about the first one's centroid, and lifted until their lowest corner is at `height`.
[[nodiscard]] SceneBlocks turned_at(SceneBlocks blocks, double angle, double height, std::size_t first = 1);

[[nodiscard]] Scene make_scene(const std::string& name, const SceneBlocks& blocks, double duration);
[[nodiscard]] std::string seeded(const char* name, int seed);
}  // namespace hdem::verification
