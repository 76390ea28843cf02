// For models of many blocks: a sheet with the number of the block at each pixel. Colours of another frame, and a picture that is moved or
// zoomed, then cost a look at each pixel and not all blocks again. Blocks that have moved since are drawn over it. It is a quarter wider and
// higher than the screen, and drawn anew when the picture comes to rest, or twice a second while it moves.
import * as twgl from "twgl.js";
import { GONE, HATCHED, HATCHED_MOVED, PLAIN, PLAIN_MOVED } from "./colours.js";
import { NUMBERS, SHEET } from "./shaders.js";

const BORDER = 0.125; // of the screen's width and height, on each side: whole pixels, so that both have the same ones
const SEEN = 0.35; // pixels: a block that has moved less is where it was
const MOST_MOVED = 20000; // blocks, from which on a new sheet is cheaper
const REST = 160; // ms without a move
const EVERY = 500; // ms between two sheets while the picture moves; more where a sheet takes more than a sixth of it

export class Sheet {
    constructor(scene) {
        const { gl } = scene;
        Object.assign(this, { scene, gl, camera: null, cost: 0, at: -Infinity, movedAt: -Infinity, moved: new Uint32Array(0) });
        this.numbers = twgl.createProgramInfo(gl, NUMBERS);
        this.colours = twgl.createProgramInfo(gl, SHEET);
        this.corners = twgl.createBufferInfoFromArrays(gl, { a_corner: { numComponents: 2, data: new Float32Array([-1, -1, 3, -1, -1, 3]) } });
        this.screen = twgl.createVertexArrayInfo(gl, [this.colours], this.corners);
        this.shape = twgl.createVertexArrayInfo(gl, [this.numbers], scene.faceShape.info);
        this.pose = new Float32Array(4 * scene.run.count);
    }

    resize() {
        const { gl, scene } = this, [width, height] = [scene.canvas.width, scene.canvas.height].map((size) => size + 2 * Math.ceil(BORDER * size));
        if (this.width === width && this.height === height) return;
        Object.assign(this, { width, height, camera: null });
        const plain = [{ internalFormat: gl.R32UI, format: gl.RED_INTEGER, type: gl.UNSIGNED_INT, minMag: gl.NEAREST, wrap: gl.CLAMP_TO_EDGE, auto: false }];
        if (this.target) gl.deleteTexture(this.target.attachments[0]), gl.deleteFramebuffer(this.target.framebuffer);
        this.target = twgl.createFramebufferInfo(gl, plain, width, height);
    }

    // Whether the sheet cannot be used for this picture any more, however it is moved.
    isStale(camera, now) {
        const old = this.camera;
        if (!old) return true;
        const still = camera.x === old.x && camera.y === old.y && camera.scale === old.scale;
        if (still) return this.moved.length > MOST_MOVED;
        return now - this.movedAt >= REST - 20 || now - this.at > Math.max(EVERY, 6 * this.cost);
    }

    // Blocks that stand elsewhere than on the sheet. To be called after the scene's poses or colours have changed.
    findMoved() {
        if (!this.camera) return;
        const { scene, pose: old } = this, { pose, colour, run } = scene, far = SEEN / this.camera.scale, found = [];
        for (let i = 0, p = 0; i < run.count; ++i, p += 4) {
            const r = run.radius[i];
            if (colour[p + 3] === GONE) continue;
            if (Math.abs(pose[p] - old[p]) + Math.abs(pose[p + 1] - old[p + 1]) + r * (Math.abs(pose[p + 2] - old[p + 2]) + Math.abs(pose[p + 3] - old[p + 3])) <= far) continue;
            found.push(i);
            if (colour[p + 3] === PLAIN) colour[p + 3] = PLAIN_MOVED;
            else if (colour[p + 3] === HATCHED) colour[p + 3] = HATCHED_MOVED;
        }
        this.moved = found;
    }

    render(camera) {
        const { gl, scene } = this, begin = performance.now(), { canvas, run } = scene;
        this.resize();
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.target.framebuffer);
        gl.viewport(0, 0, this.width, this.height);
        gl.disable(gl.BLEND);
        gl.clearBufferuiv(gl.COLOR, 0, [0, 0, 0, 0]);
        const w = camera.width * (this.width / canvas.width), h = camera.height * (this.height / canvas.height), [dx, dy] = [w / 2 / camera.scale, h / 2 / camera.scale];
        const u_view = [camera.x, camera.y, (2 * camera.scale) / w, (2 * camera.scale) / h], parts = scene.visible([camera.x - dx, camera.y - dy, camera.x + dx, camera.y + dy]);
        scene.drawBlocks(this.numbers, { info: scene.faceShape.info, vertices: this.shape }, scene.firstTriangle, gl.TRIANGLES, { u_view }, parts);
        gl.readPixels(0, 0, 1, 1, gl.RED_INTEGER, gl.UNSIGNED_INT, new Uint32Array(1)); // waits for it, to know what it costs
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        const { colour } = scene;
        for (const i of this.moved)
            if (colour[4 * i + 3] === PLAIN_MOVED) colour[4 * i + 3] = PLAIN;
            else if (colour[4 * i + 3] === HATCHED_MOVED) colour[4 * i + 3] = HATCHED;
        if (this.moved.length) scene.uploadColour();
        this.moved = [];
        this.pose.set(scene.pose.subarray(0, 4 * run.count));
        this.camera = { x: camera.x, y: camera.y, scale: camera.scale };
        this.at = performance.now();
        this.cost = this.at - begin;
    }

    // Says whether it is the picture to the pixel; if not, another one is due when it comes to rest.
    draw(camera, ratio) {
        const { gl, scene } = this, now = performance.now(), { canvas } = scene;
        this.resize();
        if (this.isStale(camera, now)) this.render(camera);
        const old = this.camera, still = camera.x === old.x && camera.y === old.y && camera.scale === old.scale, zoom = old.scale / camera.scale;
        gl.viewport(0, 0, canvas.width, canvas.height);
        gl.useProgram(this.colours.program);
        twgl.setBuffersAndAttributes(gl, this.colours, this.screen);
        const pixels = old.scale * (canvas.width / camera.width);
        const u_shift = [zoom, 0.5 * this.width - 0.5 * canvas.width * zoom + (camera.x - old.x) * pixels, 0.5 * this.height - 0.5 * canvas.height * zoom + (camera.y - old.y) * pixels];
        twgl.setUniforms(this.colours, { u_sheet: this.target.attachments[0], u_colour: scene.colourTexture, u_shift, u_ratio: ratio });
        gl.drawArrays(gl.TRIANGLES, 0, 3);
        return still;
    }
}
