// One run on the screen: its canvas, its frame of the moment, and the pointer over it.
import { Camera } from "./camera.js";
import { CLASSES, FIELDS } from "./fields.js";
import { colourByClass, colourByValue, rgb, table } from "./colours.js";
import { DIAGRAM, blockLines, boltLines, crossLines, forceLines, jointLines, liningLines, outlineLines, waterLines } from "./lines.js";
import { Scene } from "./scene.js";
import { element } from "./dom.js";
import { boltReference, contactReference, liningReference, stressReference } from "./ranges.js";

const ORDER = ["forces", "joints", "outline", "crosses", "water", "linings", "bolts", "pinned", "hovered"];

export class Pane {
    constructor(run, view) {
        Object.assign(this, { run, view, camera: new Camera(), wanted: -1, shown: -1, hovered: -1, pinned: -1, isExact: false });
        this.canvas = element("canvas", { tabIndex: 0, ariaLabel: `Blocks of ${run.facts.name}` });
        this.caption = element("div", { className: "caption" });
        this.scaleBar = element("div", { className: "scale-bar" }, element("i"), element("span"));
        this.tip = element("div", { className: "tip", hidden: true });
        this.root = element("section", { className: "pane" }, this.canvas, this.caption, this.scaleBar, this.tip);
    }

    start() {
        this.scene = new Scene(this.canvas, this.run);
        this.canvas.addEventListener("webglcontextlost", (event) => {
            event.preventDefault();
            this.view.say("The graphics were reset. Load the page again.");
        });
    }

    // x0, y0, x1, y1 of blocks as they were first seen, and of all that is drawn beside them.
    get bounds() {
        const { beside, lined } = this.run.facts, off = DIAGRAM * liningReference(this.view.runs, "thrust").size, boxes = [this.blockBounds()];
        if (beside) boxes.push(beside);
        if (lined) boxes.push([lined[0] - off, lined[1] - off, lined[2] + off, lined[3] + off]);
        return [0, 1, 2, 3].map((side) => (side < 2 ? Math.min : Math.max)(...boxes.map((box) => box[side])));
    }

    blockBounds() {
        const { run } = this, box = [Infinity, Infinity, -Infinity, -Infinity];
        let vertex = 0;
        for (let part = 0; part < run.part_size.length; ++part) {
            const block = run.part_block[part];
            for (let i = 0; i < run.part_size[part]; ++i, ++vertex) {
                const x = run.base_x[block] + run.local_x[vertex], y = run.base_y[block] + run.local_y[vertex];
                if (x < box[0]) box[0] = x;
                if (x > box[2]) box[2] = x;
                if (y < box[1]) box[1] = y;
                if (y > box[3]) box[3] = y;
            }
        }
        return box;
    }

    resize() {
        const ratio = window.devicePixelRatio || 1, box = this.root.getBoundingClientRect();
        this.ratio = ratio;
        this.camera.width = Math.max(1, box.width), (this.camera.height = Math.max(1, box.height));
        const width = Math.round(box.width * ratio), height = Math.round(box.height * ratio);
        if (width === this.canvas.width && height === this.canvas.height) return;
        this.canvas.width = Math.max(1, width), (this.canvas.height = Math.max(1, height));
        if (this.frame) this.updateLines();
    }

    // Shows a frame once it is there, unless another one has been asked for by then.
    async show(number) {
        this.wanted = number;
        const [frame, contacts] = await Promise.all([this.run.frame(number), this.run.contacts(number)]);
        if (this.wanted !== number) return false;
        Object.assign(this, { frame, contacts, shown: number });
        this.update();
        return true;
    }

    get entry() {
        return this.run.frames[this.shown];
    }

    update() {
        if (!this.frame) return;
        this.frame.poses(this.scene.pose, this.view.magnify);
        this.paint();
        this.scene.upload(this.view.ground);
        this.updateLines();
        this.view.redraw();
    }

    paint() {
        const { view, frame } = this, name = view.field;
        if (CLASSES[name]) colourByClass(this.scene.colour, frame, CLASSES[name].numbers(frame, view.runs), CLASSES[name].classes(view.runs));
        else colourByValue(this.scene.colour, frame, frame.field(name), view.range, table(view.map, FIELDS[name].signed), FIELDS[name].motion);
    }

