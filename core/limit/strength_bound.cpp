#include "core/limit/strength_bound.h"

#include "core/limit/force_points.h"
#include "core/limit/linear_program.h"
#include "core/support/bolt_strength.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double accuracy = 1e-4;        // of F
constexpr double balanced = 1.0 - 1e-7;  // of lambda
constexpr int most_iterations = 400'000;
constexpr Index most_blocks = 20'000;

class Program
{
  public:
    Program(const Model& model, const State& state, const std::vector<std::uint8_t>& weakened, bool weakens_bolts,
            bool corners_bear)
        : model_(model),
          state_(state),
          bolts_(bolt_strengths(model, state)),
          weakens_bolts_(weakens_bolts)
    {
        number_rows();
        for (std::size_t joint = 0; joint < model.joints.names.size(); ++joint)
            if (!weakened.empty() && weakened[joint] == 0)
                for (const Index law : {static_cast<Index>(joint), model.joints.unbonded_of(static_cast<Index>(joint))})
                    kept_.push_back(law);
        points_ = force_points(model, state, kept_, corners_bear);
        loads_ = loads_to_balance(model, state);
        for (Index block = 0; block < model.blocks(); ++block)
            if (state.blocks.is_free(block))
                unit_ = std::max({unit_, std::abs(loads_[block].x), std::abs(loads_[block].y), std::abs(loads_[block].w)});
        add_columns();
    }

    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] bool has_given_up() const { return gave_up_; }

    /// Are all loads balanced at F?
    [[nodiscard]] bool stands(double factor)
    {
        std::vector<double> shift(static_cast<std::size_t>(rows_), 0.0);
        for (ForcePoint& point : points_)
        {
            const PointStrength s = point.strength.at(factor);
            program_->change_column(point.column[0], cone_edge(point, -s.friction));
            program_->change_column(point.column[1], cone_edge(point, s.friction));
            const double free = std::max(s.cohesion - s.friction * s.tension, 0.0) / unit_;
            if (point.column[2] >= 0)
                program_->change_bounds(point.column[2], -free, free);
            if (s.tension > 0.0)
                for (const LinearProgram::Entry& e : effect(point, 1.0, 0.0))
                    shift[static_cast<std::size_t>(e.row)] += e.value * s.tension / unit_;
        }
        for (std::size_t i = 0; i < bolts_.size() && weakens_bolts_; ++i)
            program_->change_bounds(first_bolt_ + static_cast<int>(i), bolts_[i].least / factor / unit_,
                                    bolts_[i].greatest / factor / unit_);
        for (int row = 0; row < rows_; ++row)
            program_->set_row(row, shift[static_cast<std::size_t>(row)]);
        gave_up_ = gave_up_ || program_->solve(most_iterations) != LinearProgram::Status::optimal;
        return -program_->cost() >= balanced;
    }

  private:
    void number_rows()
    {
        row_.assign(static_cast<std::size_t>(model_.blocks()), {-1, -1, -1});
        for (const Index block : model_.slot_of_user)  // in the user's order: the answer does not depend on that in memory
        {
            const BlockInertia& inertia = state_.blocks.inertia[block];
            if (state_.blocks.present[block] == 0)
                continue;
            const std::array<double, 3> moves{inertia.inverse_mass_x, inertia.inverse_mass_y, inertia.inverse_inertia};
            for (int i = 0; i < 3; ++i)
                if (moves[i] > 0.0)
                    row_[block][i] = rows_++;
        }
    }

    /// Of N and S on the rows of both blocks.
    [[nodiscard]] std::vector<LinearProgram::Entry> effect(const ForcePoint& point, double normal, double shear) const
    {
        std::vector<LinearProgram::Entry> entries;
        for (int side = 0; side < 2; ++side)
            for (int i = 0; i < 3; ++i)
                if (const int row = row_[point.block[side]][i]; row >= 0)
                    entries.push_back({row, normal * point.normal[side][i] + shear * point.shear[side][i]});
        return entries;
    }

    /// Of a bolt with the force 1.
    [[nodiscard]] std::vector<LinearProgram::Entry> effect(const BoltStrength& bolt) const
    {
        std::vector<LinearProgram::Entry> entries;
        const auto add = [&](Index block, const Vec2& force, const Vec2& place)
        {
            const BlockMotion& m = state_.blocks.motion[block];
            const double on[] = {force.x(), force.y(), cross(place - Vec2(m.x, m.y), force) / model_.radius[block]};
            for (int i = 0; i < 3; ++i)
                if (row_[block][i] >= 0)
                    entries.push_back({row_[block][i], on[i]});
        };
        add(bolt.first, bolt.direction, bolt.first_place);
        add(bolt.second, -bolt.direction, bolt.second_place);
        return entries;
    }

    /// One edge of the cone of friction, N = 1.
    [[nodiscard]] std::vector<LinearProgram::Entry> cone_edge(const ForcePoint& point, double friction) const
    {
        return effect(point, 1.0, friction);
    }

    void add_columns()
    {
        program_.emplace(rows_);
        for (ForcePoint& point : points_)
        {
            point.column[0] = program_->add_column(0.0, infinity, 0.0, cone_edge(point, -1.0));
            point.column[1] = program_->add_column(0.0, infinity, 0.0, cone_edge(point, 1.0));
            if (point.strength.cohesion > 0.0)
                point.column[2] = program_->add_column(0.0, 0.0, 0.0, effect(point, 0.0, 1.0));
        }
        for (std::size_t i = 0; i < bolts_.size(); ++i)
        {
            const int column = program_->add_column(bolts_[i].least / unit_, bolts_[i].greatest / unit_, 0.0, effect(bolts_[i]));
            first_bolt_ = i == 0 ? column : first_bolt_;
        }
        std::vector<LinearProgram::Entry> entries;
        for (Index block = 0; block < model_.blocks(); ++block)
        {
            const std::array<double, 3> load{loads_[block].x, loads_[block].y, loads_[block].w};
            for (int i = 0; i < 3; ++i)
                if (row_[block][i] >= 0 && load[i] != 0.0)
                    entries.push_back({row_[block][i], load[i] / unit_});
        }
        columns_ = program_->add_column(0.0, 1.0, -1.0, entries) + 1;
    }

    const Model& model_;
    const State& state_;
    std::vector<BoltStrength> bolts_;
    bool weakens_bolts_ = false;
    int first_bolt_ = 0;  ///< column
    std::vector<std::array<int, 3>> row_;
    int rows_ = 0, columns_ = 0;
    std::vector<Index> kept_;  ///< laws that keep their strength
    std::vector<Triple> loads_;
    double unit_ = 0.0;  ///< that forces are counted in [N]
    std::vector<ForcePoint> points_;
    std::optional<LinearProgram> program_;
    bool gave_up_ = false;
};
}  // namespace

