#pragma once
/// What must hold in any run, seen from outside: blocks do not pass through each other, energy does not come from nowhere.

#include "core/model/model.h"
#include "core/state/state.h"

#include <algorithm>
#include <vector>

namespace hdem::verification
{
/// Overlap of two blocks, found from their shapes alone and not from the list of contacts: least way that takes
/// their parts apart, greatest over the parts [m]; 0 when apart.
[[nodiscard]] double penetration(const Model& model, const Blocks& blocks, Index a, Index b);

/// Least width of a block's convex parts, over all directions of their edges [m].
[[nodiscard]] double least_width(const Model& model, Index block);

class RobustWatch
{
  public:
    /// The ground's weight and the blocks' speeds are means over what comes after `late` [s].
    explicit RobustWatch(double late) : late_(late) {}
    void observe(const Model& model, const State& state);

    /// Greatest overlap as a share of the least width of the thinner free block [-]. From one half on, it may come out on the wrong side.
    [[nodiscard]] double worst_overlap() const { return worst_overlap_; }
    /// Lowest centroid of a free block above y = 0, the surface of the rock in the scenes [m].
    [[nodiscard]] double lowest_centroid() const { return lowest_centroid_; }
    /// Greatest rise of kinetic and stored energy less the work of gravity and loads, from any moment to a later one, as a share of the
    /// greatest energy that was in the blocks at a time [-]. Blocks that only settle count with the weight's work along 1e-4 of their width.
    [[nodiscard]] double energy_gain() const { return worst_rise_ / std::max(greatest_energy_, settling_); }
    [[nodiscard]] double greatest_speed() const { return greatest_speed_; }  ///< of a centroid [m/s]
    [[nodiscard]] bool is_finite() const { return is_finite_; }
    /// Speed that all blocks would have at their late kinetic energy [m/s].
    [[nodiscard]] double late_speed() const;
    /// What fixed blocks carried late, upwards, as a share of the free blocks' weight [-].
    [[nodiscard]] double carried() const { return late_samples_ > 0 ? late_carried_ / late_samples_ : 0.0; }

  private:
    void look_at_shapes(const Model& model, const Blocks& blocks);
    void look_at_energy(const Model& model, const State& state);
    void look_at_rest(const Model& model, const Blocks& blocks);

    double late_;
    std::vector<double> width_;  ///< per block, in the user's order [m]
    double worst_overlap_ = 0.0;
    double lowest_centroid_ = 1e300;
    double least_energy_ = 1e300;
    double worst_rise_ = 0.0;
    double greatest_energy_ = 0.0;
    double settling_ = 0.0;  ///< [J]
    double greatest_speed_ = 0.0;
    double late_speed_squared_ = 0.0;
    double late_carried_ = 0.0;
    int late_samples_ = 0;
    bool is_finite_ = true;
};
}  // namespace hdem::verification
