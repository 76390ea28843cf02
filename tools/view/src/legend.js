// What colours and lines stand for.
import { CLASSES, FIELDS, digits, scaledUnit, withUnit } from "./fields.js";
import { table } from "./colours.js";
import { JOINTS, LININGS } from "./lines.js";
import { boltReference, contactReference, liningReference, stressReference } from "./ranges.js";
import { element } from "./dom.js";

function bar(view) {
    const { label, unit, signed, motion } = FIELDS[view.field], [low, high] = view.range;
    const [factor, name] = scaledUnit(unit, Math.max(Math.abs(low), Math.abs(high))), colours = table(view.map, signed);
    const canvas = element("canvas", { width: 256, height: 1 }), context = canvas.getContext("2d"), image = context.createImageData(256, 1);
    for (let i = 0; i < 256; ++i) image.data.set([...colours.subarray(3 * i, 3 * i + 3), 255], 4 * i);
    context.putImageData(image, 0, 0);
    const ticks = [0, 0.25, 0.5, 0.75, 1].map((t) => element("span", { textContent: digits((low + t * (high - low)) / factor, 3) }));
    const detached = motion && view.panes.some((pane) => pane.shown >= 0 && pane.entry.detached > 0);
    const distances = [...new Set(view.runs.map((run) => withUnit(run.facts.detached_distance, "m", 3)))].join(" | ");
    return [element("b", { textContent: name ? `${label} [${name}]` : label }), canvas, element("div", { className: "ticks" }, ...ticks),
            detached ? swatch("hatched", `Detached: moved more than ${distances}`) : null];
}

function swatch(kind, text, colour) {
    const sample = element("i", { className: `swatch ${kind}` });
    if (colour) sample.style.background = colour;
    return element("div", { className: "entry" }, sample, element("span", { textContent: text }));
}

function classes(view) {
    const kind = CLASSES[view.field];
    if (view.field === "none") return [];
    return [element("b", { textContent: kind.label }), ...kind.classes(view.runs).map(([name, colour]) => swatch("", name, colour))];
}

// Lines are as wide as their reference says, each pane has its own.
function lines(view) {
    const found = [], { layers, joint, panes } = view;
    const each = (text, unit, reference) => {
        const values = panes.filter((pane) => pane.shown >= 0).map(reference).filter((value) => value > 0);
        if (values.length) found.push(text(values.map((value) => withUnit(value, unit, 3)).join(" | ")));
    };
    if (layers.forces) each((value) => swatch("line", `Widest: normal force ${value}`), "N", (pane) => contactReference(pane.run, pane.shown, "normal_force"));
    if (joint !== "none") each((value) => swatch("line red", `Widest: ${JOINTS[joint].label.toLowerCase()} ${value}`), JOINTS[joint].unit, (pane) => contactReference(pane.run, pane.shown, joint));
    if (layers.crosses) each((value) => swatch("cross", `Longest: principal stress ${value}; blue: tension`), "Pa", (pane) => stressReference(pane.run, pane.shown));
    if (layers.bolts && panes.some((pane) => pane.shown >= 0 && pane.entry.bolts)) found.push(swatch("bolt", `Bolts: 0 to ${withUnit(boltReference(view.runs), "N", 3)}`));
    const shows = (what) => panes.some((pane) => pane.shown >= 0 && pane.entry[what] !== undefined);
    if (LININGS[view.lining] && shows("liners")) {
        const { label, unit } = LININGS[view.lining], side = view.lining === "thrust" ? "inside: compression" : "on the side that is stretched";
        found.push(swatch("lining", `Linings: ${label.toLowerCase()} up to ${withUnit(liningReference(view.runs, view.lining).greatest, unit, 3)}, ${side}`));
    }
    if (layers.water && shows("water")) found.push(swatch("water", "Water table"));
    if ((layers.forces || joint !== "none") && panes.some((pane) => pane.shown >= 0 && !pane.entry.contacts)) found.push(element("p", { className: "note", textContent: "The page has no contacts of this frame." }));
    return found;
}

// Made anew only when it says something else: that costs more than a frame of blocks.
export function fillLegend(root, view) {
    const { field, range, map, layers, joint, panes } = view;
    const ofFrames = panes.map((pane) => pane.shown >= 0 && [pane.entry.begin, pane.entry.detached > 0, !!pane.entry.contacts, !!pane.entry.bolts, !!pane.entry.liners, pane.entry.water !== undefined]);
    const key = JSON.stringify([field, range, map, layers, joint, view.lining, ofFrames]);
    if (root.dataset.key === key) return;
    root.dataset.key = key;
    root.replaceChildren(...[...(CLASSES[field] ? classes(view) : bar(view)), ...lines(view)].filter(Boolean));
}
