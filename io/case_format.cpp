#include "io/case_format.h"

#include "io/case_problems.h"
#include "io/case_schema.h"
#include "io/stage_end_text.h"

#include <fmt/format.h>

namespace hdem
{
namespace
{
constexpr std::string_view example = R"toml(schema = 1
title = "Small tunnel in jointed rock"

[domain]                  # 16 m x 14 m of rock, held at three sides
width = 16.0
height = 14.0
fixed = ["left", "right", "bottom"]

[[joint_set]]
name = "bedding"
dip_deg = -10.0
spacing = 2.0

[[joint_set]]
name = "cross"
dip_deg = 75.0
spacing = 2.5
deviation_deg = 2.0

[generator]
seed = 7
smallest_block_area = 0.3

[[excavation]]
name = "tunnel"
shape = "horseshoe"
position = [8.0, 4.0]     # middle of the floor
width = 4.0
height = 4.0
inside = "one_block"

[material.rock]
density = 2700.0

[joint.default]
normal_stiffness = 7e9
shear_stiffness = 5e8
friction_angle_deg = 35.0
cohesion = 1e4

[[stage]]
name = "initial"          # stresses build up around the rock that is still there
cycles = 2000

[[stage]]
name = "excavated"
excavate = ["tunnel"]
until = "converged"
max_cycles = 100000
)toml";

constexpr std::string_view introduction = R"md(# The case file

<!-- Written by `hdem schema --markdown` from the table in io/case_schema*.cpp. Change the table, not this page. -->

A case file says everything a run needs: the rock, its joints, the loads, the stages, the output. It is [TOML](https://toml.io):
`key = value` lines below headers in brackets, comments behind `#`.

- **SI units** without exception, so values carry no unit. Angles are in degrees where the key ends in `_deg`. All forces, masses and
  stiffnesses are per metre out of plane.
- Headers in single brackets, `[domain]`, occur once. Headers in double brackets, `[[joint_set]]`, occur as often as there are such
  things. In `[joint.NAME]` and `[material.NAME]` you choose the name: letters, digits, `_` and `-`.
- A point or vector is `[x, y]`, a polygon `[[x, y], [x, y], [x, y], ...]` of 3 to 25 000 vertices. Where a number is expected, `2` is as good as `2.0`;
  where a whole number is expected, `1e6` is as good as `1000000`.
- Unknown keys, wrong types and values out of range are refused, all at once, each with file, line and column.
  `hdem check CASE.toml` does only this.
- `hdem run CASE.toml --set joint.default.friction_angle_deg=20` replaces or adds one value. Entries of lists count from 0,
  `--set stage[1].max_cycles=1000`, or go by name, `--set joint_set.bedding.dip_deg=15`. A bare word is taken as text: `--set contact.method=force`.
- `hdem schema` prints the JSON Schema for editors.

## A complete example

```toml
)md";

constexpr std::string_view semantics = R"md(## What the words mean

**Axes and signs.** x points right, y up. Angles, rotations and moments are positive anticlockwise. A positive normal force is compression.

**Dip.** `dip_deg` is the angle from the x axis to the joint's trace, positive anticlockwise: 30 rises to the right, -30 falls to the
right, 90 is vertical. 30 and -150 are the same joint.

**Which joint acts at a contact.** When the touching face was cut by a fault, an outline of a region, a joint set or a trace that names
a `joint`, that one (in this order, where the two faces differ); else the [joint.NAME] whose `materials` are the two blocks' materials,
in either order; else [joint.default].

**Fixed.** A fixed component (x, y or rotation) of a block is never changed by forces: it keeps the velocity it starts with, 0 unless `velocity`
or a load prescribes another. A block with all three fixed and no velocity is a support. `domain.fixed` fixes all three of each block
that has an edge on the named side. A stage can fix and free blocks later.

**Names.** Blocks, excavations, joint sets, stages and histories have names. Blocks and excavations share one set of names, because a stage can
remove either. Blocks that are cut from the domain get names when they are made; `hdem check` and the block frames show them.
In a load, `"*"` stands for all blocks that are free at that moment; it can stand beside names.

**Order of stages.** Stages run in the order of the file. At its start a stage first sets numbers of joints and materials (`set`), ends and begins what acts on the sides ([[boundary]]),
then removes what `excavate` names, then fixes, then frees.
Contacts keep their forces from stage to stage. Cycles and seconds count on from the start of the run, also for loads.

**When a load acts.** With `from_cycle = 5000` a load is there from the 5001st cycle on: when 5000 cycles are done. Likewise
`until_cycle = 6000` makes the 6000th its last. Times are compared with the time at the start of the cycle.

**Loads that grow and fall.** What a [[load]] or a [[boundary]] of kind `stress`, `velocity` or `servo` gives is multiplied with a factor, if one is
given: by `ramp_cycles = [from, until]` it grows from 0 to 1; by `table = [[cycle, factor], ...]`, or by the same in a file, it follows straight lines
between the rows. With `since = "NAME"` cycles and times are counted from the start of that stage, and a load does not act before it.

```toml
[[boundary]]
side = "top"
kind = "stress"
stress = [5e6, 0]
ramp_cycles = [0, 4000]         # pressed slowly, so that nothing swings

[[load]]
blocks = ["base"]
velocity_x = 0.1                # the greatest; the block's x is fixed
table_file = "shaking.csv"
since = "earthquake"            # the name of a [[stage]]
```

A file begins with the heading `cycle,factor` or `time,factor`. Then comes a row of two numbers for each cycle or time, ascending. Lines that begin with
`#` are skipped.

```
time,factor
0.00,0.0
0.02,0.35
0.04,-0.10
```

A stage with `until` does not end while a factor changes in it. Until then no block is left out, and all steps are the same. From then on the stage
goes on as if the load had always been there. While times in seconds are still to come, steps stay the same in earlier stages too.

**Random numbers.** Deviations and persistence are the only random things, and follow from `generator.seed` alone.

## Faults and regions

Rock with other joints on each side of a fault:

```toml
[[fault]]
name = "main"
points = [[-1, 4], [12, 9], [31, 11]]   # begins and ends outside the domain
joint = "fault"

[[region]]
name = "hanging_wall"
above = "main"

[[joint_set]]                           # above the fault only
dip_deg = 60.0
spacing = 1.5
region = "hanging_wall"

[[joint_set]]                           # below it only
dip_deg = -20.0
spacing = 2.0
outside = "hanging_wall"
```

A zone of another rock, with its own joint properties:

```toml
[[region]]
name = "weak"
polygon = [[10, 0], [20, 0], [20, 8], [10, 8]]
material = "shale"
joint = "contact"                       # along the outline

[joint.in_shale]                        # at joints of sets that name no joint, inside the zone
materials = ["shale", "shale"]
```

A set that names a `joint` takes it everywhere. To give one set two joints, write it twice, once with `region = "weak"` and once with
`outside = "weak"`, each with its own `joint`. Give both the same `origin` and `seed`: then they are the same lines.

**Above and below.** Above is the left side of a fault that is walked from its lower x to its higher x. The fault goes on straight at its ends. A fault
that ends at another one parts the rock only up to there: give such a region both faults, or a polygon. A fault that ends straight above
its beginning has no upper side: a polygon along it cuts no second joint there.

**Dead ends.** A fault that ends inside the domain, and not at another line, parts nothing beyond the last line it meets: that piece is left out, with a
warning that gives its length. Joint sets come later, and do not hold it.

**In-situ stress** of [insitu] by `surface` takes the density of domain.material; `hdem check` tells how far a region of another density is out of
equilibrium.

## The blocks file

`blocks_file` names a text file with one polygon a line in WKT. Empty lines and lines that start with `#` are skipped. Behind the polygon may stand
its name, its material, and what is fixed, each behind a semicolon and each possibly empty:

```
# ground and two blocks
POLYGON((0 0, 4 0, 4 1, 0 1, 0 0)); ground; rock; fixed
POLYGON((1 1, 2 1, 2 2, 1 2, 1 1))
POLYGON((2 1, 3 1, 3 2, 2 2, 2 1)); upper; ; rotation
```

The first vertex is repeated at the end. Blocks without a name are called `block1`, `block2`, ... counted on from those of [[block]].
Holes, MULTIPOLYGON, Z and M are refused.

A file whose name ends in `.csv` has a row a vertex instead: `name,x,y` and, in a block's first row, `material,fixed`. Rows of one block follow each
other; a heading may stand above them. `tools/import_dxf.py` makes such files from drawings.

## The traces file

`domain.traces_file` names a text file of joint traces that need not run through: one WKT line a row, or a `.csv` with rows of `name,x,y`.

```
# a joint, and one that bends
LINESTRING(0 2, 8 5.5)
LINESTRING(3 0, 4 3, 6 9)
```

The traces cut the domain into blocks where they close around an area together, or with the domain's boundary. What parts nothing, because it ends
inside a block or only joins two rings of traces, is dropped, and counted in `hdem check` and in run.log. Excavations and joint sets cut further. Traces are cut whatever `smallest_block_area`
says: a cell smaller than it stays, with a warning.
)md";

std::string escaped(std::string text)
{
    for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2)
        text.insert(i, 1, '\\');
    return text;
}

