#include "io/case_fields.h"
#include "io/case_sections.h"

namespace hdem
{
using namespace fields;

SectionSpec fault_section()
{
    KeySpec points = spec({.name = "points",
                           .unit = "m",
                           .effect = "Points in order along it, two or more. What lies outside the domain has no effect.",
                           .example = "[[-1, 4], [12, 9], [31, 11]]",
                           .range = coordinate,
                           .required = true},
                          ValueType::line);
    return {"fault",
            SectionKind::array,
            "fault",
            "One long joint, straight or with bends, that is cut before all joint sets. Let it begin and end a little outside the "
            "domain, or beyond another fault: an end inside a block separates nothing and is dropped, with a warning.",
            {field<&FaultDef::name>(
                 {.name = "name", .effect = "What regions and messages call it.", .example = "\"fault1\"", .required = true}),
             with_assign(std::move(points), assign_line<&FaultDef::points>),
             field<&FaultDef::joint>(
                 {.name = "joint",
                  .effect = "Name of the [joint.NAME] for contacts along it; it has priority over that of a joint set.",
                  .default_note = "by the materials of the two blocks"})},
            append<&CaseDef::faults>};
}

SectionSpec region_section()
{
    return {
        "region",
        SectionKind::array,
        "region",
        "A part of the domain that has joint sets or a material of its own: inside a `polygon`, on one side of a fault, or between "
        "faults. Where several of these are given, the region is the area that lies in all of them.",
        {field<&RegionDef::name>(
             {.name = "name", .effect = "What joint sets call it.", .example = "\"hanging_wall\"", .required = true}),
         field<&RegionDef::polygon>({.name = "polygon",
                                     .unit = "m",
                                     .effect = "Vertices. The outline is cut into the rock before the joint sets, except where it "
                                               "runs along the domain's boundary, a fault or an earlier outline.",
                                     .example = "[[10, 0], [20, 0], [20, 8], [10, 8]]",
                                     .range = coordinate,
                                     .default_note = "no outline"}),
         field<&RegionDef::above>({.name = "above",
                                   .effect = "Name of the fault it lies above. The fault is extended straight at its ends. It must "
                                             "separate the region from the rest.",
                                   .example = "\"fault1\"",
                                   .default_note = "no limit"}),
         field<&RegionDef::below>(
             {.name = "below", .effect = "Name of the fault it lies below.", .example = "\"fault1\"", .default_note = "no limit"}),
         field<&RegionDef::material>({.name = "material",
                                      .effect = "Name of the [material.NAME] of its blocks. Where regions overlap, the first one "
                                                "in the file with a material counts.",
                                      .default_note = "domain.material"}),
         field<&RegionDef::joint>({.name = "joint",
                                   .effect = "Name of the [joint.NAME] for contacts along the outline of the polygon.",
                                   .default_note = "by the materials of the two blocks"})},
        append<&CaseDef::regions>};
}
}  // namespace hdem
