#include "core/support/bolt_springs.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <limits>

namespace hdem
{
double stable_step_of_bolts(const Model& model, const Blocks& blocks)
{
    double greatest = 0.0;
    for (Index b = 0; b < (model.support.empty() ? 0 : model.blocks()); ++b)
    {
        Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
        add_bolt_rows(
            model, blocks, b, inverse_masses(blocks, b), [&](Index other) { return inverse_masses(blocks, other); }, sum);
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
        solver.computeDirect(sum, Eigen::EigenvaluesOnly);
        greatest = std::max(greatest, solver.eigenvalues()[2]);
    }
    return greatest > 0.0 ? 2.0 / std::sqrt(greatest) : std::numeric_limits<double>::infinity();
}
}  // namespace hdem
