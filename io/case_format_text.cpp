#include "io/case_format_text.h"

namespace hdem::format_text
{
const std::string_view example = R"toml(schema = 1
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

const std::string_view introduction = R"md(# The case file

<!-- Written by `hdem schema --markdown` from the table in io/case_schema*.cpp. Change the table, not this page. -->

A case file says everything a run needs: the rock, its joints, the loads, the stages, the output. It is [TOML](https://toml.io):
`key = value` lines below headers in brackets, comments after `#`.

- **SI units** without exception, so values carry no unit. Angles are in degrees where the key ends in `_deg`. All forces, masses and
  stiffnesses are per metre out of plane. No length and no coordinate is above 1e8 m.
- Headers in single brackets, `[domain]`, occur once. Headers in double brackets, `[[joint_set]]`, occur as often as there are such
  things. In `[joint.NAME]` and `[material.NAME]` you choose the name: letters, digits, `_` and `-`.
- A point or vector is `[x, y]`, a polygon `[[x, y], [x, y], [x, y], ...]` of 3 to 25 000 vertices. Where a number is expected, `2` is as good as `2.0`;
  where a whole number is expected, `1e6` is as good as `1000000`.
- Unknown keys, wrong types and values out of range are refused, all at once, each with file, line and column.
  `hdem check CASE.toml` does only this.
- `hdem run CASE.toml --set joint.default.friction_angle_deg=20` replaces or adds one value. An entry of a list is given by its number,
  counted from 0 (`--set stage[1].max_cycles=1000`), or by its name (`--set joint_set.bedding.dip_deg=15`). A bare word is taken as text: `--set contact.method=force`. One number for a force, an acceleration or a velocity, as in `--set load.push.force=2e5`, sets its magnitude; the direction stays that of the case.
- `hdem schema` prints the JSON Schema for editors.

## A complete example

```toml
)md";

const std::string_view semantics = R"md(## What the words mean

**Axes and signs.** x points right, y up. Angles, rotations and moments are positive anticlockwise. A positive normal force is compression.

**Dip.** `dip_deg` is the angle from the x axis to the joint's trace, positive anticlockwise: 30 rises to the right, -30 falls to the
right, 90 is vertical. 30 and -150 are the same joint.

**Which joint acts at a contact.** If a touching face was cut by a fault, an outline of a region, a joint set or a trace that names
a `joint`: that one (in this order, if the two faces differ). Else the [joint.NAME] whose `materials` are those of the two blocks,
in either order. Else [joint.default].

**Fixed.** A fixed component (x, y or rotation) of a block is never changed by forces: it keeps the velocity it starts with, 0 unless `velocity`
or a load prescribes another. A block with all three fixed and no velocity is a support. `domain.fixed` fixes all three of each block
that has an edge on the named side. A stage can fix and free blocks later. Two blocks that have all three fixed exert no forces on each other,
even if they move: leave a component of one of them free.

**Names.** Blocks, excavations, joint sets, stages and histories have names. Blocks and excavations share one set of names, because a stage can
remove either. Blocks that are cut from the domain get names when they are made; `hdem check` and the block frames show them.
In a load, `"*"` stands for all blocks that are free at that moment; it can stand beside names.

**Order of stages.** Stages run in the order of the file. At its start a stage first sets numbers of joints and materials (`set`), ends and begins what acts on the sides ([[boundary]]),
then removes what `excavate` names, then fixes, then frees.
Contacts keep their forces from stage to stage; but springs that follow impulses begin without force (`relax_cycles`). Cycles and seconds count on from the start of the run, also for loads.

**When a load acts.** With `from_cycle = 5000` a load acts from the 5001st cycle on, after 5000 cycles. Likewise
`until_cycle = 6000` makes the 6000th its last. Times are compared with the time at the start of the cycle.

**Loads that grow and fall.** What a [[load]] or a [[boundary]] of kind `stress`, `velocity` or `servo` gives is multiplied by a factor, if one is
given. With `ramp_cycles = [from, until]` it grows from 0 to 1. With `table = [[cycle, factor], ...]`, or the same in a file, it is linear
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

A stage with `until` does not end while a factor changes. Until then no block is skipped, and all steps are equal. Afterwards the stage
goes on as if the load had always been there. While a time in seconds is still to come, steps are equal in earlier stages too.

**Random numbers.** Dips, spacings, traces, gaps, persistence and Voronoi points are the only random things, and follow from `generator.seed` alone
(or from the `seed` of their section). Each use of each set has a stream of its own: what one set draws changes nothing in another one.

## Joint sets with distributions

Where a number of a joint set is drawn, it is a table instead of a number:

```toml
[[joint_set]]
name = "bedding"
dip_deg = {mean = 25.0, distribution = "von_mises", kappa = 50}
spacing = {mean = 1.2, distribution = "exponential", least = 0.3, most = 5.0}

[[joint_set]]                           # joints that end in the rock
name = "cross"
dip_deg = {mean = 80.0, distribution = "normal", sd = 6.0}
spacing = {mean = 1.5, distribution = "lognormal", sd = 0.7}
trace = {mean = 4.0, distribution = "lognormal", sd = 2.0}
gap = {mean = 1.0, distribution = "exponential"}
stops_at = ["main"]                     # a [[fault]]
```

| `distribution` | Numbers it has | For |
|---|---|---|
| `"uniform"` | `least` and `most`, or `mean` and `sd` | all |
| `"normal"` | `mean`, `sd`; a length also `least` | all |
| `"von_mises"` | `mean`, `kappa` (at most 10 000) | `dip_deg` |
| `"exponential"` | `mean` | lengths |
| `"lognormal"` | `mean`, `sd`: of the number itself, not of its logarithm | lengths |

`least` and `most` cut any of them. `mean`, `sd` and `kappa` are those before the cut: an exponential with mean 1 cut to 0.2 and 3 has the mean 1.018707. `hdem check`
prints, for each set, the mean of its joints and, in brackets, the mean of the cut distribution. `summary.json` has both under `joint_sets`.

**Through-going joints** lie at their spacings from `origin` outwards, and turn about the points at which they cross the line through `origin` at right angles to the set.
Their dips deviate by less than 45°: the distribution is cut there. For greater deviations use joints of finite length.

**Joints of finite length** have a `trace`. With `spacing` and `gap` they follow each other on parallel lines, and each turns about its own middle. With `p21` [m/m2] instead of these
their middles lie anywhere, independent of each other, and their length per area is `p21` on average. With lines, the length per area is trace / (trace + gap) / spacing.

They are cut together with the through-going sets that have no `persistence`, with faults and with outlines of regions. An area that these lines enclose becomes a block.
Sets with a `persistence` cut these blocks afterwards, by chance. The part of a joint that ends inside a block is dropped. Cells smaller than `generator.smallest_block_area`, or narrower than
2e-6 of the domain, are joined to the neighbour with the longest common edge, but never across a fault or an outline. `hdem check`, `run.log` and `summary.json` say how much length each set loses by this.
Cells with an edge below `generator.smallest_edge` are joined to a neighbour whose edge goes straight on from it; a warning names shorter edges that remain.

A rock bridge is solid rock: it does not break. If it should break, draw the joint through it, with a [joint.NAME] with the cohesion and the tension of the bridge.

**Orientations in space.** `orientation = {dip = 60, dip_direction = 130, section = 90}` and the true `spacing` of the planes: with tan α = tan δ cos(α_d − ζ) the trace falls
to the side to which the planes dip, and its spacing is s / sqrt(sin² δ cos²(α_d − ζ) + cos² δ). Here `dip_deg` is -52.9955°, and 1.5 m become 1.805633 m. All distributions
and deviations are then those in the section.

**Voronoi cells** ([voronoi]) stand for rock without sets. Their edges are cut like joints of finite length. Edges below `generator.smallest_edge` shrink to a point; at the
boundary of the domain or of the region they may still be shorter. Through-going sets cut the cells too: keep them out by `outside`.

## The profile

`domain.profile` names a file of the ground:

```
x,y
0,102.5
35,118
80,121.4
```

Lines that begin with `#` are skipped, and the heading may be left out. x grows from row to row; for a vertical or overhanging wall use a polygon. Edges of the domain are numbered as in a polygon that begins
with the lower side: 0 is the lower side, 1 the right one, the last one the left one. `fixed` and [[boundary]] accept names of sides too.

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

**Above and below.** Above is the left side of a fault, seen from its end with lower x to the other end. The fault is extended straight at its ends. A fault
that ends at another one separates the rock only up to there: give such a region both faults, or a polygon. A fault that ends straight above
its beginning has no upper side: use a polygon. Its outline cuts no second joint along the fault.

**Dead ends.** A fault that ends inside the domain, and not at another line, separates nothing beyond the last line it meets. That piece is not cut; a
warning gives its length. Joint sets are cut later, so no fault ends at them.

**In-situ stress** of [insitu] by `surface` takes the density of domain.material; `hdem check` tells how far a region of another density is out of
equilibrium.

## The blocks file

`blocks_file` names a text file with one polygon per line in WKT. Empty lines and lines that start with `#` are skipped. After the polygon may stand
its name, its material and its fixed components, each after a semicolon and possibly empty:

```
# ground and two blocks
POLYGON((0 0, 4 0, 4 1, 0 1, 0 0)); ground; rock; fixed
POLYGON((1 1, 2 1, 2 2, 1 2, 1 1))
POLYGON((2 1, 3 1, 3 2, 2 2, 2 1)); upper; ; rotation
```

The first vertex is repeated at the end. Blocks without a name are called `block1`, `block2`, ... counted on from those of [[block]].
Holes, MULTIPOLYGON, Z and M are refused.

A file whose name ends in `.csv` has one row per vertex instead: `name,x,y` and, in a block's first row, `material,fixed`. Rows of one block follow each
other; a heading with these names may stand above them. `tools/import_dxf.py` makes such files from drawings.

A file whose name ends in `.geojson` or `.json` is GeoJSON: Polygon and MultiPolygon without holes, with the properties `name`, `material` and `fixed`,
in capitals or not; a name may be a whole number. Coordinates are taken as they are, in metres. Other formats become GeoJSON by `ogr2ogr` (Debian: gdal-bin):

```sh
ogr2ogr -f GeoJSON blocks.geojson blocks.shp
```

`hdem check CASE.toml --write-blocks blocks.geojson` (or `.wkt`) writes all blocks with name, material and fixed components. For each edge, beginning with that from the first vertex
to the second, it gives the set, fault, outline or excavation that cut it (`hole_edges` for edges of holes; "domain" and "block" for given edges). Both files can be a `blocks_file` again, but what cut the edges is not read: contacts then take their joints by materials. Blocks around other blocks have holes, and are refused as input: draw a joint through them.

## The traces file

`domain.traces_file` names a text file of joint traces that need not run through: one WKT line per row, or a `.csv` with rows of `name,x,y`.

```
# a joint, and one that bends
LINESTRING(0 2, 8 5.5)
LINESTRING(3 0, 4 3, 6 9)
```

A file whose name ends in `.geojson` or `.json` is GeoJSON with LineString and MultiLineString: `ogr2ogr -f GeoJSON traces.geojson traces.shp`.

The traces cut the domain into blocks where they enclose an area, together or with the domain's boundary. A part that separates nothing, because it ends
inside a block or only joins two rings of traces, is dropped and counted in `hdem check` and in run.log. Excavations and joint sets cut further. Traces are cut whatever `smallest_block_area`
says: a cell smaller than it stays, with a warning.
)md";
}  // namespace hdem::format_text
