#pragma once
/// The packed yardstick: the least that a force-based cycle in double precision has to do, and no more. A wall of bricks 2 m x 1 m in running bond between fixed
/// sides, under the stress of hdem's wall; six contact points a brick, all of them closed.
///
/// Each cycle finds the geometry of every contact anew from the poses of its two blocks: two points on an edge of one block, the edge of the other, its
/// normal, two overlaps. Springs, Coulomb's limit, forces summed to blocks, local damping and leap-frog motion follow. What it has not: searches for contacts,
/// energies, impulses, joints with a memory, polygons that meet in other ways. It uses nothing of hdem but its teams of threads, so a change of hdem does not change it. Four contacts go at a time with fused operations.

#include "parallel/team.h"

#include <cstdint>
#include <memory>

namespace hdem::perf
{
class ForceLoop
{
  public:
    /// `side` courses of `side` bricks, at rest under their weight.
    explicit ForceLoop(Index side);
    ~ForceLoop();
    ForceLoop(ForceLoop&&) noexcept;

    void advance(std::int64_t cycles, int threads);

    [[nodiscard]] Index blocks() const;
    /// All of them, six a brick and two more at the end of each course.
    [[nodiscard]] std::int64_t contact_points() const;
    /// Points that press, as blocks lie now. A speed is that of contact_points() only when this is the same number.
    [[nodiscard]] std::int64_t closed_points() const;
    /// Vertical force of the last cycle on what is fixed, over the weight of the wall: 1 at rest.
    [[nodiscard]] double supported_share() const;
    /// Hash of poses, velocities and shear forces: the same on any number of threads.
    [[nodiscard]] std::uint64_t hash() const;

  private:
    struct World;
    std::unique_ptr<World> world_;
};
}  // namespace hdem::perf
