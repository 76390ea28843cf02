#include "io/case_fields.h"
#include "io/case_sections.h"

namespace hdem
{
using namespace fields;

SectionSpec water_section()
{
    return {
        "water",
        SectionKind::table,
        "water",
        "Water that stands or seeps slowly in the joints and around the rock: p = ρ_w g (h - y) below its level h. It presses on "
        "both faces of a joint over the whole length on which they face each other, open or closed, so that joint laws see the "
        "effective normal stress. It does not depend on time step and method. [insitu] stays the total stress. Water forces are "
        "computed anew in each stage, every 500 cycles, and more often where blocks move or float. Excavations are drained: there "
        "is no pressure where a block was removed. On a side with a [[boundary]] of kind stress only that stress acts.",
        {field<&WaterDef::level>(
             {.name = "level",
              .unit = "m",
              .effect = "Height of the water level everywhere, measured against gravity: y if gravity points down.",
              .example = "12.0",
              .range = coordinate,
              .default_note = "no water, except by the other keys"}),
         with_assign(spec({.name = "table",
                           .unit = "m",
                           .effect = "Points of the water table from left to right, seen with gravity downwards. It is straight "
                                     "between them and level beyond them. Instead of `level`.",
                           .example = "[[0, 12], [30, 9], [60, 4]]",
                           .range = coordinate,
                           .default_note = "none"},
                          ValueType::line),
                     assign_line<&WaterDef::table>),
         field<&WaterDef::pressure>(
             {.name = "pressure",
              .effect = "CSV file with rows x,y,pressure in m and Pa, e.g. from a seepage calculation. This heading may be left "
                        "out. The pressure is linear in triangles between the points. Instead of `level` and `table`.",
              .example = "\"p.csv\"",
              .default_note = "none"}),
         field<&WaterDef::density>({.name = "density", .unit = "kg/m3", .effect = "ρ_w.", .range = positive}),
         field<&WaterDef::ponded>(
             {.name = "ponded",
              .effect = "true: water also presses on free faces below its level, so that a submerged block "
                        "loses ρ_w g A of its weight. false: on joints only, and between blocks that have moved a quarter "
                        "of their size against each other no longer."}),
         field<&WaterDef::joints>(
             {.name = "joints",
              .effect = "Names of the [joint.NAME] that water gets into. A [[water_crack]] presses on its line in any joint.",
              .example = "[\"bedding\", \"fault\"]",
              .default_note = "all"}),
         field<&WaterDef::flooded>({.name = "flooded",
                                    .effect = "Names of excavations that are not drained: once excavated, water stands in them "
                                              "as around them. Not with ponded = false.",
                                    .example = "[\"shaft\"]",
                                    .default_note = "none"})},
        [](CaseDef& def, const std::string&) -> void*
        {
            def.water.given = true;
            return &def.water;
        }};
}

SectionSpec water_crack_section()
{
    return {
        "water_crack",
        SectionKind::array,
        "water crack",
        "A crack in which water stands, and the joints through which it seeps to the outside. On its line, as drawn, its pressure "
        "replaces that of [water]. The pressure stays with the faces there until their block has moved a quarter of its size. "
        "Needs [water].",
        {with_assign(spec({.name = "crack",
                           .unit = "m",
                           .effect = "Points of the crack; the last one is its foot. In it p = ρ_w g (level - y). A line that lies "
                                     "on no face of a block has no effect: `hdem check` warns of it.",
                           .example = "[[18, 30], [18, 16]]",
                           .range = coordinate,
                           .required = true},
                          ValueType::line),
                     assign_line<&WaterCrackDef::crack>),
         with_assign(spec({.name = "outlet",
                           .unit = "m",
                           .effect = "Points from the foot of the crack on. The pressure falls with length from that of the foot "
                                     "to 0 at the last point.",
                           .example = "[[18, 16], [0, 0]]",
                           .range = coordinate,
                           .required = true},
                          ValueType::line),
                     assign_line<&WaterCrackDef::outlet>),
         field<&WaterCrackDef::level>({.name = "level",
                                       .unit = "m",
                                       .effect = "Height of the water in the crack, against gravity.",
                                       .example = "19.0",
                                       .range = coordinate,
                                       .required = true})},
        append<&CaseDef::water_cracks>};
}
}  // namespace hdem