std::string code(const std::string& text)
{
    return '`' + text + '`';
}

std::string type_column(const KeySpec& key)
{
    switch (key.type)
    {
    case ValueType::boolean:
        return "true, false";
    case ValueType::integer:
        return "whole number";
    case ValueType::number:
        return "number";
    case ValueType::text:
        return "text";
    case ValueType::text_list:
        return "list of texts";
    case ValueType::integer_list:
        return "list of whole numbers";
    case ValueType::number_list:
        return "list of numbers";
    case ValueType::vector:
        return "[x, y]";
    case ValueType::stress:
        return "[xx, yy, xy]";
    case ValueType::polygon:
    case ValueType::line:
        return "list of [x, y]";
    case ValueType::text_or_texts:
        return "text or list of texts";
    case ValueType::boolean_or_texts:
        return "true, false or list";
    case ValueType::number_or_text:
        return "number or text";
    case ValueType::pair_or_text:
        return "two numbers or text";
    }
    return "";
}

std::string range_column(const KeySpec& key)
{
    constexpr double shown = 2e4;  // farther limits only keep arithmetic finite
    std::string text = key.range.describe(shown);
    for (const std::string& choice : key.choices)
        text += (text.empty() ? "" : ", ") + code('"' + choice + '"');
    if (!key.ending.empty())
        text += ", a file " + code("\"*" + key.ending + "\"");
    return text;
}

std::string default_column(const KeySpec& key)
{
    if (key.required)
        return "**required**";
    if (!key.default_json.empty())
        return code(key.default_json);
    return key.default_note.empty() ? "none" : key.default_note;
}

std::string section_page(const SectionSpec& section)
{
    const std::string heading = section.kind == SectionKind::top ? "Top of the file" : section.heading();
    std::string page = fmt::format("### {}\n\n{}{}", heading, section.about, section.about.empty() ? "" : "\n\n");
    page += "| Key | Type | Unit | Default | Range | Effect |\n|---|---|---|---|---|---|\n";
    for (const KeySpec& key : section.keys)
        page += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(key.name), type_column(key),
                            key.unit.empty() ? "-" : key.unit, escaped(default_column(key)), range_column(key),
                            escaped(key.effect));
    return page + "\n";
}
}  // namespace

std::string_view case_example()
{
    return example;
}

std::string case_format_markdown()
{
    std::string page = std::string(introduction) + std::string(example) +
                       "```\n\n## All keys\n\nEquations are those of the publication that README.md cites.\n\n";
    for (const SectionSpec& section : case_schema())
        page += section_page(section);
    return page + std::string(stage_end_page()) + std::string(semantics);
}
}  // namespace hdem
