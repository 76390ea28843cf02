#include "io/case_fields.h"
#include "io/case_sections.h"
#include "io/stage_end_text.h"

namespace hdem
{
using namespace fields;

SectionSpec convergence_section()
{
    return {
        "convergence",
        SectionKind::table,
        "convergence",
        "When a stage with `until = \"converged\"` ends.",
        {field<&ConvergenceDef::criteria>(
             {.name = "criteria",
              .effect = "All that are listed must hold. `every_block`: each block is slower than mean_speed and its unbalanced "
                        "force is below block_unbalanced_ratio, at all checks for hold_time. Without it, a few blocks that slide "
                        "or fly among many at rest are overlooked.",
              .choices = {"kinetic_energy", "unbalanced_force_ratio", "every_block"}}),
         field<&ConvergenceDef::blocks>(
             {.name = "blocks",
              .effect = "Which blocks must be at rest. `standing`: only blocks that have not moved farther than loose_distance in "
                        "their stage. The run may then end while loose blocks still fall, before they hit standing rock. If all "
                        "are loose, all count. Energy, limit and unbalanced force on the screen and in summary.json are those of "
                        "the same blocks.",
              .choices = {"all", "standing"}}),
         field<&ConvergenceDef::mean_speed>({.name = "mean_speed",
                                             .unit = "m/s",
                                             .effect = "`kinetic_energy` holds when the blocks that count have less kinetic energy "
                                                       "together than if all moved at this speed.",
                                             .range = {.low = 0, .high = 1e6, .low_included = false}}),
         field<&ConvergenceDef::unbalanced_force_ratio>({.name = "unbalanced_force_ratio",
                                                         .effect = "`unbalanced_force_ratio` holds below this.",
                                                         .range = {.low = 0, .high = 1, .low_included = false}}),
         field<&ConvergenceDef::block_unbalanced_ratio>(
             {.name = "block_unbalanced_ratio",
              .effect = "`every_block` holds when the net force on each block, with the net moment over its radius, is below this "
                        "share of its weight and loads. Blocks that are far below it are skipped until the forces on them change.",
              .range = {.low = 0, .high = 1, .low_included = false}}),
         field<&ConvergenceDef::hold_time>({.name = "hold_time",
                                            .unit = "s",
                                            .effect = "With `every_block`, all criteria must hold at every check for this long (10 "
                                                      "000 cycles are enough if no block moves). A block whose driving force is 1 "
                                                      "% above its strength becomes faster than mean_speed in this time.",
                                            .range = {.low = 0, .high = 1e6}}),
         field<&ConvergenceDef::least_cycles>(
             {.name = "least_cycles", .effect = "Cycles of a stage before the first test.", .range = count_or_none}),
         field<&ConvergenceDef::check_every>(
             {.name = "check_every", .effect = "Tested at multiples of this many cycles.", .range = count}),
         field<&ConvergenceDef::loose_distance>(
             {.name = "loose_distance",
              .unit = "m",
              .effect = "A block that moved farther than this in its stage is loose; other blocks are standing rock. In a stage "
                        "with `until = \"converged\"` under the default damping, standing rock keeps its springs, loose blocks may "
                        "meet by impulses, a loose block in flight takes longer steps, and one that creeps on in one direction is "
                        "not damped. While standing rock is slower than ten "
                        "times mean_speed, steps may be longer than a given time.step.",
              .range = length}),
         field<&ConvergenceDef::detached_distance>(
             {.name = "detached_distance",
              .unit = "m",
              .effect = "A block that moved farther in the last stage counts as detached (`detached_blocks` in summary.json). A "
                        "block that lies farther than this from its place at the start of the run, moved by earlier stages, is in "
                        "`detached_before`, unless it has settled with the rock around it.",
              .range = length}),
         field<&ConvergenceDef::lost_distance>(
             {.name = "lost_distance",
              .unit = "m",
              .effect = "In a stage with `until = \"converged\"` a block that is this far outside the initial model has left it. "
                        "It is fixed where it is, and named in the warnings of summary.json.",
              .range = length,
              .default_note = "ten times the greater of the model's width and height"})},
        part<&CaseDef::convergence>};
}

SectionSpec stage_section()
{
    KeySpec until = spec(
        {.name = "until",
         .effect = "One end or a list of ends; the first that is met ends the stage, after max_cycles at the latest. "
                   "`\"converged\"`: the criteria of [convergence] hold. Under the default damping the step is then as long as "
                   "blocks that move or are about to touch allow (if time.step is given: only while standing rock is slow). Blocks "
                   "at rest are skipped until the forces on them change. Others: [ends of a stage](#ends-of-a-stage).",
         .example = "[\"converged\", \"displacement:block1 > 0.1\"]",
         .default_note = "cycles or duration is given instead"},
        ValueType::text_or_texts);
    return {
        "stage",
        SectionKind::array,
        "stage",
        "What happens, one stage after another in the order of the file. At its start a stage first removes, then fixes, then "
        "frees blocks. It ends after `cycles`, after `duration`, or by `until`: give exactly one.",
        {field<&StageDef::name>(
             {.name = "name", .effect = "For the screen and the histories.", .default_note = "\"stage1\", \"stage2\", ..."}),
         field<&StageDef::cycles>({.name = "cycles",
                                   .effect = "Run this many cycles.",
                                   .example = "5000",
                                   .range = count,
                                   .default_note = "duration or until is given instead"}),
         field<&StageDef::duration>({.name = "duration",
                                     .unit = "s",
                                     .effect = "Run this long.",
                                     .example = "1.5",
                                     .range = {.low = 0, .high = 1e12, .low_included = false},
                                     .default_note = "cycles or until is given instead"}),
         with_assign(std::move(until),
                     [](void* object, const TomlNode& value, const KeySpec&)
                     {
                         auto& stage = *static_cast<StageDef*>(object);
                         const auto add = [&](const std::string& text)
                         {
                             if (text == "converged")
                                 stage.until_converged = true;
                             else
                                 stage.ends.push_back(read_stage_end(text).end);
                         };
                         if (value.text() != nullptr)
                             return add(*value.text());
                         for (const TomlNode& item : *value.items())
                             add(*item.text());
                     }),
         field<&StageDef::max_cycles>({.name = "max_cycles",
                                       .effect = "With until: give up after this many; the program then ends with exit code 4.",
                                       .range = count}),
         field<&StageDef::solver>(
             {.name = "solver",
              .effect = "With until: `\"static\"` first looks for equilibrium by Newton's iteration, without cycles. It needs at "
                        "least 200 free blocks, gravity and the default damping, and no loads, prescribed motions, bolts, liners, "
                        "domain.hold or impulse method. Blocks that cannot stand fall in the cycles that follow. If there is no "
                        "equilibrium, only cycles are used. A block on the verge of falling may count as stable. `\"dynamic\"`: "
                        "cycles only. `\"auto\"`: as `\"static\"` in a stage with relax_cycles in models of 1000 blocks or more "
                        "without "
                        "[[history]], where both give the same answer and the static solution comes sooner; else as `\"dynamic\"`.",
              .choices = {"static", "dynamic", "auto"}}),
         field<&StageDef::excavate>({.name = "excavate",
                                     .effect = "Names of excavations or blocks that are removed.",
                                     .example = "[\"tunnel\"]",
                                     .default_note = "none"}),
         field<&StageDef::relax_cycles>(
             {.name = "relax_cycles",
              .effect = "With excavate: the forces of the removed blocks on their neighbours decrease evenly to 0 over this many "
                        "cycles. 0: at once, as in a blast. Rock next to a sudden opening swings, and joints may slip or open that "
                        "stand in a slow excavation. A stage with until ends only after that. A static solution (solver) removes "
                        "them in "
                        "eight parts. Likewise for a [[boundary]] that ends. In the first stage of rock without [insitu], and in a "
                        "stage by springs after one by impulses, weight, loads, tractions, water and pretension grow from 0 over "
                        "this many cycles. Applied at once, they act up to 1.33 times, "
                        "and joints that break or slip by this do not recover.",
              .example = "2000",
              .range = {.low = 0, .high = 1e9}}),
         field<&StageDef::relax_to>(
             {.name = "relax_to",
              .effect = "Share of these forces that is left after relax_cycles and acts until the stage ends, as for rock that has "
                        "deformed before a support is installed. The next stage removes the rest over its own relax_cycles. No "
                        "static solution is tried with this key.",
              .example = "0.4",
              .range = {.low = 0, .high = 1, .high_included = false}}),
         field<&StageDef::fix>({.name = "fix",
                                .effect = "Names of blocks that are fixed where they are: all components, velocity 0.",
                                .default_note = "none"}),
         field<&StageDef::free>({.name = "free",
                                 .effect = "Names of blocks that are freed: all components. Their weight acts at once.",
                                 .default_note = "none"}),
         field<&StageDef::set>(
             {.name = "set",
              .effect = "New values from this stage on, each as \"joint.NAME.KEY = VALUE\" or \"material.NAME.density = VALUE\". "
                        "Where a stiffness changes, contacts keep their forces; where a density changes, blocks keep their "
                        "velocities. The law and the kind of normal spring do not change. Broken points stay broken.",
              .example = "[\"joint.default.friction_angle_deg = 25\"]",
              .default_note = "nothing changes"}),
         field<&StageDef::set_cycles>(
             {.name = "set_cycles",
              .effect = "With set: friction, cohesion and tension change evenly to their new values over this many cycles, in "
                        "steps of ten cycles. Tangents of friction angles change evenly (of patton those of φ + i "
                        "and φ_r); for barton_bandis and continuously_yielding the angles do. 0: at once. A stage with until ends "
                        "only after that. Other numbers "
                        "change at once: set them in a stage of their own. A slow change of stiffness would give the same forces, "
                        "because contacts keep theirs. For weight that grows slowly, use a [[load]] with an acceleration. New "
                        "roughness and dilation count for earlier slip too.",
              .example = "5000",
              .range = {.low = 0, .high = 1e9}}),
         field<&StageDef::set_table>({.name = "set_table",
                                      .effect = "Instead of set_cycles: rows [cycle, share], counted from the start of the stage. "
                                                "The share of the change is linear between rows and constant before the first. "
                                                "Shares are from 0 to 1, and the last one is 1.",
                                      .example = "[[0, 0.0], [1000, 0.6], [5000, 1.0]]",
                                      .range = {.low = 0, .high = 1e15},
                                      .default_note = "set_cycles"}),
         field<&StageDef::set_table_file>(
             {.name = "set_table_file",
              .effect = "A text file with such rows and the heading of files of loads: cycle,factor or time,factor.",
              .example = "\"weakening.csv\"",
              .default_note = "set_cycles"}),
         field<&StageDef::set_table_by>({.name = "set_table_by",
                                         .effect = "What the first column of `set_table` is. A file says it in its heading.",
                                         .choices = {"cycle", "time"}}),
         field<&StageDef::water_level>({.name = "water_level",
                                        .unit = "m",
                                        .effect = "water.level from here on. The change comes at once; with relax_cycles the water "
                                                  "forces change evenly over that many cycles.",
                                        .example = "4.0",
                                        .range = coordinate,
                                        .default_note = "unchanged"}),
         with_assign(spec({.name = "water_table",
                           .unit = "m",
                           .effect = "water.table from here on, likewise.",
                           .example = "[[0, 8], [60, 4]]",
                           .range = coordinate,
                           .default_note = "unchanged"},
                          ValueType::line),
                     assign_line<&StageDef::water_table>),
         field<&StageDef::method>({.name = "method",
                                   .effect = "contact.method from here on.",
                                   .choices = {"force", "impulse", "hybrid"},
                                   .default_note = "unchanged"}),
         field<&StageDef::damping>({.name = "damping",
                                    .effect = "damping.preset from here on.",
                                    .choices = {"default", "paper", "dynamic"},
                                    .default_note = "unchanged"})},
        append<&CaseDef::stages>};
}

SectionSpec history_section()
{
    std::vector<std::string> quantities = block_quantities();
    quantities.insert(quantities.end(), contact_quantities().begin(), contact_quantities().end());
    quantities.insert(quantities.end(), point_quantities().begin(), point_quantities().end());
    quantities.insert(quantities.end(), bolt_quantities().begin(), bolt_quantities().end());
    quantities.insert(quantities.end(), liner_quantities().begin(), liner_quantities().end());
    return {
        "history",
        SectionKind::array,
        "history",
        "Quantities of one block (`block`), of the contacts between two (`between`), of a bolt (`bolt`), of a liner "
        "(`liner`) or at a place (`point`), sampled into "
        "results.h5.",
        {field<&HistoryDef::name>(
             {.name = "name", .effect = "Of the group in results.h5.", .default_note = "\"history1\", \"history2\", ..."}),
         field<&HistoryDef::block>({.name = "block",
                                    .effect = "Name of the block.",
                                    .example = "\"block1\"",
                                    .default_note = "between or point is given instead"}),
         field<&HistoryDef::between>({.name = "between",
                                      .effect = "Names of the two blocks; forces act on the second.",
                                      .example = "[\"ground\", \"block1\"]",
                                      .default_note = "block is given instead"}),
         field<&HistoryDef::bolt>({.name = "bolt",
                                   .effect = "Name of the bolt; those of a pattern are called NAME.1, NAME.2, ...",
                                   .example = "\"roof.3\"",
                                   .default_note = "block or between is given instead"}),
         field<&HistoryDef::liner>({.name = "liner",
                                    .effect = "Name of the liner.",
                                    .example = "\"shotcrete\"",
                                    .default_note = "block, between or bolt is given instead"}),
         field<&HistoryDef::point>({.name = "point",
                                    .unit = "m",
                                    .effect = "A place that does not move with the rock.",
                                    .example = "[10.0, 4.0]",
                                    .range = coordinate,
                                    .default_note = "block or between is given instead"}),
         field<&HistoryDef::quantities>(
             {.name = "quantities",
              .effect = "Quantities to sample. Those up to `kinetic_energy` belong to `block`, those from `normal_force` on to "
                        "`between`, `pore_pressure` (of the water in joints, from table, field or cracks) to `point`. Those from "
                        "`axial_force` on belong to `bolt`: forces of one bolt, and its status (1 elastic, 2 slips, 3 yielded, 4 "
                        "ruptured, 5 lost). Those from `thrust` on belong to `liner`: greatest values in it; number of nodes with "
                        "a hinge; length that has come off the rock. A vector such as `velocity` becomes two columns. "
                        "`plastic_slip`, `opening`, `damage` and `broken` are means by length over closed and open contacts; 0 for "
                        "joints without memory. Contacts that formed after the start count as broken while they are closed.",
              .example = "[\"velocity\"]",
              .choices = std::move(quantities),
              .required = true}),
         field<&HistoryDef::every>({.name = "every", .effect = "Cycles between samples.", .range = count})},
        append<&CaseDef::histories>};
}

SectionSpec output_section()
{
    return {
        "output",
        SectionKind::table,
        "output",
        "",
        {field<&OutputDef::row_every>(
             {.name = "row_every",
              .effect = "Cycles between rows on the screen and in run.log, and between samples of the energies.",
              .range = count}),
         field<&OutputDef::frame_every>({.name = "frame_every",
                                         .effect = "Cycles between frames for ParaView; 0: one at the end of each stage. With more "
                                                   "than 1000 stages, only if 1000 cycles have passed since the last frame.",
                                         .range = count_or_none}),
         field<&OutputDef::contacts>({.name = "contacts", .effect = "Write contact frames as well."}),
         field<&OutputDef::checkpoint_every>(
             {.name = "checkpoint_every",
              .effect = "Cycles between checkpoints, from which `hdem run --restart` goes on; 0: by wall time only.",
              .range = count_or_none}),
         field<&OutputDef::checkpoint_wall_minutes>(
             {.name = "checkpoint_wall_minutes",
              .unit = "min",
              .effect = "Wall-clock time between checkpoints; 0: by cycles only. A checkpoint is always written at the end and "
                        "when the run is interrupted.",
              .range = {.low = 0, .high = 1e6}})},
        part<&CaseDef::output>};
}
}  // namespace hdem