    updateColours() {
        if (!this.frame) return;
        this.paint();
        this.scene.recolour(this.view.ground);
    }

    updateLines() {
        const { view, scene, run, contacts, ratio, frame } = this, { layers, ink } = view, pose = scene.pose;
        scene.setLines("outline", layers.outline ? outlineLines(run.facts.outlines[this.entry.outline] ?? [], ratio, ink) : null);
        const force = contacts && layers.forces ? contactReference(run, this.shown, "normal_force") : 0;
        scene.setLines("forces", force > 0 ? forceLines(contacts, run, pose, force, ratio, ink) : null);
        const joint = contacts && view.joint !== "none" ? contactReference(run, this.shown, view.joint) : 0;
        scene.setLines("joints", joint > 0 ? jointLines(contacts, view.joint, run, pose, joint, ratio) : null);
        const bolts = layers.bolts && this.entry.bolts;
        scene.setLines("bolts", bolts ? boltLines(bolts, table("inferno", false), boltReference(view.runs), ratio, ink) : null);
        const lining = view.lining !== "none" && this.entry.liners;
        scene.setLines("linings", lining ? liningLines(frame.chunk, view.lining, liningReference(view.runs, view.lining), ratio, ink) : null);
        const water = layers.water ? run.facts.waters?.[this.entry.water] : null;
        scene.setLines("water", water ? waterLines(water, ratio) : null);
        this.updateCrosses();
        this.mark("pinned", this.pinned);
        this.mark("hovered", this.hovered);
    }

    // Which blocks have one depends on what is in sight.
    updateCrosses() {
        const { view, scene, run } = this, stress = view.layers.crosses ? stressReference(run, this.shown) : 0;
        scene.setLines("crosses", stress > 0 ? crossLines(this.frame, scene.pose, this.camera.view, stress, this.ratio, view.ink) : null);
    }

    mark(layer, block) {
        const there = block >= 0 && this.frame?.present[block];
        this.scene.setLines(layer, there ? blockLines(this.scene, block, (layer === "pinned" ? 3.4 : 2.4) * this.ratio, layer === "pinned" ? [213, 94, 0] : this.view.ink) : null);
    }

    draw() {
        if (!this.frame) return;
        const { view } = this;
        this.isExact = this.scene.draw(this.camera, { ink: rgb("#1c2126"), edges: view.layers.edges, layers: ORDER, ratio: this.ratio });
        clearTimeout(this.later);
        if (!this.isExact) this.later = setTimeout(() => view.redraw(), 160);
        const aim = 90 / this.camera.scale, power = 10 ** Math.floor(Math.log10(aim)), step = [5, 2, 1].find((n) => n * power <= aim) * power;
        this.scaleBar.firstChild.style.width = `${step * this.camera.scale}px`;
        this.scaleBar.lastChild.textContent = step >= 1 ? `${step} m` : step >= 1e-3 ? `${+(step * 1e3).toPrecision(2)} mm` : `${+(step * 1e6).toPrecision(2)} µm`;
    }

    // The block under a place of the screen, -1: none.
    blockAt(px, py) {
        if (!this.frame) return -1;
        const [x, y] = this.camera.toWorld(px, py), { pose } = this.scene, { run, frame } = this;
        for (let i = run.count - 1; i >= 0; --i) {
            const dx = x - pose[4 * i], dy = y - pose[4 * i + 1], r = run.radius[i];
            if (!frame.present[i] || !(dx * dx + dy * dy <= r * r)) continue;
            const c = pose[4 * i + 2], s = pose[4 * i + 3];
            if (this.isInside(i, c * dx + s * dy, c * dy - s * dx)) return i;
        }
        return -1;
    }

    // By the number of outer edges that a ray to the right crosses.
    isInside(block, u, v) {
        const { edgeList, firstEdge, local } = this.scene;
        let inside = false;
        for (let e = firstEdge[block]; e < firstEdge[block + 1]; e += 2) {
            const a = 2 * edgeList[e], b = 2 * edgeList[e + 1];
            if (local[a + 1] > v !== local[b + 1] > v && u < local[a] + ((v - local[a + 1]) * (local[b] - local[a])) / (local[b + 1] - local[a + 1])) inside = !inside;
        }
        return inside;
    }
}