namespace
{
/// The greatest F between `low` and `high` for which the program stands.
StrengthBound find_bound(Program& program, double low, double high, StrengthBound bound)
{
    bound.end = StrengthBound::End::found;
    while (!program.has_given_up() && high - low > accuracy * low)
    {
        const double middle = 0.5 * (low + high);
        ++bound.solutions;
        (program.stands(middle) ? low : high) = middle;
    }
    if (program.has_given_up())
    {
        bound.end = StrengthBound::End::not_found;
        bound.why = "the linear program could not be solved";
    }
    bound.factor = 0.5 * (low + high);
    return bound;
}
}  // namespace

StrengthBound strength_bound(const Model& model, const State& state, const std::vector<std::uint8_t>& weakened, double least,
                             double most, bool weakens_bolts)
{
    StrengthBound bound;
    if (model.blocks() > most_blocks)
    {
        bound.why = "more than " + std::to_string(most_blocks) + " blocks";
        return bound;
    }
    if (std::ranges::any_of(state.support.liners, [](const LinerRecord& liner) { return liner.installed != 0; }))
    {
        bound.why = "linings are not part of the linear program";
        return bound;
    }
    Program program(model, state, weakened, weakens_bolts, true);
    bound.rows = program.rows();
    bound.columns = program.columns();
    const auto stands = [&](double factor)
    {
        ++bound.solutions;
        return program.stands(factor);
    };
    const auto give_up = [&]
    {
        bound.end = StrengthBound::End::not_found;
        bound.why = "the linear program could not be solved";
        return bound;
    };
    double low = 1.0, high = 1.0;
    bool is_low = stands(low);
    if (is_low)
        while (!program.has_given_up() && high < most && stands(high = std::min(2.0 * high, most)))
            low = high;
    else
        while (!program.has_given_up() && low > least && !(is_low = stands(low = std::max(0.5 * low, least))))
            high = low;
    if (program.has_given_up())
        return give_up();
    bound.end = low == most ? StrengthBound::End::none : (is_low ? StrengthBound::End::found : StrengthBound::End::no_balance);
    bound.factor = 0.5 * (low + high);
    return bound.end == StrengthBound::End::found ? find_bound(program, low, high, bound) : bound;
}

StrengthBound strength_bound_without_corners(const Model& model, const State& state, const std::vector<std::uint8_t>& weakened,
                                             double least, const StrengthBound& with_corners, bool weakens_bolts)
{
    Program program(model, state, weakened, weakens_bolts, false);
    double high = 0.98 * with_corners.factor;
    if (program.stands(high))
        return with_corners;
    StrengthBound bound{.rows = program.rows(), .columns = program.columns(), .solutions = 1, .why = {}};
    double low = 0.5 * high;
    for (++bound.solutions; !program.stands(low) && !program.has_given_up(); ++bound.solutions)
    {
        high = low;
        low *= 0.5;
        if (high <= least)
        {
            bound.end = StrengthBound::End::no_balance;
            return bound;
        }
    }
    return find_bound(program, low, high, bound);
}
}  // namespace hdem
