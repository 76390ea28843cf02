#pragma once
/// [[history]]: quantities of one block, of the contacts between two, of a bolt, of a liner, or at a place, as numbers.

#include "core/model/model.h"
#include "core/state/state.h"

#include <span>
#include <string>
#include <vector>

namespace hdem
{
/// What [[history]] quantities may name. Vectors become two columns, NAME_x and NAME_y, which may also be asked for alone.
const std::vector<std::string>& block_history_quantities();
const std::vector<std::string>& contact_history_quantities();
const std::vector<std::string>& bolt_history_quantities();
const std::vector<std::string>& liner_history_quantities();
const std::vector<std::string>& point_history_quantities();

/// One sampled number.
struct Column
{
    std::string name;
    std::string unit;  ///< "m", "N", ...; "1" without one
};

/// Sums over the closed contact points of two blocks.
struct PairSample
{
    double normal_force = 0.0;        ///< [N]
    double shear_force = 0.0;         ///< [N]
    double tilt_force = 0.0;          ///< [N]
    double overlap = 0.0;             ///< greatest [m]
    double length = 0.0;              ///< [m]
    double shear_displacement = 0.0;  ///< [m]
    int impulse_points = 0;
    double step = 0.0;  ///< of the last cycle [s]
    /// What joints remember: means over the contacts that are tracked, closed or not, by their lengths.
    double plastic_slip = 0.0;  ///< signed as the shear force [m]
    double opening = 0.0;       ///< dilation [m]
    double damage = 0.0;        ///< [-]
    double broken = 0.0;        ///< share of the points [-]
};

/// Reads a state after a cycle. Forces are those of that cycle, found at the poses at its start; everything else belongs to
/// the present poses. The names and meanings of the columns stand in io/hdf5_format.md.
///
/// Between two blocks, normals point from the first to the second and the shear axis is the normal turned left; sums run over
/// all closed contact points of the two, each along its own contact. shear_force acts on the second block along that axis.
/// shear_displacement is how far the second block's centroid moved against that axis relative to the first's since the stage
/// began, so that it grows with the shear force it causes; the axis is that of the longest contact, the last known one while the blocks are
/// apart, and before their first contact that of the line of centroids.
/// @see verification/unit/core/history_sampler_test.cpp
class HistorySampler
{
  public:
    /// Throws InputError for an unknown block or quantity.
    HistorySampler(const Model& model, const HistoryDef& def);

    [[nodiscard]] const std::string& name() const { return name_; }
    [[nodiscard]] const std::vector<Column>& columns() const { return columns_; }
    [[nodiscard]] bool is_due(std::int64_t cycle) const { return cycle % every_ == 0; }
    /// First cycle after the given one at which a sample is due.
    [[nodiscard]] std::int64_t next_after(std::int64_t cycle) const { return (cycle / every_ + 1) * every_; }

    /// One value per column. Costs a look at the pair's contacts; the whole list is searched only after a broad phase.
    void sample(const Model& model, const State& state, std::span<double> values);

    /// What the sampler remembers from sample to sample, for a checkpoint: the normal between the two blocks, zero before their first contact.
    [[nodiscard]] const Vec2& axis() const { return normal_; }
    void set_axis(const Vec2& axis) { normal_ = axis; }

  private:
    using BlockQuantity = double (*)(const Model&, const State&, Index);
    using PairQuantity = double (*)(const Model&, const PairSample&);
    using PointQuantity = double (*)(const Model&, const State&, const Vec2&);

    using BoltQuantity = double (*)(const Bolt&, const BoltRecord&);
    using LinerQuantity = double (*)(const Liner&, const LinerRecord&);

    void select_of_bolt(const Model& model, const HistoryDef& def);
    void select_of_liner(const Model& model, const HistoryDef& def);
    void find_contacts(const Model& model, const State& state);
    PairSample sample_pair(const Model& model, const State& state);
    void add_memories(const Model& model, const State& state, PairSample& sums) const;

    std::string name_;
    std::int64_t every_ = 1;
    std::vector<Column> columns_;
    Index first_user_ = no_index;  ///< or the only block; number that the user knows
    Index second_user_ = no_index;
    Index first_ = no_index;  ///< where a pair is now
    Index second_ = no_index;
    std::vector<BlockQuantity> of_block_;
    std::vector<PairQuantity> of_pair_;
    std::vector<BoltQuantity> of_bolt_;
    Index bolt_ = no_index;
    std::vector<LinerQuantity> of_liner_;
    Index liner_ = no_index;
    std::vector<PointQuantity> of_point_;
    Vec2 place_ = {0.0, 0.0};             ///< of_point_, local coordinates [m]
    std::vector<Index> contacts_;         ///< of the pair
    std::int64_t broad_phase_runs_ = -1;  ///< when contacts_ was found
    Vec2 normal_ = {0.0, 0.0};            ///< last known, zero before
};
}  // namespace hdem
