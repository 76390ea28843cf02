#pragma once
/// Cases whose checkpoints are damaged in tests.

#include "verification/unit/io/case_text.h"

#include <string>
#include <vector>

namespace hdem::test
{
inline const std::string case_of_checkpoints = R"(
[material.rock]
density = 2700.0
[joint.default]
normal_stiffness = 1e9
shear_stiffness = 1e9
friction_angle_deg = 30.0
[time]
step = 1e-4
[[block]]
name = "ground"
polygon = [[-1, -1], [9, -1], [9, 0], [-1, 0]]
fixed = true
[[block]]
name = "sledge"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
velocity = [1, 0]
[[block]]
name = "rider"
polygon = [[0, 1], [1, 1], [1, 2], [0, 2]]
[[block]]
name = "prop"
polygon = [[6, 0], [7, 0], [7, 1], [6, 1]]
[[stage]]
cycles = 100
[[stage]]
excavate = ["prop"]
cycles = 100
[[history]]
between = ["ground", "sledge"]
quantities = ["normal_force"]
)";

/// The same with what only such cases have in their state: stress, joints with a memory, water, bolts of each kind, a lining, ends of stages, forces taken off.
inline const std::string supported_case = case_of_checkpoints + R"(
[insitu]
surface = 2.0
ratio = 0.5
[water]
level = 0.5
[[bolt]]
name = "anchor"
from = [0.5, 1.5]
to = [0.5, -0.5]
stiffness = 1e7
pretension = 100.0
yield = 200.0
[[bolt]]
name = "cable"
kind = "grouted"
from = [0.2, 1.5]
to = [0.2, -0.5]
area = 1e-4
bond_stiffness = 1e7
bond_strength = 1e2
segment = 0.5
[[bolt]]
name = "dowel"
kind = "local"
from = [0.8, 1.5]
to = [0.8, -0.5]
stiffness = 1e7
shear_stiffness = 1e7
shear_strength = 10.0
active_length = 0.05
[[liner]]
name = "coat"
path = [[1, 2], [1, 1]]
thickness = 0.1
modulus = 1e10
normal_stiffness = 1e8
bond_strength = 10.0
hardening = [[0, 0.1], [50, 1.0]]
)";

inline std::string with_memory(std::string text)
{
    text = with(text, "friction_angle_deg = 30.0",
                "friction_angle_deg = 30.0\nresidual_friction_angle_deg = 20.0\ndilation_angle_deg = 5.0");
    return with(text, "excavate = [\"prop\"]\ncycles = 100",
                "excavate = [\"prop\"]\nrelax_cycles = 50\nuntil = [\"converged\", \"displacement:rider > 9\", \"quiet for 9 s\"]");
}

/// A case whose checkpoints are changed, and objects that only they have.
struct CheckpointSubject
{
    const char* name;
    std::string text;
    std::vector<std::string> more;  ///< datasets
};

inline std::vector<CheckpointSubject> checkpoint_subjects()
{
    return {{"plain", case_of_checkpoints, {}},
            {"supported",
             with_memory(supported_case),
             {"/state/ends", "/state/ends_values", "/blocks/released", "/blocks/released_force", "/blocks/water", "/bolts/status",
              "/bolts/record", "/bolts/history", "/liners/installed", "/liners/counts", "/liners/record", "/contacts/preload",
              "/contacts/memory_0", "/contacts/memory_1"}}};
}
}  // namespace hdem::test
