// Models of many blocks, drawn without the graphics processor, which may be a program itself: a sheet with the number of the block at each pixel.
// Another frame, and a picture that is moved or zoomed, then cost a look at each pixel and not all blocks again. Blocks that have moved since are
// drawn over it, and lines. It is a quarter wider and higher than the screen, and drawn anew when the picture comes to rest, or where it ends while it moves.
import { GONE, PLAIN } from "./colours.js";
import { fillLines, fillParts } from "./fill.js";

const BORDER = 0.125; // of the screen's width and height, on each side: whole pixels, so that both have the same ones
const SEEN = 0.35; // pixels: a block that has moved less is where it was
const MOST_MOVED = 20000; // blocks, from which on a new sheet is cheaper
const REST = 160; // ms without a move
const EVERY = 500; // ms between two sheets while the picture moves beyond the sheet; more where a sheet takes more than a sixth of it
const FAR = 1.5; // zoomed in by more than this, pixels of the sheet are too coarse while it moves
const PERIOD = 7, WIDE = 2.2; // hatching in pixels of the screen, as shaders.js has it
const STRIPE = new Uint32Array(new Uint8Array([213, 94, 0, 255]).buffer)[0];

export class Sheet {
    constructor(scene) {
        this.scene = scene;
        this.canvas = document.createElement("canvas");
        this.canvas.className = "flat";
        this.context = this.canvas.getContext("2d", { alpha: false });
        Object.assign(this, { camera: null, cost: 0, at: -Infinity, movedAt: -Infinity, moved: [] });
        this.pose = new Float32Array(4 * scene.run.count);
        this.isMoved = new Uint8Array(scene.run.count);
        this.palette = new Uint32Array(2 * (scene.run.count + 1)); // colours of the ground and the blocks, then those of their stripes
    }

    resize(width, height) {
        if (this.canvas.width === width && this.canvas.height === height && this.image) return;
        Object.assign(this.canvas, { width, height });
        this.image = new ImageData(width, height);
        this.pixels = new Uint32Array(this.image.data.buffer);
        this.width = width + 2 * Math.ceil(BORDER * width), (this.height = height + 2 * Math.ceil(BORDER * height));
        this.numbers = new Uint32Array(this.width * this.height);
        this.column = new Int32Array(width);
        this.stripes = new Uint32Array(width + height);
        this.camera = null;
    }

    // Whether the sheet cannot be used for this picture any more, however it is moved.
    isStale(camera, now) {
        const old = this.camera;
        if (!old) return true;
        if (isSame(camera, old)) return this.moved.length > MOST_MOVED;
        if (now - this.movedAt >= REST - 20) return true;
        const border = 1 + 2 * BORDER, beyond = (size, way) => 0.5 * size + Math.abs(way) * camera.scale > 0.5 * size * border * (camera.scale / old.scale);
        const ends = beyond(camera.width, camera.x - old.x) || beyond(camera.height, camera.y - old.y);
        return (ends || camera.scale > FAR * old.scale) && now - this.at > Math.max(EVERY, 6 * this.cost);
    }

    // Blocks that stand elsewhere than on the sheet. To be called after the scene's poses or colours have changed.
    findMoved() {
        this.isPainted = false;
        if (!this.camera) return;
        const { scene, pose: old, isMoved } = this, { pose, colour, run } = scene, far = SEEN / this.camera.scale, found = [];
        for (let i = 0, p = 0; i < run.count; ++i, p += 4) {
            const way = Math.abs(pose[p] - old[p]) + Math.abs(pose[p + 1] - old[p + 1]) + run.radius[i] * (Math.abs(pose[p + 2] - old[p + 2]) + Math.abs(pose[p + 3] - old[p + 3]));
            isMoved[i] = way <= far || colour[p + 3] === GONE ? 0 : 1;
            if (isMoved[i]) found.push(i);
        }
        this.moved = found;
    }

