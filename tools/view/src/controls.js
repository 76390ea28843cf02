// Buttons, lists and keys.
import { MAPS } from "./colours.js";
import { CLASSES, FIELDS } from "./fields.js";
import { JOINTS, LININGS } from "./lines.js";
import { byId, choice, element, row } from "./dom.js";

const LAYERS = { edges: ["Block edges", "e"], outline: ["Excavations", "o"], forces: ["Contact forces", "c"], crosses: ["Principal stresses", "s"], bolts: ["Bolts", "b"], water: ["Water table", "w"] };
const OF_SOME = { bolts: true, water: true }; // layers that not every run has
const THEMES = ["auto", "light", "dark"];
const KEYS = [["Space", "play or pause"], ["← →", "frame before, after"], ["Home End", "first, last frame"], ["+ −", "zoom"], ["Shift ← → ↑ ↓", "move the picture"], ["f", "all of the model"],
              ["1 … 9", "colour"], ["e o c s b w", "layers"], ["j l", "next quantity of joints, of linings"], ["t", "light or dark"], ["Esc", "let go of the block"], ["?", "this list"]];

export function fieldNames(view) {
    const known = Object.keys(FIELDS).filter((name) => view.runs.some((run) => run.frames.some((frame) => name in frame.ranges)));
    return [...known.slice(0, 4), "speed", "stress_1", "stress_3", "regime", "state", ...known.slice(4), "material", "none"].filter((name, i, all) => all.indexOf(name) === i);
}

export function jointNames(view) {
    const there = (name) => view.runs.some((run) => run.frames.some((frame) => frame.contacts && name in frame.contacts.references));
    return Object.keys(JOINTS).filter(there);
}

export function buildControls(view) {
    const fields = fieldNames(view), joints = ["none", ...jointNames(view)];
    const label = (name, i) => [name, (FIELDS[name] ?? CLASSES[name]).label + (i < 9 ? `  (${i + 1})` : "")];
    const manual = element("span", { className: "manual", hidden: true }, ...[0, 1].map((end) => {
        const input = element("input", { type: "number", step: "any", ariaLabel: end ? "highest value, SI units" : "lowest value, SI units", title: "SI units" });
        input.addEventListener("change", () => {
            if (Number.isFinite(input.valueAsNumber)) view.manual[end] = input.valueAsNumber;
            if (view.manual[1] > view.manual[0]) view.recolour();
        });
        return input;
    }));
    const fieldChoice = choice("field", fields.map(label), view.field, (name) => ((view.field = name), view.recolour()));
    const scopeChoice = choice("scope", [["stage", "of the stage"], ["frame", "of this frame"], ["run", "of all frames"], ["manual", "as given [SI]"]], view.scope, (scope) => {
        if (scope === "manual") manual.childNodes.forEach((input, end) => (input.value = view.manual[end] = view.range[end]));
        view.scope = scope;
        manual.hidden = scope !== "manual";
        view.recolour();
    });
    const mapChoice = choice("map", Object.entries(MAPS).map(([name, map]) => [name, map.label]), view.map, (map) => ((view.map = map), view.recolour()));
    byId("colour").append(row("Colour", fieldChoice), row("Range", scopeChoice), manual, row("Map", mapChoice));

    const boxes = {};
    for (const [name, [text, key]] of Object.entries(LAYERS)) {
        if (name in OF_SOME && !view.runs.some((run) => run.frames.some((frame) => frame[name] !== undefined))) continue;
        const box = (boxes[name] = element("input", { type: "checkbox", id: `layer-${name}`, checked: view.layers[name] }));
        box.addEventListener("change", () => ((view.layers[name] = box.checked), view.relayer()));
        byId("layers").append(element("label", { className: "check" }, box, element("span", { textContent: text }), element("kbd", { textContent: key })));
    }
    const jointChoice = choice("joint", joints.map((name) => [name, JOINTS[name]?.label ?? "not drawn"]), "none", (name) => ((view.joint = name), view.relayer()));
    const magnifyChoice = choice("magnify", [1, 2, 5, 10, 20, 50, 100, 500, 1000].map((n) => [n, n === 1 ? "as they are" : `× ${n}`]), 1, (times) => ((view.magnify = +times), view.rescale()));
    const linings = ["thrust", "moment", "line", "none"], names = { line: "without diagram", none: "not drawn" };
    const liningChoice = choice("lining", linings.map((name) => [name, LININGS[name]?.label ?? names[name]]), view.lining, (name) => ((view.lining = name), view.relayer()));
    const lined = view.runs.some((run) => run.frames.some((frame) => frame.liners));
    byId("layers").append(row("Joints", jointChoice, "j"), ...(lined ? [row("Linings", liningChoice, "l")] : []), row("Displacements", magnifyChoice));
    if (view.panes.length > 1) buildComparison(view);
    buildTransport(view);
    buildHelp();
    addKeys(view, { fields, fieldChoice, boxes, next: { j: [jointChoice, joints], ...(lined ? { l: [liningChoice, linings] } : {}) } });
}

function buildComparison(view) {
    const link = element("input", { type: "checkbox", checked: true });
    link.addEventListener("change", () => ((view.linked = link.checked), link.checked && view.cameraMoved(view.panes[0])));
    byId("layers").append(row("Match frames by", choice("match", [["stage", "progress of the stage"], ["time", "time"], ["frame", "number"]], view.match, (way) => view.rematch(way))),
        element("label", { className: "check" }, link, element("span", { textContent: "Move both together" })));
}

