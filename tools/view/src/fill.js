// Fills convex polygons and lines in an array of pixels, the first row on top. A pixel belongs to the polygon that its middle lies in.

let across = new Float64Array(64), down = new Float64Array(64); // corners in pixels

// All parts of a block. `view`: x, y in the middle, scale [pixels a metre], width, height [pixels]. `stripes`: by x + (height - 1 - y), where not 0 the pixel becomes `stripe`.
export function fillParts(scene, block, view, pixels, value, stripes = null, stripe = 0) {
    const { pose, local, firstPart, partBegin } = scene, p = 4 * block, c = pose[p + 2] * view.scale, s = pose[p + 3] * view.scale;
    const x = 0.5 * view.width + (pose[p] - view.x) * view.scale, y = 0.5 * view.height - (pose[p + 1] - view.y) * view.scale;
    for (let part = firstPart[block]; part < firstPart[block + 1]; ++part) {
        const begin = partBegin[part], corners = partBegin[part + 1] - begin;
        if (corners > across.length) (across = new Float64Array(2 * corners)), (down = new Float64Array(2 * corners));
        for (let k = 0, v = 2 * begin; k < corners; ++k, v += 2) {
            across[k] = x + c * local[v] - s * local[v + 1];
            down[k] = y - s * local[v] - c * local[v + 1];
        }
        fillPolygon(corners, view, pixels, value, stripes, stripe);
    }
}

// Lines as lines.js makes them, opaque.
export function fillLines({ ends, width, colour, count }, view, pixels) {
    const colours = new Uint32Array(colour.buffer, colour.byteOffset, count), { scale } = view;
    for (let i = 0; i < count; ++i) {
        const x0 = 0.5 * view.width + (ends[4 * i] - view.x) * scale, y0 = 0.5 * view.height - (ends[4 * i + 1] - view.y) * scale;
        const x1 = 0.5 * view.width + (ends[4 * i + 2] - view.x) * scale, y1 = 0.5 * view.height - (ends[4 * i + 3] - view.y) * scale;
        const length = Math.hypot(x1 - x0, y1 - y0), wide = Math.max(1, width[i]), u = length > 1e-5 ? (0.5 * wide * (x1 - x0)) / length : 0.5 * wide, v = length > 1e-5 ? (0.5 * wide * (y1 - y0)) / length : 0;
        across.set([x0 - 0.7 * u - v, x1 + 0.7 * u - v, x1 + 0.7 * u + v, x0 - 0.7 * u + v]);
        down.set([y0 - 0.7 * v + u, y1 + 0.7 * v + u, y1 + 0.7 * v - u, y0 - 0.7 * v - u]);
        fillPolygon(4, view, pixels, colours[i], null, 0);
    }
}

function fillPolygon(corners, { width, height }, pixels, value, stripes, stripe) {
    let top = Infinity, bottom = -Infinity;
    for (let k = 0; k < corners; ++k) {
        if (down[k] < top) top = down[k];
        if (down[k] > bottom) bottom = down[k];
    }
    const first = Math.max(0, Math.ceil(top - 0.5)), last = Math.min(height - 1, Math.ceil(bottom - 0.5) - 1);
    for (let row = first; row <= last; ++row) {
        const middle = row + 0.5;
        let left = Infinity, right = -Infinity;
        for (let k = 0, before = corners - 1; k < corners; before = k++) {
            if (down[k] > middle === down[before] > middle) continue;
            const x = across[k] + ((middle - down[k]) * (across[before] - across[k])) / (down[before] - down[k]);
            if (x < left) left = x;
            if (x > right) right = x;
        }
        const from = row * width + Math.max(0, Math.ceil(left - 0.5)), to = row * width + Math.min(width, Math.ceil(right - 0.5));
        if (!stripes) for (let at = from; at < to; ++at) pixels[at] = value;
        else for (let at = from; at < to; ++at) pixels[at] = stripes[at - row * width + height - 1 - row] ? stripe : value;
    }
}
