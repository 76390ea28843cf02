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
        field<&BoltDef::name>({.name = "name",
                               .effect = "For histories and messages. Bolts of a pattern are called NAME.1, NAME.2, ...",
                               .default_note = "\"bolt1\", \"bolt2\", ..."}),
        field<&BoltDef::kind>({.name = "kind", .effect = "See above.", .choices = {"anchored", "grouted", "local"}}),
        field<&BoltDef::from>({.name = "from",
                               .unit = "m",
                               .effect = "Its head, as drawn; on the outline of an opening, as a rule.",
                               .example = "[10.0, 14.0]",
                               .range = coordinate,
                               .default_note = "around is given instead"}),
        field<&BoltDef::to>({.name = "to",
                             .unit = "m",
                             .effect = "Its end in the rock, as drawn.",
                             .example = "[10.0, 18.0]",
                             .range = coordinate,
                             .default_note = "around is given instead"}),
        field<&BoltDef::around>({.name = "around",
                                 .effect = "Name of an excavation: bolts with their heads on its outline, at right angles to it.",
                                 .example = "\"tunnel\"",
                                 .default_note = "from and to are given instead"}),
        field<&BoltDef::length>({.name = "length",
                                 .unit = "m",
                                 .effect = "Of each bolt of a pattern.",
                                 .example = "4.0",
                                 .range = length,
                                 .default_note = "must be given with around"}),
        field<&BoltDef::along>({.name = "along",
                                .unit = "m",
                                .effect = "Greatest distance of the heads along the outline. Heads stand in the middle of equal "
                                          "pieces no longer than this.",
                                .example = "1.2",
                                .range = length,
                                .default_note = "must be given with around"}),
        field<&BoltDef::arc>({.name = "arc",
                              .unit = "deg",
                              .effect = "Only heads in the directions from the first to the second, anticlockwise from the x axis, "
                                        "as seen from the centre of the outline's bounding box: [30, 150] is the roof.",
                              .example = "[30, 150]",
                              .range = {.low = -360, .high = 720},
                              .default_note = "all around"}),
        field<&BoltDef::stage>({.name = "stage",
                                .effect = "Name of the stage at whose start it is installed, after excavation and without force "
                                          "except its pretension.",
                                .example = "\"supported\"",
                                .default_note = "the first"}),
        field<&BoltDef::spacing>(
            {.name = "spacing",
             .unit = "m",
             .effect = "Distance of such bolts out of plane. Forces, stiffnesses and strengths of this section "
                       "are those of one bolt.",
             .range = length})};
}

std::vector<KeySpec> bar_keys()
{
    return {
        field<&BoltDef::area>({.name = "area",
                               .unit = "m2",
                               .effect = "Cross-section of the bar, A. Belongs to anchored and grouted.",
                               .example = "4.9e-4",
                               .range = positive,
                               .default_note = "must be given; anchored: unless stiffness is given"}),
        field<&BoltDef::modulus>({.name = "modulus", .unit = "Pa", .effect = "Young's modulus of the bar, E.", .range = positive}),
        field<&BoltDef::stiffness>({.name = "stiffness",
                                    .unit = "N/m",
                                    .effect = "Anchored: axial stiffness of the bolt, instead of E A / free_length. Local: axial "
                                              "stiffness of one crossing.",
                                    .example = "3e7",
                                    .range = non_negative,
                                    .default_note = "E A / free_length; local: must be given"}),
        field<&BoltDef::free_length>(
            {.name = "free_length",
             .unit = "m",
             .effect = "Anchored: the length that stretches. Grouted: the length without bond, from the head on.",
             .example = "3.5",
             .range = {.low = 0, .high = 1e8},
             .default_note = "anchored: the distance of its ends; grouted: 0"}),
        field<&BoltDef::pretension>({.name = "pretension",
                                     .unit = "N",
                                     .effect = "Force with which it is installed. Belongs to anchored.",
                                     .range = non_negative}),
        field<&BoltDef::yield>({.name = "yield",
                                .unit = "N",
                                .effect = "Axial force at which it yields: it bears no more and keeps its elongation.",
                                .example = "2.5e5",
                                .range = positive,
                                .default_note = "never"}),
        field<&BoltDef::rupture_strain>({.name = "rupture_strain",
                                         .effect = "Strain at which it ruptures, including that of pretension and yielding. It "
                                                   "refers to free_length (anchored), to a piece between two nodes but at least "
                                                   "twice the diameter (grouted), or to active_length (local).",
                                         .example = "0.1",
                                         .range = positive,
                                         .default_note = "never"}),
        field<&BoltDef::bond_stiffness>({.name = "bond_stiffness",
                                         .unit = "N/m/m",
                                         .effect = "Of the grout, per metre of bolt. Belongs to grouted.",
                                         .example = "1.12e8",
                                         .range = positive,
                                         .default_note = "must be given with grouted"}),
        field<&BoltDef::bond_strength>({.name = "bond_strength",
                                        .unit = "N/m",
                                        .effect = "Greatest force between bolt and rock, per metre of bolt. Belongs to grouted.",
                                        .example = "1.75e5",
                                        .range = positive,
                                        .default_note = "must be given with grouted"}),
        field<&BoltDef::segment>({.name = "segment",
                                  .unit = "m",
                                  .effect = "Greatest distance between its nodes. Belongs to grouted.",
                                  .example = "0.05",
                                  .range = length,
                                  .default_note = "0.1 (E A / bond_stiffness)^1/2"}),
        field<&BoltDef::plate>(
            {.name = "plate",
             .effect = "A plate holds the head against the rock: the bar cannot slip into the rock there. Belongs to grouted."}),
        field<&BoltDef::shear_stiffness>({.name = "shear_stiffness",
                                          .unit = "N/m",
                                          .effect = "Across the bolt, of one crossing. Belongs to local.",
                                          .example = "1e8",
                                          .range = non_negative,
                                          .default_note = "must be given with local"}),
        field<&BoltDef::shear_strength>({.name = "shear_strength",
                                         .unit = "N",
                                         .effect = "Greatest force across the bolt. Belongs to local.",
                                         .example = "5e4",
                                         .range = positive,
                                         .default_note = "no limit"}),
        field<&BoltDef::active_length>(
            {.name = "active_length",
             .unit = "m",
             .effect = "Length of bar that deforms at a crossing, half on each side; usually twice its diameter. The axial force "
                       "acts along the line between the two ends of this length. Belongs to local.",
             .example = "0.05",
             .range = length,
             .default_note = "must be given with local"})};
}
}  // namespace

SectionSpec bolt_section()
{
    std::vector<KeySpec> keys = place_keys();
    std::ranges::move(bar_keys(), std::back_inserter(keys));
    return {
        "bolt",
        SectionKind::array,
        "bolt",
        "Rock bolts. anchored: a bar between its head and its end, free in between, with or without pretension; it bears "
        "tension only. grouted: a bar bonded to the rock along its length (cable, dowel); the bond may slip, the bar may "
        "yield; the bond reaches up to each joint, and the bar takes its direction there over twice its diameter. local: an axial "
        "spring, in tension and compression, and a shear spring at each joint that the line from -> to crosses. A bolt is fastened "
        "to the blocks at its points; a block that is excavated takes its part with it. "
        "Bolts act as forces with all methods. With bolts no static solution is tried.",
        std::move(keys),
        append<&CaseDef::bolts>};
}
}  // namespace hdem
