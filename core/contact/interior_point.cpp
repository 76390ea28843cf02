#include "core/contact/interior_point.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hdem
{
namespace
{
constexpr int patience = 20;  ///< steps in which the error must fall by half
constexpr double kept = 0.9;  ///< share of the way to the boundary that a step may go
}  // namespace

InteriorPoint::InteriorPoint(const IslandProblem& problem) : problem_(problem), points_(problem.points.size())
{
    std::vector<std::array<Index, 3>> component(problem.blocks.size());
    std::vector<std::array<double, 3>> scale(problem.blocks.size());
    for (std::size_t i = 0; i < problem.blocks.size(); ++i)
    {
        const BlockInertia& inertia = problem.blocks[i].inertia;
        const std::array<double, 3> inverse{inertia.inverse_mass_x, inertia.inverse_mass_y, inertia.inverse_inertia};
        for (std::size_t k = 0; k < 3; ++k)
        {
            component[i][k] = inverse[k] > 0.0 ? components_++ : no_index;
            scale[i][k] = std::sqrt(inverse[k]);
        }
    }
    unknowns_ = components_;
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
        const ImpulsePoint& p = problem.points[i];
        Point& point = points_[i];
        point.row = {Row{p.t_y, -p.t_x, -p.ref_t, -p.t_y, p.t_x, p.inc_t}, Row{-p.t_x, -p.t_y, p.ref_m, p.t_x, p.t_y, -p.inc_m}};
        for (std::size_t k = 0; k < 6; ++k)
        {
            const auto block = static_cast<std::size_t>(k < 3 ? p.ref : p.inc);
            point.at[k] = component[block][k % 3];
            for (Row& row : point.row)
                row[k] *= scale[block][k % 3];
        }
        point.normal_at = p.mass_normal > 0.0 ? unknowns_++ : no_index;
        const bool has_shear = p.cohesive_impulse > 0.0 || (p.friction > 0.0 && (p.mass_normal > 0.0 || p.impulse_normal > 0.0));
        point.shear_at = has_shear ? unknowns_++ : no_index;
    }
}

void InteriorPoint::start()
{
    // All products alike, and impulses that could stop the heaviest block, and carry it. (From less steps are short.)
    const double impulse = problem_.stopping_impulse();
    const double speed = impulse / problem_.heaviest();
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
        const ImpulsePoint& p = problem_.points[i];
        points_[i].velocity = problem_.velocity_at(p);
        Pairs& now = points_[i].now;
        now.normal = p.mass_normal > 0.0 ? impulse : p.impulse_normal;
        now.parting = speed;
        now.shear = points_[i].shear_at == no_index ? p.impulse_shear : 0.0;
        now.against = now.along = impulse * speed / std::max(shear_limit(p, now.normal), 1e-300);
    }
    greatest_ = problem_.impulse_bound();
    change_ = Vector::Zero(components_);
}

double InteriorPoint::mean_product(const std::vector<Pairs>& change, double length) const
{
    double sum = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
        const Point& point = points_[i];
        const Pairs x = point.now + length * change[i];
        const double limit = shear_limit(problem_.points[i], x.normal);
        sum += point.normal_at == no_index ? 0.0 : x.normal * x.parting;
        sum += point.shear_at == no_index ? 0.0 : (limit - x.shear) * x.against + (limit + x.shear) * x.along;
        count += (point.normal_at == no_index ? 0 : 1) + (point.shear_at == no_index ? 0 : 2);
    }
    return count > 0 ? sum / count : 0.0;
}

PointVelocity InteriorPoint::velocity_now(const Point& point) const
{
    PointVelocity v = point.velocity;
    for (std::size_t k = 0; k < 6; ++k)
        if (point.at[k] != no_index)
        {
            v.m += point.row[0][k] * change_[point.at[k]];
            v.t += point.row[1][k] * change_[point.at[k]];
        }
    return v;
}

/// Newton's equations for the changes of velocities, J and J_S; s, a and b are eliminated.
void InteriorPoint::factorize()
{
    entries_.clear();
    for (Index i = 0; i < components_; ++i)
        entries_.emplace_back(i, i, 1.0);
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
        const ImpulsePoint& p = problem_.points[i];
        const Point& point = points_[i];
        const Pairs& now = point.now;
        const auto add = [&](const Row& row, Index unknown, double sign)
        {
            for (std::size_t k = 0; k < 6; ++k)
                if (point.at[k] != no_index)
                {
                    entries_.emplace_back(point.at[k], unknown, sign * row[k]);
                    entries_.emplace_back(unknown, point.at[k], row[k]);
                }
        };
        if (point.normal_at != no_index)
        {
            add(point.row[0], point.normal_at, 1.0);
            entries_.emplace_back(point.normal_at, point.normal_at, -now.parting / now.normal);
        }
        if (point.shear_at == no_index)
            continue;
        add(point.row[1], point.shear_at, -1.0);
        const double limit = shear_limit(p, now.normal);
        const double against = now.against / (limit - now.shear), along = now.along / (limit + now.shear);
        entries_.emplace_back(point.shear_at, point.shear_at, along + against);
        if (point.normal_at != no_index)
            entries_.emplace_back(point.shear_at, point.normal_at, p.friction * (along - against));
    }
    matrix_.resize(unknowns_, unknowns_);
    matrix_.setFromTriplets(entries_.begin(), entries_.end());
    if (!std::exchange(is_analysed_, true))
        factor_.analyzePattern(matrix_);
    factor_.factorize(matrix_);
}

