// From which value to which colours and widths go.
import { FIELDS } from "./fields.js";

function framesOf(run, number, scope) {
    const now = run.frames[number];
    return scope === "frame" ? [now] : run.frames.filter((frame) => scope === "run" || frame.begin === now.begin);
}

// Low and high of a field over the frames of all runs that belong to the scope: frame, stage or run. What grows in a stage has the range of its
// end, without the blocks that are detached by then: they would take all colours on their way.
export function rangeOf(panes, field, scope) {
    let low = Infinity, high = -Infinity;
    for (const pane of panes)
        for (const frame of framesOf(pane.run, Math.max(0, pane.wanted), scope).slice(scope === "stage" && FIELDS[field].grows ? -1 : 0)) {
            const range = frame.ranges[field];
            if (range) low = Math.min(low, range[0]), (high = Math.max(high, range[1]));
        }
    const most = Math.max(-low, high);
    if (!(most > 0)) return FIELDS[field].signed ? [-1, 1] : [0, 1];
    return FIELDS[field].signed ? [-most, most] : [0, high];
}

// What the widest line stands for, the same in all frames of a stage.
export function contactReference(run, number, quantity) {
    return Math.max(0, ...framesOf(run, number, "stage").map((frame) => frame.contacts?.references[quantity] ?? 0));
}

export function stressReference(run, number) {
    return Math.max(0, ...framesOf(run, number, "stage").flatMap((frame) => ["stress_1", "stress_3"].flatMap((name) => frame.ranges[name].map(Math.abs))));
}

// By which the diagram of linings is scaled, the same in all frames of all runs: their greatest value, and the longer side of all of them when they were installed.
export function liningReference(runs, name) {
    const all = runs.flatMap((run) => run.frames.flatMap((frame) => frame.liners ?? [])), boxes = runs.flatMap((run) => (run.facts.lined ? [run.facts.lined] : []));
    return { greatest: Math.max(0, ...all.map((one) => one[name] ?? 0)), size: Math.max(0, ...boxes.map(([x0, y0, x1, y1]) => Math.max(x1 - x0, y1 - y0))) };
}

export function boltReference(runs) {
    return Math.max(1e-9, ...runs.flatMap((run) => run.frames.flatMap((frame) => frame.bolts?.force ?? [])));
}
