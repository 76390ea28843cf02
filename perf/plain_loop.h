#pragma once
/// The plain yardstick: the work of force_loop.h on the same wall, one point at a time as the compiler makes it, each quantity in an array of its own and each
/// point by itself. The bars for walls were set for a loop of this kind.

#include "parallel/team.h"

#include <cstdint>
#include <memory>

namespace hdem::perf
{
class PlainLoop
{
  public:
    /// `side` courses of `side` bricks, at rest under their weight.
    explicit PlainLoop(Index side);
    ~PlainLoop();
    PlainLoop(PlainLoop&&) noexcept;

    void advance(std::int64_t cycles, int threads);

    // As in ForceLoop.
    [[nodiscard]] Index blocks() const;
    [[nodiscard]] std::int64_t contact_points() const;
    [[nodiscard]] std::int64_t closed_points() const;
    [[nodiscard]] double supported_share() const;
    [[nodiscard]] std::uint64_t hash() const;

  private:
    struct World;
    std::unique_ptr<World> world_;
};
}  // namespace hdem::perf
