// One run of the page: its shapes, and its frames as they are asked for.
import { readChunk } from "./coding.js";
import { FIELDS, FLAG } from "./fields.js";

const MOST_BYTES = 600e6; // of frames that are kept

class Frame {
    constructor(run, entry, chunk) {
        Object.assign(this, { run, entry, chunk, values: new Map() });
        const count = run.count, given = chunk.has("index") ? chunk.get("index") : null;
        this.slots = given && given.length < count ? given : null; // null: the first ones, as a rule all
        this.present = new Uint8Array(count);
        if (this.slots) for (const slot of this.slots) this.present[slot] = 1;
        else this.present.fill(1, 0, chunk.get("flags").length);
        this.flags = this.spread(chunk.get("flags"), Uint8Array, 0);
    }

    spread(values, type = Float32Array, absent = NaN) {
        if (!this.slots && values.length === this.run.count) return values;
        const all = new type(this.run.count).fill(absent);
        if (this.slots) for (let i = 0; i < values.length; ++i) all[this.slots[i]] = values[i];
        else all.set(values);
        return all;
    }

    // What the file has, for each block; not a number for those that are gone.
    get(name) {
        if (!this.values.has(name)) this.values.set(name, this.spread(this.chunk.get(name)));
        return this.values.get(name);
    }

    field(name) {
        const key = `field ${name}`;
        if (!this.values.has(key)) this.values.set(key, FIELDS[name].values(this));
        return this.values.get(key);
    }

    // x, y, cosine, sine of each block; displacements and rotations since the stage began are drawn `times` as large.
    poses(out, times = 1) {
        const run = this.run, from = run.references[this.entry.reference];
        const x = this.get("displacement_x"), y = this.get("displacement_y"), turn = this.get("rotation");
        for (let i = 0; i < run.count; ++i) {
            const angle = from.angle[i] + times * turn[i];
            out[4 * i] = run.base_x[i] + from.x[i] + times * x[i];
            out[4 * i + 1] = run.base_y[i] + from.y[i] + times * y[i];
            out[4 * i + 2] = Math.cos(angle);
            out[4 * i + 3] = Math.sin(angle);
        }
        return out;
    }

    get isEmpty() {
        return this.chunk.get("flags").length === 0;
    }

    isDetached(block) {
        return (this.flags[block] & FLAG.detached) !== 0;
    }
}

export class Run {
    static async open(facts) {
        const run = new Run();
        run.facts = facts;
        run.count = facts.blocks;
        run.frames = facts.frames;
        run.waiting = new Map();
        run.bytes = 0;
        const chunk = await readChunk(facts.static);
        for (const name of ["id", "base_x", "base_y", "area", "mass", "radius", "material", "local_x", "local_y", "part_size", "part_block", "outer", "names"])
            run[name] = chunk.get(name);
        run.references = [];
        for (let i = 0; chunk.has(`reference_x/${i}`); ++i)
            run.references.push({ x: chunk.get(`reference_x/${i}`), y: chunk.get(`reference_y/${i}`), angle: chunk.get(`reference_angle/${i}`) });
        return run;
    }

    frame(number) {
        if (!this.waiting.has(number)) {
            const entry = this.frames[number];
            this.waiting.set(number, readChunk(entry.chunk).then((chunk) => {
                this.bytes += chunk.bytes.length;
                return new Frame(this, entry, chunk);
            }));
            this.forget(number);
        }
        return this.waiting.get(number);
    }

    forget(wanted) {
        for (const number of [...this.waiting.keys()]) {
            if (this.bytes < MOST_BYTES) return;
            if (number === wanted) continue;
            this.waiting.get(number).then((frame) => (this.bytes -= frame.chunk.bytes.length));
            this.waiting.delete(number);
        }
    }

    // Contacts of a frame as arrays: the two blocks, both ends about the first one, and what they carry. Null where the page has none.
    contacts(number) {
        const entry = this.frames[number].contacts;
        if (!entry) return Promise.resolve(null);
        this.contactWaiting ??= new Map();
        if (!this.contactWaiting.has(number)) {
            if (this.contactWaiting.size > 40) this.contactWaiting.delete(this.contactWaiting.keys().next().value);
            this.contactWaiting.set(number, this.readContacts(entry));
        }
        return this.contactWaiting.get(number);
    }

    async readContacts(entry) {
        this.rows ??= readChunk(this.facts.rows);
        const [rows, chunk] = await Promise.all([this.rows, readChunk(entry)]);
        return { rows: { first: rows.get("first"), second: rows.get("second"), ends: ["x0", "y0", "x1", "y1"].map((name) => rows.get(name)) },
                 row: chunk.get("row"), regime: chunk.get("regime"), has: (name) => chunk.has(name), get: (name) => chunk.get(name) };
    }

    async tables() {
        this.tableChunk ??= readChunk(this.facts.tables_chunk);
        const chunk = await this.tableChunk;
        return this.facts.tables.map(({ name, columns }, number) => ({
            name, columns: columns.map(([column, unit]) => ({ name: column, unit, values: chunk.get(`${number}/${column}`) })), time: chunk.get(`${number}/time`),
        }));
    }
}
