#pragma once
/// Contact points of a model during a static solution: what they bear, their tangents, and how far each may be trusted.

#include "core/detection/edge_touch.h"
#include "core/model/model.h"
#include "core/state/state.h"
#include "core/state/workspace.h"
#include "core/statics/block_matrix.h"
#include "core/statics/point_law.h"

namespace hdem
{
/// A point during the search for an equilibrium.
struct StaticPoint
{
    double start_shear = 0.0;     ///< T: shear force at the last equilibrium [N]
    double q_x = 0.0, q_y = 0.0;  ///< body point of inc whose way along the reference edge is the point's way [m]
    double start_t = 0.0;         ///< where it was, along the reference edge from the centroid of ref [m]
    double strength = 0.0;        ///< shear strength at the last iterate [N]
    double trust = 0.03;          ///< share of the elastic stiffness where the law has none, see renew_points [-]
    PointStatus status = PointStatus::open;
    double first_q_x = 0.0, first_q_y = 0.0, first_t = 0.0, first_shear = 0.0;  ///< as the search began, where it was closed then
    std::uint8_t iterations_open = 0;                                           ///< in a row
    bool has_healed = false;                                                    ///< was parted in this search, and has closed again
    bool began_closed = false;
    bool is_parted = false;    ///< open: cohesion is broken
    bool holds_shear = false;  ///< its whole elastic stiffness acts along the edge
};

/// Tangents of a contact's two points in the axes of its reference edge.
struct ContactTangent
{
    double e_x = 1.0, e_y = 0.0;
    std::array<double, 2> ref_t{}, ref_m{}, inc_t{}, inc_m{};  ///< levers [m]
    std::array<PointTangent, 2> point;

    /// -d(force) / d(place): unknowns x, y, rotation of ref, then of inc; the rows of ref (side 0) or inc (1). What a change of the lengths and axes does to the
    /// forces is left out: of the order overlap over length.
    [[nodiscard]] RowPair stiffness(int side) const;
    /// Change of overlap and way at a point by small moves of ref and inc [m].
    [[nodiscard]] std::array<double, 2> ways(int k, const double* ref, const double* inc) const;
    /// Length of both together [m].
    [[nodiscard]] double way(int k, const double* ref, const double* inc) const;
};

/// Sums over a range of contacts.
struct PointTally
{
    Index stick = 0, slip = 0;
    Index open = 0;  ///< not parted
    Index newly_parted = 0;
    double friction = 0.0;  ///< work of slip since the last equilibrium [J]

    PointTally& operator+=(const PointTally& other);
};

/// How points are trusted in this iteration.
struct PointRule
{
    bool part_all_open = false;  ///< break the cohesion of all points that are open
    bool is_first = false;       ///< first iteration of a search
};

/// Begin a search where the contacts stand, from their history.
void begin_points(IndexRange contacts, const Model& model, const State& state, std::vector<StaticPoint>& points);

/// What each contact of the range puts on its two blocks at the present poses. With `frozen` shear strengths are those of the last iterate.
void put_loads(IndexRange range, const Model& model, const State& state, const std::vector<StaticPoint>& points, bool frozen,
               std::vector<BlockLoad>& loads);

/// At a new iterate: status of each point, whether it parts, how far it is trusted, and its tangent.
///
/// Trust takes the place of a region around the iterate, point by point: where the law gives no stiffness, in an open point or along a slip, a share of the
/// elastic one holds the step back. Trust falls to a quarter each time that the status stays, down to 1e-6, and grows 16 times, up to 1, when the status
/// changes. Without it Newton's iteration may jump between states for ever.
PointTally renew_points(IndexRange range, const Model& model, const State& state, const PointRule& rule,
                        std::vector<StaticPoint>& points, std::vector<ContactTangent>& tangents);

/// Trust points less, in their tangents too, that a step moves by more than `far` [m].  step: three per block of the model.
void restrain_points(IndexRange range, const State& state, const std::vector<double>& step, double far,
                     std::vector<StaticPoint>& points, std::vector<ContactTangent>& tangents);
/// Greatest way of a point of the range by this step [m].
[[nodiscard]] double greatest_way(IndexRange range, const State& state, const std::vector<ContactTangent>& tangents,
                                  const std::vector<double>& step);

/// Write forces, lengths and regimes into the history of the contacts, so that the next cycle finds them as they are; points that are open bear nothing.
void commit_points(IndexRange range, const Model& model, const std::vector<StaticPoint>& points, State& state);
}  // namespace hdem
