// Reads the chunks that coding.py writes: base64 of zlib of arrays, one after the other.

const HALF = new Float32Array(65536);
for (let i = 0; i < 65536; ++i) {
    const sign = i & 0x8000 ? -1 : 1, exponent = (i >> 10) & 31, digits = i & 1023;
    HALF[i] = exponent === 0 ? sign * digits * 2 ** -24 : exponent === 31 ? NaN : sign * (1 + digits / 1024) * 2 ** (exponent - 15);
}
const SIZE = { f8: 8, f4: 4, f2: 2, i2: 2, u4: 4, u1: 1, text: 1 };

function bytesOfBase64(text) {
    if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
    const characters = atob(text), bytes = new Uint8Array(characters.length);
    for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
    return bytes;
}

async function inflate(bytes) {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

// The lowest bytes of all numbers stand first, then the next ones.
function unshuffled(bytes, size) {
    const count = bytes.length / size, out = new Uint8Array(bytes.length);
    for (let place = 0; place < size; ++place)
        for (let i = 0, from = place * count, to = place; i < count; ++i, ++from, to += size) out[to] = bytes[from];
    return out.buffer;
}

function decoded(coding, bytes, scale) {
    if (coding === "text") return new TextDecoder().decode(bytes).split("\n");
    if (coding === "u1") return bytes;
    const buffer = unshuffled(bytes, SIZE[coding]);
    if (coding === "f8") return new Float64Array(buffer);
    if (coding === "f4") return new Float32Array(buffer);
    if (coding === "f2") return Float32Array.from(new Uint16Array(buffer), (half) => HALF[half] * scale);
    if (coding === "i2") return Float32Array.from(new Int16Array(buffer), (value) => value * scale);
    const values = new Uint32Array(buffer);
    for (let i = 1; i < values.length; ++i) values[i] += values[i - 1];
    return values;
}

// Arrays by name, each decoded when it is first asked for.
export class Chunk {
    constructor(layout, bytes) {
        this.bytes = bytes;
        this.places = new Map();
        this.ready = new Map();
        let begin = 0;
        for (const [name, coding, count, scale = 1] of layout) {
            this.places.set(name, { coding, scale, begin, end: begin + count * SIZE[coding] });
            begin += count * SIZE[coding];
        }
        if (begin !== bytes.length) throw new Error("a part of the page is damaged; make it again with hdem view");
    }

    has(name) {
        return this.places.has(name);
    }

    get(name) {
        if (!this.ready.has(name)) {
            const { coding, scale, begin, end } = this.places.get(name);
            this.ready.set(name, decoded(coding, this.bytes.subarray(begin, end), scale));
        }
        return this.ready.get(name);
    }
}

export async function readChunk({ id, layout }) {
    const element = document.getElementById(id);
    if (!element) throw new Error("the page is cut off; make it again with hdem view");
    return new Chunk(layout, await inflate(bytesOfBase64(element.textContent.trim())));
}
