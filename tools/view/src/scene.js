// Draws one run on one canvas.
import * as twgl from "twgl.js";
import { EDGES, FACES, LINES } from "./shaders.js";
import { Sheet } from "./sheet.js";

const WIDTH = 1024; // of the textures: block i has number i + 1, and number n stands in column n % WIDTH; number 0 is the ground
const CHUNK = 1024; // blocks that are left out together when none of them is in sight
const MANY = 20000; // blocks in sight, from which on they are drawn by way of a sheet, without edges; models of more are not smoothed

export class Scene {
    constructor(canvas, run) {
        const gl = canvas.getContext("webgl2", { antialias: run.count < MANY, alpha: false, depth: false, stencil: false, powerPreference: "high-performance" });
        if (!gl) throw new Error("this browser has no WebGL 2, or it is switched off");
        Object.assign(this, { canvas, gl, run });
        this.faces = twgl.createProgramInfo(gl, FACES);
        this.edges = twgl.createProgramInfo(gl, EDGES);
        this.lines = twgl.createProgramInfo(gl, LINES);
        this.layers = new Map();
        this.buffers = new Map();
        this.makeShapes();
        const rows = Math.max(1, Math.ceil((run.count + 1) / WIDTH));
        this.allPoses = new Float32Array(4 * WIDTH * rows);
        this.allColours = new Uint8Array(4 * WIDTH * rows);
        this.pose = this.allPoses.subarray(4); // of block i from 4 * i
        this.colour = this.allColours.subarray(4);
        const plain = { width: WIDTH, height: rows, minMag: gl.NEAREST, wrap: gl.CLAMP_TO_EDGE, auto: false };
        this.poseTexture = twgl.createTexture(gl, { ...plain, internalFormat: gl.RGBA32F, src: this.allPoses });
        this.colourTexture = twgl.createTexture(gl, { ...plain, internalFormat: gl.RGBA, src: this.allColours });
        this.rows = rows;
        if (run.count < MANY) return;
        this.sheet = new Sheet(this);
        this.flat = this.sheet.canvas;
        canvas.before(this.flat);
    }

    // Fans of triangles of convex parts, and outer edges; both in the order of blocks.
    makeShapes() {
        const { run, gl } = this, vertices = run.local_x.length;
        const local = new Float32Array(2 * vertices), block = new Uint32Array(vertices);
        const triangles = new Uint32Array(3 * (vertices - 2 * run.part_size.length)), edges = new Uint32Array(2 * run.outer.reduce((sum, one) => sum + one, 0));
        const firstTriangle = new Uint32Array(run.count + 1), firstEdge = new Uint32Array(run.count + 1), firstPart = new Uint32Array(run.count + 1);
        const partBegin = new Uint32Array(run.part_size.length + 1);
        let t = 0, e = 0, begin = 0;
        for (let part = 0; part < run.part_size.length; ++part) {
            const size = run.part_size[part], owner = run.part_block[part];
            for (let i = 0; i < size; ++i) {
                const v = begin + i;
                local[2 * v] = run.local_x[v], (local[2 * v + 1] = run.local_y[v]), (block[v] = owner + 1);
                if (i >= 2) triangles[t++] = begin, (triangles[t++] = v - 1), (triangles[t++] = v);
                if (run.outer[v]) edges[e++] = v, (edges[e++] = begin + ((i + 1) % size));
            }
            begin += size;
            partBegin[part + 1] = begin;
            firstTriangle[owner + 1] = t, (firstEdge[owner + 1] = e), (firstPart[owner + 1] = part + 1);
        }
        Object.assign(this, { local, block, firstTriangle, firstEdge, firstPart, partBegin, edgeList: edges });
        const shared = { a_local: { numComponents: 2, data: local }, a_block: { numComponents: 1, data: block } };
        const both = twgl.createBufferInfoFromArrays(gl, { ...shared, indices: { numComponents: 3, data: triangles } });
        const onlyEdges = { ...both, indices: twgl.createBufferFromTypedArray(gl, edges, gl.ELEMENT_ARRAY_BUFFER), numElements: e };
        this.faceShape = { info: both, vertices: twgl.createVertexArrayInfo(gl, [this.faces], both) };
        this.edgeShape = { info: onlyEdges, vertices: twgl.createVertexArrayInfo(gl, [this.edges], onlyEdges) };
        const sizes = Float32Array.from(run.radius).sort();
        this.typicalSize = 2 * (sizes[sizes.length >> 1] ?? 1);
    }

    // After `pose` and `colour` have changed.
    upload(ground) {
        this.posesDue = true;
        this.recolour(ground);
        this.findBounds();
    }

