#include "verification/unit/io/case_text.h"

#include <gmock/gmock.h>

namespace hdem
{
namespace
{
using test::read;
using test::two_blocks;
using test::with;
using testing::ElementsAre;

const std::string generated = R"(
title = "everything"
schema = 1
[domain]
width = 20
height = 10.5
origin = [1, -2]
fixed = ["left", "top"]
material = "shale"
[[joint_set]]
dip_deg = -10
spacing = 1.5
[[joint_set]]
name = "cross"
dip_deg = 80.0
spacing = 2.5
deviation_deg = 3
persistence = 0.5
origin = [3, 4]
seed = 99
joint = "weak"
[generator]
seed = 12
smallest_block_area = 0.2
smallest_edge = 0.05
[[excavation]]
name = "tunnel"
shape = "horseshoe"
position = [10, 2]
width = 4
height = 3
arc_segments = 8
inside = "one_block"
[[excavation]]
name = "pipe"
shape = "circle"
position = [15, 5]
diameter = 1
[[excavation]]
name = "room"
shape = "rectangle"
position = [5, 5]
width = 2
height = 1
[[excavation]]
name = "wedge"
shape = "polygon"
polygon = [[1, 1], [2, 1], [2, 2]]
[material.shale]
density = 2500
[material.rock]
density = 2700
[joint.default]
normal_stiffness = 1e9
shear_stiffness = 2e8
friction_angle_deg = 25
[joint.weak]
normal_stiffness = 2e9
shear_stiffness = 3e8
friction_angle_deg = 10
cohesion = 500
restitution = 0.25
materials = ["rock", "shale"]
[gravity]
vector = [1, -9]
[[load]]
blocks = ["*", "b12"]
acceleration = [1, 2]
force = [3, 4]
moment = 5
from_cycle = 10
until_cycle = 20
[[load]]
blocks = ["b12"]
velocity_x = 1
velocity_y = -1
angular_velocity = 0.5
from_time = 0.25
until_time = 1
table = [[0, 1], [0.5, -2]]
table_by = "time"
[[load]]
blocks = ["b12"]
moment = 1
ramp_cycles = [5, 15]
[contact]
method = "impulse"
restitution = 0.3
threshold_scale = 2
fixed_mass_counts = true
impulse_sweeps = 4
correction_fraction = 0.5
allowed_overlap = 1e-5
length_floor = 0.01
overlap_limit = 0.125
skin = 0.1
[damping]
preset = "paper"
local = 0.5
global_damping_ratio = 0.01
average_frequency = 100
[time]
fraction = 0.2
stable_fraction = 0.5
[convergence]
criteria = ["unbalanced_force_ratio", "kinetic_energy"]
mean_speed = 1e-3
unbalanced_force_ratio = 1e-4
least_cycles = 10
detached_distance = 0.2
[[stage]]
name = "first"
cycles = 5e3
[[stage]]
excavate = ["tunnel", "pipe", "room", "wedge"]
fix = ["b1"]
free = ["b2"]
until = "converged"
max_cycles = 2000
method = "force"
damping = "dynamic"
[[stage]]
duration = 0.5
[[history]]
block = "b3"
quantities = ["velocity", "force"]
every = 10
[[history]]
name = "wall"
between = ["b3", "b4"]
quantities = ["overlap"]
[output]
row_every = 5
frame_every = 7
contacts = false
)";

TEST(CaseSections, FillRockMassSections)
{
    const CaseDef def = read(generated);
    EXPECT_EQ(def.title, "everything");
    EXPECT_TRUE(def.domain.given);
    EXPECT_EQ(def.domain.width, 20.0);
    EXPECT_EQ(def.domain.height, 10.5);
    EXPECT_EQ(def.domain.origin, Vec2(1, -2));
    EXPECT_THAT(def.domain.fixed, ElementsAre("left", "top"));
    EXPECT_EQ(def.domain.material, "shale");

    ASSERT_EQ(def.joint_sets.size(), 2U);
    EXPECT_EQ(def.joint_sets[0].name, "set1");
    EXPECT_EQ(def.joint_sets[0].dip_deg, -10.0);
    EXPECT_FALSE(def.joint_sets[0].origin);
    EXPECT_EQ(def.joint_sets[1].name, "cross");
    EXPECT_EQ(def.joint_sets[1].spacing, 2.5);
    EXPECT_EQ(def.joint_sets[1].deviation_deg, 3.0);
    EXPECT_EQ(def.joint_sets[1].persistence, 0.5);
    EXPECT_EQ(def.joint_sets[1].origin, Vec2(3, 4));
    EXPECT_EQ(def.joint_sets[1].seed, 99U);
    EXPECT_EQ(def.joint_sets[1].joint, "weak");

    EXPECT_EQ(def.generator.seed, 12U);
    EXPECT_EQ(def.generator.smallest_block_area, 0.2);
    EXPECT_EQ(def.generator.smallest_edge, 0.05);

    ASSERT_EQ(def.excavations.size(), 4U);
    EXPECT_EQ(def.excavations[0].shape, OutlineShape::horseshoe);
    EXPECT_EQ(def.excavations[0].position, Vec2(10, 2));
    EXPECT_EQ(def.excavations[0].arc_segments, 8);
    EXPECT_EQ(def.excavations[0].inside, InsideOutline::one_block);
    EXPECT_EQ(def.excavations[1].shape, OutlineShape::circle);
    EXPECT_EQ(def.excavations[1].diameter, 1.0);
    EXPECT_EQ(def.excavations[2].shape, OutlineShape::rectangle);
    EXPECT_EQ(def.excavations[2].width, 2.0);
    EXPECT_EQ(def.excavations[2].height, 1.0);
    EXPECT_EQ(def.excavations[3].shape, OutlineShape::polygon);
    EXPECT_THAT(def.excavations[3].polygon, ElementsAre(Vec2(1, 1), Vec2(2, 1), Vec2(2, 2)));
}

TEST(CaseSections, FillMaterialsJointsAndLoads)
{
    const CaseDef def = read(generated);
    ASSERT_EQ(def.materials.size(), 2U);
    EXPECT_EQ(def.materials[0].name, "shale");
    EXPECT_EQ(def.materials[0].density, 2500.0);
    ASSERT_EQ(def.joints.size(), 2U);
    EXPECT_EQ(def.joints[0].name, "default");
    EXPECT_FALSE(def.joints[0].restitution);
    EXPECT_EQ(def.joints[1].name, "weak");
    EXPECT_EQ(def.joints[1].normal_stiffness, 2e9);
    EXPECT_EQ(def.joints[1].shear_stiffness, 3e8);
    EXPECT_EQ(def.joints[1].friction_angle_deg, 10.0);
    EXPECT_EQ(def.joints[1].cohesion, 500.0);
    EXPECT_EQ(def.joints[1].restitution, 0.25);
    EXPECT_THAT(def.joints[1].materials, ElementsAre("rock", "shale"));
    EXPECT_EQ(def.gravity, Vec2(1, -9));

    ASSERT_EQ(def.loads.size(), 3U);
    EXPECT_EQ(def.loads[1].factor.table, (FactorTable{{0.0, 1.0}, {0.5, -2.0}}));
    EXPECT_EQ(def.loads[1].factor.table_by, TableColumn::time);
    EXPECT_TRUE(def.loads[0].factor.table.empty());
    EXPECT_EQ(def.loads[2].factor.ramp_cycles, Vec2(5, 15));
    EXPECT_FALSE(def.loads[2].factor.ramp_time);
    EXPECT_THAT(def.loads[0].blocks, ElementsAre("*", "b12"));
    EXPECT_EQ(def.loads[0].acceleration, Vec2(1, 2));
    EXPECT_EQ(def.loads[0].force, Vec2(3, 4));
    EXPECT_EQ(def.loads[0].moment, 5.0);
    EXPECT_EQ(def.loads[0].interval.from_cycle, 10);
    EXPECT_EQ(def.loads[0].interval.until_cycle, 20);
    EXPECT_FALSE(def.loads[0].velocity_x);
    EXPECT_EQ(def.loads[1].velocity_x, 1.0);
    EXPECT_EQ(def.loads[1].velocity_y, -1.0);
    EXPECT_EQ(def.loads[1].angular_velocity, 0.5);
    EXPECT_EQ(def.loads[1].interval.from_time, 0.25);
    EXPECT_EQ(def.loads[1].interval.until_time, 1.0);
}

TEST(CaseSections, FillSettings)
{
    const CaseDef def = read(generated);
    EXPECT_EQ(def.contact.method, Method::impulse);
    EXPECT_EQ(def.contact.restitution, 0.3);
    EXPECT_EQ(def.contact.threshold_scale, 2.0);
    EXPECT_FALSE(def.contact.threshold_velocity);
    EXPECT_TRUE(def.contact.fixed_mass_counts);
    EXPECT_EQ(def.contact.impulse_sweeps, 4);
    EXPECT_EQ(def.contact.correction_fraction, 0.5);
    EXPECT_EQ(def.contact.allowed_overlap, 1e-5);
    EXPECT_EQ(def.contact.length_floor, 0.01);
    EXPECT_EQ(def.contact.overlap_limit, 0.125);
    EXPECT_EQ(def.contact.skin, 0.1);
    EXPECT_EQ(def.damping.preset, DampingPreset::paper);
    EXPECT_EQ(def.damping.local, 0.5);
    EXPECT_EQ(def.damping.global_damping_ratio, 0.01);
    EXPECT_EQ(def.damping.average_frequency, 100.0);
    EXPECT_FALSE(def.time.step);
    EXPECT_EQ(def.time.fraction, 0.2);
    EXPECT_EQ(def.time.stable_fraction, 0.5);
    EXPECT_THAT(def.convergence.criteria, ElementsAre("unbalanced_force_ratio", "kinetic_energy"));
    EXPECT_EQ(def.convergence.mean_speed, 1e-3);
    EXPECT_EQ(def.convergence.unbalanced_force_ratio, 1e-4);
    EXPECT_EQ(def.convergence.least_cycles, 10);
    EXPECT_EQ(def.convergence.detached_distance, 0.2);
}

TEST(CaseSections, FillStagesHistoriesAndOutput)
{
    const CaseDef def = read(generated);
    ASSERT_EQ(def.stages.size(), 3U);
    EXPECT_EQ(def.stages[0].name, "first");
    EXPECT_EQ(def.stages[0].cycles, 5000);
    EXPECT_FALSE(def.stages[0].until_converged);
    EXPECT_EQ(def.stages[1].name, "stage2");
    EXPECT_THAT(def.stages[1].excavate, ElementsAre("tunnel", "pipe", "room", "wedge"));
    EXPECT_THAT(def.stages[1].fix, ElementsAre("b1"));
    EXPECT_THAT(def.stages[1].free, ElementsAre("b2"));
    EXPECT_TRUE(def.stages[1].until_converged);
    EXPECT_EQ(def.stages[1].max_cycles, 2000);
    EXPECT_EQ(def.stages[1].method, Method::force);
    EXPECT_EQ(def.stages[1].damping, DampingPreset::dynamic);
    EXPECT_EQ(def.stages[2].duration, 0.5);
    ASSERT_EQ(def.histories.size(), 2U);
    EXPECT_EQ(def.histories[0].name, "history1");
    EXPECT_EQ(def.histories[0].block, "b3");
    EXPECT_THAT(def.histories[0].quantities, ElementsAre("velocity", "force"));
    EXPECT_EQ(def.histories[0].every, 10);
    EXPECT_EQ(def.histories[1].name, "wall");
    EXPECT_THAT(def.histories[1].between, ElementsAre("b3", "b4"));
    EXPECT_EQ(def.output.row_every, 5);
    EXPECT_EQ(def.output.frame_every, 7);
    EXPECT_FALSE(def.output.contacts);
}

TEST(CaseSections, FillExplicitBlocks)
{
    const CaseDef def = read(with(two_blocks, "[[stage]]",
                                  "fixed = [\"x\", \"rotation\"]\nvelocity = [1, 2]\nangular_velocity = 3\n"
                                  "[[block]]\npolygon = [[5, 0], [6, 0], [6, 1], [5, 0]]\nfixed = [\"y\"]\n[[stage]]"));
    ASSERT_EQ(def.blocks.size(), 3U);
    EXPECT_TRUE(def.blocks[0].fix_x && def.blocks[0].fix_y && def.blocks[0].fix_rotation);
    EXPECT_TRUE(def.blocks[1].fix_x && !def.blocks[1].fix_y && def.blocks[1].fix_rotation);
    EXPECT_EQ(def.blocks[1].velocity, Vec2(1, 2));
    EXPECT_EQ(def.blocks[1].angular_velocity, 3.0);
    EXPECT_EQ(def.blocks[2].name, "block3");
    EXPECT_EQ(def.blocks[2].polygon.size(), 3U) << "a ring closed by hand keeps its closing vertex";
    EXPECT_TRUE(!def.blocks[2].fix_x && def.blocks[2].fix_y && !def.blocks[2].fix_rotation);
}

TEST(CaseSections, FillPolygonDomain)
{
    const CaseDef def = read(
        with(two_blocks, "[[stage]]", "[domain]\npolygon = [[9, 0], [12, 0], [9, 4]]\nfixed_edges = [0, 2]\n[[stage]]"));
    EXPECT_EQ(def.domain.polygon.size(), 3U);
    EXPECT_THAT(def.domain.fixed_edges, ElementsAre(0, 2));
}
}  // namespace
}  // namespace hdem