function buildTransport(view) {
    const slider = byId("slider"), play = byId("play");
    slider.addEventListener("input", () => view.goTo(+slider.value));
    play.addEventListener("click", () => view.play(!view.playing));
    byId("back").addEventListener("click", () => step(view, -1));
    byId("forth").addEventListener("click", () => step(view, 1));
    byId("speed-holder").append(choice("speed", [1, 2, 5, 10, 20, 30, 60].map((n) => [n, `${n} / s`]), view.speed, (speed) => (view.speed = +speed)));
    byId("loop").addEventListener("change", () => (view.loop = byId("loop").checked));
    byId("fit").addEventListener("click", () => view.fit());
    byId("theme").addEventListener("click", () => nextTheme(view));
    byId("save").addEventListener("click", () => savePicture(view));
    view.listeners.push(() => {
        slider.max = view.timeline.length - 1;
        slider.value = view.place;
        slider.ariaValueText = `frame ${view.place + 1}`;
        byId("counter").textContent = `${view.place + 1} / ${view.timeline.length}`;
        play.textContent = view.playing ? "❚❚" : "▶";
        play.setAttribute("aria-label", view.playing ? "pause" : "play");
        drawTicks(view);
    });
}

// Where stages begin.
function drawTicks(view) {
    const ticks = byId("ticks"), key = `${view.match} ${view.timeline.length}`;
    if (ticks.dataset.made === key) return;
    ticks.dataset.made = key;
    const run = view.runs[0], last = Math.max(1, view.timeline.length - 1);
    ticks.replaceChildren(...view.timeline.frames.flatMap(([number], place) => {
        const before = place ? run.frames[view.timeline.frames[place - 1][0]] : null, entry = run.frames[number];
        if (before && before.begin === entry.begin) return [];
        const tick = element("i", { title: entry.stage || `stage from cycle ${entry.begin}` });
        tick.style.left = `${(100 * place) / last}%`;
        return [tick];
    }));
}

function step(view, by) {
    view.play(false);
    view.goTo(view.place + by);
}

function nextTheme(view) {
    const now = document.documentElement.dataset.theme ?? "auto", next = THEMES[(THEMES.indexOf(now) + 1) % THEMES.length];
    view.retheme(next);
    byId("theme").title = `Theme: ${next}`;
}

function savePicture(view) {
    view.panes.forEach((pane) => {
        pane.draw();
        pane.scene.seen.toBlob((blob) => {
            const link = element("a", { href: URL.createObjectURL(blob), download: `${pane.run.facts.name}_${String(pane.entry.number).padStart(6, "0")}.png` });
            link.click();
            URL.revokeObjectURL(link.href);
        });
    });
}

function buildHelp() {
    byId("help-keys").append(...KEYS.map(([keys, what]) => element("tr", {}, element("th", {}, ...keys.split(" ").map((key) => element("kbd", { textContent: key }))), element("td", { textContent: what }))));
    byId("help").addEventListener("click", () => byId("help-box").showModal());
    byId("help-box").addEventListener("click", () => byId("help-box").close());
}

function addKeys(view, { fields, fieldChoice, boxes, next }) {
    const pan = { ArrowLeft: [60, 0], ArrowRight: [-60, 0], ArrowUp: [0, 60], ArrowDown: [0, -60] };
    const zoom = (factor) => (view.panes[0].camera.zoom(factor), view.cameraMoved(view.panes[0]));
    const choose = (list, value) => ((list.value = value), list.dispatchEvent(new Event("change")));
    const layerOf = Object.fromEntries(Object.entries(LAYERS).map(([name, [, key]]) => [key, name]));
    const actions = {
        " ": () => view.play(!view.playing), ArrowLeft: () => step(view, -1), ArrowRight: () => step(view, 1), Home: () => step(view, -Infinity), End: () => step(view, Infinity),
        "+": () => zoom(1.3), "=": () => zoom(1.3), "-": () => zoom(1 / 1.3), f: () => view.fit(), t: () => nextTheme(view), "?": () => byId("help-box").showModal(),
        Escape: () => view.pin(view.panes[0], -1), ...Object.fromEntries(Object.entries(next).map(([key, [list, all]]) => [key, () => choose(list, all[(all.indexOf(list.value) + 1) % all.length])])),
    };
    document.addEventListener("keydown", (event) => {
        const typed = event.target instanceof HTMLElement && event.target.matches("input[type=number], select");
        if (event.ctrlKey || event.metaKey || event.altKey || (typed && event.key !== "Escape") || byId("help-box").open) return;
        let action = actions[event.key];
        if (event.shiftKey && pan[event.key]) action = () => (view.panes[0].camera.pan(...pan[event.key]), view.cameraMoved(view.panes[0]));
        else if (layerOf[event.key] in boxes) action = () => boxes[layerOf[event.key]].click();
        else if (/^[1-9]$/.test(event.key) && fields[+event.key - 1]) action = () => choose(fieldChoice, fields[+event.key - 1]);
        if (!action) return;
        event.preventDefault();
        action();
    });
}
