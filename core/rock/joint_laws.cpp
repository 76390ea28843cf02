#include "core/rock/joint_laws.h"

#include "core/geometry/tangent.h"
#include "core/joint/all_laws.h"
#include "core/stress/insitu_stress.h"

#include <algorithm>
#include <cmath>

namespace hdem
{
namespace
{
/// Stiffnesses that do not grow with the stress have no bound [Pa/m].
double greatest_shear_stiffness(const JointDef& joint)
{
    return joint.shear_exponent.value_or(0.0) != 0.0 ? joint.greatest_stiffness
                                                     : std::max(joint.greatest_stiffness, joint.shear_stiffness);
}

struct Curve
{
    CurveKind kind = CurveKind::linear;
    JointNumbers numbers{};
};

/// Curves that stiffen are straight lines from the greatest expected stress on: no point can become stiffer than the time step allows.
Curve curve_of(const JointDef& joint, double stress)
{
    if (joint.law == JointLaw::barton_bandis && joint.rock_strength)
    {
        const BandisClosure closure = bandis_closure(joint.jrc, joint.jcs, *joint.rock_strength, joint.closure_cycle);
        return {CurveKind::hyperbolic, Hyperbolic::numbers(closure.stiffness, closure.greatest, stress)};
    }
    if (joint.greatest_closure)
        return {CurveKind::hyperbolic, Hyperbolic::numbers(joint.normal_stiffness, *joint.greatest_closure, stress)};
    if (joint.normal_exponent)
        return {CurveKind::power_law, PowerLaw::numbers(joint.normal_stiffness, *joint.normal_exponent,
                                                        std::min(joint.greatest_stiffness,
                                                                 joint.normal_stiffness * power(stress, *joint.normal_exponent)))};
    return {CurveKind::linear, Linear::numbers(joint.normal_stiffness)};
}

double residual_angle(const JointDef& joint)
{
    return joint.residual_friction_angle_deg.value_or(joint.friction_angle_deg);
}

CoulombInput coulomb_input(const JointDef& joint)
{
    return {.shear_stiffness = joint.shear_stiffness,
            .friction_angle = joint.friction_angle_deg,
            .residual_friction = residual_angle(joint),
            .cohesion = joint.cohesion,
            .residual_cohesion = joint.residual_cohesion.value_or(0.0),
            .tension = joint.tension.value_or(0.0),
            .residual_tension = joint.residual_tension.value_or(0.0),
            .dilation_angle = joint.dilation_angle_deg.value_or(0.0),
            .dilation_limit = joint.dilation_limit.value_or(no_limit)};
}

struct Law
{
    JointKind kind;
    JointNumbers numbers;
};

template <typename Type, typename Input>
Law law_with(const Input& input, const JointNumbers& curve)
{
    return {kind_of<Type>(), Type::numbers(input, curve)};
}

Law law_of(const JointDef& joint, const JointSurroundings& around, const JointNumbers& curve)
{
    const double k = joint.shear_stiffness, phi = joint.friction_angle_deg;
    switch (joint.law)
    {
    case JointLaw::barton_bandis:
        return law_with<BartonBandis>(BartonBandisInput{.shear_stiffness = k,
                                                        .roughness = joint.jrc,
                                                        .wall_strength = joint.jcs,
                                                        .residual_friction = residual_angle(joint),
                                                        .length = joint.length.value_or(around.block_size),
                                                        .damage = joint.damage,
                                                        .normal_stress = joint.normal_stress.value_or(around.normal_stress)},
                                      curve);
    case JointLaw::patton:
        return law_with<Patton>(PattonInput{.shear_stiffness = k,
                                            .friction = phi,
                                            .roughness = joint.asperity_angle_deg,
                                            .residual_friction = residual_angle(joint),
                                            .cohesion = joint.cohesion,
                                            .dilation_limit = joint.dilation_limit.value_or(no_limit)},
                                curve);
    case JointLaw::continuously_yielding:
        return law_with<ContinuouslyYielding>(ContinuouslyYieldingInput{.shear_stiffness = k,
                                                                        .shear_exponent = joint.shear_exponent.value_or(0.0),
                                                                        .greatest_stiffness = greatest_shear_stiffness(joint),
                                                                        .friction = phi,
                                                                        .first_friction = joint.mobilised_angle_deg,
                                                                        .roughness = joint.wear_length},
                                              curve);
    case JointLaw::plesha:
        return law_with<Plesha>(
            PleshaInput{.shear_stiffness = k, .friction = phi, .roughness = joint.asperity_angle_deg, .wear = joint.wear}, curve);
    case JointLaw::saeb_amadei:
        return law_with<SaebAmadei>(SaebAmadeiInput{.shear_stiffness = k,
                                                    .rock_strength = joint.transition_stress,
                                                    .friction = phi,
                                                    .roughness = joint.asperity_angle_deg,
                                                    .rock_cohesion = joint.rock_cohesion,
                                                    .rock_friction = joint.rock_friction_angle_deg,
                                                    .residual_slip = joint.residual_displacement,
                                                    .residual_share = joint.residual_share},
                                    curve);
    case JointLaw::slip_weakening:
        return law_with<SlipWeakening>(SlipWeakeningInput{.shear_stiffness = k,
                                                          .friction = phi,
                                                          .residual_friction = residual_angle(joint),
                                                          .weakening_length = joint.wear_length},
                                       curve);
    case JointLaw::library:
        return law_with<UserLaw>(UserLawInput{.function = joint.function, .parameters = joint.parameters, .shear_stiffness = k},
                                 curve);
    case JointLaw::coulomb:
        break;
    }
    Law law = law_with<CoulombResidual>(coulomb_input(joint), curve);
    if (!needs_memory(joint))
        law.kind = JointKind::plain;
    return law;
}

/// As a share of the block size: a bond without tension breaks as its joint opens, but not by a gap that is round-off, or that the springs leave which press it where it is
/// drawn (core/stress/drawn_joints.h). As much as leaves plain contacts closed (closed_gap, core/detection/edge_touch.h).
constexpr double round_off_gap = 1e-9;

JointRow row_of(const JointDef& joint, const JointSurroundings& around)
{
    const Curve curve = curve_of(joint, joint.normal_stress.value_or(around.normal_stress));
    const Law law = law_of(joint, around, curve.numbers);
    JointRow row{.kind = law.kind, .curve = curve.kind, .numbers = law.numbers};
    row.residual_friction = tangent(radians(residual_angle(joint)));
    if (row.kind != kind_of<CoulombResidual>())
        return row;
    row.residual_cohesion = joint.residual_cohesion.value_or(0.0);
    row.tension = joint.tension.value_or(0.0);
    row.reach = around.reach;
    row.torn_reach = joint.residual_tension.value_or(0.0) > 0.0 ? around.reach : 0.0;
    row.is_bonded = joint.cohesion > 0.0 || row.tension > 0.0;
    row.begins_broken = joint.initially == JointStart::broken;
    if (row.is_bonded && row.tension == 0.0 && CoulombResidual::loses_strength(row.numbers))
        row.numbers[CoulombResidual::tension] = std::min(row.numbers[curve_stiffness] * round_off_gap * around.block_size,
                                                         joint.cohesion);
    return row;
}

/// What the rest of the code asks of a joint: stiffness for the step, friction and cohesion of impulses.
CoulombSlip slip_of(const JointDef& joint, const JointRow& row, const JointSurroundings& around)
{
    CoulombSlip slip{.normal_stiffness = joint.normal_stiffness,
                     .shear_stiffness = joint.shear_stiffness,
                     .friction_coefficient = tangent(radians(joint.friction_angle_deg)),
                     .cohesion = joint.law == JointLaw::coulomb ? joint.cohesion : 0.0,
                     .restitution = joint.restitution.value_or(around.restitution)};
    if (!row.has_memory())
        return slip;
    const double stress = joint.normal_stress.value_or(around.normal_stress);
    slip.normal_stiffness = normal_state(row, closure_under(row, stress)).stiffness;
    if (joint.law == JointLaw::barton_bandis)
    {
        slip.shear_stiffness = row.numbers[BartonBandis::shear_stiffness];
        slip.friction_coefficient = row.residual_friction;
    }
    if (joint.law == JointLaw::slip_weakening)
        slip.friction_coefficient = row.residual_friction;
    if (joint.law == JointLaw::continuously_yielding)
        slip.shear_stiffness = std::min(joint.shear_stiffness * power(stress, joint.shear_exponent.value_or(0.0)),
                                        greatest_shear_stiffness(joint));
    return slip;
}

/// The same of blocks that have met since the start.
JointRow unbonded_row(const JointDef& joint, const JointRow& row, const CoulombSlip& slip)
{
    if (row.curve == CurveKind::linear)
        return {};
    const CoulombInput input{.shear_stiffness = slip.shear_stiffness,
                             .friction_angle = residual_angle(joint),
                             .residual_friction = residual_angle(joint)};
    return {.kind = kind_of<CoulombResidual>(),
            .curve = row.curve,
            .numbers = CoulombResidual::numbers(input, row.numbers),
            .residual_friction = row.residual_friction};
}
}  // namespace

bool needs_memory(const JointDef& joint)
{
    return joint.law != JointLaw::coulomb || joint.tension || joint.residual_friction_angle_deg || joint.residual_cohesion ||
           joint.residual_tension || joint.dilation_angle_deg || joint.greatest_closure || joint.normal_exponent ||
           joint.initially == JointStart::broken;
}

namespace
{
/// By which a load or a side is ever multiplied.
double greatest_factor(const FactorDef& factor)
{
    double greatest = factor.table.empty() ? 1.0 : 0.0;
    for (const auto& row : factor.table)
        greatest = std::max(greatest, std::abs(row[1]));
    return greatest;
}
}  // namespace

double expected_stress(const CaseDef& def, const InsituField& insitu, const RockExtent& rock)
{
    double density = 0.0;
    for (const MaterialDef& material : def.materials)
        density = std::max(density, material.density);
    double stress = density * def.gravity.norm() * rock.along_gravity;
    if (insitu.given)
        for (const double y : {rock.low, rock.high})
        {
            const StressDef s = stress_at(insitu, y);
            stress = std::max(stress, std::max(std::abs(s.xx), std::abs(s.yy)) + std::abs(s.xy));
        }
    constexpr double concentration = 2.0, of_loads = 4.0;
    stress *= concentration;
    for (std::size_t i = 0; i < def.loads.size(); ++i)
    {
        const LoadDef& load = def.loads[i];
        stress = std::max(stress,
                          greatest_factor(load.factor) * of_loads *
                              (load.force.norm() / rock.block_size + density * load.acceleration.norm() * rock.along_loads[i]));
    }
    for (const BoundaryDef& boundary : def.boundaries)
        stress = std::max(stress, greatest_factor(boundary.factor) * of_loads *
                                      std::max(boundary.stress.value_or(Vec2(0.0, 0.0)).lpNorm<1>(), std::abs(boundary.target)));
    return stress > 0.0 ? stress : 1e7;
}

void add_laws(const CaseDef& def, const JointSurroundings& around, JointTable& table)
{
    const bool joints_change = std::ranges::any_of(def.stages, [](const StageDef& stage) { return !stage.joints.empty(); });
    std::vector<JointRow> rows;
    for (const JointDef& joint : def.joints)
    {
        table.names.push_back(joint.name);
        rows.push_back(row_of(joint, around));
        table.laws.push_back(slip_of(joint, rows.back(), around));
    }
    for (std::size_t j = 0; j < def.joints.size(); ++j)
    {
        const CoulombSlip slip = table.laws[j];
        const bool differs = slip.cohesion > 0.0 || rows[j].has_memory() || joints_change;
        table.unbonded.push_back(differs ? static_cast<Index>(table.laws.size()) : static_cast<Index>(j));
        if (!differs)
            continue;
        table.laws.push_back(slip);
        table.laws.back().cohesion = 0.0;
        table.laws.back().friction_coefficient = rows[j].residual_friction;
        rows.push_back(unbonded_row(def.joints[j], rows[j], slip));
    }
    for (auto j = static_cast<Index>(table.unbonded.size()); j < static_cast<Index>(table.laws.size()); ++j)
        table.unbonded.push_back(j);
    if (std::ranges::any_of(rows, [](const JointRow& row) { return row.has_memory(); }))
        table.rows = std::move(rows);
}

std::vector<StageLaws> laws_of_stages(const CaseDef& def, const JointSurroundings& around)
{
    std::vector<StageLaws> stages(def.stages.size());
    for (std::size_t i = 0; i < stages.size(); ++i)
    {
        if (def.stages[i].joints.empty())
            continue;
        CaseDef changed;
        changed.joints = def.stages[i].joints;
        changed.stages = {def.stages[i]};
        JointTable table;
        add_laws(changed, around, table);
        stages[i] = {std::move(table.laws), std::move(table.rows)};
    }
    return stages;
}
}  // namespace hdem
