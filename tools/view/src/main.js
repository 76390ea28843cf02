// Opens the runs of the page, shows the last frame, and reads the others in the background.
import { buildControls } from "./controls.js";
import { addFieldsOf } from "./fields.js";
import { Histories } from "./histories.js";
import { followPointer } from "./pointer.js";
import { Run } from "./run.js";
import { View } from "./view.js";
import { byId, choice } from "./dom.js";
import { remember, startLive } from "./live.js";

async function start() {
    const facts = JSON.parse(byId("hdem-facts").textContent);
    facts.runs.forEach(addFieldsOf);
    const runs = await Promise.all(facts.runs.map(Run.open)), view = new View(runs);
    const words = runs.map(({ facts: run }) => run.title || run.name), first = facts.runs[0];
    byId("title").textContent = [...new Set(words)].join(" | ");
    byId("about").textContent = runs.map(({ facts: run }) => `${run.name}${run.state === "done" ? "" : ` (${run.state})`}: ${run.blocks.toLocaleString("en").replaceAll(",", "\u202f")} blocks, ${run.frames.length} ${run.frames.length === 1 ? "frame" : "frames"}`).join(" · ");
    byId("about").title = `${first.case}, hdem ${first.program}, page made ${facts.made}`;
    byId("panes").append(...view.panes.map((pane) => pane.root));
    view.start();
    buildControls(view);
    view.panes.forEach((pane) => followPointer(pane, view));
    new ResizeObserver(() => {
        view.panes.forEach((pane) => pane.resize());
        view.draw();
    }).observe(byId("panes"));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => view.retheme(document.documentElement.dataset.theme ?? "auto"));

    const place = await remember(view, facts);
    await view.goTo(place ?? view.timeline.length - 1);
    view.draw();
    byId("loading").remove();
    window.hdem = { view, runs, ready: performance.now() };
    startLive(view, facts);
    window.hdem.histories = await showHistories(view, runs);
    for (const run of runs) for (let i = 0; i < run.frames.length && run.bytes < 300e6; ++i) await run.frame(i).then(() => new Promise((done) => setTimeout(done)));
}

async function showHistories(view, runs) {
    const tables = await Promise.all(runs.map((run) => run.tables())), names = [...new Set(tables.flat().map((table) => table.name))];
    if (!names.length) return null;
    const histories = new Histories(byId("charts"), (time) => (view.play(false), view.goTo(view.timeline.placeOfTime(runs, time))));
    const show = (name) => histories.show(tables.map((own) => own.find((table) => table.name === name)), runs.map((run) => run.facts.name));
    byId("history-holder").append(choice("history", names.map((name) => [name, name.replaceAll("_", " ")]), names[0], show));
    byId("history-section").hidden = false;
    show(names[0]);
    const follow = () => histories.moveTo(view.panes[0].shown >= 0 ? view.panes[0].entry.time : 0);
    view.listeners.push(follow);
    follow();
    const redraw = view.retheme.bind(view);
    view.retheme = (theme) => (redraw(theme), show(byId("history").value));
    return histories;
}

start().catch((error) => {
    byId("loading")?.remove();
    byId("message").hidden = false;
    byId("message").textContent = `The page cannot be shown: ${error.message}.`;
    console.error(error);
});
