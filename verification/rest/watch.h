#pragma once
/// What energy allows in a scene at any time, looked at in every cycle.

#include "core/observer.h"
#include "verification/rest/scene.h"

namespace hdem::verification::rest
{
/// The fastest block, against what it could have at most.
struct Peak
{
    double share = 0.0;    ///< speed / allowed
    double speed = 0.0;    ///< [m/s]
    double allowed = 0.0;  ///< [m/s]
    std::size_t block = 0;
    std::int64_t cycle = 0;
};

/// Nothing but gravity and loads gives energy, and joints are empty at the start: 1/2 m v^2 of a block is at most what all of them have done on all blocks,
/// and what blocks had at the start. 1 % of it is allowed beyond, and
///
///   4 sqrt(g u) + g dt        u how far joints give way at rest (Scene::settle), dt the step
///
/// for blocks that swing on their joints at steps near the stable limit, and because velocities are known half a step before places.
class EnergyWatch final : public Observer
{
  public:
    explicit EnergyWatch(const Scene& scene) : settle_(scene.settle) {}
    [[nodiscard]] std::int64_t next_cycle(std::int64_t now) const override { return now + 1; }
    void observe(const Model& model, const State& state) override;

    [[nodiscard]] const Peak& peak() const { return peak_; }
    /// Greatest rise of kinetic and elastic energy less the work of gravity and loads, from any four cycles to a later one, as a share of the greatest
    /// energy of the run [-]. Of the four, the greatest energy counts: a contact that becomes longer while it is compressed loses energy in one cycle and gives a
    /// part of it back in the next.
    [[nodiscard]] double rise() const { return greatest_energy_ > 0.0 ? rise_ / greatest_energy_ : 0.0; }
    /// Greatest part of the energy that the ledger does not explain, as a share of its greatest term [-].
    [[nodiscard]] double residual() const { return residual_ > 0.0 ? residual_ / greatest_term_ : 0.0; }
    /// Positions at the start, in the model's order and local axes [m].
    [[nodiscard]] const std::vector<Vec2>& start() const { return start_; }

  private:
    void look_at_speeds(const Model& model, const State& state);
    void look_at_energy(const Model& model, const State& state);

    double settle_;
    std::vector<Vec2> start_;
    double initial_ = 0.0;  ///< kinetic energy at the start [J]
    Peak peak_;
    double span_energy_ = -1e300;   ///< greatest of these cycles so far [J]
    double least_energy_ = 1e300;   ///< least of earlier spans [J]
    double rise_ = 0.0;             ///< [J]
    double greatest_energy_ = 0.0;  ///< [J]
    double residual_ = 0.0;         ///< [J]
    double greatest_term_ = 0.0;    ///< [J]
};
}  // namespace hdem::verification::rest
