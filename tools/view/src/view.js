// What is shown and how: the state behind the controls, and what follows when it changes.
import { rgb } from "./colours.js";
import { CLASSES } from "./fields.js";
import { rangeOf } from "./ranges.js";
import { Timeline } from "./timeline.js";
import { factsOf } from "./facts.js";
import { fillLegend } from "./legend.js";
import { byId, element } from "./dom.js";
import { Pane } from "./pane.js";
import { point } from "./pointer.js";

export class View {
    constructor(runs) {
        Object.assign(this, { runs, field: "displacement", map: "standard", scope: "stage", manual: [0, 1], range: [0, 1], joint: "none", lining: "thrust", magnify: 1, linked: true,
                              layers: { edges: true, outline: true, forces: false, crosses: false, bolts: true, water: true }, place: 0, playing: false, speed: 10, loop: true,
                              match: "stage", drawn: 0, listeners: [] });
        this.panes = runs.map((run) => new Pane(run, this));
        this.timeline = new Timeline(runs, this.match);
        this.readTheme();
    }

    readTheme() {
        const style = getComputedStyle(document.documentElement);
        this.ground = rgb(style.getPropertyValue("--canvas").trim());
        this.ink = rgb(style.getPropertyValue("--lines").trim());
    }

    start() {
        for (const pane of this.panes) {
            pane.start();
            pane.resize();
        }
        this.fit();
    }

    // Both panes from one corner to the other: with the same scale where they are looked at together.
    fit() {
        for (const pane of this.panes) pane.camera.fit((pane.box ??= pane.bounds));
        if (this.linked && this.panes.length > 1) this.cameraMoved(this.panes.reduce((a, b) => (a.camera.scale < b.camera.scale ? a : b)));
        else this.panes.forEach((pane) => this.cameraMoved(pane));
    }

    cameraMoved(moved) {
        for (const pane of this.panes) {
            if (pane !== moved && !this.linked) continue;
            if (pane !== moved) {
                const [a, b] = [moved.run.facts.origin, pane.run.facts.origin];
                Object.assign(pane.camera, { x: moved.camera.x + a[0] - b[0], y: moved.camera.y + a[1] - b[1], scale: moved.camera.scale, fitted: moved.camera.fitted });
            }
            if (pane.scene.sheet) pane.scene.sheet.movedAt = performance.now();
            if (this.layers.crosses && pane.frame) pane.crossesDue = true;
        }
        this.redraw();
    }

    // One picture at the next turn of the screen, however much has changed.
    redraw() {
        if (this.due) return;
        this.due = true;
        requestAnimationFrame(() => this.draw());
    }

    draw() {
        this.due = false;
        for (const pane of this.panes) {
            if (pane.crossesDue) pane.updateCrosses();
            pane.crossesDue = false;
            pane.draw();
        }
        ++this.drawn;
    }

    setRange() {
        if (!CLASSES[this.field]) this.range = this.scope === "manual" ? this.manual : rangeOf(this.panes, this.field, this.scope);
    }

    // The frames at this place of the slider. Says whether they are there now.
    async goTo(place) {
        this.place = Math.min(Math.max(0, place), this.timeline.length - 1);
        const numbers = this.timeline.frames[this.place];
        this.panes.forEach((pane, i) => (pane.wanted = numbers[i]));
        this.setRange();
        this.busy = true;
        try {
            await Promise.all(this.panes.map((pane, i) => pane.show(numbers[i])));
        } catch (error) {
            this.say(error.message);
        }
        this.busy = false;
        this.told();
    }

    // Everything that depends on the frame, the field or the layers, but not the picture itself.
    told() {
        fillLegend(byId("legend"), this);
        this.panes.forEach((pane) => {
            if (pane.shown < 0) return;
            const { entry, run } = pane;
            pane.caption.replaceChildren(element("b", { textContent: run.facts.name, hidden: this.panes.length < 2 }),
                element("span", { textContent: `${entry.stage ? `${entry.stage} · ` : ""}cycle ${entry.cycle.toLocaleString("en").replaceAll(",", "\u202f")} · ${+entry.time.toPrecision(5)} s${pane.frame.isEmpty ? " · no blocks are left" : ""}` }));
            if (!pane.tip.hidden && pane.pointer) point(pane, this, pane.pointer);
        });
        this.showPinned();
        for (const listener of this.listeners) listener();
    }

    // After a change of field, range, map or layers.
    recolour() {
        this.setRange();
        this.panes.forEach((pane) => pane.updateColours());
        this.redraw();
        this.told();
    }

    relayer() {
        this.panes.forEach((pane) => pane.frame && pane.updateLines());
        this.redraw();
        this.told();
    }

    rescale() {
        this.panes.forEach((pane) => pane.update());
        this.told();
    }

    rematch(way) {
        const cycleNow = this.panes[0].shown;
        this.match = way;
        this.timeline = new Timeline(this.runs, way);
        this.goTo(Math.max(0, this.timeline.frames.findIndex((numbers) => numbers[0] === cycleNow)));
    }

    pin(pane, block) {
        for (const other of this.panes) {
            const same = other === pane ? block : block < 0 ? -1 : other.run.names.indexOf(pane.run.names[block]);
            other.pinned = same === pane.pinned && other === pane ? -1 : same;
            other.mark("pinned", other.pinned);
        }
        if (pane.pinned < 0) this.panes.forEach((other) => ((other.pinned = -1), other.mark("pinned", -1)));
        this.redraw();
        this.showPinned();
    }

    showPinned() {
        const root = byId("block"), shown = this.panes.filter((pane) => pane.pinned >= 0 && pane.frame);
        root.replaceChildren(...shown.flatMap((pane) => {
            const { run, pinned } = pane, head = element("h3", { textContent: run.names[pinned] + (this.panes.length > 1 ? ` · ${run.facts.name}` : "") });
            return pane.frame.present[pinned] ? [head, ...factsOf(pane, pinned)] : [head, element("p", { className: "note", textContent: "It has been removed." })];
        }));
        byId("block-section").hidden = !shown.length;
    }

    say(text) {
        const note = byId("message");
        note.textContent = text;
        note.hidden = !text;
    }

    retheme(theme) {
        if (theme === "auto") delete document.documentElement.dataset.theme;
        else document.documentElement.dataset.theme = theme;
        this.readTheme();
        this.panes.forEach((pane) => pane.updateColours());
        this.relayer();
    }

    // Plays frame after frame, `speed` a second, at most one at each turn of the screen.
    play(on) {
        this.playing = on;
        if (on && this.place === this.timeline.length - 1) this.goTo(0);
        let last = performance.now();
        const turn = (now) => {
            if (!this.playing) return;
            if (now - last >= 1000 / this.speed - 2 && !this.busy) {
                last = now;
                if (this.place < this.timeline.length - 1) this.goTo(this.place + 1);
                else if (this.loop) this.goTo(0);
                else this.play(false);
            }
            requestAnimationFrame(turn);
        };
        if (on) requestAnimationFrame(turn);
        for (const listener of this.listeners) listener();
    }
}
