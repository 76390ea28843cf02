#include "io/case_fields.h"
#include "io/case_sections.h"

namespace hdem
{
using namespace fields;

namespace
{
void assign_fixed(void* object, const TomlNode& value, const KeySpec&)
{
    auto& block = *static_cast<BlockDef*>(object);
    if (const bool* all = value.boolean())
        block.fix_x = block.fix_y = block.fix_rotation = *all;
    else
        for (const TomlNode& item : *value.items())
            (*item.text() == "x" ? block.fix_x : *item.text() == "y" ? block.fix_y : block.fix_rotation) = true;
}
}  // namespace

SectionSpec top_section()
{
    return {
        "",
        SectionKind::top,
        "case",
        "Keys before the first header.",
        {with_assign(
             spec({.name = "schema",
                   .effect = "Version of this format. A file that says another version is refused.",
                   .example = "1",
                   .range = {case_schema_version, case_schema_version}},
                  ValueType::integer),
             [](void*, const TomlNode&, const KeySpec&) {}, "1"),
         field<&CaseDef::title>(
             {.name = "title", .effect = "Shown on the screen, in pictures and in the report.", .default_note = "empty"}),
         field<&CaseDef::blocks_file>({.name = "blocks_file",
                                       .effect = "File with one WKT polygon per line, CSV or GeoJSON (below); its blocks come "
                                                 "after those of [[block]]. A relative path starts at the folder of the case file.",
                                       .example = "\"blocks.wkt\"",
                                       .default_note = "no file"})},
        whole_case};
}

SectionSpec domain_section()
{
    return {
        "domain",
        SectionKind::table,
        "domain",
        "The area that is filled with rock: a rectangle (`width`, `height`, `origin`) or a `polygon`. "
        "Joint sets and excavations cut this area only; explicit blocks are added as they are.",
        {field<&DomainDef::width>({.name = "width",
                                   .unit = "m",
                                   .effect = "Width of the rectangle.",
                                   .example = "35.0",
                                   .range = length,
                                   .default_note = "no rectangle"}),
         field<&DomainDef::height>({.name = "height",
                                    .unit = "m",
                                    .effect = "Height of the rectangle.",
                                    .example = "33.0",
                                    .range = length,
                                    .default_note = "no rectangle"}),
         field<&DomainDef::origin>(
             {.name = "origin", .unit = "m", .effect = "Lower left corner of the rectangle.", .range = coordinate}),
         field<&DomainDef::polygon>({.name = "polygon",
                                     .unit = "m",
                                     .effect = "Vertices, instead of the rectangle; simple, convex or not, in either direction.",
                                     .range = coordinate,
                                     .default_note = "no polygon"}),
         field<&DomainDef::profile>(
             {.name = "profile",
              .effect = "CSV file of rows x,y: the ground, with x ascending. The domain is what lies below it down to `bottom`, "
                        "instead of the rectangle or the polygon. Its sides have the names of a rectangle's.",
              .example = "\"topo.csv\"",
              .default_note = "no profile"}),
         field<&DomainDef::bottom>({.name = "bottom",
                                    .unit = "m",
                                    .effect = "y of the lower side of a domain below a profile.",
                                    .example = "-20.0",
                                    .range = coordinate,
                                    .default_note = "must be given with profile"}),
         field<&DomainDef::fixed>({.name = "fixed",
                                   .effect = "Sides of the rectangle. A block with an edge on one of them is fixed; one that lies "
                                             "inside an excavation, until it is removed.",
                                   .example = "[\"left\", \"right\", \"bottom\"]",
                                   .choices = {"left", "right", "bottom", "top"},
                                   .default_note = "none"}),
         field<&DomainDef::fixed_edges>(
             {.name = "fixed_edges",
              .effect = "The same for edges of the polygon: edge 0 runs from the first vertex to the second.",
              .example = "[0, 1]",
              .range = {.low = 0, .high = 1e6},
              .default_note = "none"}),
         field<&DomainDef::hold>(
             {.name = "hold",
              .effect = "For a model in which nothing is fixed and a [[boundary]] of kind stress acts in every stage. `mean`: the "
                        "blocks at these sides do not move or turn on average. Forces in proportion to their masses hold them, and "
                        "carry what is out of equilibrium, e.g. after an excavation. As drawn, tractions and weight must be in "
                        "equilibrium. With `none`, something must be fixed, or stand on a side of another kind.",
              .example = "\"mean\"",
              .choices = {"none", "mean"}}),
         field<&DomainDef::material>(
             {.name = "material", .effect = "Name of the [material.NAME] of all blocks cut from the domain."}),
         field<&DomainDef::traces_file>(
             {.name = "traces_file",
              .effect = "File with joint traces of finite length (below). They cut the domain first; joint "
                        "sets cut the pieces.",
              .example = "\"traces.wkt\"",
              .default_note = "no file"}),
         field<&DomainDef::traces_joint>({.name = "traces_joint",
                                          .effect = "Name of the [joint.NAME] for contacts along traces.",
                                          .default_note = "by the materials of the two blocks"}),
         field<&DomainDef::traces_snap>(
             {.name = "traces_snap",
              .unit = "m",
              .effect = "Every trace is made longer by this at both ends, so that mapped traces that end "
                        "just short of each other meet.",
              .range = non_negative})},
        [](CaseDef& def, const std::string&) -> void*
        {
            def.domain.given = true;
            return &def.domain;
        }};
}

SectionSpec generator_section()
{
    return {
        "generator",
        SectionKind::table,
        "generator",
        "How the domain is cut. The same file gives the same blocks, bit for bit, on every machine.",
        {field<&GeneratorDef::seed>({.name = "seed", .effect = "Seed of all random numbers of the case.", .range = {.low = 0}}),
         field<&GeneratorDef::smallest_block_area>({.name = "smallest_block_area",
                                                    .unit = "m2",
                                                    .effect = "A cut that would leave a smaller piece is refused, and smaller "
                                                              "pieces at an excavation outline are joined to a neighbour, across "
                                                              "a fault or the boundary of a region only where there is no other. "
                                                              "Cuts are made one after another: which of them are refused "
                                                              "depends on their order, and may differ in a mirrored model. "
                                                              "The smallest block decides the time step.",
                                                    .range = non_negative}),
         field<&GeneratorDef::smallest_edge>({.name = "smallest_edge",
                                              .unit = "m",
                                              .effect = "A cut that would leave a shorter edge is refused.",
                                              .range = non_negative})},
        part<&CaseDef::generator>};
}

SectionSpec excavation_section()
{
    return {"excavation",
            SectionKind::array,
            "excavation",
            "An outline that is cut into the blocks of the domain. What lies inside stays until a stage removes it.",
            {field<&ExcavationDef::name>(
                 {.name = "name", .effect = "What a stage's `excavate` calls it.", .example = "\"tunnel\"", .required = true}),
             field<&ExcavationDef::shape>({.name = "shape",
                                           .effect = "`horseshoe`: a rectangle of width × (height − width/2) under a half circle; "
                                                     "`rectangle`; `circle`; `polygon`.",
                                           .example = "\"horseshoe\"",
                                           .choices = {"horseshoe", "circle", "rectangle", "polygon"},
                                           .required = true}),
             field<&ExcavationDef::position>({.name = "position",
                                              .unit = "m",
                                              .effect = "Middle of the floor (horseshoe, rectangle) or centre (circle).",
                                              .example = "[17.5, 12.5]",
                                              .range = coordinate,
                                              .default_note = "must be given, except for a polygon"}),
             field<&ExcavationDef::width>({.name = "width",
                                           .unit = "m",
                                           .effect = "Of a horseshoe or rectangle.",
                                           .example = "9.0",
                                           .range = length,
                                           .default_note = "must be given for these"}),
             field<&ExcavationDef::height>({.name = "height",
                                            .unit = "m",
                                            .effect = "Of a horseshoe or rectangle, floor to crown.",
                                            .example = "8.0",
                                            .range = length,
                                            .default_note = "must be given for these"}),
             field<&ExcavationDef::diameter>({.name = "diameter",
                                              .unit = "m",
                                              .effect = "Of a circle.",
                                              .example = "6.0",
                                              .range = length,
                                              .default_note = "must be given for a circle"}),
             field<&ExcavationDef::arc_segments>(
                 {.name = "arc_segments",
                  .effect = "Straight edges that stand for the half circle of a horseshoe or for the circle.",
                  .range = {.low = 3, .high = 1000}}),
             field<&ExcavationDef::polygon>({.name = "polygon",
                                             .unit = "m",
                                             .effect = "Vertices of the outline when shape = \"polygon\".",
                                             .range = coordinate,
                                             .default_note = "must be given for a polygon"}),
             field<&ExcavationDef::inside>(
                 {.name = "inside",
                  .effect = "`jointed`: the blocks inside keep the joints that cut them; `one_block`: "
                            "the inside is a single rigid block. Rock in two excavations belongs to the first "
                            "one in the file.",
                  .choices = {"jointed", "one_block"}})},
            append<&CaseDef::excavations>};
}

SectionSpec block_section()
{
    KeySpec fixed = spec({.name = "fixed",
                          .effect = "`true`: never moved by forces. A list fixes only these components, e.g. `[\"rotation\"]`. A "
                                    "fixed component keeps its velocity of the start.",
                          .example = "true",
                          .choices = {"x", "y", "rotation"}},
                         ValueType::boolean_or_texts);
    return {"block",
            SectionKind::array,
            "block",
            "One explicit block, instead of or beside a generated rock mass.",
            {field<&BlockDef::name>({.name = "name",
                                     .effect = "What loads, stages and histories call it.",
                                     .default_note = "\"block1\", \"block2\", ... in the order of the file"}),
             field<&BlockDef::polygon>(
                 {.name = "polygon",
                  .unit = "m",
                  .effect = "Vertices; simple, convex or not, in either direction. The last need not repeat the first.",
                  .example = "[[0, 0], [1, 0], [1, 1], [0, 1]]",
                  .range = coordinate,
                  .required = true}),
             field<&BlockDef::material>({.name = "material", .effect = "Name of its [material.NAME]."}),
             with_assign(std::move(fixed), assign_fixed, "false"),
             field<&BlockDef::velocity>({.name = "velocity", .unit = "m/s", .effect = "At the start.", .range = speed}),
             field<&BlockDef::angular_velocity>(
                 {.name = "angular_velocity", .unit = "rad/s", .effect = "At the start, positive anticlockwise.", .range = speed})},
            append<&CaseDef::blocks>};
}
}  // namespace hdem