    render(camera) {
        const { scene, width, height, numbers } = this, begin = performance.now(), { run, colour } = scene, ratio = this.canvas.width / camera.width;
        const wide = { x: camera.x, y: camera.y, scale: camera.scale * ratio, width, height };
        numbers.fill(0);
        const [dx, dy] = [width / 2 / wide.scale, height / 2 / wide.scale];
        for (const [first, end] of scene.visible([camera.x - dx, camera.y - dy, camera.x + dx, camera.y + dy]))
            for (let block = first; block < end; ++block) if (colour[4 * block + 3] !== GONE) fillParts(scene, block, wide, numbers, block + 1);
        Object.assign(this, { moved: [], isPainted: false, camera: { x: camera.x, y: camera.y, scale: camera.scale } });
        this.isMoved.fill(0);
        this.pose.set(scene.pose.subarray(0, 4 * run.count));
        this.at = performance.now();
        this.cost = this.at - begin;
    }

    // Colours of all numbers. What has moved or is gone shows the ground.
    paint(ratio) {
        const { scene, palette, isMoved, stripes } = this, { run, allColours, colour } = scene, count = run.count + 1;
        const colours = new Uint32Array(allColours.buffer, 0, count), ground = colours[0];
        palette[0] = palette[count] = ground;
        this.hatched = false;
        for (let i = 0; i < run.count; ++i) {
            const state = colour[4 * i + 3], seen = state !== GONE && !isMoved[i], own = seen ? (colours[i + 1] | OPAQUE) >>> 0 : ground, isPlain = !seen || state === PLAIN;
            palette[i + 1] = own;
            palette[count + i + 1] = isPlain ? own : STRIPE;
            if (!isPlain) this.hatched = true;
        }
        for (let n = 0; n < stripes.length; ++n) stripes[n] = ((n + 1) / ratio) % PERIOD < WIDE ? count : 0;
        this.isPainted = true;
    }

    // Says whether it is the picture to the pixel; if not, another one is due when it comes to rest.
    draw(camera, ratio, layers) {
        const { canvas } = this.scene;
        this.resize(canvas.width, canvas.height);
        if (this.isStale(camera, performance.now())) this.render(camera);
        if (!this.isPainted) this.paint(ratio);
        this.look(camera);
        const { width, height } = this.canvas, view = { x: camera.x, y: camera.y, scale: camera.scale * (width / camera.width), width, height };
        this.drawMoved(view);
        for (const [, lines] of layers) fillLines(lines, view, this.pixels);
        this.context.putImageData(this.image, 0, 0);
        return isSame(camera, this.camera);
    }

    // Each pixel of the screen, from the sheet.
    look(camera) {
        const { pixels, palette, numbers, column, stripes, width, height, camera: old } = this, { width: w, height: h } = this.canvas, ground = palette[0];
        const step = old.scale / camera.scale, scale = old.scale * (w / camera.width);
        const left = 0.5 * width - 0.5 * w * step + (camera.x - old.x) * scale, top = 0.5 * height - 0.5 * h * step - (camera.y - old.y) * scale;
        for (let x = 0; x < w; ++x) column[x] = Math.floor(left + (x + 0.5) * step);
        let begin = 0, end = w;
        while (begin < w && column[begin] < 0) ++begin;
        while (end > begin && column[end - 1] >= width) --end;
        for (let y = 0, at = 0; y < h; ++y, at += w) {
            const row = Math.floor(top + (y + 0.5) * step);
            if (row < 0 || row >= height) {
                pixels.fill(ground, at, at + w);
                continue;
            }
            if (begin > 0) pixels.fill(ground, at, at + begin);
            if (end < w) pixels.fill(ground, at + end, at + w);
            const from = row * width, stripe = h - 1 - y;
            if (this.hatched) for (let x = begin; x < end; ++x) pixels[at + x] = palette[numbers[from + column[x]] + stripes[x + stripe]];
            else for (let x = begin; x < end; ++x) pixels[at + x] = palette[numbers[from + column[x]]];
        }
    }

    drawMoved(view) {
        const { scene, pixels } = this, { colour, allColours } = scene, colours = new Uint32Array(allColours.buffer);
        for (const block of this.moved) fillParts(scene, block, view, pixels, (colours[block + 1] | OPAQUE) >>> 0, colour[4 * block + 3] === PLAIN ? null : this.stripes, STRIPE);
    }
}

const OPAQUE = 0xff000000;
const isSame = (a, b) => a.x === b.x && a.y === b.y && a.scale === b.scale;
