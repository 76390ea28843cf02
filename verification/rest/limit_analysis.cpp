#include "verification/rest/limit_analysis.h"

#include "core/check.h"

#include <Clp_C_Interface.h>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace hdem::verification::rest
{
namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

/// min c x, rows between bounds, columns between bounds.
class LinearProgram
{
  public:
    int add_column(double low, double high, double cost)
    {
        low_.push_back(low);
        high_.push_back(high);
        cost_.push_back(cost);
        return static_cast<int>(low_.size()) - 1;
    }
    int add_row(double low, double high)
    {
        row_low_.push_back(low);
        row_high_.push_back(high);
        return static_cast<int>(row_low_.size()) - 1;
    }
    void add(int row, int column, double value) { entries_.emplace_back(row, column, value); }

    enum class Status
    {
        optimal,
        infeasible,
        unbounded
    };
    Status solve()
    {
        Eigen::SparseMatrix<double, Eigen::ColMajor, int> matrix(static_cast<Eigen::Index>(row_low_.size()),
                                                                 static_cast<Eigen::Index>(low_.size()));
        matrix.setFromTriplets(entries_.begin(), entries_.end());
        const std::unique_ptr<Clp_Simplex, void (*)(Clp_Simplex*)> clp(Clp_newModel(), Clp_deleteModel);
        Clp_setLogLevel(clp.get(), 0);
        Clp_loadProblem(clp.get(), static_cast<int>(matrix.cols()), static_cast<int>(matrix.rows()), matrix.outerIndexPtr(),
                        matrix.innerIndexPtr(), matrix.valuePtr(), low_.data(), high_.data(), cost_.data(), row_low_.data(),
                        row_high_.data());
        Clp_primal(clp.get(), 0);  // tells what has no solution from what has no bound
        objective_ = Clp_objectiveValue(clp.get());
        switch (Clp_status(clp.get()))
        {
        case 0:
            return Status::optimal;
        case 1:
            return Status::infeasible;
        case 2:
            return Status::unbounded;
        default:
            throw RunError("linear program: CLP gave up (status " + std::to_string(Clp_status(clp.get())) + ").");
        }
    }
    [[nodiscard]] double objective() const { return objective_; }

  private:
    std::vector<double> low_, high_, cost_, row_low_, row_high_;
    std::vector<Eigen::Triplet<double>> entries_;
    double objective_ = 0.0;
};

/// Unknown forces of the points, in units of the greatest weight; |S| <= N tan(phi) + c l.
struct PointForces
{
    std::vector<int> normal, shear;

    PointForces(LinearProgram& program, const std::vector<TouchingPoint>& points, const Strength& strength, double unit)
    {
        for (const TouchingPoint& point : points)
        {
            normal.push_back(program.add_column(0.0, infinity, 0.0));
            shear.push_back(program.add_column(-infinity, infinity, 0.0));
            for (const double way : {1.0, -1.0})
            {
                const int row = program.add_row(-infinity, strength.cohesion * point.length / unit);
                program.add(row, shear.back(), way);
                program.add(row, normal.back(), -strength.friction);
            }
        }
    }

    /// `factor` times what one point does to a body, in row: component 0 is x, 1 is y, 2 the moment over the body's radius.
    void add_to(LinearProgram& program, int row, int component, double factor, std::size_t k, const TouchingPoint& point,
                const std::vector<Body>& bodies, std::size_t body) const
    {
        const double sign = body == point.second ? factor : -factor;
        const Vec2 lever = (point.place - bodies[body].centroid) / bodies[body].radius;
        const auto part = [&](const Vec2& way) { return component == 2 ? cross(lever, way) : way[component]; };
        program.add(row, normal[k], sign * part(point.normal));
        program.add(row, shear[k], sign * part(turned_left(point.normal)));
    }
};

/// Points of each body.
std::vector<std::vector<std::size_t>> points_of(const std::vector<Body>& bodies, const std::vector<TouchingPoint>& points)
{
    std::vector<std::vector<std::size_t>> of(bodies.size());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
        of[points[k].first].push_back(k);
        of[points[k].second].push_back(k);
    }
    return of;
}

