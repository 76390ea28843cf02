#include "io/case_fields.h"
#include "io/case_sections.h"

namespace hdem
{
using namespace fields;

namespace
{
std::vector<KeySpec> place_keys()
{
    return {
        field<&LinerDef::name>(
            {.name = "name", .effect = "For histories and messages.", .default_note = "\"liner1\", \"liner2\", ..."}),
        field<&LinerDef::around>({.name = "around",
                                  .effect = "Name of an excavation: along its outline.",
                                  .example = "\"tunnel\"",
                                  .default_note = "path is given instead"}),
        field<&LinerDef::arc>({.name = "arc",
                               .unit = "deg",
                               .effect = "Only the part of the outline in the directions from the first to the second, "
                                         "anticlockwise from the x axis, as seen from the centre of the outline's bounding box: "
                                         "[-10, 190] leaves out the floor of most tunnels.",
                               .example = "[-10, 190]",
                               .range = {.low = -360, .high = 720},
                               .default_note = "a closed ring"}),
        with_assign(spec({.name = "path",
                          .unit = "m",
                          .effect = "Points, as drawn; the rock lies to the right of the path. The liner is closed if the last "
                                    "point is the first one.",
                          .example = "[[0, 0], [8, 0]]",
                          .range = coordinate,
                          .default_note = "around is given instead"},
                         ValueType::line),
                    assign_line<&LinerDef::path>),
        field<&LinerDef::stage>({.name = "stage",
                                 .effect = "Name of the stage at whose start it is installed, after excavation and without force.",
                                 .example = "\"lined\"",
                                 .default_note = "the first"})};
}

std::vector<KeySpec> beam_keys()
{
    return {field<&LinerDef::thickness>({.name = "thickness",
                                         .unit = "m",
                                         .effect = "Thickness of the beams, t.",
                                         .example = "0.15",
                                         .range = length,
                                         .required = true}),
            field<&LinerDef::modulus>({.name = "modulus",
                                       .unit = "Pa",
                                       .effect = "Young's modulus of the beams, E; for plane strain give E / (1 - ν²).",
                                       .example = "25e9",
                                       .range = positive,
                                       .required = true}),
            field<&LinerDef::inertia>({.name = "inertia",
                                       .unit = "m3",
                                       .effect = "Second moment of area per metre out of plane, I.",
                                       .example = "2.8e-4",
                                       .range = positive,
                                       .default_note = "t³ / 12"}),
            field<&LinerDef::density>({.name = "density",
                                       .unit = "kg/m3",
                                       .effect = "Gives weight and inertia. The weight grows over the first 500 cycles.",
                                       .range = positive}),
            field<&LinerDef::compressive_strength>({.name = "compressive_strength",
                                                    .unit = "Pa",
                                                    .effect = "The greatest thrust is this times t; the liner then yields.",
                                                    .example = "25e6",
                                                    .range = positive,
                                                    .default_note = "never yields"}),
            field<&LinerDef::tensile_strength>({.name = "tensile_strength",
                                                .unit = "Pa",
                                                .effect = "The greatest axial tension is this times t.",
                                                .example = "2e6",
                                                .range = positive,
                                                .default_note = "never yields"}),
            field<&LinerDef::moment_strength>(
                {.name = "moment_strength",
                 .unit = "N m/m",
                 .effect = "Greatest moment, M_p; a plastic hinge turns at it. It does not depend on the thrust.",
                 .example = "11250",
                 .range = positive,
                 .default_note = "never yields"}),
            field<&LinerDef::segment>(
                {.name = "segment",
                 .unit = "m",
                 .effect = "Greatest distance between its nodes. There are also nodes at corners and where the block behind the "
                           "liner changes. Moments under a block that hangs on the liner are too small by the share 0.25 (h / "
                           "b)^2; h is this distance, b = (4 E I / normal_stiffness)^(1/4).",
                 .example = "0.25",
                 .range = length,
                 .default_note = "2 t, or 0.15 b if less"}),
            field<&LinerDef::hardening>(
                {.name = "hardening",
                 .effect = "Rows [cycles since it was installed, factor of modulus and strengths]: linear in between, constant "
                           "before and after. Factors are above 0. Forces do not change with the factor.",
                 .example = "[[0, 0.1], [5000, 1.0]]",
                 .range = non_negative,
                 .default_note = "1"})};
}

std::vector<KeySpec> tie_keys()
{
    return {
        field<&LinerDef::normal_stiffness>({.name = "normal_stiffness",
                                            .unit = "Pa/m",
                                            .effect = "Of the springs between liner and rock, across the liner.",
                                            .example = "1e10",
                                            .range = positive,
                                            .required = true}),
        field<&LinerDef::shear_stiffness>({.name = "shear_stiffness",
                                           .unit = "Pa/m",
                                           .effect = "The same along the liner.",
                                           .example = "1e9",
                                           .range = non_negative,
                                           .default_note = "normal_stiffness"}),
        field<&LinerDef::friction_angle_deg>({.name = "friction_angle_deg",
                                              .unit = "deg",
                                              .effect = "Between liner and rock.",
                                              .range = {.low = 0, .high = 90, .high_included = false}}),
        field<&LinerDef::cohesion>({.name = "cohesion",
                                    .unit = "Pa",
                                    .effect = "Between liner and rock, until the bond breaks there.",
                                    .range = non_negative}),
        field<&LinerDef::bond_strength>({.name = "bond_strength",
                                         .unit = "Pa",
                                         .effect = "Tension at which the bond between liner and rock breaks there.",
                                         .range = non_negative}),
        field<&LinerDef::pressure>({.name = "pressure",
                                    .unit = "Pa",
                                    .effect = "Pressure between liner and rock that acts on the liner only, e.g. of water behind "
                                              "it. (The rock's own water is [water].)",
                                    .range = any_size}),
        field<&LinerDef::pressure_cycles>({.name = "pressure_cycles",
                                           .effect = "Cycles over which the pressure grows from 0, since the liner was installed.",
                                           .range = count_or_none})};
}
}  // namespace

SectionSpec liner_section()
{
    std::vector<KeySpec> keys = place_keys();
    std::ranges::move(beam_keys(), std::back_inserter(keys));
    std::ranges::move(tie_keys(), std::back_inserter(keys));
    return {"liner",
            SectionKind::array,
            "liner",
            "Liners: beams (Euler and Bernoulli) along the outline of an excavation, or along points, tied to the rock by springs "
            "with friction, cohesion and a bond that breaks. All numbers are per metre out of plane. Displacements of the liner "
            "are assumed small. They act as forces with all methods. With liners no static solution is tried.",
            std::move(keys),
            append<&CaseDef::liners>};
}
}  // namespace hdem