/// Their right side, for products that are to be reached.
InteriorPoint::Vector InteriorPoint::right_side(const std::vector<Products>& aim) const
{
    Vector right = Vector::Zero(unknowns_);
    right.head(components_) = -change_;
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
        const ImpulsePoint& p = problem_.points[i];
        const Point& point = points_[i];
        const Pairs& now = point.now;
        const PointVelocity v = velocity_now(point);
        for (std::size_t k = 0; k < 6; ++k)
            if (point.at[k] != no_index)
                right[point.at[k]] -= point.row[0][k] * (now.normal - p.impulse_normal) -
                                      point.row[1][k] * (now.shear - p.impulse_shear);
        if (point.normal_at != no_index)
            right[point.normal_at] = p.target - v.m - aim[i].normal / now.normal;
        const double limit = shear_limit(p, now.normal);
        if (point.shear_at != no_index)
            right[point.shear_at] = aim[i].along / (limit + now.shear) - aim[i].against / (limit - now.shear) - v.t;
    }
    return right;
}

std::vector<InteriorPoint::Pairs> InteriorPoint::changes(const Vector& step, const std::vector<Products>& aim) const
{
    // Velocities from the products, not from those of blocks, whose rounding is greater than the smallest of these.
    const auto speed = [](double product, double impulse, double impulse_change, double value)
    { return (product - value * (impulse + impulse_change)) / impulse; };
    std::vector<Pairs> change(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
        const ImpulsePoint& p = problem_.points[i];
        const Point& point = points_[i];
        const Pairs& now = point.now;
        if (point.normal_at != no_index)
        {
            change[i].normal = step[point.normal_at];
            change[i].parting = speed(aim[i].normal, now.normal, change[i].normal, now.parting);
        }
        if (point.shear_at == no_index)
            continue;
        change[i].shear = step[point.shear_at];
        const double limit = shear_limit(p, now.normal), wider = p.friction * change[i].normal;
        change[i].against = speed(aim[i].against, limit - now.shear, wider - change[i].shear, now.against);
        change[i].along = speed(aim[i].along, limit + now.shear, wider + change[i].shear, now.along);
    }
    return change;
}

/// Share of a step that keeps all of a point's pairs positive.
double InteriorPoint::length_inside(std::size_t i, const Pairs& change) const
{
    const ImpulsePoint& p = problem_.points[i];
    const Pairs& now = points_[i].now;
    double length = 1.0;
    const auto limit_by = [&](double value, double by) { length = by < 0.0 ? std::min(length, -kept * value / by) : length; };
    if (points_[i].normal_at != no_index)
    {
        limit_by(now.normal, change.normal);
        limit_by(now.parting, change.parting);
    }
    if (points_[i].shear_at != no_index)
    {
        const double limit = shear_limit(p, now.normal), wider = p.friction * change.normal;
        limit_by(limit - now.shear, wider - change.shear);
        limit_by(limit + now.shear, wider + change.shear);
        limit_by(now.against, change.against);
        limit_by(now.along, change.along);
    }
    return length;
}

double InteriorPoint::length_inside(const std::vector<Pairs>& change) const
{
    double length = 1.0;
    for (std::size_t i = 0; i < points_.size(); ++i)
        length = std::min(length, length_inside(i, change[i]));
    return length;
}

/// Mehrotra's predictor and corrector: what a step towards products of 0 would reach says how small they may be asked to be, and what it leaves out.
double InteriorPoint::take_step()
{
    factorize();
    if (factor_.info() != Eigen::Success)
        return 0.0;
    std::vector<Products> aim(points_.size());
    const std::vector<Pairs> guess = changes(factor_.solve(right_side(aim)), aim);
    const double mean = mean_product(guess, 0.0);
    const double share = mean_product(guess, length_inside(guess)) / mean;
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
        const Pairs& d = guess[i];
        const double wider = problem_.points[i].friction * d.normal, product = share * share * share * mean;
        aim[i] = {product - d.normal * d.parting, product - (wider - d.shear) * d.against, product - (wider + d.shear) * d.along};
    }
    const Vector step = factor_.solve(right_side(aim));
    if (!step.allFinite())
        return 0.0;
    const std::vector<Pairs> change = changes(step, aim);
    const double length = length_inside(change);
    for (std::size_t i = 0; i < points_.size(); ++i)
        points_[i].now = points_[i].now + length * change[i];
    change_ += length * step.head(components_);
    return length;
}

/// The problem with the impulses of now; points that part have none.
IslandProblem InteriorPoint::present() const
{
    std::vector<double> normal(points_.size()), shear(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
        const ImpulsePoint& p = problem_.points[i];
        const Pairs& now = points_[i].now;
        const bool parts = points_[i].normal_at != no_index && now.normal < p.mass_normal * now.parting;
        normal[i] = parts ? 0.0 : now.normal;
        const double most = shear_limit(p, normal[i]);
        shear[i] = std::clamp(now.shear, -most, most);
    }
    IslandProblem problem = problem_;
    problem.set_impulses(normal, shear);
    return problem;
}

IslandProblem InteriorPoint::solve(double goal)
{
    start();
    IslandProblem best = problem_;
    double least = best.error();
    double milestone = least;
    for (int left = patience; left > 0 && least > goal; --left)
    {
        if (take_step() == 0.0)
            break;
        IslandProblem next = present();
        const double error = next.error();
        if (next.greatest_impulse() > greatest_)
            break;  // they grow without end: no impulses solve it
        if (!(error < least))
            continue;
        least = error;
        best = std::move(next);
        if (least > 0.5 * milestone)
            continue;
        milestone = least;
        left = patience;
    }
    return best;
}
}  // namespace hdem
