#include "io/case_fields.h"
#include "io/case_schema_factor.h"
#include "io/case_sections.h"

namespace hdem
{
using namespace fields;

namespace
{
void assign_threshold_scale(void* object, const TomlNode& value, const KeySpec&)
{
    auto& scale = static_cast<ContactDef*>(object)->threshold_scale;
    scale.reset();
    if (value.is_number())
        scale = value.number();
}
}  // namespace

SectionSpec material_section()
{
    return {"material",
            SectionKind::named,
            "material",
            "The rock of blocks that name it. `rock` is the name that domain and blocks use when they give none. At most 4096.",
            {field<&MaterialDef::density>({.name = "density",
                                           .unit = "kg/m3",
                                           .effect = "Mass of a block = density × area × 1 m.",
                                           .example = "2700.0",
                                           .range = {.low = 0, .high = 1e9, .low_included = false},
                                           .required = true})},
            append<&CaseDef::materials>};
}

SectionSpec gravity_section()
{
    return {"gravity",
            SectionKind::table,
            "gravity",
            "Acts on every free block.",
            {field<&CaseDef::gravity>({.name = "vector",
                                       .unit = "m/s2",
                                       .effect = "Acceleration [x, y]; y points up. Tilt it to tilt the model.",
                                       .range = {.low = -1e6, .high = 1e6}}),
             field<&CaseDef::gravity_tilt_deg>(
                 {.name = "tilt_deg",
                  .unit = "deg",
                  .effect = "The model is tilted by this angle, anticlockwise: `vector` is turned clockwise by it. `hdem critical` "
                            "can vary this one number. A water.level stays at right angles to gravity; the points of a water.table "
                            "stay where they are drawn.",
                  .range = {.low = -180, .high = 180}})},
            whole_case};
}

SectionSpec load_section()
{
    const auto cycle = Range{.low = 0, .high = 1e15};
    const auto time = Range{.low = 0, .high = 1e12};
    SectionSpec section = {
        "load",
        SectionKind::array,
        "load",
        "Acts on named blocks, from one moment until another. Several loads on a block add up. If several prescribe the same "
        "velocity component, the last in the file counts.",
        {field<&LoadDef::name>(
             {.name = "name",
              .effect = "For messages, and for `--set load.NAME.force` or `hdem critical --vary load.NAME.force`.",
              .default_note = "\"load1\", \"load2\", ..."}),
         field<&LoadDef::blocks>({.name = "blocks",
                                  .effect = "Names of blocks; \"*\" = all blocks that are free when the load acts.",
                                  .example = "[\"block1\"]",
                                  .required = true}),
         field<&LoadDef::acceleration>({.name = "acceleration",
                                        .unit = "m/s2",
                                        .effect = "Body acceleration, added to gravity.",
                                        .range = {.low = -1e6, .high = 1e6}}),
         field<&LoadDef::force>(
             {.name = "force", .unit = "N", .effect = "At the centroid or at `point`, per metre of thickness.", .range = any_size}),
         field<&LoadDef::point>({.name = "point",
                                 .unit = "m",
                                 .effect = "Where `force` acts: a point of the block as drawn, which moves and turns with it.",
                                 .example = "[0.5, 1.0]",
                                 .range = coordinate,
                                 .default_note = "the centroid"}),
         field<&LoadDef::moment>(
             {.name = "moment", .unit = "N m", .effect = "Positive anticlockwise, per metre of thickness.", .range = any_size}),
         field<&LoadDef::velocity_x>({.name = "velocity_x",
                                      .unit = "m/s",
                                      .effect = "Prescribed; the block's x must be fixed. 0 once the load has ended.",
                                      .range = speed,
                                      .default_note = "not prescribed"}),
         field<&LoadDef::velocity_y>({.name = "velocity_y",
                                      .unit = "m/s",
                                      .effect = "Prescribed; the block's y must be fixed. 0 once the load has ended.",
                                      .range = speed,
                                      .default_note = "not prescribed"}),
         field<&LoadDef::angular_velocity>({.name = "angular_velocity",
                                            .unit = "rad/s",
                                            .effect = "Prescribed; the block's rotation must be fixed. 0 once the load has ended.",
                                            .range = speed,
                                            .default_note = "not prescribed"}),
         inner_field<&LoadDef::interval, &Interval::from_cycle>(
             {.name = "from_cycle",
              .effect = "Acts once this many cycles are done, counted from `since`.",
              .range = cycle,
              .default_note = "from the start"}),
         inner_field<&LoadDef::interval, &Interval::until_cycle>({.name = "until_cycle",
                                                                  .effect = "Acts no more once this many cycles are done.",
                                                                  .range = cycle,
                                                                  .default_note = "to the end"}),
         inner_field<&LoadDef::interval, &Interval::from_time>({.name = "from_time",
                                                                .unit = "s",
                                                                .effect = "Instead of from_cycle.",
                                                                .range = time,
                                                                .default_note = "from the start"}),
         inner_field<&LoadDef::interval, &Interval::until_time>({.name = "until_time",
                                                                 .unit = "s",
                                                                 .effect = "Instead of until_cycle.",
                                                                 .range = time,
                                                                 .default_note = "to the end"})},
        append<&CaseDef::loads>};
    add_factor_keys<&LoadDef::factor>(section.keys);
    return section;
}

SectionSpec contact_section()
{
    KeySpec scale = spec(
        {.name = "threshold_scale",
         .effect = "C_scale of Eq. (25): a contact faster than C_scale × (gravity's and the springs' velocity) is "
                   "impulse-based. `\"model\"`: Eq. (28), area of the smallest rectangle around the model / mean block area.",
         .range = positive,
         .choices = {"model"}},
        ValueType::number_or_text);
    return {
        "contact",
        SectionKind::table,
        "contact",
        "How contacts are found and treated.",
        {field<&ContactDef::method>({.name = "method",
                                     .effect = "`force`: springs at every contact; `impulse`: momentum exchange at every contact; "
                                               "`hybrid`: chosen for each contact point in each cycle.",
                                     .choices = {"force", "impulse", "hybrid"}}),
         field<&ContactDef::restitution>(
             {.name = "restitution",
              .effect = "R of Eq. (15), rebound speed / impact speed of impulse contacts. It is reduced in impacts that would give "
                        "energy, by friction or in several points at once (not under the preset paper).",
              .range = share}),
         with_assign(std::move(scale), assign_threshold_scale, "\"model\""),
         field<&ContactDef::threshold_velocity>({.name = "threshold_velocity",
                                                 .unit = "m/s",
                                                 .effect = "The threshold itself, instead of Eq. (25).",
                                                 .range = non_negative,
                                                 .default_note = "Eq. (25)"}),
         field<&ContactDef::fixed_mass_counts>({.name = "fixed_mass_counts",
                                                .effect = "`true`: a fixed block enters the collision mass of Eqs. (16), (27) with "
                                                          "its own mass, not with infinite mass."}),
         field<&ContactDef::impulse_sweeps>(
             {.name = "impulse_sweeps",
              .effect = "Passes over the impulse contacts in a cycle. More passes distribute impacts better among many contacts of "
                        "one block, and cost more. Where blocks hit each other, groups of up to 200 points get up to ten times as "
                        "many, but not under preset = \"paper\".",
              .range = {.low = 1, .high = 10000}}),
         field<&ContactDef::correction_fraction>(
             {.name = "correction_fraction",
              .effect = "Share of the overlap that impulse contacts remove in each cycle, Eq. (19).",
              .range = share}),
         field<&ContactDef::allowed_overlap>(
             {.name = "allowed_overlap",
              .unit = "m",
              .effect = "Overlap that this correction leaves, so that resting contacts stay closed.",
              .range = {.low = 0, .high = 1e3}}),
         field<&ContactDef::correction_rate>(
             {.name = "correction_rate",
              .unit = "1/s",
              .effect = "The most that this correction removes per second, beyond the approach of each cycle, as a share of the "
                        "smaller block's size. A higher rate presses blocks into springs on their other side, which adds energy.",
              .range = {.low = 0, .high = 1e12}}),
         field<&ContactDef::length_floor>({.name = "length_floor",
                                           .effect = "Least contact length as a share of the smaller block's size (the square root "
                                                     "of its area); it lets corner-on-corner contacts bear. Edges that lie over "
                                                     "each other by less than a fifth of it bear "
                                                     "nothing, so that blocks slide over the ends of joints.",
                                           .range = {.low = 0, .high = 1, .low_included = false}}),
         field<&ContactDef::overlap_limit>(
             {.name = "overlap_limit",
              .effect = "The run stops when an overlap exceeds this share of the smaller block's size.",
              .range = {.low = 0, .high = 1, .low_included = false}}),
         field<&ContactDef::recycling_distance>(
             {.name = "recycling_distance",
              .effect = "Touching edges and corners are searched anew once two blocks have moved by this share of the smaller "
                        "block's size relative to each other. Until then overlaps follow from the stored edges and corners. 0: in "
                        "every cycle.",
              .range = share}),
         field<&ContactDef::skin>({.name = "skin",
                                   .effect = "Pairs closer than this share of the mean block size are tracked. Larger: fewer "
                                             "searches, more pairs. The result does not depend on it, but for joints that open "
                                             "with water.ponded = false: "
                                             "water presses on their faces until they are farther apart than this.",
                                   .range = {.low = 0, .high = 10, .low_included = false}})},
        part<&CaseDef::contact>};
}

SectionSpec damping_section()
{
    return {
        "damping",
        SectionKind::table,
        "damping",
        "",
        {field<&DampingDef::preset>(
             {.name = "preset",
              .effect = "`default`: local damping while force contacts hold a block, none once it slides, tips or flies, so that "
                        "it moves at the right acceleration; `paper`: exactly the published scheme (sect. 3.3), including springs "
                        "that close and open late; `dynamic`: no local damping, exact motion.",
              .choices = {"default", "paper", "dynamic"}}),
         field<&DampingDef::local>(
             {.name = "local",
              .effect = "α of Eqs. (13), (14): share of a block's unbalanced force that opposes its motion. Not used by `dynamic`.",
              .range = {.low = 0, .high = 1, .high_included = false}}),
         field<&DampingDef::global_damping_ratio>({.name = "global_damping_ratio",
                                                   .effect = "ξ_g of Eq. (22): blocks with an impulse contact lose the share 2 ξ_g "
                                                             "ω_avg Δt of their velocity in a cycle, at most all of it.",
                                                   .range = {.low = 0, .high = 1e6}}),
         field<&DampingDef::average_frequency>(
             {.name = "average_frequency", .unit = "rad/s", .effect = "ω_avg of Eq. (22).", .range = {.low = 0, .high = 1e9}})},
        part<&CaseDef::damping>};
}

SectionSpec time_section()
{
    return {"time",
            SectionKind::table,
            "time",
            "",
            {field<&TimeDef::step>(
                 {.name = "step",
                  .unit = "s",
                  .effect = "Time step Δt. If it exceeds the stable limit 2/ω_max of the springs, the run is refused, or stops "
                            "once these springs act. If it is not given, stages with `until = \"converged\"` under the default "
                            "damping use longer steps: stable_fraction of the largest stable step of the present contacts, at most "
                            "4096 times the default, unless loads still change or motions are prescribed.",
                  .example = "5e-5",
                  .range = {.low = 0, .high = 1e6, .low_included = false},
                  .default_note = "Eq. (32): fraction × 2 √(smallest mass / (2 × largest stiffness)); a block with a side L above "
                                  "4 m counts with 4 m / L of its mass (not under `preset = \"paper\"`). If this is above the "
                                  "stable limit of the first contacts: half that limit"}),
             field<&TimeDef::fraction>({.name = "fraction",
                                        .effect = "FRAC of Eq. (32), when step is not given.",
                                        .range = {.low = 0, .high = 1, .low_included = false}}),
             field<&TimeDef::stable_fraction>(
                 {.name = "stable_fraction",
                  .effect = "Share of the largest stable step, 2/ω_max of the present contacts, that stages with `until = "
                            "\"converged\"` take where step is not given. Smaller: more cycles, more room for contacts that grow.",
                  .range = {.low = 0, .high = 1, .low_included = false}})},
            part<&CaseDef::time>};
}
}  // namespace hdem
