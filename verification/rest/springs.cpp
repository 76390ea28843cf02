#include "verification/rest/springs.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace hdem::verification::rest
{
namespace
{
constexpr double near = 1e-6;  // of the smallest block's size: what touches at the start

/// Stretch of a spring along `way` at a point, by a motion (x, y, rotation) of a body.
Eigen::Vector3d row_of(const Vec2& way, const Vec2& lever)
{
    return {way.x(), way.y(), cross(lever, way)};
}

Eigen::Vector3d roots_of_inverse_masses(const Body& body)
{
    return body.fixed ? Eigen::Vector3d(0.0, 0.0, 0.0)
                      : Eigen::Vector3d(1.0 / std::sqrt(body.mass), 1.0 / std::sqrt(body.mass), 1.0 / std::sqrt(body.inertia));
}

double greatest_eigenvalue(const Eigen::MatrixXd& matrix)
{
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff();
}

/// S K S of all points, with S = M^-1/2: three rows a body.
Eigen::MatrixXd scaled_stiffness(const std::vector<Body>& bodies, const std::vector<TouchingPoint>& points, double normal,
                                 double shear)
{
    const auto size = static_cast<Eigen::Index>(3 * bodies.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    for (const TouchingPoint& point : points)
        for (const bool along : {false, true})
        {
            const Vec2 way = along ? turned_left(point.normal) : point.normal;
            Eigen::VectorXd row = Eigen::VectorXd::Zero(size);
            for (const std::size_t b : {point.first, point.second})
                row.segment<3>(static_cast<Eigen::Index>(
                    3 * b)) = (b == point.second ? 1.0 : -1.0) *
                              row_of(way, point.place - bodies[b].centroid).cwiseProduct(roots_of_inverse_masses(bodies[b]));
            matrix += point.length * (along ? shear : normal) * row * row.transpose();
        }
    return matrix;
}

/// Of a block on a face from `start` to `end`.
double face_frequency_squared(const Body& body, const JointDef& joint, const Vec2& start, const Vec2& end)
{
    const Vec2 face = end - start;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(3, 3);
    for (const Vec2& at : {start, end})
        for (const bool along : {false, true})
        {
            const Vec2 way = along ? face.normalized() : turned_left(face.normalized());
            const Eigen::Vector3d row = row_of(way, at - body.centroid).cwiseProduct(roots_of_inverse_masses(body));
            matrix += 0.5 * face.norm() * (along ? joint.shear_stiffness : joint.normal_stiffness) * row * row.transpose();
        }
    return greatest_eigenvalue(matrix);
}

/// Of a block on one of its faces.
double landing_frequency_squared(const Body& body, const JointDef& joint)
{
    double greatest = 0.0;
    for (const auto& [corners, source] : body.parts)
        for (std::size_t i = 0; i < corners.size(); ++i)
            if (source[i] != edge_internal)
                greatest = std::max(greatest, face_frequency_squared(body, joint, corners[i], corners[next(i, corners.size())]));
    return greatest;
}

/// Greatest omega^2 [1/s2].
struct Frequencies
{
    double touching_squared = 0.0;  ///< of what touches at the start
    double landing_squared = 0.0;   ///< of one block on its stiffest face

    explicit Frequencies(const Scene& scene)
    {
        const std::vector<Body> bodies = bodies_of(scene);
        const JointDef& joint = scene.def.joints.front();
        touching_squared = greatest_eigenvalue(
            scaled_stiffness(bodies, touching_at_start(scene, bodies), joint.normal_stiffness, joint.shear_stiffness));
        for (const Body& body : bodies)
            if (!body.fixed)
                landing_squared = std::max(landing_squared, landing_frequency_squared(body, joint));
    }
};
}  // namespace

std::vector<Body> bodies_of(const Scene& scene)
{
    std::vector<Body> bodies;
    for (std::size_t i = 0; i < scene.def.blocks.size(); ++i)
        bodies.push_back(body_of(scene.def.blocks[i].polygon, density_of(scene, i), scene.is_fixed(i)));
    return bodies;
}

std::vector<TouchingPoint> touching_at_start(const Scene& scene, const std::vector<Body>& bodies)
{
    return find_touching(bodies, near * least_size(scene), near * least_size(scene));
}

double stable_limit(const Scene& scene)
{
    const Frequencies frequencies(scene);
    return 2.0 / std::sqrt(std::max(frequencies.touching_squared, frequencies.landing_squared));
}

double stable_limit(const Scene& scene, double landings)
{
    const Frequencies frequencies(scene);
    return 2.0 / std::sqrt(frequencies.touching_squared + landings * frequencies.landing_squared);
}

double elastic_settle(const Scene& scene)
{
    const std::vector<Body> bodies = bodies_of(scene);
    const JointDef& joint = scene.def.joints.front();
    Eigen::MatrixXd matrix = scaled_stiffness(bodies, touching_at_start(scene, bodies), joint.normal_stiffness,
                                              1e-3 * joint.shear_stiffness);
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(matrix.rows());
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        const auto row = static_cast<Eigen::Index>(3 * i);
        if (bodies[i].fixed)
            matrix.block<3, 3>(row, row).setIdentity();
        else
            weight[row + 1] = -std::sqrt(bodies[i].mass) * g;
    }
    const Eigen::VectorXd scaled = matrix.ldlt().solve(weight);
    double greatest = 0.0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        const Eigen::Vector3d way = scaled.segment<3>(static_cast<Eigen::Index>(3 * i))
                                        .cwiseProduct(roots_of_inverse_masses(bodies[i]));
        greatest = std::max(greatest, way.head<2>().norm() + std::abs(way[2]) * bodies[i].radius);
    }
    return greatest;
}
}  // namespace hdem::verification::rest
