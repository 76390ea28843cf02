#include "core/contact/island_newton.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hdem
{
namespace
{
constexpr int rounds = 10;
constexpr int patience = 2;                               ///< rounds after which the error must have fallen
constexpr int steps = 4;                                  ///< of Newton's method in a round
constexpr int sweeps = 50;                                ///< that follow them
constexpr std::array<double, 3> stays{1e-9, 1e-4, 1e-6};  ///< of the rounds in turn

/// What an unknown impulse has to do with one of its two blocks.
struct End
{
    Index unknown = no_index;
    Triple row;     ///< by which the block's velocity counts in the one that the unknown must make 0
    Triple change;  ///< of the block's velocity by a unit of the unknown
};

/// A point in its piece.
struct Piece
{
    Index normal = no_index, shear = no_index;  ///< numbers of its unknowns
    double slip = 0.0;                          ///< sign of J_S where it slips

    /// J_S over J
    [[nodiscard]] double slope(const ImpulsePoint& p) const { return normal != no_index ? slip * p.friction : 0.0; }
};

class NewtonStep
{
  public:
    explicit NewtonStep(const IslandProblem& now) : next_(now), ends_(now.blocks.size())
    {
        for (const ImpulsePoint& p : now.points)
            pieces_.push_back(piece_of(p, now.velocity_at(p)));
        for (std::size_t i = 0; i < pieces_.size(); ++i)
        {
            set_known(next_.points[i], pieces_[i]);
            enter_unknowns(next_.points[i], pieces_[i]);
        }
    }

    [[nodiscard]] IslandProblem solve(double stay)
    {
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(unknowns_, unknowns_);
        for (const std::vector<End>& block : ends_)
            for (const End& of : block)
                for (const End& by : block)
                    matrix(of.unknown, by.unknown) += of.row.x * by.change.x + of.row.y * by.change.y + of.row.w * by.change.w;
        Eigen::VectorXd right(unknowns_);
        for (std::size_t i = 0; i < pieces_.size(); ++i)
        {
            const ImpulsePoint& p = next_.points[i];
            const PointVelocity v = next_.velocity_at(p);
            const auto set_row = [&](Index unknown, double mass, double velocity)
            {
                if (unknown == no_index)
                    return;
                matrix(unknown, unknown) += stay / mass;
                right[unknown] = velocity;
            };
            set_row(pieces_[i].normal, p.mass_normal, v.m - p.target);
            set_row(pieces_[i].shear, p.mass_shear, -v.t);
        }
        if (unknowns_ > 0)
            add(matrix.partialPivLu().solve(right));
        return next_;
    }

  private:
    /// In doubt (a group that has no impulses yet and falls as a whole) a point is pressed and sticks.
    Piece piece_of(const ImpulsePoint& p, const PointVelocity& v)
    {
        Piece piece;
        if (p.mass_normal > 0.0 && p.impulse_normal + p.mass_normal * (v.m - p.target) >= 0.0)
            piece.normal = unknowns_++;
        const double shear = p.impulse_shear - p.mass_shear * v.t, limit = shear_limit(p, next_normal(p, v));
        const bool has_strength = limit > 0.0 || (piece.normal != no_index && p.friction > 0.0);
        if (std::abs(shear) > limit)
            piece.slip = has_strength ? std::copysign(1.0, shear) : 0.0;
        else if (has_strength && p.mass_shear < std::numeric_limits<double>::max())  // else no impulse changes v_t
            piece.shear = unknowns_++;
        return piece;
    }

    void set_known(ImpulsePoint& p, const Piece& piece)
    {
        const double normal = piece.normal == no_index && p.mass_normal > 0.0 ? 0.0 : p.impulse_normal;
        double shear = slip_limited(p.impulse_shear, shear_limit(p, normal));
        if (piece.shear != no_index)
            shear = p.impulse_shear;
        else if (piece.slip != 0.0)
            shear = piece.slip * (normal * p.friction + p.cohesive_impulse);
        next_.set_impulses(p, normal, shear);
    }

    void enter_unknowns(const ImpulsePoint& p, const Piece& piece)
    {
        if (piece.normal != no_index)
            enter(p, piece.normal, Kick(p, piece.slope(p), -1.0), {-p.t_y, p.t_x, p.ref_t}, {p.t_y, -p.t_x, -p.inc_t});
        if (piece.shear != no_index)
            enter(p, piece.shear, Kick(p, 1.0, 0.0), {-p.t_x, -p.t_y, p.ref_m}, {p.t_x, p.t_y, -p.inc_m});
    }

    void enter(const ImpulsePoint& p, Index unknown, const Kick& kick, const Triple& ref_row, const Triple& inc_row)
    {
        const auto at = [&](Index block, const Triple& row, double x, double y, double w)
        {
            End end{.unknown = unknown, .row = row, .change = {}};
            change_velocity(next_.blocks[block].inertia, x, y, w, end.change.x, end.change.y, end.change.w);
            ends_[block].push_back(end);
        };
        at(p.ref, ref_row, -kick.x, -kick.y, -kick.w_ref);
        at(p.inc, inc_row, kick.x, kick.y, kick.w_inc);
    }

    void add(const Eigen::VectorXd& change)
    {
        for (std::size_t i = 0; i < pieces_.size(); ++i)
        {
            ImpulsePoint& p = next_.points[i];
            const Piece& piece = pieces_[i];
            const double normal = piece.normal == no_index ? p.impulse_normal
                                                           : std::max(p.impulse_normal + change[piece.normal], 0.0);
            const double limit = shear_limit(p, normal);
            const double shear = piece.slip != 0.0 ? piece.slip * limit
                                                   : p.impulse_shear + (piece.shear == no_index ? 0.0 : change[piece.shear]);
            next_.set_impulses(p, normal, slip_limited(shear, limit));
        }
    }

    IslandProblem next_;
    std::vector<Piece> pieces_;
    std::vector<std::vector<End>> ends_;  ///< of each block
    Index unknowns_ = 0;
};

void sweep(IslandProblem& problem)
{
    for (ImpulsePoint& p : problem.points)
    {
        problem.set_impulses(p, next_normal(p, problem.velocity_at(p)), p.impulse_shear);
        problem.set_impulses(p, p.impulse_normal, next_shear(p, problem.velocity_at(p)));
    }
}
}  // namespace

IslandProblem newton_step(const IslandProblem& now, double stay)
{
    return NewtonStep(now).solve(stay);
}

IslandProblem solve_by_newton(const IslandProblem& problem, double goal)
{
    const double bound = problem.impulse_bound();
    IslandProblem best = problem, now = problem;
    double least = best.error();
    bool grows = false;  // in this round, impulses without end: there may be none that solve it
    const auto keep_better = [&](const IslandProblem& next)
    {
        const double error = next.error();
        const bool is_bounded = next.greatest_impulse() <= bound;
        grows = grows || !is_bounded;
        if (!(error < least) || !is_bounded)
            return;
        least = error;
        best = next;
    };
    int useless = 0;
    for (int round = 0; round < rounds && least > goal && useless < patience; ++round)
    {
        const double before = least;
        grows = false;
        now = best;
        for (int step = 0; step < steps && least > goal; ++step)
            keep_better(now = newton_step(now, stays[static_cast<std::size_t>(round) % stays.size()]));
        if (least <= goal)
            break;
        now = best;
        for (int k = 0; k < sweeps; ++k)
            sweep(now);
        keep_better(now);
        useless = least < 0.9 * before ? 0 : grows ? patience : useless + 1;
    }
    return best;
}
}  // namespace hdem