    // Only when blocks are drawn: a sheet needs none of them as long as nothing moves.
    uploadDue() {
        const { gl, rows } = this;
        if (this.coloursDue) {
            gl.bindTexture(gl.TEXTURE_2D, this.colourTexture);
            gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, WIDTH, rows, gl.RGBA, gl.UNSIGNED_BYTE, this.allColours);
        }
        this.coloursDue = false;
        if (!this.posesDue) return;
        this.posesDue = false;
        gl.bindTexture(gl.TEXTURE_2D, this.poseTexture);
        gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, WIDTH, rows, gl.RGBA, gl.FLOAT, this.allPoses);
    }

    // After `colour` has changed.
    recolour(ground) {
        this.allColours.set([...ground, 255]);
        this.groundColour = [...ground.map((one) => one / 255), 1];
        this.sheet?.findMoved();
        this.coloursDue = true;
    }

    findBounds() {
        const { run, pose } = this, chunks = Math.ceil(run.count / CHUNK);
        this.bounds ??= new Float64Array(4 * chunks);
        for (let c = 0; c < chunks; ++c) {
            let x0 = Infinity, y0 = Infinity, x1 = -Infinity, y1 = -Infinity;
            for (let i = c * CHUNK; i < Math.min(run.count, (c + 1) * CHUNK); ++i) {
                const x = pose[4 * i], y = pose[4 * i + 1], r = run.radius[i];
                if (x - r < x0) x0 = x - r;
                if (x + r > x1) x1 = x + r;
                if (y - r < y0) y0 = y - r;
                if (y + r > y1) y1 = y + r;
            }
            this.bounds.set([x0, y0, x1, y1], 4 * c);
        }
    }

    // Runs of blocks that may be in sight: [first, one behind the last]
    visible([x0, y0, x1, y1]) {
        const found = [], { bounds, run } = this;
        for (let c = 0; 4 * c < bounds.length; ++c) {
            if (!(bounds[4 * c] <= x1 && bounds[4 * c + 2] >= x0 && bounds[4 * c + 1] <= y1 && bounds[4 * c + 3] >= y0)) continue;
            const last = found[found.length - 1], begin = c * CHUNK, end = Math.min(run.count, begin + CHUNK);
            if (last && last[1] === begin) last[1] = end;
            else found.push([begin, end]);
        }
        return found;
    }

    // Lines of a layer: { ends: x0 y0 x1 y1 each, width: pixels each, colour: four bytes each, count }. Null: none.
    setLines(layer, lines) {
        if (!lines || !lines.count) this.layers.delete(layer);
        else this.layers.set(layer, lines);
    }

    // Buffers of a layer stay; they are filled when it is drawn for the first time.
    buffersOf(layer, { ends, width, colour }) {
        const { gl } = this, data = { a_ends: ends, a_width: width, a_colour: colour };
        if (!this.buffers.has(layer)) {
            const info = twgl.createBufferInfoFromArrays(gl, {
                a_corner: { numComponents: 2, data: new Float32Array([0, -0.5, 0, 0.5, 1, -0.5, 1, 0.5]) },
                a_ends: { numComponents: 4, data: ends, divisor: 1 },
                a_width: { numComponents: 1, data: width, divisor: 1 },
                a_colour: { numComponents: 4, data: colour, divisor: 1, normalize: true, type: gl.UNSIGNED_BYTE },
            });
            this.buffers.set(layer, { info, data, vertices: twgl.createVertexArrayInfo(gl, [this.lines], info) });
        }
        const made = this.buffers.get(layer);
        if (made.data.a_ends !== ends) for (const [name, values] of Object.entries(data)) twgl.setAttribInfoBufferFromArray(gl, made.info.attribs[name], values);
        made.data = data;
        return made.vertices;
    }

    drawBlocks(program, shape, first, mode, uniforms, parts) {
        const { gl } = this;
        if (!parts.length) return;
        this.uploadDue();
        gl.useProgram(program.program);
        twgl.setBuffersAndAttributes(gl, program, shape.vertices);
        twgl.setUniforms(program, { ...uniforms, u_pose: this.poseTexture, u_colour: this.colourTexture });
        for (const [begin, end] of parts)
            if (first[end] > first[begin]) gl.drawElements(mode, first[end] - first[begin], gl.UNSIGNED_INT, 4 * first[begin]);
    }

    // `layers`: names in the order in which they are drawn. Says whether the picture is as it is to stay.
    draw(camera, { ink, edges, layers, ratio }) {
        const parts = this.visible(camera.view), inSight = parts.reduce((sum, [begin, end]) => sum + end - begin, 0), isFlat = this.sheet && inSight >= MANY;
        const lines = layers.filter((name) => this.layers.has(name)).map((name) => [name, this.layers.get(name)]);
        this.show(isFlat);
        if (isFlat) return this.sheet.draw(camera, ratio, lines);
        const { gl, canvas } = this, u_view = [camera.x, camera.y, (2 * camera.scale) / camera.width, (2 * camera.scale) / camera.height];
        gl.viewport(0, 0, canvas.width, canvas.height);
        gl.clearBufferfv(gl.COLOR, 0, this.groundColour);
        gl.disable(gl.BLEND);
        this.drawBlocks(this.faces, this.faceShape, this.firstTriangle, gl.TRIANGLES, { u_view, u_ratio: ratio }, parts);
        gl.enable(gl.BLEND);
        gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
        const alpha = edges && inSight < MANY ? Math.min(1, Math.max(0, (this.typicalSize * camera.scale - 4) / 14)) : 0; // blocks of few pixels would be ink only
        if (alpha > 0.02)
            this.drawBlocks(this.edges, this.edgeShape, this.firstEdge, gl.LINES, { u_view, u_ink: [ink[0] / 255, ink[1] / 255, ink[2] / 255, 0.75 * alpha] }, parts);
        gl.useProgram(this.lines.program);
        for (const [name, layer] of lines) {
            twgl.setBuffersAndAttributes(gl, this.lines, this.buffersOf(name, layer));
            twgl.setUniforms(this.lines, { u_view, u_size: [canvas.width / 2, canvas.height / 2] });
            gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, layer.count);
        }
        return true;
    }

    // Which of the two canvases is on the screen. What is transparent costs nothing, but still has the pointer.
    show(isFlat) {
        if (!this.flat) return;
        this.flat.hidden = !isFlat;
        this.canvas.style.opacity = isFlat ? 0 : 1;
    }

    get seen() {
        return this.flat && !this.flat.hidden ? this.flat : this.canvas;
    }
}
