#include "io/case_fields.h"
#include "io/case_sections.h"
#include "io/distribution_key.h"

namespace hdem
{
using namespace fields;

namespace
{
/// A plain number stays a plain number: only a table makes a distribution.
template <auto Mean, auto Law>
void assign_law(void* object, const TomlNode& value, const KeySpec& key)
{
    auto& set = *static_cast<JointSetDef*>(object);
    const DistributionDef read = read_distribution(value, key);
    set.*Mean = read.mean;
    set.*Law = read.is_random() ? read : DistributionDef{};
}

template <auto Member>
void assign_distribution(void* object, const TomlNode& value, const KeySpec& key)
{
    static_cast<JointSetDef*>(object)->*Member = read_distribution(value, key);
}

void assign_orientation(void* object, const TomlNode& value, const KeySpec&)
{
    static_cast<JointSetDef*>(object)->orientation = read_orientation(value);
}

KeySpec distribution(Say say)
{
    return spec(std::move(say), ValueType::distribution);
}

const std::vector<std::string> length_laws = {"uniform", "normal", "exponential", "lognormal"};
}  // namespace

SectionSpec joint_set_section()
{
    return {
        "joint_set",
        SectionKind::array,
        "joint set",
        "Parallel joints that cut the domain into blocks: through-going ones at a spacing, or with `trace` joints of finite "
        "length. Dip, "
        "spacing, trace and gap are numbers or distributions (below).",
        {field<&JointSetDef::name>({.name = "name",
                                    .effect = "For messages, pictures and `--set`.",
                                    .default_note = "\"set1\", \"set2\", ... in the order of the file"}),
         with_assign(distribution({.name = "dip_deg",
                                   .unit = "deg",
                                   .effect = "Inclination of the trace to the x axis, positive anticlockwise. For through-going "
                                             "joints it deviates by less than 45° from the mean.",
                                   .example = "-30.0",
                                   .range = {.low = -180, .high = 180},
                                   .choices = {"uniform", "normal", "von_mises"},
                                   .default_note = "must be given, or orientation"}),
                     assign_law<&JointSetDef::dip_deg, &JointSetDef::dip_law>),
         with_assign(spec({.name = "orientation",
                           .unit = "deg",
                           .effect = "Instead of dip_deg: dip below the horizontal, dip_direction and section as azimuths from "
                                     "north, clockwise; section is the azimuth of +x. `spacing` is then the true distance of the "
                                     "planes in space, and `hdem check` prints what it is in the section.",
                           .example = "{dip = 60.0, dip_direction = 130.0, section = 90.0}",
                           .default_note = "dip_deg"},
                          ValueType::orientation),
                     assign_orientation),
         with_assign(
             distribution({.name = "spacing",
                           .unit = "m",
                           .effect = "Distance between neighbouring joints, measured across them. For a distribution, `least` is a "
                                     "fifth of the mean unless given, because thin slivers reduce the time step.",
                           .example = "2.0",
                           .range = length,
                           .choices = length_laws,
                           .default_note = "must be given, or p21"}),
             assign_law<&JointSetDef::spacing, &JointSetDef::spacing_law>),
         with_assign(distribution({.name = "trace",
                                   .unit = "m",
                                   .effect = "Length of each joint, which then ends in the rock. Needs `gap` or `p21`. Each joint "
                                             "turns about its own middle, so its dip may deviate by any angle.",
                                   .example = "6.0",
                                   .range = length,
                                   .choices = length_laws,
                                   .default_note = "joints are through-going"}),
                     assign_distribution<&JointSetDef::trace>),
         with_assign(distribution({.name = "gap",
                                   .unit = "m",
                                   .effect = "Rock bridge between joints that follow each other on a line.",
                                   .example = "2.0",
                                   .range = non_negative,
                                   .choices = length_laws,
                                   .default_note = "must be given with trace, or p21"}),
                     assign_distribution<&JointSetDef::gap>),
         field<&JointSetDef::p21>({.name = "p21",
                                   .unit = "m/m2",
                                   .effect = "Length of traces per area, instead of spacing and gap. The middles of traces then "
                                             "lie anywhere, independent of each other.",
                                   .example = "1.2",
                                   .range = positive,
                                   .default_note = "by spacing and gap"}),
         field<&JointSetDef::deviation_deg>({.name = "deviation_deg",
                                             .unit = "deg",
                                             .effect = "The dip of each joint is drawn uniformly from dip_deg ± this.",
                                             .range = {.low = 0, .high = 45}}),
         field<&JointSetDef::persistence>({.name = "persistence",
                                           .effect = "Chance that a block in the path of a joint is cut by it; 1 = every joint "
                                                     "runs through. Not with `trace` or `stops_at`.",
                                           .range = {.low = 0, .high = 1, .low_included = false}}),
         field<&JointSetDef::origin>({.name = "origin",
                                      .unit = "m",
                                      .effect = "One joint of the set passes through this point (without its deviation).",
                                      .range = coordinate,
                                      .default_note = "centre of the domain"}),
         field<&JointSetDef::seed>({.name = "seed",
                                    .effect = "Seed of this set's random numbers, to vary one set and keep the others.",
                                    .range = {.low = 0},
                                    .default_note = "from generator.seed and the set's number"}),
         field<&JointSetDef::joint>({.name = "joint",
                                     .effect = "Name of the [joint.NAME] for contacts on faces that this set cut.",
                                     .default_note = "by the materials of the two blocks"}),
         field<&JointSetDef::region>({.name = "region",
                                      .effect = "Name of the [[region]] whose blocks this set cuts. The lines of the set are the "
                                                "same with and without this key.",
                                      .example = "\"hanging_wall\"",
                                      .default_note = "the whole domain"}),
         field<&JointSetDef::outside>({.name = "outside",
                                       .effect = "Name of a [[region]] whose blocks this set does not cut.",
                                       .example = "\"weak\"",
                                       .default_note = "the whole domain"}),
         field<&JointSetDef::stops_at>(
             {.name = "stops_at",
              .effect = "Names of the [[fault]]s at which joints of this set end. The part with the joint's middle stays. Without "
                        "`trace` the middle is where the joint crosses the line through `origin` at right angles to the set.",
              .example = "[\"fault1\"]",
              .default_note = "joints go on beyond faults"})},
        append<&CaseDef::joint_sets>};
}

SectionSpec voronoi_section()
{
    return {"voronoi",
            SectionKind::table,
            "voronoi",
            "Cells around random points that fill the domain, or a region: rock without sets of joints.",
            {field<&VoronoiDef::edge>({.name = "edge",
                                       .unit = "m",
                                       .effect = "Mean length of the cells' edges.",
                                       .example = "1.5",
                                       .range = length,
                                       .required = true}),
             field<&VoronoiDef::iterations>(
                 {.name = "iterations",
                  .effect = "Times that every point moves to the centroid of its cell (Lloyd). 0 gives cells of "
                            "very different size; after 5 they are alike.",
                  .range = {.low = 0, .high = 100}}),
             field<&VoronoiDef::region>({.name = "region",
                                         .effect = "Name of the [[region]] that is filled.",
                                         .example = "\"weak\"",
                                         .default_note = "the whole domain"}),
             field<&VoronoiDef::joint>({.name = "joint",
                                        .effect = "Name of the [joint.NAME] for contacts between cells.",
                                        .default_note = "by the materials of the two blocks"}),
             field<&VoronoiDef::seed>(
                 {.name = "seed", .effect = "Seed of the points.", .range = {.low = 0}, .default_note = "from generator.seed"})},
            [](CaseDef& def, const std::string&) -> void*
            {
                def.voronoi.given = true;
                return &def.voronoi;
            }};
}
}  // namespace hdem
