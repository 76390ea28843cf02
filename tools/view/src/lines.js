// What is drawn over the blocks as lines: outlines of excavations, contacts, principal stresses, support, water, the block under the pointer.

export class Lines {
    constructor(most) {
        this.ends = new Float32Array(4 * most);
        this.width = new Float32Array(most);
        this.colour = new Uint8Array(4 * most);
        this.count = 0;
    }

    add(x0, y0, x1, y1, width, [r, g, b], alpha = 255) {
        const i = this.count++;
        this.ends[4 * i] = x0, (this.ends[4 * i + 1] = y0), (this.ends[4 * i + 2] = x1), (this.ends[4 * i + 3] = y1);
        this.width[i] = width;
        this.colour[4 * i] = r, (this.colour[4 * i + 1] = g), (this.colour[4 * i + 2] = b), (this.colour[4 * i + 3] = alpha);
    }

    cut() {
        const n = this.count;
        return { ends: this.ends.subarray(0, 4 * n), width: this.width.subarray(0, n), colour: this.colour.subarray(0, 4 * n), count: n };
    }
}

// With a light seam, so that it is seen on rock and on a dark ground.
export function outlineLines(flat, ratio, colour) {
    const lines = new Lines(flat.length / 2);
    for (const [width, own] of [[4.2 * ratio, SEAM], [2.2 * ratio, colour]])
        for (let i = 0; i < flat.length; i += 4) lines.add(flat[i], flat[i + 1], flat[i + 2], flat[i + 3], width, own);
    return lines.cut();
}

const IMPULSE = 3;
const ORANGE = [213, 94, 0], RED = [204, 51, 17], BLUE = [0, 114, 178], SEAM = [214, 219, 225];

// Both ends of contact number i, where the frame has its first block.
export function endsOfContact(contacts, i, run, pose, out) {
    const row = contacts.row[i], block = contacts.rows.first[row], r = run.radius[block];
    const x = pose[4 * block], y = pose[4 * block + 1], c = pose[4 * block + 2], s = pose[4 * block + 3], e = contacts.rows.ends;
    for (let end = 0; end < 2; ++end) {
        const u = e[2 * end][row] * r, v = e[2 * end + 1][row] * r;
        out[2 * end] = x + c * u - s * v;
        out[2 * end + 1] = y + s * u + c * v;
    }
    return out;
}

// From centroid to contact to centroid, as wide as the normal force is great. Those below a fiftieth of the widest are left out.
export function forceLines(contacts, run, pose, reference, ratio, ink) {
    const force = contacts.get("normal_force"), lines = new Lines(2 * force.length), ends = [0, 0, 0, 0], widest = 6 * ratio;
    for (let i = 0; i < force.length; ++i) {
        const width = widest * Math.min(1, force[i] / reference);
        if (!(width > 0.02 * widest)) continue;
        endsOfContact(contacts, i, run, pose, ends);
        const row = contacts.row[i], a = contacts.rows.first[row], b = contacts.rows.second[row];
        const x = 0.5 * (ends[0] + ends[2]), y = 0.5 * (ends[1] + ends[3]), colour = contacts.regime[i] === IMPULSE ? ORANGE : ink;
        lines.add(pose[4 * a], pose[4 * a + 1], x, y, Math.max(width, 0.5), colour);
        lines.add(x, y, pose[4 * b], pose[4 * b + 1], Math.max(width, 0.5), colour);
    }
    return lines.cut();
}

// Name of the quantity of a joint -> label, unit, value of each contact
export const JOINTS = {
    slip: { label: "Slip since the stage began", unit: "m" },
    mobilised_friction: { label: "Mobilised friction", unit: "deg" },
    normal_force: { label: "Normal force", unit: "N" },
    shear_force: { label: "Shear force", unit: "N" },
    plastic_slip: { label: "Plastic slip", unit: "m" },
    opening: { label: "Opening by dilation", unit: "m" },
    damage: { label: "Damage", unit: "" },
    broken: { label: "Broken", unit: "" },
    pore_pressure: { label: "Water pressure", unit: "Pa" },
};

export function jointValues(contacts, name) {
    if (name !== "mobilised_friction") return contacts.has(name) ? contacts.get(name) : null;
    const shear = contacts.get("shear_force");
    return Float32Array.from(contacts.get("normal_force"), (normal, i) => (Math.atan2(Math.abs(shear[i]), normal) * 180) / Math.PI);
}

export function jointLines(contacts, name, run, pose, reference, ratio) {
    const values = jointValues(contacts, name);
    if (!values) return null;
    const lines = new Lines(values.length), ends = [0, 0, 0, 0], widest = 7 * ratio;
    for (let i = 0; i < values.length; ++i) {
        const width = widest * Math.min(1, Math.abs(values[i]) / reference);
        if (!(width > 0.04 * widest)) continue;
        endsOfContact(contacts, i, run, pose, ends);
        lines.add(...ends, width, RED);
    }
    return lines.cut();
}