/// That forces are counted in.
double greatest_force(const Loads& loads)
{
    double greatest = 0.0;
    for (const Eigen::Vector3d& load : loads)
        greatest = std::max(greatest, load.head<2>().norm());
    return greatest;
}

double in_radius(const Loads& loads, const std::vector<Body>& bodies, std::size_t body, int component)
{
    return component == 2 ? loads[body][2] / bodies[body].radius : loads[body][component];
}
}  // namespace

Loads weights(const std::vector<Body>& bodies, const Vec2& gravity)
{
    Loads loads;
    for (const Body& body : bodies)
    {
        const Vec2 weight = body.fixed ? Vec2(0.0, 0.0) : Vec2(body.mass * gravity);
        loads.emplace_back(weight.x(), weight.y(), 0.0);
    }
    return loads;
}

double least_unbalance(const std::vector<Body>& bodies, const std::vector<TouchingPoint>& points, const Strength& strength,
                       const Vec2& gravity)
{
    const Loads loads = weights(bodies, gravity);
    const double unit = greatest_force(loads);
    const auto of = points_of(bodies, points);
    LinearProgram program;
    const PointForces forces(program, points, strength, unit);
    const int share = program.add_column(0.0, infinity, 1.0);
    for (std::size_t body = 0; body < bodies.size(); ++body)
    {
        if (bodies[body].fixed)
            continue;
        const double weight = std::max(loads[body].head<2>().norm() / unit, light_share);
        for (int component = 0; component < 3; ++component)
            for (const double way : {1.0, -1.0})
            {
                const int row = program.add_row(-infinity, -way * in_radius(loads, bodies, body, component) / unit);
                program.add(row, share, -weight);
                for (const std::size_t k : of[body])
                    forces.add_to(program, row, component, way, k, points[k], bodies, body);
            }
    }
    program.solve();
    return program.objective();
}

std::optional<double> load_multiplier(const std::vector<Body>& bodies, const std::vector<TouchingPoint>& points,
                                      const Strength& strength, const Loads& dead, const Loads& live)
{
    const double unit = greatest_force(dead);
    const auto of = points_of(bodies, points);
    LinearProgram program;
    const PointForces forces(program, points, strength, unit);
    const int multiplier = program.add_column(0.0, infinity, -1.0);
    for (std::size_t body = 0; body < bodies.size(); ++body)
    {
        if (bodies[body].fixed)
            continue;
        for (int component = 0; component < 3; ++component)
        {
            const double weight = -in_radius(dead, bodies, body, component) / unit;
            const int row = program.add_row(weight, weight);
            program.add(row, multiplier, in_radius(live, bodies, body, component) / unit);
            for (const std::size_t k : of[body])
                forces.add_to(program, row, component, 1.0, k, points[k], bodies, body);
        }
    }
    switch (program.solve())
    {
    case LinearProgram::Status::optimal:
        return -program.objective();
    case LinearProgram::Status::unbounded:
        return infinity;
    default:
        return std::nullopt;
    }
}

double strength_factor(const std::vector<Body>& bodies, const std::vector<TouchingPoint>& points, const Strength& strength,
                       const Vec2& gravity, double most)
{
    const auto balances = [&](double factor) {
        return least_unbalance(bodies, points, {strength.friction / factor, strength.cohesion / factor}, gravity) < 1e-7;
    };
    double low = 0.01, high = most;
    if (!balances(low))
        return 0.0;
    if (balances(high))
        return most;
    for (int i = 0; i < 22; ++i)
        (balances(std::sqrt(low * high)) ? low : high) = std::sqrt(low * high);
    return low;
}
}  // namespace hdem::verification::rest
