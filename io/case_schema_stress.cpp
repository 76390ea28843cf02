#include "io/case_fields.h"
#include "io/case_sections.h"

namespace hdem
{
using namespace fields;

SectionSpec insitu_section()
{
    return {
        "insitu",
        SectionKind::table,
        "insitu",
        "Stress that the rock carries before the first cycle. It is locked into the joints: no block is moved. Give `stress` (and "
        "its `gradient`), or the `surface` of the ground and the `ratio` of horizontal to vertical stress. The numbers of `stress` "
        "and `gradient` are tension positive. If the stress field is in equilibrium, so is each block, also at fixed sides and at "
        "a ground without load. `hdem check` prints how far blocks are out of equilibrium, and which joints bear more than their "
        "strength: these slip in the first cycle.",
        {field<&InsituDef::stress>({.name = "stress",
                                    .unit = "Pa",
                                    .effect = "[σ_xx, σ_yy, σ_xy] at y = `reference`; compression is negative.",
                                    .example = "[-8e6, -5e6, 1e6]",
                                    .range = any_size,
                                    .default_note = "given by surface"}),
         field<&InsituDef::gradient>({.name = "gradient",
                                      .unit = "Pa/m",
                                      .effect = "Change of the three per metre upwards. With gravity, that of σ_yy is ρ g.",
                                      .range = any_size}),
         field<&InsituDef::reference>(
             {.name = "reference", .unit = "m", .effect = "Height y at which `stress` holds.", .range = coordinate}),
         field<&InsituDef::surface>({.name = "surface",
                                     .unit = "m",
                                     .effect = "Height y of the ground: σ_yy = ρ g (y - surface), with the density of the domain's "
                                               "material, or of the first block where there is no domain; no stress above it.",
                                     .example = "120.0",
                                     .range = coordinate,
                                     .default_note = "given by stress"}),
         field<&InsituDef::ratio>({.name = "ratio",
                                   .effect = "K0, horizontal over vertical stress. Belongs to `surface`.",
                                   .example = "1.5",
                                   .range = {.low = 0, .high = 100},
                                   .default_note = "must be given with surface"}),
         field<&InsituDef::ratio_offset>({.name = "ratio_offset",
                                          .unit = "Pa",
                                          .effect = "Added to the horizontal compression. Belongs to `surface`.",
                                          .range = any_size})},
        [](CaseDef& def, const std::string&) -> void*
        {
            def.insitu.given = true;
            return &def.insitu;
        }};
}
}  // namespace hdem
