#include "io/case_fields.h"
#include "io/case_schema_factor.h"
#include "io/case_sections.h"

namespace hdem
{
using namespace fields;

namespace
{
constexpr const char* about =
    "What holds or presses a side of the domain, in all stages or in some. `fixed`: the blocks with an edge on the side do not "
    "move, as with domain.fixed. `roller`: a wall behind the side; rock cannot move across it and slides along it freely. "
    "`stress`: a traction on the blocks with an edge on the side as drawn; it does not turn with them. `velocity`: a wall that "
    "moves as given. `servo`: a wall that moves along its normal until it presses with `target`; each cycle corrects a twentieth "
    "of the missing force. This needs the stiffness of springs, so stages with the impulse method are refused. A wall is a rigid "
    "block without mass outside the domain. It has the boundary's name (NAME.1, NAME.2, ... where there are several edges), so "
    "that a [[history]] can read its force. Its joint is [joint.default] without friction and cohesion; its linear spring has the "
    "stiffness at normal_stress. It carries the stress of [insitu] from the start. A wall that begins in a later stage is placed "
    "where it touches the rock, without force. Tractions of kind stress keep their direction: a model that is compressed on all "
    "sides and held by one block soon turns over once something moves. Let rollers hold two of its sides. Where a boundary ends, "
    "its wall is taken away, its traction ends, or its blocks are freed (not those that `fix` of a stage holds), at once or over "
    "the stage's relax_cycles.";

void assign_stress(void* object, const TomlNode& value, const KeySpec&)
{
    auto& boundary = *static_cast<BoundaryDef*>(object);
    boundary.is_insitu = value.text() != nullptr;
    if (value.text() == nullptr)
        boundary.stress = vector(value);
}
}  // namespace

SectionSpec boundary_section()
{
    KeySpec stress = spec({.name = "stress",
                           .unit = "Pa",
                           .effect = "[compression, shear along the side anticlockwise around the domain]. `\"insitu\"`: the "
                                     "traction of [insitu], with which the rock is in equilibrium. Belongs to kind stress.",
                           .example = "[5e6, 0.0]",
                           .range = any_size,
                           .choices = {"insitu"},
                           .default_note = "must be given with kind stress"},
                          ValueType::pair_or_text);
    SectionSpec section = {
        "boundary",
        SectionKind::array,
        "boundary",
        about,
        {field<&BoundaryDef::name>({.name = "name",
                                    .effect = "What it and its wall are called.",
                                    .default_note = "\"boundary1\", \"boundary2\", ... in the order of the file"}),
         field<&BoundaryDef::side>({.name = "side",
                                    .effect = "Of a rectangular domain.",
                                    .example = "\"left\"",
                                    .choices = {"left", "right", "bottom", "top"},
                                    .default_note = "given by edges"}),
         field<&BoundaryDef::edges>({.name = "edges",
                                     .effect = "Of domain.polygon: 0 is the edge from the first to the second vertex.",
                                     .example = "[0, 3]",
                                     .range = {.low = 0, .high = 1e6},
                                     .default_note = "given by side"}),
         field<&BoundaryDef::kind>({.name = "kind",
                                    .effect = "What acts on the side, see above.",
                                    .example = "\"roller\"",
                                    .choices = {"fixed", "roller", "stress", "velocity", "servo"},
                                    .required = true}),
         with_assign(std::move(stress), assign_stress),
         field<&BoundaryDef::stress_gradient>({.name = "stress_gradient",
                                               .unit = "Pa/m",
                                               .effect = "Change of both numbers of `stress` per metre upwards: negative where the "
                                                         "pressure grows with depth. With it `stress` holds at y = stress_height.",
                                               .example = "[-2.65e4, 0.0]",
                                               .range = any_size}),
         field<&BoundaryDef::stress_height>({.name = "stress_height",
                                             .unit = "m",
                                             .effect = "Height y at which `stress` holds, where it has a gradient.",
                                             .example = "40.0",
                                             .range = coordinate}),
         field<&BoundaryDef::velocity>({.name = "velocity",
                                        .unit = "m/s",
                                        .effect = "Of the wall. Belongs to kind velocity.",
                                        .range = speed,
                                        .default_note = "must be given with kind velocity"}),
         field<&BoundaryDef::target>(
             {.name = "target",
              .unit = "Pa",
              .effect = "Compression to reach: force of the wall divided by the length of the side as "
                        "drawn, without the parts in front of fixed blocks. In wet rock this is the effective stress: the "
                        "pressure of the water on the side comes on top. Belongs to kind servo.",
              .example = "2e6",
              .range = positive,
              .default_note = "must be given with kind servo"}),
         field<&BoundaryDef::max_velocity>({.name = "max_velocity",
                                            .unit = "m/s",
                                            .effect = "Greatest speed of the wall. Belongs to kind servo.",
                                            .example = "1e-3",
                                            .range = {.low = 0, .high = 1e6, .low_included = false},
                                            .default_note = "convergence.mean_speed"}),
         field<&BoundaryDef::stages>({.name = "stages",
                                      .effect = "Names of the stages in which it acts.",
                                      .example = "[\"load\", \"shear\"]",
                                      .default_note = "all"})},
        append<&CaseDef::boundaries>};
    add_factor_keys<&BoundaryDef::factor>(section.keys);
    return section;
}
}  // namespace hdem
