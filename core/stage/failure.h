#pragma once
/// Decides whether rock fails or settles, by how far and how fast blocks move.

#include "core/model/model.h"
#include "core/state/state.h"

#include <optional>
#include <vector>

namespace hdem
{
/// When a block has failed.
struct FailureRule
{
    std::optional<double> displacement;  ///< of its rim [m]; not given: the greatest of the next three
    double share = 0.02;                 ///< of the block's size
    double strains = 10.0;               ///< times the greatest elastic strain of its joints
    double
        stretches = 4.0;  ///< times the stretch that its bolts still need to yield: before, they hold with less than their strength
    double least_area = 0.0;  ///< smaller blocks do not count [m2]
};

/// Watches the blocks of one trial, from where the stage began.
///
/// The rim of a block moves by d, counted from the reference pose; L is the distance of the rule. Passing L/2, L, 2 L and 4 L its speed is noted. A block that
/// nothing holds goes faster and faster: under a constant force its speed grows by sqrt(2) from each of these marks to the next. One that finds a new rest
/// slows down. So the block has failed
///
///   when it passes L, 2 L or 4 L with 1.15 times the speed with which it passed the mark before
///   when it passes 8 L
///
/// The mean speed between two looks counts, which the swinging of a block on its springs does not change much. Neither stiffness nor time step
/// enters but through L.
///
/// Rock just above its strength is slow: local damping takes four fifths of what drives it, and columns that chatter creep at an even speed.
/// `find_creeping` sees it before they pass L. From the start of the trial on d is noted at T, 2 T, 4 T and so on. Under a constant force it is four times as great
/// each time, at an even speed twice as great; where the block comes to rest it stays. The block has failed when d has grown by 1.7 and
/// again by 1.7, to L/20 at least.
/// @see verification/unit/core/stage/failure_test.cpp
class FailureWatch
{
  public:
    /// Strains of the joints are those of `state`, the state of rest that a trial begins from.
    FailureWatch(const FailureRule& rule, const Model& model, const State& state);

    /// After some cycles. @return  blocks that have failed since, the user's numbers
    [[nodiscard]] std::vector<Index> look(const Model& model, const State& state);

    /// To be asked at T, 2 T, 4 T, ... @return  the block that has gone farthest, if it creeps away, or no_index; the user's number
    [[nodiscard]] Index find_creeping();

    /// The block that has gone farthest in terms of its L, and how far; the user's number.
    struct Farthest
    {
        Index block = no_index;
        double moved = 0.0;  ///< [m]
        double limit = 0.0;  ///< L [m]
    };
    [[nodiscard]] const Farthest& farthest() const { return farthest_; }
    /// Is a block large enough to count? `user`: the user's number.
    [[nodiscard]] bool counts(Index user, const Model& model) const
    {
        return model.area[model.slot_of_user[user]] >= rule_.least_area;
    }
    [[nodiscard]] double limit(Index user) const { return track_[user].limit; }

  private:
    struct Track
    {
        double limit = 0.0;
        double last = 0.0;        ///< d at the last look [m]
        double noted = 0.0;       ///< d when creep was looked for last [m]
        int grown = 0;            ///< times in a row that d had grown then
        double mark_speed = 0.0;  ///< at the last mark [m/s]
        int marks = 0;            ///< passed
        bool has_failed = false;
    };
    [[nodiscard]] bool advance(Track& track, double moved, double seconds) const;

    FailureRule rule_;
    std::vector<Track> track_;  ///< by the user's number
    double time_ = 0.0;
    bool has_noted_ = false;
    Farthest farthest_;
};

/// Upper bound on the displacement of the farthest point of a block since its stage began [m].
[[nodiscard]] double rim_displacement(Index block, const Model& model, const Blocks& blocks);

/// Blocks that move with one that has failed: a quarter of its way and of its speed at least. The user's numbers, ascending.
[[nodiscard]] std::vector<Index> blocks_moving_with(Index failed, const Model& model, const State& state);
}  // namespace hdem