// Crosses of principal stresses: in each block, or in the greatest one of each cell where there are too many.
export function crossLines(frame, pose, [x0, y0, x1, y1], reference, ratio, ink, most = 900) {
    const run = frame.run, cell = Math.sqrt(((x1 - x0) * (y1 - y0)) / most), columns = Math.ceil((x1 - x0) / cell), greatest = new Map();
    for (let i = 0; i < run.count; ++i) {
        const x = pose[4 * i], y = pose[4 * i + 1];
        if (!frame.present[i] || !(x >= x0 && x <= x1 && y >= y0 && y <= y1)) continue;
        const place = Math.floor((x - x0) / cell) + columns * Math.floor((y - y0) / cell), other = greatest.get(place);
        if (other === undefined || run.area[i] > run.area[other]) greatest.set(place, i);
    }
    const xx = frame.get("stress_xx"), yy = frame.get("stress_yy"), xy = frame.get("stress_xy");
    const s1 = frame.field("stress_1"), s3 = frame.field("stress_3"), lines = new Lines(2 * greatest.size);
    const areas = Float32Array.from(greatest.values(), (i) => run.area[i]).sort();
    const scale = (0.55 * Math.max(cell, Math.sqrt(areas[areas.length >> 1] ?? 0))) / reference;
    for (const i of greatest.values()) {
        const angle = 0.5 * Math.atan2(2 * xy[i], xx[i] - yy[i]);
        for (const [value, turn] of [[s1[i], angle], [s3[i], angle + 0.5 * Math.PI]]) {
            const half = scale * Math.min(Math.abs(value), 1.5 * reference);
            if (!(half > 0)) continue;
            const dx = half * Math.cos(turn), dy = half * Math.sin(turn), x = pose[4 * i], y = pose[4 * i + 1];
            lines.add(x - dx, y - dy, x + dx, y + dy, 1.3 * ratio, value >= 0 ? ink : BLUE);
        }
    }
    return lines.cut();
}

// Coloured by their axial force.
export function boltLines(bolts, colours, greatest, ratio, ink) {
    const lines = new Lines(2 * bolts.ends.length);
    for (const ends of bolts.ends) lines.add(...ends, 5 * ratio, ink);
    bolts.ends.forEach((ends, i) => {
        const place = 3 * Math.round(255 * Math.min(1, Math.max(0, bolts.force[i] / greatest)));
        lines.add(...ends, 3.2 * ratio, colours.subarray(place, place + 3));
    });
    return lines.cut();
}

// What linings carry -> label, unit, names of the values at both ends of a segment
export const LININGS = {
    thrust: { label: "Thrust", unit: "N", of: ["liner_thrust", "liner_thrust"] },
    moment: { label: "Moment", unit: "N m", of: ["liner_moment_from", "liner_moment_to"] },
};
export const DIAGRAM = 0.12; // of the size of all linings: where the greatest value stands

// Linings, and off them their diagram: inside where it is compressed, or where its inside is stretched.
export function liningLines(chunk, name, { greatest, size }, ratio, ink) {
    if (!chunk.has("liner_ends")) return null;
    const ends = chunk.get("liner_ends"), count = ends.length / 4, lines = new Lines(5 * count);
    const values = LININGS[name]?.of.map((one) => chunk.get(one)), scale = greatest > 0 ? (DIAGRAM * size) / greatest : 0;
    for (let i = 0; i < count; ++i) lines.add(...ends.subarray(4 * i, 4 * i + 4), 5 * ratio, SEAM);
    for (let i = 0; values && i < count; ++i) {
        const [x0, y0, x1, y1] = ends.subarray(4 * i, 4 * i + 4), length = Math.hypot(x1 - x0, y1 - y0) || 1;
        const u = (-scale * (y1 - y0)) / length, v = (scale * (x1 - x0)) / length, [a, b] = [values[0][i], values[1][i]];
        if (!(Number.isFinite(a) && Number.isFinite(b))) continue;
        lines.add(x0, y0, x0 + a * u, y0 + a * v, 0.8 * ratio, ORANGE);
        lines.add(x1, y1, x1 + b * u, y1 + b * v, 0.8 * ratio, ORANGE);
        lines.add(x0 + a * u, y0 + a * v, x1 + b * u, y1 + b * v, 2 * ratio, ORANGE);
    }
    for (let i = 0; i < count; ++i) lines.add(...ends.subarray(4 * i, 4 * i + 4), 3 * ratio, ink);
    return lines.cut();
}

// The water table, dashed. `flat`: x0, y0, x1, y1, ... from one end of the model to the other.
export function waterLines(flat, ratio) {
    const points = [];
    for (let i = 0; i < flat.length; i += 2) points.push([flat[i], flat[i + 1]]);
    const lengths = points.slice(1).map(([x, y], i) => Math.hypot(x - points[i][0], y - points[i][1]));
    const dash = lengths.reduce((sum, one) => sum + one, 0) / 80;
    if (!(dash > 0)) return null;
    const pieces = lengths.map((length) => Math.max(1, 2 * Math.round(length / (2 * dash)))), lines = new Lines(2 * pieces.reduce((sum, one) => sum + one, 0));
    for (const [width, colour] of [[4.4 * ratio, SEAM], [2.4 * ratio, BLUE]])
        points.slice(1).forEach(([x1, y1], i) => {
            const [x0, y0] = points[i], at = (t) => [x0 + t * (x1 - x0), y0 + t * (y1 - y0)];
            for (let n = 0; n < pieces[i]; n += 2) lines.add(...at(n / pieces[i]), ...at((n + 1) / pieces[i]), width, colour);
        });
    return lines.cut();
}

// Edges of one block.
export function blockLines(scene, block, width, colour) {
    const { edgeList, firstEdge, local, pose } = scene, begin = firstEdge[block], end = firstEdge[block + 1], lines = new Lines((end - begin) / 2);
    const [x, y, c, s] = pose.subarray(4 * block, 4 * block + 4);
    const place = (v) => [x + c * local[2 * v] - s * local[2 * v + 1], y + s * local[2 * v] + c * local[2 * v + 1]];
    for (let e = begin; e < end; e += 2) lines.add(...place(edgeList[e]), ...place(edgeList[e + 1]), width, colour);
    return lines.cut();
}
