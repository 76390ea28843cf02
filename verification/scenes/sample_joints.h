#pragma once
/// One joint of each law with a memory, in the order of JointLaw; the last is that of a shared library.

#include "core/model/joint_def.h"

#include <array>
#include <cmath>

namespace hdem::scenes
{
/// Friction that falls with slip, tan phi from 0.8 to 0.5; parameters: the way over which it falls [m].
inline void weakening_law(const hdem_joint_points* p)
{
    for (int i = 0; i < p->count; ++i)
    {
        const double trial = p->last_shear[i] - p->shear_stiffness * p->slide[i];
        p->normal[i] = std::max(p->normal_stiffness * p->closure[i], 0.0);
        p->strength[i] = p->normal[i] * (0.5 + 0.3 / (1.0 + p->state[i] / p->parameters[0]));
        const double excess = std::max(std::abs(trial) - p->strength[i], 0.0);
        p->shear[i] = trial - std::copysign(excess, trial);
        p->state[i] += excess / p->shear_stiffness;
    }
}

inline std::array<JointDef, 8> sample_joints()
{
    return {JointDef{.name = "default",
                     .normal_stiffness = 1e10,
                     .shear_stiffness = 1e9,
                     .friction_angle_deg = 30.0,
                     .cohesion = 1e5,
                     .residual_friction_angle_deg = 25.0,
                     .dilation_angle_deg = 10.0,
                     .dilation_limit = 0.005},
            JointDef{.name = "default",
                     .law = JointLaw::barton_bandis,
                     .shear_stiffness = 1e9,
                     .residual_friction_angle_deg = 30.0,
                     .jrc = 10.0,
                     .jcs = 1e8,
                     .length = 1.0,
                     .rock_strength = 1.2e8},
            JointDef{.name = "default",
                     .law = JointLaw::patton,
                     .normal_stiffness = 1e10,
                     .shear_stiffness = 5e9,
                     .friction_angle_deg = 30.0,
                     .cohesion = 1e6,
                     .residual_friction_angle_deg = 35.0,
                     .asperity_angle_deg = 15.0},
            JointDef{.name = "default",
                     .law = JointLaw::continuously_yielding,
                     .normal_stiffness = 1e10,
                     .shear_stiffness = 1e9,
                     .friction_angle_deg = 30.0,
                     .mobilised_angle_deg = 50.0,
                     .wear_length = 5e-4},
            JointDef{.name = "default",
                     .law = JointLaw::plesha,
                     .normal_stiffness = 1e10,
                     .shear_stiffness = 2e9,
                     .friction_angle_deg = 30.0,
                     .asperity_angle_deg = 15.0,
                     .wear = 2e-5},
            JointDef{.name = "default",
                     .law = JointLaw::saeb_amadei,
                     .normal_stiffness = 1e10,
                     .shear_stiffness = 5e9,
                     .friction_angle_deg = 30.0,
                     .greatest_closure = 3e-4,
                     .asperity_angle_deg = 15.0,
                     .transition_stress = 5e7,
                     .rock_cohesion = 5e6,
                     .rock_friction_angle_deg = 40.0},
            JointDef{.name = "default",
                     .law = JointLaw::slip_weakening,
                     .normal_stiffness = 1e10,
                     .shear_stiffness = 1e9,
                     .friction_angle_deg = 35.0,
                     .residual_friction_angle_deg = 25.0,
                     .wear_length = 5e-3},
            JointDef{.name = "default",
                     .law = JointLaw::library,
                     .normal_stiffness = 1e10,
                     .shear_stiffness = 1e9,
                     .friction_angle_deg = 26.0,
                     .parameters = {1e-3},
                     .function = weakening_law}};
}
}  // namespace hdem::scenes
