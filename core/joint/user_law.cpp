#include "core/joint/user_law.h"

#include <cmath>
#include <deque>
#include <limits>

namespace hdem
{
namespace
{
/// Set while models are made, before any cycle runs.
std::deque<UserLawInput>& kept_laws()
{
    static std::deque<UserLawInput> laws;
    return laws;
}
}  // namespace

int keep_user_law(const UserLawInput& input)
{
    kept_laws().push_back(input);
    return static_cast<int>(kept_laws().size());
}

void ask_user_law(int number, const UserLawSprings& springs, int from, int count, UserLawPoints& points)
{
    const UserLawInput& law = kept_laws()[static_cast<std::size_t>(number) - 1];
    for (int i = from; i < from + count; ++i)
    {
        points.energy[i] = std::numeric_limits<double>::quiet_NaN();
        points.normal_tangent[i] = springs.normal;
    }
    const hdem_joint_points asked{.count = count,
                                  .parameter_count = static_cast<int>(law.parameters.size()),
                                  .parameters = law.parameters.data(),
                                  .normal_stiffness = springs.normal,
                                  .shear_stiffness = springs.shear,
                                  .closure = &points.closure[from],
                                  .slide = &points.slide[from],
                                  .last_shear = &points.last_shear[from],
                                  .last_normal = &points.last_normal[from],
                                  .slip = &points.slip[from],
                                  .state = &points.state[from],
                                  .second = &points.second[from],
                                  .opening = &points.opening[from],
                                  .normal = &points.normal[from],
                                  .shear = &points.shear[from],
                                  .strength = &points.strength[from],
                                  .energy = &points.energy[from],
                                  .normal_tangent = &points.normal_tangent[from]};
    law.function(&asked);
    for (int i = from; i < from + count; ++i)
        if (std::isnan(points.energy[i]))
            points.energy[i] = 0.5 * points.normal[i] * points.normal[i] / springs.normal;
}
}  // namespace hdem
