#include "core/joint/user_law.h"
#include "core/state/hash_stream.h"
#include "core/state/state_hash.h"

namespace hdem
{
namespace
{
void add_shapes(const Model& model, HashStream& hash)
{
    const Shapes& shapes = model.shapes;
    for (const Index i : model.slot_of_user)
    {
        hash.add({model.mass[i], model.inertia[i], static_cast<double>(shapes.part_begin[i + 1] - shapes.part_begin[i])});
        for (Index v = shapes.vertex_begin[shapes.part_begin[i]]; v < shapes.vertex_begin[shapes.part_begin[i + 1]]; ++v)
            hash.add({shapes.vertex[v].x(), shapes.vertex[v].y(), static_cast<double>(shapes.edge_source[v])});
    }
}

void add_joints(const Model& model, HashStream& hash)
{
    for (const CoulombSlip& law : model.joints.laws)
        hash.add({law.normal_stiffness, law.shear_stiffness, law.friction_coefficient, law.cohesion, law.restitution});
    for (const JointRow& row : model.joints.rows)
    {
        hash.add({static_cast<double>(row.kind), static_cast<double>(row.curve), row.reach, row.torn_reach, row.tension,
                  row.residual_friction, row.residual_cohesion});
        for (int i = 0; i < UserLaw::number; ++i)  // that one counts the joints of all models of the process
            hash.add({row.numbers[i]});
    }
}

void add_boundaries(const Model& model, HashStream& hash)
{
    for (const Boundary& boundary : model.boundaries)
    {
        hash.add({static_cast<double>(boundary.kind), boundary.velocity.x(), boundary.velocity.y(), boundary.target,
                  boundary.max_velocity});
        for (const auto& row : boundary.factor.rows)
            hash.add({row[0], row[1], boundary.factor.is_by_time ? 1.0 : 0.0, static_cast<double>(boundary.factor.since)});
        for (const std::uint8_t acts : boundary.in_stage)
            hash.add({static_cast<double>(acts)});
        for (const BoundaryForce& force : boundary.forces)
            hash.add({static_cast<double>(model.user_number[force.block]), force.x, force.y, force.moment});
    }
    if (model.holds_mean)
        hash.add({1.0});
}

void add_bolts(const Model& model, HashStream& hash)
{
    for (const Bolt& bolt : model.support.bolts)
    {
        hash.add({static_cast<double>(bolt.kind), static_cast<double>(bolt.stage), bolt.spacing, bolt.stiffness,
                  bolt.shear_stiffness, bolt.pretension, bolt.yield, bolt.shear_strength, bolt.rupture, bolt.length,
                  bolt.section_stiffness, bolt.bond_stiffness, bolt.bond_strength, bolt.plate ? 1.0 : 0.0});
        for (const BoltLink& link : bolt.links)
            hash.add({static_cast<double>(model.user_number[link.first]), static_cast<double>(model.user_number[link.second]),
                      link.first_arm.x(), link.first_arm.y(), link.second_arm.x(), link.second_arm.y()});
        for (const BoltSegment& segment : bolt.segments)
            hash.add({static_cast<double>(segment.part), segment.length, segment.is_bonded ? 1.0 : 0.0});
    }
}

void add_liners(const Model& model, HashStream& hash)
{
    for (const Liner& liner : model.support.liners)
    {
        hash.add({static_cast<double>(liner.stage), liner.mass, liner.axial_stiffness, liner.bending_stiffness,
                  liner.compressive_strength, liner.tensile_strength, liner.moment_strength, liner.normal_stiffness,
                  liner.shear_stiffness, liner.friction, liner.cohesion, liner.bond_strength, liner.pressure,
                  static_cast<double>(liner.pressure_cycles)});
        for (const auto& row : liner.hardening)
            hash.add({row[0], row[1]});
        for (const LinerSegment& s : liner.segments)
            hash.add({s.block == no_index ? -1.0 : static_cast<double>(model.user_number[s.block]), static_cast<double>(s.node[0]),
                      static_cast<double>(s.node[1]), s.arm[0].x(), s.arm[0].y(), s.length, s.along.x(), s.along.y()});
    }
}
}  // namespace

std::uint64_t model_hash(const Model& model)
{
    if (model.drawn_hash)
        return *model.drawn_hash;
    HashStream hash;
    add_shapes(model, hash);
    add_joints(model, hash);
    // A step that the case does not give may have been lowered for its contacts since the model was made.
    hash.add(
        {model.has_step ? model.time_step : model.paper_time_step, model.threshold_scale, model.gravity.x(), model.gravity.y()});
    add_boundaries(model, hash);
    add_bolts(model, hash);
    add_liners(model, hash);
    return hash.digest();
}
}  // namespace hdem
